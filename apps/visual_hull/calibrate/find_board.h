// SPDX-License-Identifier: Apache-2.0
//
// A board in a photograph.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/calibrate/board.h"

namespace nef::visual_hull {

/// Corners of a board that a photograph shows, of its squares and of its markers: where they lie on the board (in the
/// frame of board_corners) and where they are seen, in pixels whose centres are whole numbers.
struct SeenBoard {
  std::vector<cv::Point3d> corners;
  std::vector<cv::Point2d> points;
};

/// Finds the corners of a board in a picture (three channels of 8 bits) to a fraction of a pixel: those of the markers
/// that OpenCV's detector reads, and those of squares between them. Corners of squares are found better, those of
/// markers are more, and they surround an object that hides the middle. Nothing if fewer than two markers are seen.
SeenBoard find_board(const cv::Mat& picture, const Board& board);

}  // namespace nef::visual_hull
