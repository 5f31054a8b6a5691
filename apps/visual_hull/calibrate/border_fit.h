// SPDX-License-Identifier: Apache-2.0
//
// A lens and poses by borders of a board, all photographs together.
#pragma once

#include <span>
#include <vector>

#include "apps/visual_hull/calibrate/board_borders.h"
#include "apps/visual_hull/calibrate/board_lens.h"

namespace nef::visual_hull {

/// A photograph whose borders are fitted.
struct BorderView {
  std::vector<SeenBorder> borders;
  Pose pose;             ///< to begin with, and then the fitted one
  std::size_t kept = 0;  ///< borders that count
  double error_px = 0;   ///< root mean square of what they are off by, across
  double off_px = 0;     ///< as BoardPose has it, by the noise of borders, lens included
};

/// Moves poses, and with `fit_the_lens` those numbers of the lens that its model leaves free (BoardLens), to where
/// borders lie in all photographs, by least squares with Tukey's weights: a shadow or an outline beside a border does
/// not count. Each photograph has a number for how far black spreads over white in it, or white over black, as print,
/// light and the curve of a camera make it. The start must be right to some tenths of a pixel, the borders of a view
/// determine its pose: fifty borders at least in directions of both axes. O(borders + views) for each of ten steps.
void fit_borders(BoardLens& lens, std::span<BorderView> views, bool fit_the_lens);

}  // namespace nef::visual_hull
