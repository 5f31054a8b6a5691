// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/tables/vertex_table.h"

#include "nef/base/capacity.h"

namespace nef {

void VertexTable::set_shalfedges(std::size_t i, SHalfedgeId value) {
  if (shalfedges_.empty()) {
    shalfedges_.reserve(rows_.capacity());
    for (const Row& row : rows_) shalfedges_.emplace_back(2 * row.svertices.index());
  }
  shalfedges_[i] = value;
}

void VertexTable::trim() {
  trim_capacity(rows_);
  trim_capacity(shalfedges_);
  trim_capacity(sloops_);
  trim_capacity(other_planes_);
}

std::size_t VertexTable::bytes() const {
  return held_bytes(rows_) + held_bytes(shalfedges_) + held_bytes(sloops_) + held_bytes(other_planes_);
}

}  // namespace nef
