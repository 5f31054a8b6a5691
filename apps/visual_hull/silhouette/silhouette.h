// SPDX-License-Identifier: Apache-2.0
//
// From an image to an exact silhouette.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "apps/visual_hull/scene/scene.h"
#include "apps/visual_hull/silhouette/contour.h"
#include "apps/visual_hull/silhouette/simplify.h"

namespace nef::visual_hull {

/// What a silhouette that is cut by the frame of the image says about the space beyond it.
enum class Border {
  kOutside,  ///< there is nothing of the object
  kUnknown,  ///< there may be: only what is seen as background is carved
};

struct SilhouetteOptions {
  ThresholdOptions threshold;
  PixelOrigin origin = PixelOrigin::kCenter;
  Border border = Border::kOutside;
  SimplifyOptions simplify;
  DiagonalPixels diagonal = DiagonalPixels::kTouch;
  bool soft = false;    ///< outlines run where the opacity is half (half_contour.h) instead of along sides of pixels
  double min_area = 0;  ///< square pixels; contours around less are noise of photographs: islands go, holes are filled
};

/// What a view contributes.
struct ViewSilhouette {
  std::size_t contours = 0;  ///< rings, holes included
  std::size_t holes = 0;
  std::size_t contour_vertices = 0;  ///< before simplification
  Silhouette region;                 ///< the simplified silhouette, or the background if `background`
  bool background = false;           ///< the view keeps what is not inside `region` (a cut silhouette, kUnknown)
  bool cut_by_frame = false;         ///< by that of the image as it was taken
  cv::Size image_size;               ///< empty for polygons
};

/// 255 where the image shows the object, 0 elsewhere, as the lens has it; with `options.soft` an opacity (opacity.h)
/// with this object. The image may have 1, 3 or 4 channels of any depth: see ThresholdOptions. Throws InputError naming
/// the view if the image cannot be read.
cv::Mat read_mask(const std::filesystem::path& image, const std::string& view, const SilhouetteOptions& options);

/// The intrinsics as OpenCV wants them, whose whole image coordinates are centres of pixels: 3x3, double.
cv::Mat opencv_intrinsics(const Distortion& distortion, PixelOrigin origin);

/// A photograph in colour (blue, green, red), without its lens distortion; empty if it cannot be read.
cv::Mat read_photograph(const std::filesystem::path& image, const Distortion& distortion, PixelOrigin origin);

/// The mask of an image that is loaded already. Throws InputError if it has no such channel.
cv::Mat make_mask(const cv::Mat& image, const ThresholdOptions& options);

/// The opacity (opacity.h) of an image that is loaded already, half at the threshold, with the object of `make_mask`.
/// Throws InputError if it has no such channel.
cv::Mat make_opacity(const cv::Mat& image, const ThresholdOptions& options);

/// Traces a mask (an opacity, with `options.soft`), undoes the distortion of its lens on the contours (lens.h), and
/// simplifies them. Throws InputError naming the view if nothing is set, or if the distortion cannot be undone.
ViewSilhouette silhouette_of_mask(const cv::Mat& mask, const Distortion& lens, const std::string& view,
                                  const SilhouetteOptions& options, const nef::Monitor& monitor = {});

/// The same for polygons in place of an image.
ViewSilhouette silhouette_of_polygons(const std::vector<Ring>& polygons, const std::string& view,
                                      const SilhouetteOptions& options, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
