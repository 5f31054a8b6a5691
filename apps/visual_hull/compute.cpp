// SPDX-License-Identifier: Apache-2.0
//
// The pipeline: Scene -> Masks -> Silhouettes -> Box -> Cones -> Hull, one file of pipeline/ for each step. If the hull
// has no volume, pipeline/vanished.h finds out which views have no point in common.
#include <algorithm>
#include <functional>
#include <memory>

#include "apps/visual_hull/pipeline/hull_in_room.h"
#include "apps/visual_hull/pipeline/room.h"
#include "apps/visual_hull/pipeline/run.h"
#include "apps/visual_hull/pipeline/scene_masks.h"
#include "apps/visual_hull/pipeline/view_silhouettes.h"
#include "apps/visual_hull/scene/place.h"
#include "apps/visual_hull/stream.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/parts/by_volume.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::visual_hull {

const char* phase_name(Phase phase) {
  static constexpr std::array<const char*, kPhaseCount> kNames{"load",  "contours",     "refine", "box",  "suspects",
                                                               "cones", "intersection", "verify", "write"};
  return kNames[static_cast<std::size_t>(phase)];
}

void timed(PhaseReports& reports, Phase phase, const nef::Monitor& monitor,
           const std::function<void(const nef::Monitor&)>& work) {
  PhaseReport& report = reports[static_cast<std::size_t>(phase)];
  const nef::PhaseTimer timer(report.seconds, report.predicates, monitor);
  const nef::ProcessStopwatch processor;
  work(timer.monitor());
  report.cpu_seconds += processor.seconds();
}

namespace {

void verify(const Run& run, Result& result, const nef::Monitor& monitor) {
  run.each_view(Phase::kVerify, result.views, monitor, [&](std::size_t i, const nef::Monitor& own) {
    ViewResult& view = result.views[i];
    if (!view.silhouette.background) {
      view.verification = verify_view(result.hull, view.camera, view.silhouette.region, kLinesPerPixel, own);
      return;
    }
    // Nothing of it is seen as background for sure.
    const nef::Polyhedron seen = nef::interior(make_cone(view.camera, view.silhouette.region, result.box, own), own);
    Verification check;
    check.inside = nef::intersect(result.hull, seen, own).is_empty();
    if (!check.inside) check.problem = "a part of the hull is seen as background";
    check.area_known = false;
    view.verification = check;
  });
}

std::vector<Camera> cameras_of(const Scene& scene) {
  std::vector<Camera> cameras;
  for (const View& view : scene.views) cameras.push_back(view.camera);
  return cameras;
}

void check_options(const Scene& scene, const Options& options) {
  if (scene.guessed && !options.refine) {
    throw nef::InputError("the cameras of the turntable are not known; --refine finds them");
  }
  if (options.repair_masks && (scene.guessed || !options.mask)) {
    throw nef::InputError(
        "--repair-masks compares the masks of photographs (--mask) by their cameras: find the cameras first, with "
        "--refined-scene FILE.json, then name that file");
  }
  for (const View& view : scene.views) {
    if (options.suspects || options.drop_suspects) require_pinhole(view.camera, "--suspects");
    if (options.refine) require_pinhole(view.camera, "--refine");
    if (options.repair_masks) require_pinhole(view.camera, "--repair-masks");
  }
  if (options.at_least && (*options.at_least < 1 || *options.at_least > scene.views.size())) {
    throw nef::InputError("--at-least: from 1 to " + std::to_string(scene.views.size()) + ", the number of views");
  }
}

/// The pieces of a hull, and the largest alone if that is asked for.
void look_at_pieces(const Options& options, Result& result, const nef::Monitor& monitor) {
  if (result.vanished || nef::counts(result.hull).volumes <= 2) return;  // the outside and one inside
  const std::vector<nef::Polyhedron> pieces = nef::split(result.hull, monitor);
  if (pieces.size() < 2) return;
  for (const nef::Polyhedron& piece : pieces) result.pieces.push_back(nef::approximate_volume(piece, monitor).value);
  std::sort(result.pieces.begin(), result.pieces.end(), std::greater<>());
  if (options.largest) result.hull = pieces[nef::largest_piece(pieces, monitor)];
}

/// Silhouettes -> Box -> Cones -> Hull.
void finish(const Run& run, const Scene& scene, Place place, Result& result, const nef::Monitor& monitor) {
  Room room;
  timed(result.phases, Phase::kBox, monitor,
        [&](const nef::Monitor& watching) { room = room_of(scene, run.options, result.views, place, watching); });
  if (run.options.suspects || run.options.drop_suspects) {
    timed(result.phases, Phase::kSuspects, monitor,
          [&](const nef::Monitor& watching) { compare(run, scene, result, place, room, watching); });
  }
  result.box = place.outward(room.box);
  result.box_found = room.found;
  if (room.enclosing) result.enclosing = place.outward(*room.enclosing);
  FoundHull found = hull_in_room(run, place, room, result.views, result.phases, monitor);
  result.direct = found.direct;
  result.vanished = std::move(found.vanished);
  result.hull = std::move(found.hull);
  timed(result.phases, Phase::kIntersection, monitor,
        [&](const nef::Monitor& watching) { look_at_pieces(run.options, result, watching); });
  if (place.moved()) {
    timed(result.phases, Phase::kIntersection, monitor, [&](const nef::Monitor& watching) {
      result.hull = nef::transform(result.hull, nef::AffineMap::translate(place.shift), watching);
    });
  }
  if (run.options.verify && !result.vanished) {
    timed(result.phases, Phase::kVerify, monitor, [&](const nef::Monitor& watching) { verify(run, result, watching); });
  }
}

/// Masks -> Silhouettes -> Cameras, if they are to be refined -> Hull.
void hull_of_masks(const Run& run, const Scene& scene, std::vector<cv::Mat> masks, const SilhouetteOptions& options,
                   Place place, Result& result, const nef::Monitor& monitor) {
  std::vector<Silhouette> outlines(run.options.refine ? result.views.size() : 0);
  add_silhouettes(run, scene, std::move(masks), options, result, outlines, monitor);
  if (run.options.refine) refine_views(run, scene, outlines, result, place, monitor);
  finish(run, scene, std::move(place), result, monitor);
}

}  // namespace

