// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/combine/combine.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/scene/pose.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

constexpr std::size_t kOutlineSamples = 150;  // of a view

/// A scene with the silhouettes of its views.
struct Photographed {
  std::string name;
  Scene scene;
  Result views;
};

Photographed read_series(const std::filesystem::path& file, const Options& options) {
  Photographed series{file.string(), read_scene(file), {}};
  if (series.scene.guessed) throw nef::InputError(series.name + ": its cameras are not known");
  for (const View& view : series.scene.views) require_pinhole(view.camera, "combine");
  series.views = silhouettes_of(series.scene, scene_folder(file), options);
  for (std::size_t i = 0; i < series.scene.views.size(); ++i) {
    series.scene.views[i].image = series.views.views[i].image;
  }
  series.scene.origin = series.views.origin;
  return series;
}

bool same_threshold(const std::optional<ThresholdOptions>& a, const std::optional<ThresholdOptions>& b) {
  if (!a || !b) return !a && !b;
  return a->kind == b->kind && a->value == b->value && a->invert == b->invert && a->channel == b->channel;
}

void check_same_conventions(const Photographed& a, const Photographed& b) {
  const std::string both = a.name + " and " + b.name;
  if (a.scene.origin != b.scene.origin) {
    throw nef::InputError(both + ": one counts pixels from their centres, the other from their corners");
  }
  if (!same_threshold(a.scene.threshold, b.scene.threshold)) {
    throw nef::InputError(both + ": their thresholds differ; make masks first (visual_hull masks)");
  }
  if (a.scene.views[0].camera.handedness() != b.scene.views[0].camera.handedness()) {
    throw nef::InputError(both + ": the cameras of one are mirrored");
  }
}

void add_outlines(const Photographed& photographed, OutlineSeries& series, const nef::Monitor& monitor) {
  const std::size_t before = series.outlines.size();
  const Scene& scene = photographed.scene;
  series.outlines.resize(before + scene.views.size());
  for (const View& view : scene.views) series.cameras.emplace_back(view.camera);
  nef::parallel_for(scene.views.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const ViewSilhouette& s = photographed.views.views[i].silhouette;
    const ImageSize frame = s.cut_by_frame ? ImageSize{s.image_size.width, s.image_size.height} : ImageSize{};
    series.outlines[before + i] =
        refine::make_outline(s.region, frame, scene.views[i].distortion, scene.origin, kOutlineSamples);
  });
}

// A place that few views do not tell from another one.
void note_ambiguous(const PlacedSeries& series, nef::Messages& notes) {
  const Placement& p = series.placement;
  if (!p.fits() || !p.ambiguous()) return;
  notes.push_back(fmt::format(
      "{}: another place fits nearly as well ({:.2f} px, this one {:.2f} px, by some of the views): look at "
      "the hull; a nearly symmetric object needs a mark that outlines show",
      series.name, p.runner_up_px, p.best_found_px));
}

// The views of a series under names of their own.
void add_views(std::vector<View> views, std::size_t number, Scene& scene) {
  std::set<std::string> taken;
  for (const View& view : scene.views) taken.insert(view.name);
  for (View& view : views) {
    while (!taken.insert(view.name).second) view.name = std::to_string(number) + "_" + view.name;
    scene.views.push_back(std::move(view));
  }
}

}  // namespace

bool Combined::fits() const {
  return std::all_of(series.begin(), series.end(), [](const PlacedSeries& s) { return s.placement.fits(); });
}

Combined combine(const std::vector<std::filesystem::path>& scenes, const Options& options) {
  if (scenes.size() < 2) throw nef::InputError("combine: two scenes at least are needed, one for each pose");
  Options plain;
  plain.silhouette = options.silhouette;
  plain.silhouette.simplify = {};
  plain.silhouette.border = Border::kOutside;
  plain.mask = options.mask;
  plain.origin = options.origin;
  plain.monitor = options.monitor;
  Combined combined;
  std::vector<Photographed> series;
  for (const std::filesystem::path& file : scenes) {
    series.push_back(read_series(file, plain));
    Photographed& now = series.back();
    combined.notes.insert(combined.notes.end(), now.views.notes.begin(), now.views.notes.end());
    if (now.scene.box) combined.notes.push_back(now.name + ": its box is dropped, since the object was moved");
    if (series.size() == 1) {
      combined.scene = now.scene;
      combined.scene.box.reset();
      continue;
    }
    check_same_conventions(series[0], now);
    options.monitor.tell_progress("placing", series.size() - 1, scenes.size());
    OutlineSeries first;
    for (std::size_t k = 0; k + 1 < series.size(); ++k) add_outlines(series[k], first, options.monitor);
    OutlineSeries second;
    add_outlines(now, second, options.monitor);
    const std::vector<refine::MovingCamera> cameras = second.cameras;
    PlacedSeries placed{now.name, cameras.size(), place_series(std::move(first), std::move(second), options.monitor)};
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      View& view = now.scene.views[i];
      view.camera = make_view(view.name, placed_camera(cameras[i], placed.placement).matrix()).camera;
    }
    add_views(now.scene.views, series.size(), combined.scene);
    note_ambiguous(placed, combined.notes);
    combined.series.push_back(std::move(placed));
  }
  return combined;
}

}  // namespace nef::visual_hull
