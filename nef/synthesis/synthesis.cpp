// SPDX-License-Identifier: Apache-2.0
#include "nef/synthesis/synthesis.h"

#include "nef/base/threads/parallel.h"
#include "nef/complex/owners.h"
#include "nef/synthesis/edge_linking.h"
#include "nef/synthesis/facet_linking.h"
#include "nef/synthesis/volume_linking.h"

namespace nef {
namespace {

// Edges, facets and volumes; and nothing.
void begin(std::size_t step, const Monitor& monitor) {
  monitor.check_interruption();
  monitor.tell_progress("synthesis", step - 1, 3);
}

void name_owners_and_labels(Complex& c, LabelId outer, const Monitor& monitor) {
  parallel_calls(monitor,
                 {[&](const Monitor&) { name_svertex_owners(c); }, [&](const Monitor&) { name_pair_owners(c); }});
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

void synthesize(Complex& complex, LabelId outer, const Monitor& caller) {
  const Monitor monitor = for_vertices(complex.vertex_count(), caller);
  name_owners_and_labels(complex, outer, monitor);
  begin(1, monitor);
  link_edges(complex, monitor);
  begin(2, monitor);
  link_facets(complex, monitor);
  begin(3, monitor);
  link_volumes(complex, outer, monitor);
  begin(4, monitor);
}

void synthesize(Complex& complex, LabelId outer, KnownLinks&& known, const Monitor& caller) {
  const Monitor monitor = for_vertices(complex.vertex_count(), caller);
  name_owners_and_labels(complex, outer, monitor);
  begin(1, monitor);
  link_edges(complex, known, monitor);
  begin(2, monitor);
  if (known.facets.empty() && known.loose_corners.empty() && known.loose_isolated.empty()) {
    link_facets(complex, monitor);
  } else {
    link_facets(complex, known, monitor);
  }
  begin(3, monitor);
  known = {};
  link_volumes(complex, outer, monitor);
  begin(4, monitor);
}

}  // namespace nef
