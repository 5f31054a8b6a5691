// SPDX-License-Identifier: Apache-2.0
//
// Scene -> Masks: what of each image is object.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/pipeline/run.h"

namespace nef::visual_hull {

/// How silhouettes are read: what the command line does not say about masks, the scene does.
SilhouetteOptions silhouette_options(const Scene& scene, const Options& options);

/// The views of a scene before any image is seen.
Views views_of(const Scene& scene);

/// Throws InputError, which calls the image `what`, if its size is not the one that the view's camera was calibrated
/// for.
void check_size_of(const cv::Mat& mask, const View& view, const std::string& what);

/// The mask of each view, an empty one where the scene has polygons; `folder` is where the scene's images are looked
/// up. Sets the images of `result.views` and notes what was chosen. Throws InputError for images that cannot be used.
std::vector<cv::Mat> masks_of(const Run& run, const Scene& scene, const std::filesystem::path& folder,
                              const SilhouetteOptions& options, Result& result, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
