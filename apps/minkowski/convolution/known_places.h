// SPDX-License-Identifier: Apache-2.0
//
// Where an arrangement of facets was looked at before.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "apps/minkowski/convolution/arrangement/facet_pyramids.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {

/// A point that was looked at.
struct KnownPoint {
  std::uint32_t vertex = kNone;      ///< drawn there; kNone if the sum surely has none
  std::vector<FacetAtPoint> facets;  ///< that hold it, in ascending order

  /// A facet among these, or nullptr. O(log n).
  [[nodiscard]] const FacetAtPoint* find(std::uint32_t facet) const;
};

/// Points by where they are about, in the cells of a grid.
class PlacesOfPoints {
 public:
  /// `extent`: the largest absolute coordinate.
  explicit PlacesOfPoints(double extent);

  void add(const Double3& place, std::uint32_t point);
  /// Points that may be in a box; none if that reaches into several cells. O(1). Valid until the next `add`.
  [[nodiscard]] std::span<const std::uint32_t> near(const Box& box) const;

  /// The size of a cell: far above errors, far below facets.
  [[nodiscard]] double size() const { return size_; }

 private:
  [[nodiscard]] std::uint64_t key_of(const Double3& place) const;

  double size_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> points_;
};

/// A part of a line on which several facets meet, and all points at which these facets may have vertices there.
struct KnownLine {
  std::vector<std::uint32_t> facets;  ///< that were looked at
  std::vector<std::uint32_t> along;   ///< those of them that have the line in their planes
  std::vector<std::uint32_t> points;  ///< and others
  Box box;                            ///< of the part
};

/// Lines that were looked at. Where many facets have a line in common, so has each pair of them.
class KnownLines {
 public:
  void add(KnownLine line);
  /// A line that f and g are along, whose part includes a box; nullptr if there is none. O(lines along f). Valid until
  /// the next `add`.
  KnownLine* find(std::uint32_t f, std::uint32_t g, const Box& box);
  /// Says that another facet is along a line that `find` gave.
  void add_along(KnownLine& line, std::uint32_t facet);

 private:
  std::vector<KnownLine> lines_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> along_;  // facet -> lines
};

}  // namespace nef::minkowski
