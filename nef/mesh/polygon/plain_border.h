// SPDX-License-Identifier: Apache-2.0
//
// Whether directed sides in a plane bound a region that they surround once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// Tests borders by the sweep of [Shamos, Hoey 1976]. Keeps its memory from border to border.
class PlainBorder {
 public:
  /// From its first point to its second one.
  using Side = std::array<std::uint32_t, 2>;

  /// The points must outlive this object.
  explicit PlainBorder(const MeshPoints& points) : points_(points), rank_(points.size(), 0) {}

  /// True if the sides, projected along `axis`, have nothing in common but ends that are the same point, and wind
  /// around every point beside them 0 times or `turn` times, which is 1 (counterclockwise) or -1. At each point as many
  /// sides must end as begin; any number of cycles may meet there. Throws OpenQuestion if the points do. O(n log n) for
  /// n sides unless a line crosses very many of them.
  bool surrounds_once(std::span<const Side> sides, std::size_t axis, int turn, const Monitor& monitor);

 private:
  // A side by the ranks of its ends, the smaller one first.
  struct Segment {
    std::uint32_t left = 0;
    std::uint32_t right = 0;
    bool is_floor = false;  // the region lies above
  };

  bool sort(std::span<const Side> sides);
  void list_segments(std::span<const Side> sides, int turn);
  bool reach(std::uint32_t rank);
  bool sort_leaving(std::span<std::uint32_t> leaving) const;
  [[nodiscard]] bool alternate(std::size_t first, std::size_t last) const;
  [[nodiscard]] bool apart(std::uint32_t below, std::uint32_t above) const;
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] int side_of(std::uint32_t rank, std::uint32_t segment) const;

  const MeshPoints& points_;
  Monitor monitor_;
  std::size_t axis_ = 0;
  std::vector<std::uint32_t> rank_;  // of points of the border at hand
  std::vector<std::uint32_t> ends_;  // these points, from left to right
  std::vector<Segment> segments_;    // by their left ends
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> arriving_;  // the number at each end
  std::vector<std::uint32_t> leaving_;
  std::vector<std::uint32_t> status_;  // segments that the line crosses, from below
};

}  // namespace nef
