// SPDX-License-Identifier: Apache-2.0
//
// Numbers for pixels by which object and background may differ.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/masks/mask_method.h"

namespace nef::visual_hull {

/// From a picture (three channels of 8 bits: blue, green, red) to one channel of 8 bits, larger for the object.
struct Measure {
  std::string name;  ///< "red-blue", "darkness of gray", "distance from the background"
  std::function<cv::Mat(const cv::Mat& picture)> of;
};

/// A channel, or its complement.
Measure channel_measure(ThresholdOptions::Channel channel, bool inverted);

/// All channels but alpha, and their complements.
std::vector<Measure> channel_measures();

/// How far colours are from those of a picture without the object, pixel by pixel; its size is adapted. A darker pixel
/// of the same chromaticity (down to two fifths) is a shadow and has the distance 0.
Measure background_measure(const cv::Mat& background);

/// How far colours are from one colour, whatever their brightness (a fifth to 1.6 times): a screen behind the object.
Measure key_measure(const std::array<int, 3>& key);

/// The median of pictures of the same size, channel by channel: what stands still in most of them.
cv::Mat median_picture(const std::vector<cv::Mat>& pictures);

/// The longest side of the copies in which objects are looked for first.
inline constexpr int kLongestCopy = 800;

/// A photograph as three channels of 8 bits, whatever the file stores, its sides at most `longest` pixels if that is
/// positive. Throws InputError if it cannot be read.
cv::Mat read_picture(const std::filesystem::path& file, int longest = 0);

}  // namespace nef::visual_hull
