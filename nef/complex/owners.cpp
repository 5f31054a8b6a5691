// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/owners.h"

#include <algorithm>

namespace nef {

void name_svertex_owners(Complex& complex) {
  complex.svertex_owner.resize(complex.svertex_count());
  const auto owner = complex.svertex_owner.begin();
  for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
    std::fill(owner + complex.vertices[v].svertices, owner + complex.vertices[v + 1].svertices, v);
  }
}

void name_shalfedge_owners(Complex& complex) {
  complex.shalfedge_owner.assign(complex.shalfedge_count(), 0);
  for (std::uint32_t v = 0; v < complex.vertex_count(); ++v) {
    const std::uint32_t end = complex.vertices[v + 1].shalfedges;
    for (std::uint32_t i = complex.vertices[v].shalfedges; i < end; i += 2) complex.shalfedge_owner.set(i, v);
  }
}

}  // namespace nef
