// SPDX-License-Identifier: Apache-2.0
//
// From a series of photographs of one object to its masks.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/masks/mask_method.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {

/// The masks of a series.
struct CutOuts {
  std::vector<cv::Mat> masks;   ///< one a photograph: 8 bits, 255 where the object is, else 0; opacities if soft
  std::vector<double> quality;  ///< how clearly both sides of each outline differ (Separation); 0: not at all
  std::string chosen;           ///< how they were made: "red-blue above 121.9"
  nef::Messages notes;          ///< masks to be looked at, and why
};

/// Cuts the object out of each photograph by one rule for all: a measure of pixels, the median of the levels that
/// separate best in each photograph, and the object above it (separation.h). kAuto takes the measure by which outlines
/// are clearest in the median photograph, among all channels and their complements, or GrabCut in a rectangle with
/// margins of 5 % if none is clear; photographs whose alpha varies are their own masks. O(pixels) a photograph and
/// measure, at most 800 pixels along a side for the choice. Throws InputError for a photograph that cannot be read,
/// naming it.
CutOuts cut_out(const std::vector<std::filesystem::path>& photographs, const MaskMethod& method,
                const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
