// SPDX-License-Identifier: Apache-2.0
//
// Which cells of free space touch: one lies in the closure of the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/planner/partition/cells.h"

namespace nef::planner {

/// For each free cell the free cells that touch it, in ascending order. It keeps no reference.
class Incidences {
 public:
  Incidences() = default;
  /// `free` tells of each cell whether it is; read off the sphere maps, O(their items).
  Incidences(const Complex& complex, const CellNumbering& cells, const std::vector<bool>& free);

  [[nodiscard]] std::span<const CellId> of(CellId cell) const {
    return {lists_.data() + begin_[cell], begin_[cell + 1] - begin_[cell]};
  }
  /// Those of them that have the cell in their closure: they come last.
  [[nodiscard]] std::span<const CellId> larger(CellId cell) const {
    return {lists_.data() + larger_[cell], begin_[cell + 1] - larger_[cell]};
  }

 private:
  std::vector<std::uint32_t> begin_;   // of each cell's list; one more than there are cells
  std::vector<std::uint32_t> larger_;  // where its larger cells begin
  std::vector<CellId> lists_;
};

}  // namespace nef::planner
