// SPDX-License-Identifier: Apache-2.0
//
// The lens of a camera, and where it stood, by corners of a board.
#pragma once

#include <optional>
#include <span>

#include "apps/visual_hull/calibrate/find_board.h"
#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull {

/// A lens as boards determine it.
struct BoardLens {
  Lens lens;
  double error_px = 0;     ///< root mean square distance between corners as seen and as this lens sees them
  double focal_share = 0;  ///< standard deviation of the focal length, as a share of it
  // Its model.
  bool square_pixels = true;  ///< there is one focal length
  bool centred = true;   ///< the principal point is the middle of the image, because the boards do not determine it
  int coefficients = 0;  ///< of its distortion that are not zero, the first ones of k1, k2, p1, p2, k3
};

/// The lens that explains boards best [Zhang 2000]. From few parameters to many (focal length and k1; k2; principal
/// point; two focal lengths, k3 and tangential distortion) the largest model is taken whose parameters the boards
/// determine (principal point to half a percent of the image's longer side) and that explains them significantly better
/// (F test). Boards of one tilt do not determine the principal point, whichever way they are turned in their plane.
/// `views`: at least one, each with six corners at least that do not lie on a line. O(corners) for each of some hundred
/// steps.
BoardLens fit_lens(std::span<const SeenBoard* const> views, const ImageSize& size);

/// A pose, and how well it explains a board.
struct BoardPose {
  Pose pose;
  double error_px = 0;      ///< root mean square, of the corners that count
  std::size_t corners = 0;  ///< that count
  double off_px = 0;        ///< of the image of what stands on the board, by the noise of corners: root mean square
  bool ambiguous = false;   ///< another pose, of the other tilt, explains the corners nearly as well
};

/// The pose of a camera by the corners of a board [Collins, Bartoli 2014], then by least squares. Corners that are off
/// by more than a fifth of a pixel and three times the median do not count, if a quarter of them at most are, and eight
/// are left: the object, its outline or the border of a shadow lies beside them. Where corners leave none, or two,
/// those of markers count as well. `off_px` is for points up to the longer side of the seen part of the board above it.
/// Nothing if there is none.
std::optional<BoardPose> pose_by_board(const SeenBoard& view, const Lens& lens);

/// Points of a block on the seen part of a board, as high as that is long. `seen`: of the board, at least one.
std::vector<cv::Point3d> things_on_board(const std::vector<cv::Point3d>& seen);

}  // namespace nef::visual_hull
