// SPDX-License-Identifier: Apache-2.0
//
// Masks that the other views contradict, decided again.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull {

/// A photograph with its camera.
struct PhotographedView {
  std::string name;  ///< for messages
  std::filesystem::path photograph;
  Camera camera;
  Distortion distortion;
};

/// What repair has done to a mask.
struct MaskChange {
  std::size_t added = 0;    ///< pixels that are object now
  std::size_t removed = 0;  ///< pixels that were object
  double share = 0;         ///< both, of the pixels of the mask as it was (of those added, if it was empty)
};

/// Repairs masks (8 bits, 255: object; changed in place) by the silhouettes of the other views. Pixels of the object
/// through which no line of sight leads to a point that all other views but one allow are taken away: a shadow, a part
/// of the background. Pixels of the background behind which all other views allow a thick part of the object are
/// decided by their colours (GrabCut), with the rest of the mask as what is sure. All other pixels stay as they are.
/// Twice, since what has been repaired votes better. Views without a pixel have no vote, and the inner half of what the
/// others allow counts as sure there. Nothing changes with fewer than four votes. O(pixels) a view, and 2 M points of a
/// grid a view at most. Throws InputError for a photograph that is needed and
/// cannot be read.
std::vector<MaskChange> repair_masks(const std::vector<PhotographedView>& views, PixelOrigin origin,
                                     std::vector<cv::Mat>& masks, const nef::Monitor& monitor = {});

/// "view 7: 1234 pixels added, 20 removed (3.4 % of the object)", for each view of which a thousandth has changed.
std::vector<std::string> change_lines(const std::vector<PhotographedView>& views,
                                      const std::vector<MaskChange>& changes);

}  // namespace nef::visual_hull
