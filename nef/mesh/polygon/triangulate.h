// SPDX-License-Identifier: Apache-2.0
//
// Exact triangulation of planar polygons with holes: by a plane sweep, or ear by ear where a ring may be no polygon.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"
#include "nef/mesh/polygon/ear_clipping.h"
#include "nef/mesh/polygon/projected_corners.h"
#include "nef/mesh/polygon/sweep_triangulation.h"

namespace nef {

/// The coordinate axis along which the normal of a plane is largest, and the sign of the oriented normal there: a
/// polygon that turns counterclockwise about the normal is seen along the axis to turn by the sign.
struct ProjectionAxis {
  std::size_t axis = 0;
  int sign = 1;
};
ProjectionAxis projection_axis(const PlaneTable& planes, PlaneId plane);

/// +1 if a ring of at least three points turns counterclockwise in the projection along `axis`, -1 if clockwise, 0 if
/// its farthest corner there is flat (the projection, or the ring, is no simple polygon). Exact. O(n).
int ring_orientation(const MeshPoints& points, const std::vector<std::uint32_t>& ring, std::size_t axis,
                     const Monitor& monitor);

/// Triangulates polygons on the points of one MeshPoints. Keeps its memory from call to call; one per thread.
class Triangulator {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// `points` must outlive the triangulator.
  Triangulator(const MeshPoints& points, const Monitor& monitor)
      : points_(points), monitor_(monitor), projected_(points, monitor) {}

  /// What came of a ring that was cut: nothing, triangles, or those of a ring that is strictly convex as it is seen.
  enum class Cut : std::uint8_t { kFailed, kDone, kConvex };

  /// Cuts a ring, planar or not, that may be no polygon, along the axis that shows it largest of those that show it as
  /// a simple polygon: as a fan where it is convex there, else ear by ear. Appends nothing if it fails.
  Cut cut(const std::vector<std::uint32_t>& ring, std::vector<Triangle>& out);

  /// True if a ring of three points at least is strictly convex in the projection along `axis`. O(n).
  [[nodiscard]] bool is_convex(std::span<const std::uint32_t> ring, std::size_t axis);

  /// Cuts a polygon into triangles between its own vertices, oriented like it, and appends them to `out`. The corners
  /// are given ring after ring, each ring ending before the corner that ring_end says. The first ring is the outer one;
  /// the others are holes, turned the other way. Rings may have straight corners and may touch themselves and each
  /// other at vertices, and themselves along edges from within (dangling edges), but not cross; no corner lies inside
  /// an edge. A hole may be a single edge, walked out and back, or a point. Equal points have equal numbers. `axis` is
  /// a coordinate axis along which the plane projects one to one, and `sign` is +1 if the outer ring turns
  /// counterclockwise in that projection as orientation_along sees it.
  ///
  /// Returns false, and appends nothing, if it finds that the rings are no such polygon; triangles that overlap can
  /// only come of rings that go around some points twice. O(n log n), and O(n) for convex polygons; by the plane sweep
  /// of [Hertel, Mehlhorn 1983].
  bool triangulate(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> ring_end, std::size_t axis,
                   int sign, std::vector<Triangle>& out);

  /// The same for rings in lists of their own.
  bool triangulate(std::span<const std::vector<std::uint32_t>> rings, std::size_t axis, int sign,
                   std::vector<Triangle>& out);

  /// The same for a single ring that may be no polygon. Corners are cut off one after another (EarClipper), which finds
  /// a polygon in more rings: corners may lie inside of edges, from within. O(n) for convex polygons, O(n^2) at worst.
  bool triangulate(std::span<const std::uint32_t> ring, std::size_t axis, int sign, std::vector<Triangle>& out);

 private:
  void cut_convex(std::span<const std::uint32_t> ring, std::vector<Triangle>& out);
  void push(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::vector<Triangle>& out) const {
    out.push_back({projected_.point(a), projected_.point(b), projected_.point(c)});
  }
  [[nodiscard]] bool goes_around_once() const;
  [[nodiscard]] bool is_convex() const;
  bool cut_four(std::vector<Triangle>& out) const;

  const MeshPoints& points_;
  Monitor monitor_;
  ProjectedCorners projected_;
  SweepTriangulator sweep_;
  EarClipper ears_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> ring_end_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace nef
