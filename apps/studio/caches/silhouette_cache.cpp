// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/caches/silhouette_cache.h"

#include <optional>
#include <vector>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/scene/images.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

// A method whose files, if it has any, are below the root.
visual_hull::MaskMethod mask_method(const RootFolder& root, const fs::path& folder, const std::string& text,
                                    std::vector<FileState>& files) {
  visual_hull::MaskMethod method = visual_hull::parse_mask_method(text);
  if (!method.strokes.empty())
    throw InputError("strokes are for the program visual_hull; the studio has other methods");
  if (!method.background.empty()) {
    method.background = root.file((folder / method.background).lexically_relative(root.path()).generic_string());
    files.emplace_back(method.background);
  }
  return method;
}

// Traces all outlines; `files` gets the states of all files that are read. Other formats than JSON name further files,
// which nobody would have looked at.
TracedScene traced(const RootFolder& root, const fs::path& file, const OutlineOptions& options, const Monitor& monitor,
                   std::vector<FileState>& files, Messages& notes) {
  if (lower_extension(file.string()) != "json")
    throw InputError("the studio reads scenes of visual hulls in JSON only");
  files.emplace_back(file);
  visual_hull::Scene scene = visual_hull::read_scene(file);
  const fs::path folder = visual_hull::scene_folder(file);
  for (const fs::path& image : visual_hull::images_of(scene, folder, std::nullopt)) {
    if (image.empty()) continue;
    static_cast<void>(root.file(image.lexically_relative(root.path()).generic_string()));
    files.emplace_back(image);
  }
  visual_hull::Options how;
  how.monitor = monitor;
  if (!options.threshold.empty()) how.silhouette.threshold = visual_hull::parse_threshold(options.threshold);
  if (!options.mask.empty()) how.mask = mask_method(root, folder, options.mask, files);
  how.silhouette.simplify.tolerance = options.simplify;
  const visual_hull::Result result = visual_hull::silhouettes_of(scene, folder, how);
  notes = result.notes;
  TracedScene found;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    visual_hull::View& view = scene.views[i];
    const visual_hull::ViewResult& traced_view = result.views[i];
    found.images.push_back(traced_view.image);
    found.distortions.push_back(traced_view.distortion);
    found.sizes.push_back({traced_view.silhouette.image_size.width, traced_view.silhouette.image_size.height});
    view.camera = traced_view.camera;
    view.polygons = traced_view.silhouette.region.rings;
    view.image.clear();
    view.distortion = {};
  }
  scene.origin = result.origin;
  found.scene = std::move(scene);
  return found;
}

}  // namespace

TracedScene SilhouetteCache::scene(const RootFolder& root, const std::string& name, const OutlineOptions& options,
                                   const Monitor& monitor, Messages& notes) {
  const Key key{root.file(name), options};
  std::optional<Value> value = used_.find(key);
  if (!value) {
    value.emplace();
    std::vector<FileState> files;
    value->scene = traced(root, key.file, options, monitor, files, value->notes);
    used_.keep(key, std::move(files), *value);
  }
  notes.insert(notes.end(), value->notes.begin(), value->notes.end());
  return value->scene;
}

}  // namespace nef::studio
