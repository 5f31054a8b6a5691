// SPDX-License-Identifier: Apache-2.0
#include "nef/synthesis/synthesis.h"

#include "nef/base/interruption.h"
#include "nef/base/progress.h"
#include "nef/complex/owners.h"
#include "nef/synthesis/edge_linking.h"
#include "nef/synthesis/facet_linking.h"
#include "nef/synthesis/volume_linking.h"

namespace nef {
namespace {

LabelId count_labels(const Complex& c, LabelId outer) {
  LabelId largest = 1;
  const auto take = [&largest](LabelId mark) {
    if (mark != kOutside && mark > largest) largest = mark;
  };
  take(outer);
  for (const VertexRecord& v : c.vertices) take(v.mark);
  for (const SVertex& v : c.svertices) take(v.mark);
  for (const SHalfedge& e : c.shalfedges) take(e.mark);
  for (const SLoop& l : c.sloops) take(l.mark);
  for (const SFace& f : c.sfaces) take(f.mark);
  return static_cast<LabelId>(largest + 1);
}

// Edges, facets and volumes; and nothing.
void begin(std::size_t step) {
  check_interruption();
  tell_progress("synthesis", step - 1, 3);
}

}  // namespace

void synthesize(Complex& complex, LabelId outer) {
  complex.label_count = count_labels(complex, outer);
  name_svertex_owners(complex);
  name_shalfedge_owners(complex);
  begin(1);
  link_edges(complex);
  begin(2);
  link_facets(complex);
  begin(3);
  link_volumes(complex, outer);
  begin(4);
}

void synthesize(Complex& complex, LabelId outer, KnownLinks&& known) {
  complex.label_count = count_labels(complex, outer);
  name_svertex_owners(complex);
  name_shalfedge_owners(complex);
  begin(1);
  link_edges(complex, known);
  begin(2);
  link_facets(complex, known);
  begin(3);
  known = {};
  link_volumes(complex, outer);
  begin(4);
}

}  // namespace nef
