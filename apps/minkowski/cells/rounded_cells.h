// SPDX-License-Identifier: Apache-2.0
//
// Solid convex cells in doubles with proven bounds: what filters whose misses are proofs ask.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {

/// The unit of roundoff of doubles.
inline constexpr double kUnit = 0x1p-53;

/// True if products of three coordinates of sets of this size neither overflow nor lose digits that matter: what lies
/// in a set is only computed to parts of 2^-53 of its size, so what is below 2^-1022 there is far below that. The
/// bounds of this folder, of unions and of convolutions hold for such sizes; others are left to exact ways.
inline bool has_moderate_size(double size) { return size > 0x1p-200 && size < 0x1p200; }

/// True if `inner` lies in `outer`.
inline bool box_holds(const Box& outer, const Box& inner) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (outer.low[k] > inner.low[k] || outer.high[k] < inner.high[k]) return false;
  }
  return true;
}

/// The plane of a face: value(x) is positive outside.
struct RoundedFace {
  Double3 normal{};
  Double3 origin{};
  double slack = 0;   ///< bound of the error of value(x) for x that is rounded from a point in the cells' size
  double weight = 0;  ///< sum of the absolute values of the normal: how an error of x enters value(x)

  [[nodiscard]] double value(const Double3& x) const {
    return normal[0] * (x[0] - origin[0]) + normal[1] * (x[1] - origin[1]) + normal[2] * (x[2] - origin[2]);
  }
};

/// The plane of three points that turn counterclockwise from outside, each within 2u `size` of the truth in every
/// coordinate, and none larger than `size`. Its slack is infinite if they are too close to tell, or the size is not
/// moderate.
RoundedFace rounded_plane(const Double3& o, const Double3& p, const Double3& q, double size);

/// Vertices, faces and boxes of a set of cells, flat. O(n) to build.
class RoundedCells {
 public:
  /// Cells that are not solid have vertices and a box, but no faces.
  explicit RoundedCells(std::span<const ConvexCell> cells);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  [[nodiscard]] const Box& box(std::uint32_t cell) const { return boxes_[cell]; }
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }
  /// Vertices and faces in the order of the cell's mesh; global numbers begin at first_...(cell).
  [[nodiscard]] std::uint32_t first_vertex(std::uint32_t cell) const { return first_vertex_[cell]; }
  [[nodiscard]] std::uint32_t first_face(std::uint32_t cell) const { return first_face_[cell]; }
  [[nodiscard]] std::uint32_t end_face(std::uint32_t cell) const { return first_face_[cell + 1]; }
  [[nodiscard]] std::uint32_t cell_of_face(std::uint32_t face) const { return cell_of_face_[face]; }
  [[nodiscard]] std::size_t face_count() const { return faces_.size(); }
  [[nodiscard]] const RoundedFace& face(std::uint32_t face) const { return faces_[face]; }
  [[nodiscard]] std::span<const Double3> vertices(std::uint32_t cell) const {
    return {vertices_.data() + first_vertex_[cell], first_vertex_[cell + 1] - first_vertex_[cell]};
  }
  [[nodiscard]] const Double3& vertex(std::uint32_t number) const { return vertices_[number]; }
  /// The largest absolute coordinate of all.
  [[nodiscard]] double extent() const { return extent_; }
  /// A bound of how far a rounded vertex is from the true one in each coordinate (u of its size, with room).
  [[nodiscard]] double vertex_error() const { return 4 * kUnit * extent_; }

  /// True only if a point that rounds to x is in the interior of the (solid) cell.
  [[nodiscard]] bool surely_inside(std::uint32_t cell, const Double3& x) const;

 private:
  std::vector<Double3> vertices_;
  std::vector<RoundedFace> faces_;
  std::vector<std::uint32_t> first_vertex_{0}, first_face_{0}, cell_of_face_;
  std::vector<Box> boxes_;
  double extent_ = 0;
};

}  // namespace nef::minkowski
