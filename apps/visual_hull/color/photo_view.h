// SPDX-License-Identifier: Apache-2.0
//
// One view as a source of colours: its photograph, and what of a mesh it sees.
#pragma once

#include <array>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/color/depth_map.h"
#include "apps/visual_hull/color/projection.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/mesh/mesh.h"

namespace nef::visual_hull {

/// The photograph that belongs to the image of a silhouette: of the same name, in the folder images beside masks or
/// silhouettes or in the folder above, or else the image itself, which may be colours with alpha.
std::filesystem::path photograph_of(const std::filesystem::path& image);

/// The views that have images. Throws InputError, naming `option`, if none has.
std::vector<const ViewResult*> views_with_images(const std::vector<ViewResult>& views, const std::string& option);

/// The vertices of a mesh as the nearest doubles.
std::vector<std::array<double, 3>> rounded_points(const nef::Mesh& mesh);

/// A photograph without lens distortion, the pixels of its silhouette, and a map of the depth of a mesh. A view sees a
/// point if nothing of the mesh is nearer, by more than three pixels' width, at all four pixels around its image: maps
/// of depth in doubles, made for display; no other answer depends on them.
class PhotoView {
 public:
  /// A colour (red, green, blue; 0 to 255). Pixels at the border of a silhouette contain background as well; `inside`
  /// are those at least two pixels from it.
  struct Sample {
    std::array<double, 3> color{};
    bool inside = false;
  };

  /// `points`: those of the mesh. Throws InputError, naming the view, if its photograph cannot be read or has another
  /// size than the silhouette's image, and naming `option` if its lines of sight are parallel.
  PhotoView(const ViewResult& view, PixelOrigin origin, const nef::Mesh& mesh,
            const std::vector<std::array<double, 3>>& points, const std::string& option);

  [[nodiscard]] std::optional<ImagePlace> project(const std::array<double, 3>& point) const {
    return projection_(point);
  }
  [[nodiscard]] const ImageProjection& projection() const { return projection_; }
  [[nodiscard]] cv::Size size() const { return image_.size(); }

  /// True if the view sees the point that it shows at a place.
  [[nodiscard]] bool sees(const ImagePlace& place) const { return depths_.sees(place); }

  /// The nearest pixel's colour, in whole numbers, at a place that is seen; at the border that of the nearest pixel of
  /// the silhouette. Nothing if there is none within two pixels.
  [[nodiscard]] std::optional<Sample> pixel_at(const ImagePlace& place) const;

  /// The same, interpolated between the four pixels around the place where all of these are inside.
  [[nodiscard]] std::optional<Sample> blend_at(const ImagePlace& place) const;

 private:
  cv::Mat image_;
  std::array<cv::Mat, 2> pixels_;  // of the silhouette, and those of them whose neighbours are in it, too
  ImageProjection projection_;
  DepthMap depths_;
};

}  // namespace nef::visual_hull
