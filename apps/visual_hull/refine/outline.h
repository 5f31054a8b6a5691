// SPDX-License-Identifier: Apache-2.0
//
// An outline for measuring in doubles: signed distances to it, and points on it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "apps/visual_hull/polygon/polygon.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull::refine {

/// A smooth signed distance to the border of a silhouette, in pixels: positive inside. The staircase of pixels is
/// smoothed away (by two pixels, without a bias by curvature). Where the frame of the image cuts the silhouette, the
/// distance goes on beyond it as it is at the frame, so that nobody is sure of what the image does not show.
class DistanceField {
 public:
  DistanceField() = default;
  /// `frame`: the size of an image whose frame cuts the silhouette, {} if none does. O(pixels of the silhouette's box).
  DistanceField(const Silhouette& silhouette, const ImageSize& frame, PixelOrigin origin);

  [[nodiscard]] double value(const Eigen::Vector2d& p) const;
  /// The distance, and the vector along which it grows.
  [[nodiscard]] double value(const Eigen::Vector2d& p, Eigen::Vector2d& gradient) const;

 private:
  struct Cell {
    const float* at = nullptr;  // its upper left node
    double x = 0, y = 0;        // within the cell
    Eigen::Vector2d beyond;     // from the nearest point of the grid
  };
  [[nodiscard]] Cell cell(const Eigen::Vector2d& p) const;

  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // of the first node
  double step_ = 1;
  int width_ = 0, height_ = 0;
  bool frame_ = false;
  std::vector<float> values_;
};

/// A point of an outline.
struct OutlineSample {
  Eigen::Vector2d point;
  bool held_out = false;  ///< belongs to the pieces of the outline that a fit does not use when it is to be judged
};

/// What one view says about the object.
struct Outline {
  DistanceField distance;
  std::vector<OutlineSample> samples;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< of the silhouette's box
  double extent = 0;                                 ///< the larger side of that box
};

/// About `count` samples spread evenly along the outline, none on the frame of the image if that cuts the silhouette;
/// every other piece of six samples is held out. `lens` is the distortion that was undone. A silhouette that is not
/// empty is needed.
Outline make_outline(const Silhouette& silhouette, const ImageSize& frame, const Distortion& lens, PixelOrigin origin,
                     std::size_t count);

}  // namespace nef::visual_hull::refine
