// SPDX-License-Identifier: Apache-2.0
//
// Boards to be printed, to scale.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "apps/visual_hull/calibrate/board.h"

namespace nef::visual_hull {

/// The size of a page in millimetres.
struct PageSize {
  double width = 297;
  double height = 210;
};

/// The page that a board is printed on: the smallest of A4, A3 and A2 in landscape or portrait with margins of 12 mm,
/// else one that is that much larger than the board.
PageSize page_for(const Board& board);

/// The bytes of a file with the board, by the extension: ".pdf" and ".svg", a page with the board in its middle and
/// below it a line of a known length, to be measured on the print; ".png", the board alone, 20 pixels a millimetre,
/// which the file says. Throws InputError for other extensions, and for a picture of a board of more than 2 m.
std::string board_file(const Board& board, const std::string& extension);

/// The board alone, with a white border of one square, so many pixels a millimetre: three channels of 8 bits.
cv::Mat board_picture(const Board& board, double pixels);

}  // namespace nef::visual_hull
