// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/silhouette_cache.h"

#include <algorithm>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/scene/images.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

// Traces all outlines. Other formats than JSON name further files, which nobody would have looked at.
visual_hull::Scene traced(const RootFolder& root, const fs::path& file, const OutlineOptions& options,
                          const Monitor& monitor, Messages& notes) {
  if (lower_extension(file.string()) != "json")
    throw InputError("the studio reads scenes of visual hulls in JSON only");
  visual_hull::Scene scene = visual_hull::read_scene(file);
  const fs::path folder = visual_hull::scene_folder(file);
  for (const fs::path& image : visual_hull::images_of(scene, folder, std::nullopt)) {
    if (!image.empty()) static_cast<void>(root.file(image.lexically_relative(root.path()).generic_string()));
  }
  visual_hull::Options how;
  how.monitor = monitor;
  if (!options.threshold.empty()) how.silhouette.threshold = visual_hull::parse_threshold(options.threshold);
  how.silhouette.simplify.tolerance = options.simplify;
  const visual_hull::Result result = visual_hull::silhouettes_of(scene, folder, how);
  notes = result.notes;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    visual_hull::View& view = scene.views[i];
    const visual_hull::ViewResult& traced_view = result.views[i];
    view.camera = traced_view.camera;
    view.polygons = traced_view.silhouette.region.rings;
    view.image.clear();
    view.distortion = {};
  }
  scene.origin = result.origin;
  return scene;
}

}  // namespace

visual_hull::Scene SilhouetteCache::scene(const RootFolder& root, const std::string& name,
                                          const OutlineOptions& options, const Monitor& monitor, Messages& notes) {
  Entry entry{.file = root.file(name), .written = {}, .options = options, .scene = {}, .notes = {}};
  std::error_code error;
  entry.written = fs::last_write_time(entry.file, error);
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&entry](const Entry& e) {
      return e.file == entry.file && e.written == entry.written && e.options == entry.options;
    });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
      notes.insert(notes.end(), found->notes.begin(), found->notes.end());
      return found->scene;
    }
  }
  entry.scene = traced(root, entry.file, options, monitor, entry.notes);
  notes.insert(notes.end(), entry.notes.begin(), entry.notes.end());
  visual_hull::Scene scene = entry.scene;
  const std::lock_guard lock(mutex_);
  entries_.push_front(std::move(entry));
  if (entries_.size() > kMost) entries_.pop_back();
  return scene;
}

}  // namespace nef::studio
