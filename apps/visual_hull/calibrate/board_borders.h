// SPDX-License-Identifier: Apache-2.0
//
// Where black meets white on a board, and where a photograph shows it: some thousand places, each known to a fraction
// of a pixel across the border, where the corners of the chessboard are some ten.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/calibrate/board.h"
#include "apps/visual_hull/scene/pose.h"

namespace nef::visual_hull {

/// A place on a straight border between black and white, in the frame of the board (board_corners). Lengths are
/// millimetres.
struct BoardBorder {
  Eigen::Vector2d at;
  Eigen::Vector2d to_white;  ///< across the border, of length 1
  double black = 0;          ///< how far it is black on the one side
  double white = 0;          ///< how far it is white on the other
  double along = 0;          ///< how far the border goes on straight, in the direction that is shorter
};

/// Places along all borders of a board, half a cell of a marker apart. Of each length no more than a square is looked
/// at. O(places * square).
std::vector<BoardBorder> board_borders(const Board& board);

/// A border as a photograph shows it.
struct SeenBorder {
  cv::Point3d at;       ///< on the board
  cv::Point2d point;    ///< in pixels whose centres are whole numbers
  cv::Vec2d direction;  ///< across the border towards white, of length 1, in the image
};

/// Finds borders in a photograph by a camera that is right to about a pixel: along a line across each border, the place
/// where brightness is half way from black to white, if it rises there and nowhere else. Borders are left out where
/// the next one is nearer than two pixels, or that something covers. `gray`: 8 bits. O(borders).
std::vector<SeenBorder> find_borders(const cv::Mat& gray, const std::vector<BoardBorder>& borders, const Lens& lens,
                                     const Pose& pose);

}  // namespace nef::visual_hull
