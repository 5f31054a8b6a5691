// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace nef::visual_hull {

/// One picture (blue, green, red) of all photographs in rows, small, what is not object dimmed and its outline red; one
/// mask a photograph. Throws InputError for a photograph that cannot be read.
cv::Mat mask_overview(const std::vector<std::filesystem::path>& photographs, const std::vector<cv::Mat>& masks);

}  // namespace nef::visual_hull
