// SPDX-License-Identifier: Apache-2.0
//
// A board in a photograph.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/calibrate/board.h"

namespace nef::visual_hull {

/// Corners of a board that a photograph shows: where they lie on the board (as board_corners has them) and where they
/// are seen, in pixels whose centres are whole numbers.
struct SeenBoard {
  std::vector<cv::Point3d> corners;
  std::vector<cv::Point2d> points;

  /// The same of the corners of markers, which are not found as well.
  std::vector<cv::Point3d> marker_corners;
  std::vector<cv::Point2d> marker_points;
};

/// Finds the corners of a board in a picture (three channels of 8 bits), by OpenCV's detector of markers and, between
/// markers that were found, to a fraction of a pixel. Nothing if fewer than two markers are seen.
SeenBoard find_board(const cv::Mat& picture, const Board& board);

}  // namespace nef::visual_hull
