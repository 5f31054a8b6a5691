// SPDX-License-Identifier: Apache-2.0
//
// Scenes of visual hulls with their outlines in place of their images, which take longer to read and to trace than a
// hull to compute.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/studio/caches/recently_used.h"
#include "apps/studio/root/root_folder.h"
#include "apps/visual_hull/scene/scene.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef::studio {

/// How outlines are made.
struct OutlineOptions {
  std::string threshold;  ///< as parse_threshold reads it; empty: that of the scene
  std::string mask;       ///< of photographs, as parse_mask_method reads it; empty: images are masks
  double simplify = 0;    ///< pixels by which outlines may move to lose vertices

  friend bool operator==(const OutlineOptions&, const OutlineOptions&) = default;
};

/// A scene whose views have polygons in place of their images, and these.
struct TracedScene {
  visual_hull::Scene scene;
  std::vector<std::filesystem::path> images;         ///< of each view; empty where its file has polygons
  std::vector<visual_hull::Distortion> distortions;  ///< of the images
  std::vector<visual_hull::ImageSize> sizes;         ///< of the images
};

class SilhouetteCache {
 public:
  /// The scene of a JSON file below the root. Kept as long as the file and
  /// all its images stay as they are; images are read again for other options. Throws InputError, also for an image
  /// that is not below the root. Any number of threads may call it.
  TracedScene scene(const RootFolder& root, const std::string& name, const OutlineOptions& options,
                    const Monitor& monitor, Messages& notes);

 private:
  struct Key {
    std::filesystem::path file;
    OutlineOptions options;

    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Value {
    TracedScene scene;
    Messages notes;
  };

  RecentlyUsed<Key, Value> used_{6};
};

}  // namespace nef::studio
