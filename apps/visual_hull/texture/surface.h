// SPDX-License-Identifier: Apache-2.0
//
// A mesh of triangles in doubles, with the neighbours of each triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"

namespace nef::visual_hull {

/// The surface that gets a texture.
class Surface {
 public:
  /// A side that two triangles share: from one vertex to the other.
  struct Side {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::array<std::uint32_t, 2> triangles{};
  };

  /// Throws InputError unless all faces are triangles. O(n log n).
  explicit Surface(const nef::Mesh& mesh);

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] const std::vector<nef::Double3>& points() const { return points_; }
  [[nodiscard]] const std::array<std::uint32_t, 3>& triangle(std::size_t t) const { return triangles_[t]; }
  [[nodiscard]] std::array<nef::Double3, 3> corners(std::size_t t) const;

  /// The outward normal; its length is twice the area.
  [[nodiscard]] nef::Double3 normal(std::size_t t) const;

  /// All pairs of triangles at a side, in the order of its vertices; a side of four triangles comes several times.
  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  /// The sides of a triangle, as indices.
  [[nodiscard]] std::span<const std::uint32_t> sides_of(std::size_t t) const {
    return std::span(side_list_).subspan(side_begin_[t], side_begin_[t + 1] - side_begin_[t]);
  }
  /// The triangle at the other side of a side.
  [[nodiscard]] std::uint32_t beyond(std::uint32_t side, std::size_t t) const {
    const auto& both = sides_[side].triangles;
    return both[0] == t ? both[1] : both[0];
  }

 private:
  void find_sides();

  std::vector<nef::Double3> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Side> sides_;
  std::vector<std::uint32_t> side_begin_;
  std::vector<std::uint32_t> side_list_;
};

/// The point of given weights of the corners.
nef::Double3 point_at(const std::array<nef::Double3, 3>& corners, const std::array<double, 3>& weights);

}  // namespace nef::visual_hull
