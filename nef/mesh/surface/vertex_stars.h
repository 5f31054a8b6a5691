// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// The triangles around each vertex of a triangulated surface, and two things that are so around practically all
/// vertices of ordinary meshes and answer most questions of a check in a few comparisons a corner:
///
/// - A vertex is *closed* if each edge at it is left by one triangle and arrived at by one, and no two triangles have
///   the same corners. If all are closed, every edge has two faces, which run through it in opposite directions.
/// - A closed vertex is *flat* if its triangles surely meet in nothing but the vertex and the edges that they share
///   there. To see this, let all of them turn the same way in the projection along an axis. As each edge is left and
///   arrived at once they form cycles. Each triangle is a wedge of less than half a turn, so a cycle goes around the
///   vertex at least once, and as often as its wedges hold any one direction. If this number is 1 for all together,
///   there is one cycle, whose wedges are disjoint in the projection but for their borders.
class VertexStars {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// A triangle at a vertex.
  struct Wedge {
    std::uint32_t triangle = 0;
    std::uint32_t corner = 0;  ///< of the triangle
    std::uint32_t from = 0;    ///< the end of the edge that the triangle leaves the vertex by
    std::uint32_t to = 0;      ///< and of the one that it comes back by
  };

  /// Triangles of points, none degenerate. Both must outlive this object. O(n log n), for a bounded number of triangles
  /// around a vertex O(n); on the threads of `monitor`, but for the sorting of triangles by vertex.
  VertexStars(const MeshPoints& points, std::span<const Triangle> triangles, const Monitor& monitor);

  /// The triangles at a vertex, in their order.
  [[nodiscard]] std::span<const Wedge> star(std::uint32_t vertex) const {
    return std::span(wedges_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

  /// The triangle that runs back through the side of a triangle from corner k to the next one; kNone if one of the two
  /// is not closed.
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::uint32_t k) const {
    return across_[3 * triangle + k];
  }
  static constexpr std::uint32_t kNone = 0xffffffffU;  ///< stands for no triangle

  /// A bit for each axis and side from which a triangle surely is seen: 2^(2 axis) if it turns counterclockwise in the
  /// projection along the axis, 2^(2 axis + 1) if it turns clockwise.
  [[nodiscard]] unsigned views(std::uint32_t triangle) const { return views_[triangle]; }
  static constexpr unsigned kAllViews = 63;  ///< all of these bits

  /// True if all vertices are closed.
  [[nodiscard]] bool all_closed() const { return all_closed_; }

  /// True if two triangles have a common corner that is flat.
  [[nodiscard]] bool settle(const Triangle& a, const Triangle& b) const {
    unsigned result = 0;  // without branches, which nobody could foresee
    for (const std::uint32_t corner : a) {
      const unsigned shared = static_cast<unsigned>(corner == b[0]) | static_cast<unsigned>(corner == b[1]) |
                              static_cast<unsigned>(corner == b[2]);
      result |= shared & flat_[corner];
    }
    return result != 0;
  }

 private:
  [[nodiscard]] std::uint8_t views_of(const Triangle& t) const;
  bool close(std::span<const Wedge> star);
  bool close_wide(std::span<const Wedge> star);
  [[nodiscard]] bool is_flat(std::uint32_t vertex, std::span<const Wedge> star) const;
  [[nodiscard]] std::size_t times_around(std::uint32_t vertex, std::span<const Wedge> star, std::size_t axis,
                                         bool counterclockwise) const;

  const MeshPoints& points_;
  std::vector<std::uint32_t> begin_;  // of each point, in wedges_; and the end
  std::vector<Wedge> wedges_;
  std::vector<std::uint32_t> across_;  // of each side
  std::vector<std::uint8_t> views_;    // of each triangle
  std::vector<std::uint8_t> flat_;     // of each point
  bool all_closed_ = true;
};

}  // namespace nef
