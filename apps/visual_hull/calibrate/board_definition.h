// SPDX-License-Identifier: Apache-2.0
//
// A board as OpenCV knows it.
#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "apps/visual_hull/calibrate/board.h"

namespace nef::visual_hull {

/// OpenCV's object for a board; its coordinates are millimetres from a corner of the board.
cv::Ptr<cv::aruco::CharucoBoard> board_definition(const Board& board);

}  // namespace nef::visual_hull
