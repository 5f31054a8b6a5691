// SPDX-License-Identifier: Apache-2.0
//
// What a person has painted over a photograph: green on the object, red on the background.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// Where the strokes of a photograph are: the path itself, or the file in this folder whose name, without its
/// extension, is the photograph's. Empty if the folder has none. Throws InputError if there is no such path.
std::filesystem::path strokes_of(const std::filesystem::path& path, const std::filesystem::path& photograph);

/// Seeds for `cut_by_seeds` from a picture (three channels of 8 bits: blue, green, red) with strokes: #00FF00 is object
/// and #FF0000 background, each up to a distance of 60 of 255 in each channel, for brushes with soft borders; all other
/// pixels are likely what the nearest stroke says. Without red, margins of 5 % are background. `what` names the picture
/// in errors. Throws InputError if nothing is green. O(pixels).
cv::Mat seeds_from_strokes(const cv::Mat& strokes, const std::string& what);

}  // namespace nef::visual_hull
