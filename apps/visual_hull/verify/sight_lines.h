// SPDX-License-Identifier: Apache-2.0
//
// Lines of sight cut by silhouettes, in doubles: for statistics.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "apps/visual_hull/cones/cone.h"
#include "apps/visual_hull/verify/consistency.h"

namespace nef::visual_hull {

/// A part of a line of sight, by depth.
struct DepthInterval {
  double from = 0;
  double to = 0;
};

/// A view for lines of sight.
class SightView {
 public:
  explicit SightView(const ComparedView& view);

  /// About `count` points spread evenly over the silhouette, always the same ones.
  [[nodiscard]] std::vector<Eigen::Vector2d> sample(std::size_t count) const;
  /// The direction in which a point of the image is seen, of depth 1.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& image) const;
  /// The volume that one sample stands for at depth 1, per unit of depth cubed over three.
  [[nodiscard]] double solid_angle() const { return angle_; }
  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] double area() const { return area_; }

 private:
  friend class SightPencil;
  [[nodiscard]] bool inside(const Eigen::Vector2d& p) const;

  Eigen::Matrix<double, 3, 4> matrix_;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d centre_;
  double angle_ = 0;  // |det| of the inverse of the left block, times the area
  double area_ = 0;
  // Vertices ring by ring, each ring closed by its first vertex again.
  std::vector<double> u_, v_;
  std::vector<Eigen::Vector3d> normals_;  // of the planes through the camera and the side from each vertex to the next
  std::vector<std::uint32_t> ring_begin_;
};

/// The lines through one point as a view sees them: lines through one point of its image, which are told apart by their
/// angle about the line through that point and the camera [Matusik, Buehler, McMillan 2001].
class SightPencil {
 public:
  /// Keeps a reference to the view. O(n) for n sides of its outline.
  SightPencil(const SightView& view, const Eigen::Vector3d& centre);

  /// Replaces `ends` by those of the parts of `range` of the line centre + s * direction that are seen in the
  /// silhouette, in order, two for each part. Asks only the sides at the line's angle.
  void cut(const Eigen::Vector3d& direction, const DepthInterval& range, std::vector<double>& ends) const;

 private:
  void sort_sides_by_angle();

  /// A line's direction, by its components across, times this: on which side of the line a vertex is seen.
  struct Form {
    double x = 0;
    double y = 0;
    [[nodiscard]] double at(double dx, double dy) const { return x * dx + y * dy; }
  };

  const SightView& view_;
  double depth_ = 0;                      // of the point
  Eigen::Vector3d across0_, across1_;     // directions across the line through point and camera; zero if that is none
  std::vector<Form> forms_;               // of the vertices
  std::vector<double> heights_;           // of the point over the sides' planes
  std::vector<std::uint32_t> bin_begin_;  // equal parts of half a turn
  std::vector<std::uint32_t> bin_sides_;  // a side by its first vertex
};

/// The range of depths at which a line is in a box; empty (from > to) if it misses it.
DepthInterval in_box(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, const Eigen::Vector3d& low,
                     const Eigen::Vector3d& high);

}  // namespace nef::visual_hull
