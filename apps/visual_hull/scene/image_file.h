// SPDX-License-Identifier: Apache-2.0
//
// Image files to pixels. PNG is read here; for all other formats OpenCV's library of image formats is loaded when the
// first such file comes: it stands on some 120 other libraries, which would be most of the start of a program that is
// linked to it. It decodes in a process with limits (nef/io/bounded_process.h), since damaged files make such libraries
// crash, or take memory and time without bounds.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace nef::visual_hull {

/// The pixels of a file as it stores them, with one channel, three (blue, green, red) or four, as
/// cv::imread(IMREAD_UNCHANGED) gives them. Empty if they cannot be read, or take more than 2 GiB.
cv::Mat read_pixels(const std::filesystem::path& file);

/// The same with eight bits and three channels, whatever the file stores.
cv::Mat read_colors(const std::filesystem::path& file);

}  // namespace nef::visual_hull
