// SPDX-License-Identifier: Apache-2.0
#include "nef/synthesis/synthesis.h"

#include "nef/base/interruption.h"
#include "nef/base/progress.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/owners.h"
#include "nef/synthesis/edge_linking.h"
#include "nef/synthesis/facet_linking.h"
#include "nef/synthesis/volume_linking.h"

namespace nef {
namespace {

// Edges, facets and volumes; and nothing.
void begin(std::size_t step) {
  check_interruption();
  tell_progress("synthesis", step - 1, 3);
}

void name_owners_and_labels(Complex& c, LabelId outer, unsigned threads) {
  parallel_calls(threads, {[&] { name_svertex_owners(c); }, [&] { name_pair_owners(c); }});
  LabelId largest = 1;
  const auto take = [&largest](LabelId mark) {
    if (mark != kOutside && mark > largest) largest = mark;
  };
  take(outer);
  PatternTable::for_each_mark(c.patterns, take);
  for (const SLoop& loop : c.sloops) take(loop.mark);
  c.label_count = static_cast<LabelId>(largest + 1);
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
