// SPDX-License-Identifier: Apache-2.0
//
// Video: the hulls of one rig of cameras, frame after frame.
//
//   const nef::visual_hull::HullStream stream(nef::visual_hull::read_scene("rig.json"), options);
//   while (camera.grab(masks)) nef::Mesh mesh = nef::to_mesh(stream.frame(masks).hull).mesh;
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// A scene whose cameras stay while its images change. What depends on the cameras alone (their inverses, the place of
/// the scene) is computed once. Frames are independent of each other: any number of threads may ask for one at a time,
/// and copies share what is kept.
class HullStream {
 public:
  /// The scene's polygons, where it has them in place of images, are those of every frame. Each frame has a monitor of
  /// its own instead of that of the options. Throws InputError for options that mean nothing for the scene.
  HullStream(Scene scene, const Options& options);

  /// The hull of one frame. masks[i] is the i-th view's: one channel of 8 bits, object where it is not zero; it is
  /// only read, and may be anything where the view has polygons. Lens distortion of the scene is undone. Throws
  /// InputError as `compute` does, and for masks of another number, kind or size.
  [[nodiscard]] Result frame(const std::vector<cv::Mat>& masks, const nef::Monitor& monitor = {}) const;

  /// The same for image files: `folder` is where the scene's images are looked up, `images`, if given, a folder whose
  /// i-th image is the i-th view's.
  [[nodiscard]] Result frame(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& images,
                             const nef::Monitor& monitor = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace nef::visual_hull
