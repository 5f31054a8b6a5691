// SPDX-License-Identifier: Apache-2.0
//
// Cameras by a board: from photographs of an object that stands on it to a scene in millimetres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/visual_hull/calibrate/board.h"
#include "apps/visual_hull/calibrate/board_lens.h"
#include "apps/visual_hull/scene/scene.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {

/// What has become of one photograph.
struct CalibratedView {
  std::filesystem::path photograph;
  std::size_t corners = 0;  ///< of the board that were found; where there is a pose, those that count (board_lens.h)
  std::size_t borders = 0;  ///< between black and white that count (border_fit.h); 0: the pose is that of the corners
  double error_px = 0;      ///< root mean square of what borders, or corners where there are none, are seen off by
  double off_px = 0;        ///< root mean square of what the camera is off by in its image of things on the board
  Pose pose;                ///< in the frame of the board (board_corners)
  std::string refused;      ///< why the photograph is of no use; empty: it has a camera
};

/// The cameras of a series.
struct Calibration {
  BoardLens lens;
  std::vector<CalibratedView> views;       ///< in the order of the photographs
  std::vector<CalibratedView> lens_views;  ///< of the series that the lens was determined by, if there was one
  double error_px = 0;                     ///< root mean square over all views that have a camera
  nef::Messages notes;                     ///< photographs that were refused, and what the series does not determine

  /// The views that have a camera; their images are the photographs, lengths millimetres. It tells how far cameras are
  /// off, so that their refinement by silhouettes knows.
  [[nodiscard]] Scene scene() const;
};

/// Finds the board in each photograph and determines one lens for all (fit_lens), by the photographs of `lens` if there
/// are any: of the same camera at the same zoom and focus, with the board held at different tilts. Then each photograph
/// has its pose. One whose corners are off by more than a pixel and three times the median is refused, and the lens is
/// determined again. Lens and poses then move to where borders between black and white are seen, of which there are a
/// hundred times as many as corners (border_fit.h); the lens by both series, unless it explains the photographs far
/// worse than its own series. Photographs of another size than the first, with less than six corners, or with corners
/// that two poses explain are refused, too; notes name them. Throws InputError if less than three are left, or if the
/// boards do not determine a lens, or if a file is no image. O(pixels) a photograph.
Calibration calibrate(const std::vector<std::filesystem::path>& photographs, const Board& board,
                      const std::vector<std::filesystem::path>& lens = {}, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
