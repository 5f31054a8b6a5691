// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/id.h"
#include "nef/base/item_iterator.h"
#include "nef/complex/ids.h"

namespace nef {

/// A connected, relatively open piece of a plane with one mark.
struct Facet {
  PlaneId plane;  ///< unflipped
  LabelId mark = 0;
  CycleId first_cycle{0};  ///< the outer cycle; holes follow
  std::uint32_t cycle_count = 0;
  std::uint32_t first_isolated = 0;  ///< vertices inside the facet, in isolated_vertices
  std::uint32_t isolated_count = 0;
  VolumeId volume_above{0};  ///< on the positive side of the plane
  VolumeId volume_below{0};

  /// The outer cycle first.
  [[nodiscard]] IdRange<CycleId> cycles() const { return {first_cycle, cycle_count}; }
};

/// What is on a facet and on both sides of it.
struct FacetSides {
  LabelId mark = 0;
  VolumeId volume_above{0};
  VolumeId volume_below{0};
  bool operator==(const FacetSides&) const = default;
};

/// The facets of a complex, given away by value. Their cycles, and the vertices inside them, follow each other in the
/// order of facets. Facets beside the same volumes share what says so, and columns that say nothing are not held: most
/// sets have one cycle a facet, and few have vertices inside.
class FacetTable {
 public:
  using value_type = Facet;
  using Iterator = ItemIterator<FacetTable>;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] IdRange<FacetId> ids() const { return {FacetId{0}, end_id()}; }
  /// The index after the last one.
  [[nodiscard]] FacetId end_id() const { return FacetId{size()}; }
  [[nodiscard]] bool contains(FacetId id) const { return id.index() < size(); }

  // Whoever reads one field of a facet must not pay for the others, so all of this is inlined.
  [[gnu::always_inline]] Facet operator[](FacetId id) const { return item(id.index()); }
  [[gnu::always_inline, nodiscard]] Facet item(std::size_t i) const {
    const FacetSides& sides = sides_[rows_[i].sides];
    Facet facet;
    facet.plane = rows_[i].plane;
    facet.mark = sides.mark;
    facet.first_cycle = first_cycle(i);
    facet.cycle_count = first_cycle_.empty() ? 1 : first_cycle_[i + 1] - first_cycle_[i];
    facet.first_isolated = first_isolated_.empty() ? 0 : first_isolated_[i];
    facet.isolated_count = first_isolated_.empty() ? 0 : first_isolated_[i + 1] - first_isolated_[i];
    facet.volume_above = sides.volume_above;
    facet.volume_below = sides.volume_below;
    return facet;
  }
  [[nodiscard]] FacetSides sides_of(FacetId id) const { return sides_[rows_[id.index()].sides]; }
  /// What sides_of() gives, each at least once, and which of these it gives for a facet.
  [[nodiscard]] std::span<const FacetSides> kinds() const { return sides_; }
  [[nodiscard]] std::uint32_t kind(FacetId id) const { return rows_[id.index()].sides; }
  [[nodiscard]] PlaneId plane(FacetId id) const { return rows_[id.index()].plane; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

  /// Adds a facet, the cycles and inner vertices of which follow those of the facet before; where they begin is not
  /// read.
  FacetId push_back(const Facet& facet);

  /// Adds all facets of another table, whose cycles and inner vertices then follow those that are here.
  void append(const FacetTable& more);

  /// Says of all facets, in their order, what is on them and beside them.
  void assign_sides(std::span<const FacetSides> of_all);

  /// Gives facet f the mark mark_of(f), for all of them.
  template <typename MarkOf>
  void assign_marks(MarkOf&& mark_of) {
    std::vector<FacetSides> sides;
    sides.reserve(size());
    for (const FacetId f : ids()) {
      sides.push_back(sides_of(f));
      sides.back().mark = mark_of(f);
    }
    assign_sides(sides);
  }

  /// Changes one facet. Where its cycles and inner vertices end, those of the next one begin.
  void set(FacetId id, const Facet& facet);

  /// Calls visit(mark) for the marks that facets have; of a table that may change, visit may change them.
  template <typename Table, typename Visit>
  static void for_each_mark(Table& table, Visit&& visit) {
    if (table.empty()) return;
    for (auto& sides : table.sides_) visit(sides.mark);
  }

  void clear() { *this = FacetTable(); }
  void reserve(std::size_t size) { rows_.reserve(size); }
  void trim();
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Row {
    PlaneId plane;
    std::uint32_t sides = 0;
  };

  [[nodiscard]] CycleId first_cycle(std::size_t i) const {
    return CycleId{first_cycle_.empty() ? static_cast<std::uint32_t>(i) : first_cycle_[i]};
  }
  std::uint32_t place_of(const FacetSides& sides);
  void hold_cycles();
  void hold_isolated();

  std::vector<Row> rows_;
  std::vector<FacetSides> sides_;
  // Of each facet, and where those of the last one end; or none: each facet has one cycle, none has vertices inside.
  std::vector<std::uint32_t> first_cycle_, first_isolated_;
};

}  // namespace nef