Result compute(const Scene& scene, const std::filesystem::path& folder, const Options& options) {
  return HullStream(scene, options).frame(folder, std::nullopt, options.monitor);
}

Result silhouettes_of(const Scene& scene, const std::filesystem::path& folder, const Options& options) {
  const Run run(options, options.monitor);
  const nef::Monitor quiet = options.monitor.quiet();
  const SilhouetteOptions silhouettes = silhouette_options(scene, options);
  Result result;
  result.origin = silhouettes.origin;
  result.views = views_of(scene);
  std::vector<Silhouette> none;
  add_silhouettes(run, scene, masks_of(run, scene, folder, silhouettes, result, quiet), silhouettes, result, none,
                  quiet);
  return result;
}

struct HullStream::State {
  Scene scene;
  Options options;
  SilhouetteOptions silhouettes;
  Place place;
  Views views;
};

HullStream::HullStream(Scene scene, const Options& options) {
  check_options(scene, options);
  auto state = std::make_shared<State>();
  state->options = options;
  state->options.monitor = {};  // what it refers to need not live as long
  state->silhouettes = silhouette_options(scene, options);
  state->place = place_of(cameras_of(scene));
  state->views = views_of(scene);
  state->scene = std::move(scene);
  state_ = std::move(state);
}

Result HullStream::frame(const std::vector<cv::Mat>& masks, const nef::Monitor& monitor) const {
  const State& s = *state_;
  const Run run(s.options, monitor);
  const nef::Monitor quiet = monitor.quiet();
  if (masks.size() != s.views.size()) {
    throw nef::InputError("a frame needs one mask per view: " + std::to_string(s.views.size()) + ", not " +
                          std::to_string(masks.size()));
  }
  Result result;
  result.origin = s.silhouettes.origin;
  result.views = s.views;
  std::vector<cv::Mat> loaded(masks.size());
  timed(result.phases, Phase::kLoad, quiet, [&](const nef::Monitor& watching) {
    run.each_view(Phase::kLoad, result.views, watching, [&](std::size_t i, const nef::Monitor&) {
      const View& view = s.scene.views[i];
      if (view.polygons) return;
      if (masks[i].type() != CV_8UC1 || masks[i].empty()) {
        throw nef::InputError("view " + view.name + ": a mask has one channel of 8 bits and at least one pixel");
      }
      loaded[i] = masks[i];
      check_size_of(loaded[i], view, "the mask");
    });
  });
  hull_of_masks(run, s.scene, std::move(loaded), s.silhouettes, s.place, result, quiet);
  return result;
}

Result HullStream::frame(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& images,
                         const nef::Monitor& monitor) const {
  const State& s = *state_;
  Options options = s.options;
  if (images) options.images = images;
  const Run run(options, monitor);
  const nef::Monitor quiet = monitor.quiet();
  Result result;
  result.origin = s.silhouettes.origin;
  result.views = s.views;
  hull_of_masks(run, s.scene, masks_of(run, s.scene, folder, s.silhouettes, result, quiet), s.silhouettes, s.place,
                result, quiet);
  return result;
}

}  // namespace nef::visual_hull
