// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/patterns/pattern_table.h"

#include "nef/base/capacity.h"

namespace nef {

PatternId PatternTable::push(const SphereMapBuffer& map) {
  const PatternId id{size()};
  svertices_.insert(svertices_.end(), map.svertices.begin(), map.svertices.end());
  shalfedges_.insert(shalfedges_.end(), map.shalfedges.begin(), map.shalfedges.end());
  sfaces_.insert(sfaces_.end(), map.sfaces.begin(), map.sfaces.end());
  entries_.insert(entries_.end(), map.entries.begin(), map.entries.end());
  records_.back().mark = map.mark;
  Record end;
  end.svertices = static_cast<std::uint32_t>(svertices_.size());
  end.shalfedges = static_cast<std::uint32_t>(shalfedges_.size());
  end.sfaces = static_cast<std::uint32_t>(sfaces_.size());
  end.entries = static_cast<std::uint32_t>(entries_.size());
  records_.push_back(end);
  return id;
}

void PatternTable::reserve(std::size_t patterns, std::size_t svertices, std::size_t shalfedges, std::size_t sfaces) {
  records_.reserve(patterns + 1);
  svertices_.reserve(svertices);
  shalfedges_.reserve(shalfedges);
  sfaces_.reserve(sfaces);
  entries_.reserve(sfaces);
}

void PatternTable::trim() {
  trim_capacity(records_);
  trim_capacity(svertices_);
  trim_capacity(shalfedges_);
  trim_capacity(sfaces_);
  trim_capacity(entries_);
}

std::size_t PatternTable::bytes() const {
  return held_bytes(records_) + held_bytes(svertices_) + held_bytes(shalfedges_) + held_bytes(sfaces_) +
         held_bytes(entries_);
}

}  // namespace nef
