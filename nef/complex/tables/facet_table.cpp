// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/tables/facet_table.h"

#include <algorithm>

#include "nef/base/capacity.h"
#include "nef/base/error.h"

namespace nef {

FacetId FacetTable::push_back(const Facet& facet) {
  if (facet.cycle_count != 1) hold_cycles();
  if (facet.isolated_count != 0) hold_isolated();
  rows_.push_back({facet.plane, place_of({facet.mark, facet.volume_above, facet.volume_below})});
  if (!first_cycle_.empty()) first_cycle_.push_back(first_cycle_.back() + facet.cycle_count);
  if (!first_isolated_.empty()) first_isolated_.push_back(first_isolated_.back() + facet.isolated_count);
  return FacetId{size() - 1};
}

void FacetTable::append(const FacetTable& more) {
  for (const Facet& facet : more) push_back(facet);
}

// Most sets have few volumes, and facets of the same ones follow each other, so the last few are those to look at. What
// is not among these is held again.
std::uint32_t FacetTable::place_of(const FacetSides& sides) {
  constexpr std::size_t kLast = 8;
  const std::size_t count = sides_.size();
  for (std::size_t i = count; i > count - std::min(count, kLast); --i) {
    if (sides_[i - 1] == sides) return static_cast<std::uint32_t>(i - 1);
  }
  sides_.push_back(sides);
  return static_cast<std::uint32_t>(count);
}

void FacetTable::hold_cycles() {
  if (!first_cycle_.empty()) return;
  first_cycle_.reserve(rows_.capacity() + 1);
  for (std::uint32_t i = 0; i <= size(); ++i) first_cycle_.push_back(i);
}

void FacetTable::hold_isolated() {
  if (first_isolated_.empty()) first_isolated_.assign(size() + 1, 0);
}

void FacetTable::assign_sides(std::span<const FacetSides> of_all) {
  NEF_ASSERT(of_all.size() == size());
  sides_.clear();
  for (std::size_t i = 0; i < of_all.size(); ++i) rows_[i].sides = place_of(of_all[i]);
}

void FacetTable::set(FacetId id, const Facet& facet) {
  const std::size_t i = id.index();
  rows_[i] = {facet.plane, place_of({facet.mark, facet.volume_above, facet.volume_below})};
  if (!first_cycle_.empty() || facet.first_cycle.index() != i || facet.cycle_count != 1) {
    hold_cycles();
    first_cycle_[i] = facet.first_cycle.index();
    first_cycle_[i + 1] = facet.first_cycle.index() + facet.cycle_count;
  }
  if (!first_isolated_.empty() || facet.isolated_count != 0) {
    hold_isolated();
    first_isolated_[i] = facet.first_isolated;
    first_isolated_[i + 1] = facet.first_isolated + facet.isolated_count;
  }
}

void FacetTable::trim() {
  trim_capacity(rows_);
  trim_capacity(sides_);
  trim_capacity(first_cycle_);
  trim_capacity(first_isolated_);
}

std::size_t FacetTable::bytes() const {
  return held_bytes(rows_) + held_bytes(sides_) + held_bytes(first_cycle_) + held_bytes(first_isolated_);
}

}  // namespace nef
