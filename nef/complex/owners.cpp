// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/owners.h"

#include <algorithm>

namespace nef {

void name_svertex_owners(Complex& complex) {
  complex.svertex_owner.resize(complex.svertex_count());
  for (const VertexId v : complex.vertex_ids()) std::ranges::fill(complex.svertex_owner[complex.halfedges(v)], v);
}

void name_pair_owners(Complex& complex) {
  complex.pair_owner.clear();
  if (complex.vertices.has_two_shalfedges_per_svertex()) return;
  complex.pair_owner.resize(complex.shalfedge_count() / 2);
  const auto owner = complex.pair_owner.begin();
  for (const VertexId v : complex.vertex_ids()) {
    std::fill(owner + pair_of(complex.vertices.shalfedges(v)), owner + pair_of(complex.vertices.shalfedges(v.next())),
              v);
  }
}

}  // namespace nef
