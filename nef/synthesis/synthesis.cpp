// SPDX-License-Identifier: Apache-2.0
#include "nef/synthesis/synthesis.h"

#include <algorithm>
#include <array>

#include "nef/base/interruption.h"
#include "nef/base/parallel.h"
#include "nef/base/progress.h"
#include "nef/complex/owners.h"
#include "nef/synthesis/edge_linking.h"
#include "nef/synthesis/facet_linking.h"
#include "nef/synthesis/volume_linking.h"

namespace nef {
namespace {

// The largest mark of some items, or `largest` if that is larger.
template <typename Items>
LabelId largest_mark(const Items& items, LabelId largest, std::size_t step = 1) {
  for (std::size_t i = 0; i < items.size(); i += step) {
    const LabelId mark = items[i].mark;
    if (mark != kOutside && mark > largest) largest = mark;
  }
  return largest;
}

// Edges, facets and volumes; and nothing.
void begin(std::size_t step) {
  check_interruption();
  tell_progress("synthesis", step - 1, 3);
}

void name_owners_and_labels(Complex& c, LabelId outer, unsigned threads) {
  std::array<LabelId, 2> largest{outer == kOutside ? LabelId{1} : std::max(LabelId{1}, outer), 1};
  const auto of_shalfedges = [&] { largest[0] = largest_mark(c.shalfedges, largest[0], 2); };  // twins have one mark
  const auto of_others = [&] {
    largest[1] = largest_mark(c.vertices, largest[1]);
    largest[1] = largest_mark(c.svertices, largest[1]);
    largest[1] = largest_mark(c.sloops, largest[1]);
    largest[1] = largest_mark(c.sfaces, largest[1]);
  };
  parallel_calls(threads,
                 {of_others, of_shalfedges, [&] { name_svertex_owners(c); }, [&] { name_shalfedge_owners(c); }});
  c.label_count = static_cast<LabelId>(std::max(largest[0], largest[1]) + 1);
}

}  // namespace

void synthesize(Complex& complex, LabelId outer, unsigned threads) {
  name_owners_and_labels(complex, outer, threads);
  begin(1);
  link_edges(complex, threads);
  begin(2);
  link_facets(complex, threads);
  begin(3);
  link_volumes(complex, outer, threads);
  begin(4);
}

void synthesize(Complex& complex, LabelId outer, KnownLinks&& known, unsigned threads) {
  name_owners_and_labels(complex, outer, threads);
  begin(1);
  link_edges(complex, known);
  begin(2);
  if (known.facets.empty() && known.loose_corners.empty() && known.loose_isolated.empty()) {
    link_facets(complex, threads);
  } else {
    link_facets(complex, known, threads);
  }
  begin(3);
  known = {};
  link_volumes(complex, outer, threads);
  begin(4);
}

}  // namespace nef
