// SPDX-License-Identifier: Apache-2.0
//
// The pipeline: Scene -> Silhouettes -> Box -> Cones -> Hull. The box is the smallest one around the convex hulls of
// the cones, found by linear programs (cones/bounds.h), unless one is given. The hull comes from one of two ways with
// the same result: vertex by vertex (viewing_edges/), which is faster for detailed outlines but covers fewer cases, or
// by intersecting cones as Nef polyhedra in a balanced tree (cones/). The first one returns nothing for what it does
// not cover, and then the second one follows. If the hull has no volume, the last part finds out which views have no
// point in common.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>

#include "apps/visual_hull/cones/at_least.h"
#include "apps/visual_hull/cones/bounds.h"
#include "apps/visual_hull/cones/intersection.h"
#include "apps/visual_hull/masks/cut_out.h"
#include "apps/visual_hull/scene/place.h"
#include "apps/visual_hull/scene/understanding.h"
#include "apps/visual_hull/silhouette/opacity.h"
#include "apps/visual_hull/stream.h"
#include "apps/visual_hull/verify/empty_hull.h"
#include "apps/visual_hull/viewing_edges/background_view.h"
#include "apps/visual_hull/viewing_edges/direct_hull.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/construct/construct.h"
#include "nef/parts/by_volume.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::visual_hull {
namespace {

constexpr std::size_t kDirectVertices = 150;  // of all polygons: with fewer the general way is as fast

constexpr std::size_t kFewestViews = 3;  // that are left when suspects are dropped

using Views = std::vector<ViewResult>;

/// What every step needs to know about the run.
struct Run {
  const Options& options;
  /// Tells the monitor of the run. All steps have a monitor that does not tell by itself, since what is told is about
  /// views, not about the operations on their sets.
  nef::ProgressFunction show;

  Run(const Options& its_options, const nef::Monitor& monitor)
      : options(its_options), show([monitor](const char* phase, std::size_t done, std::size_t total) {
          monitor.tell_progress(phase, done, total);
        }) {}

  static std::string step(Phase phase, const std::string& view) {
    return view.empty() ? phase_name(phase) : phase_name(phase) + (" " + view);
  }
  /// By the thread of the run.
  void tell(Phase phase, const std::string& view, std::size_t done, std::size_t total) const {
    show(step(phase, view).c_str(), done, total);
  }

  /// body(i, own) for every view, on as many threads as the user allows.
  void each_view(Phase phase, const Views& views, const nef::Monitor& monitor,
                 const std::function<void(std::size_t, const nef::Monitor& own)>& body) const {
    std::atomic<std::size_t> begun = 0;
    nef::parallel_for(views.size(), monitor.telling(show), [&](std::size_t i, const nef::Monitor& own) {
      own.tell_progress(step(phase, views[i].name).c_str(), begun++, views.size());
      body(i, own.quiet());
    });
  }
};

// What the command line does not say about masks, the scene does.
SilhouetteOptions silhouette_options(const Scene& scene, const Options& options) {
  SilhouetteOptions result = options.silhouette;
  result.origin = options.origin.value_or(scene.origin);
  if (!scene.threshold) return result;
  ThresholdOptions& threshold = result.threshold;
  if (threshold.kind == ThresholdOptions::Kind::kDefault) {
    threshold.kind = scene.threshold->kind;
    threshold.value = scene.threshold->value;
  }
  if (threshold.channel == ThresholdOptions::Channel::kGray) threshold.channel = scene.threshold->channel;
  threshold.invert = threshold.invert || scene.threshold->invert;
  return result;
}

void check_size_of(const cv::Mat& mask, const View& view, const std::string& what) {
  if (!view.size || (view.size->width == mask.cols && view.size->height == mask.rows)) return;
  throw nef::InputError("view " + view.name + ": " + what + " has " + std::to_string(mask.cols) + " x " +
                        std::to_string(mask.rows) + " pixels, but its camera was calibrated for " +
                        std::to_string(view.size->width) + " x " + std::to_string(view.size->height) +
                        ": scale the image or the intrinsics");
}

/// Decides again what the other views contradict, of the masks of photographs.
void repair_cut_out(const Run& run, PixelOrigin origin, Result& result, std::vector<cv::Mat>& masks,
                    const nef::Monitor& monitor) {
  run.tell(Phase::kLoad, "masks, compared", 0, masks.size());
  std::vector<PhotographedView> views;
  std::vector<std::size_t> numbers;
  std::vector<cv::Mat> own;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const ViewResult& view = result.views[i];
    if (view.image.empty()) continue;
    views.push_back({view.name, view.image, view.camera, view.distortion});
    numbers.push_back(i);
    own.push_back(object_of(masks[i]));
  }
  const std::vector<MaskChange> changes = repair_masks(views, origin, own, monitor);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    cv::Mat& mask = masks[numbers[k]];
    own[k].copyTo(mask, object_of(mask) != own[k]);
    result.views[numbers[k]].mask_change = changes[k];
  }
  const nef::Messages lines = change_lines(views, changes);
  result.notes.insert(result.notes.end(), lines.begin(), lines.end());
}

/// The masks of photographs, in one go, since one rule is looked for that suits all.
void cut_out_views(const Run& run, const Scene& scene, Result& result, std::vector<cv::Mat>& masks,
                   const nef::Monitor& monitor) {
  std::vector<std::filesystem::path> photographs;
  for (const ViewResult& view : result.views) {
    if (!view.image.empty()) photographs.push_back(view.image);
  }
  if (photographs.empty()) return;
  run.tell(Phase::kLoad, "masks", 0, photographs.size());
  MaskMethod method = *run.options.mask;
  method.soft = run.options.silhouette.soft;
  CutOuts cut = cut_out(photographs, method, monitor);
  result.notes.push_back("masks: " + cut.chosen);
  result.notes.insert(result.notes.end(), cut.notes.begin(), cut.notes.end());
  std::size_t next = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (result.views[i].image.empty()) continue;
    masks[i] = std::move(cut.masks[next++]);
    check_size_of(masks[i], scene.views[i], result.views[i].image.string());
  }
  if (run.options.repair_masks) repair_cut_out(run, result.origin, result, masks, monitor);
}

cv::Mat load_mask(const ViewResult& entry, const View& view, const SilhouetteOptions& options) {
  if (entry.image.empty()) return {};
  cv::Mat mask = read_mask(entry.image, view.name, options);
  check_size_of(mask, view, entry.image.string());
  return mask;
}

/// The views of a scene before any image is seen.
Views views_of(const Scene& scene) {
  Views views(scene.views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].name = scene.views[i].name;
    views[i].camera = scene.views[i].camera;
    views[i].distortion = scene.views[i].distortion;
  }
  return views;
}

/// Scene -> Masks.
std::vector<cv::Mat> masks_of(const Run& run, const Scene& scene, const std::filesystem::path& folder,
                              const SilhouetteOptions& options, Result& result, const nef::Monitor& monitor) {
  std::vector<cv::Mat> masks(result.views.size());
  timed(result.phases, Phase::kLoad, monitor, [&](const nef::Monitor& watching) {
    const std::vector<std::filesystem::path> images = images_of(scene, folder, run.options.images, &result.notes);
    for (std::size_t i = 0; i < masks.size(); ++i) {
      if (!scene.views[i].polygons) result.views[i].image = images[i];
    }
    if (run.options.mask) return cut_out_views(run, scene, result, masks, watching);
    run.each_view(Phase::kLoad, result.views, watching, [&](std::size_t i, const nef::Monitor&) {
      masks[i] = load_mask(result.views[i], scene.views[i], options);
    });
  });
  return masks;
}

/// A silhouette as cameras are refined by: along the sides of pixels, and nothing beyond the frame.
Silhouette outline_of(const View& view, const cv::Mat& mask, SilhouetteOptions options, const nef::Monitor& monitor) {
  options.simplify = {};
  options.border = Border::kOutside;
  return view.polygons ? silhouette_of_polygons(*view.polygons, view.name, options, monitor).region
                       : silhouette_of_mask(mask, view.distortion, view.name, options, monitor).region;
}

/// Masks -> Silhouettes; also as they are before anything is simplified, where `outlines` has a place for each view.
void add_silhouettes(const Run& run, const Scene& scene, std::vector<cv::Mat> masks, const SilhouetteOptions& options,
                     Result& result, std::vector<Silhouette>& outlines, const nef::Monitor& monitor) {
  timed(result.phases, Phase::kContours, monitor, [&](const nef::Monitor& watching) {
    run.each_view(Phase::kContours, result.views, watching, [&](std::size_t i, const nef::Monitor& own) {
      const View& view = scene.views[i];
      result.views[i].silhouette = view.polygons
                                       ? silhouette_of_polygons(*view.polygons, view.name, options, own)
                                       : silhouette_of_mask(masks[i], view.distortion, view.name, options, own);
      if (!outlines.empty()) outlines[i] = outline_of(view, masks[i], options, own);
      masks[i].release();
    });
  });
}

/// The size that all images have. Throws InputError naming a view of another size, or of no image.
ImageSize size_of_all(const Views& views) {
  const cv::Size first = views[0].silhouette.image_size;
  for (const ViewResult& view : views) {
    const cv::Size& size = view.silhouette.image_size;
    if (size != first || size.area() == 0) {
      throw nef::InputError("view " + view.name + ": images of a turntable have one size");
    }
  }
  return {first.width, first.height};
}

/// Puts the cameras that the silhouettes agree on best in the place of those that were given.
void refine_views(const Run& run, const Scene& scene, const std::vector<Silhouette>& outlines, Result& result,
                  Place& place, const nef::Monitor& monitor) {
  timed(result.phases, Phase::kRefine, monitor, [&](const nef::Monitor& watching) {
    run.tell(Phase::kRefine, "", 0, 1);
    std::vector<refine::GivenView> given;
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      const ViewSilhouette& s = result.views[i].silhouette;
      const ImageSize frame = s.cut_by_frame ? ImageSize{s.image_size.width, s.image_size.height} : ImageSize{};
      given.push_back({scene.views[i].name, result.views[i].camera, &outlines[i], frame, scene.views[i].distortion});
    }
    refine::RefineOptions options{result.origin, {}, scene.camera_error};
    if (scene.guessed) options.turntable = size_of_all(result.views);
    result.refinement = refine::refine_cameras(given, options, watching);
    if (!result.refinement->accepted) return;
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      cameras.push_back(result.refinement->views[i].camera);
      result.views[i].camera = cameras.back();
    }
    place = place_of(cameras);
  });
}

std::vector<ComparedView> compared(const Views& views, const Place& place) {
  std::vector<ComparedView> result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewSilhouette& s = views[i].silhouette;
    if (!s.background) result.push_back({&place.cameras[i], &s.region, s.cut_by_frame});
  }
  return result;
}

std::size_t polygon_vertices(const Views& views) {
  std::size_t vertices = 0;
  for (const ViewResult& view : views) {
    if (!view.silhouette.background) vertices += view.silhouette.region.vertex_count();
  }
  return vertices;
}

bool worth_direct(const Views& views) { return polygon_vertices(views) >= kDirectVertices; }

/// The box to look at, in the coordinates of the place.
struct Room {
  WorldBox box;
  bool found = false;                 ///< from the cones
  std::optional<WorldBox> enclosing;  ///< known to hold the hull in its interior
  bool empty = false;                 ///< the convex hulls of the cones have no common point; the box is a guess
};

// Around the point that the cameras look at, as far as the farthest of them.
WorldBox guessed_box(const Place& place) {
  std::vector<Sight> sights;
  for (const Camera& camera : place.cameras) sights.push_back(sight_of(camera));
  const Eigen::Vector3d middle = common_point(sights).value_or(sights[0].centre);
  double reach = 0;
  for (const Sight& s : sights) reach = std::max(reach, (middle - s.centre).norm());
  if (!(reach > 0)) reach = 1;
  WorldBox box;
  for (int i = 0; i < 3; ++i) {
    box.low[static_cast<std::size_t>(i)] = nef::exact_rational(middle[i] - 2 * reach);
    box.high[static_cast<std::size_t>(i)] = nef::exact_rational(middle[i] + 2 * reach);
  }
  return box;
}

Room room_of(const Scene& scene, const Options& options, const Views& views, const Place& place,
             const nef::Monitor& monitor) {
  Room room;
  const bool given = options.box || scene.box;
  if (given) {
    const WorldBox& box = options.box ? *options.box : *scene.box;
    check_box(box, "box");
    room.box = place.inward(box);
    // Only the direct way asks for more.
    if (options.way == Way::kCones || options.at_least) return room;
    if (options.way == Way::kBest && !worth_direct(views)) return room;
  }
  std::vector<std::vector<HalfSpace>> cones(views.size());  // none for views that keep what they do not see
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].silhouette.background) continue;
    cones[i] = convex_cone(place.cameras[i], views[i].silhouette.region, monitor);
  }
  const Bounds bounds = bounds_of_at_least(cones, std::min(options.at_least.value_or(views.size()), views.size()));
  if (bounds.kind == Bounds::Kind::kBox) room.enclosing = loosen(bounds.box);
  if (given) return room;
  if (bounds.kind == Bounds::Kind::kUnbounded) {
    throw nef::InputError(
        std::string(options.at_least ? "the cones of fewer views than all" : "the cones of the views") +
        " do not bound the scene: give a box with --box x0,y0,z0,x1,y1,z1");
  }
  room.found = true;
  room.empty = bounds.kind == Bounds::Kind::kEmpty;
  room.box = room.empty ? guessed_box(place) : *room.enclosing;
  return room;
}

/// Compares the views and, if that is asked for, leaves out the guilty ones. The room is found anew without them.
void compare(const Run& run, const Scene& scene, Result& result, Place& place, Room& room,
             const nef::Monitor& monitor) {
  while (true) {
    const std::vector<ComparedView> views = compared(result.views, place);
    Consistency found = compare_views(views, room.box, monitor);
    const bool all = views.size() == result.views.size();
    if (!all) return;  // views that keep what they do not see are not judged
    const std::optional<std::size_t> guilty = found.guilty;
    if (!run.options.drop_suspects || !guilty || result.views.size() <= kFewestViews) {
      result.consistency = std::move(found);
      return;
    }
    result.dropped.push_back({result.views[*guilty].name, found.views[*guilty], found.share(*guilty)});
    const auto at = static_cast<std::ptrdiff_t>(*guilty);
    result.views.erase(result.views.begin() + at);
    place.cameras.erase(place.cameras.begin() + at);
    room = room_of(scene, run.options, result.views, place, monitor);
  }
}

/// What a view leaves of the room: its cone; of a view that keeps what it does not see, the complement of the cone of
/// its background.
Part part_of(ViewResult& view, const Camera& camera, const Room& room, const nef::Monitor& monitor) {
  nef::Polyhedron cone = make_cone(camera, view.silhouette.region, room.box, monitor);
  view.cone_facets = nef::counts(cone).facets;
  if (view.silhouette.background) cone = nef::complement(nef::interior(cone, monitor));
  return {std::move(cone), camera.axis()};
}

std::vector<Part> cones_of(const Run& run, Views& views, const Place& place, const Room& room,
                           const nef::Monitor& monitor) {
  std::vector<Part> parts(views.size());
  run.each_view(Phase::kCones, views, monitor, [&](std::size_t i, const nef::Monitor& own) {
    parts[i] = part_of(views[i], place.cameras[i], room, own);
  });
  return parts;
}

/// True if a box that was given may cut the hull.
bool box_cuts(const Room& room) {
  bool cuts = false;
  for (std::size_t i = 0; i < 3 && !room.found; ++i) {
    cuts = cuts || room.enclosing->low[i] <= room.box.low[i] || room.enclosing->high[i] >= room.box.high[i];
  }
  return cuts;
}

/// The hull vertex by vertex, where the views allow that and it is worth it. A box that cuts it comes afterwards, as an
/// operand of a Boolean.
std::optional<nef::Polyhedron> direct(const Run& run, const Views& views, const Place& place, const Room& room,
                                      const nef::Monitor& monitor) {
  if (!room.enclosing) return std::nullopt;
  if (run.options.way == Way::kBest && !worth_direct(views)) return std::nullopt;
  std::vector<DirectView> inputs;
  std::vector<Silhouette> kept(views.size());  // of views that keep what they do not see
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewSilhouette& seen = views[i].silhouette;
    inputs.push_back({&place.cameras[i], &seen.region});
    if (!seen.background) continue;
    std::optional<Silhouette> region = beside_background(place.cameras[i], seen.region, *room.enclosing, monitor);
    if (!region) return std::nullopt;
    kept[i] = *std::move(region);
    inputs[i].silhouette = &kept[i];
  }
  run.tell(Phase::kIntersection, "edges", 0, 1);
  std::optional<nef::Polyhedron> hull = direct_hull(inputs, *room.enclosing, monitor);
  if (!hull) return std::nullopt;
  if (box_cuts(room)) hull = nef::intersect(*hull, nef::make_box(room.box.low, room.box.high, monitor), monitor);
  if (nef::counts(*hull).volumes < 2) return std::nullopt;  // empty or flat: the general way finds out why
  return hull;
}

/// Cones -> Hull.
nef::Polyhedron hull_of_parts(const Run& run, const Views& views, const Room& room, const std::vector<Part>& parts,
                              const nef::Monitor& monitor) {
  const nef::Polyhedron box = nef::make_box(room.box.low, room.box.high, monitor);
  if (run.options.at_least) {
    std::vector<nef::Polyhedron> cones;
    for (const Part& part : parts) cones.push_back(part.solid);
    return in_at_least(cones, *run.options.at_least, box, monitor);
  }
  std::vector<Part> all = parts;
  // A box that was found is larger than what the cones leave, but for views that keep space.
  bool needed = !room.found;
  for (const ViewResult& view : views) needed = needed || view.silhouette.background;
  if (needed) all.push_back({box, {}});
  return intersect_parts(std::move(all), monitor.telling(run.show));
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

/// Why the hull is empty.
Vanished explain_empty(const Run& run, const Views& views, const Place& place, const Room& room,
                       const nef::Monitor& monitor) {
  constexpr std::size_t kMostSets = 5;
  Vanished vanished{views.back().name, "the views have no point in common", {}};
  const std::vector<ComparedView> plain = compared(views, place);
  if (run.options.at_least) vanished.reason = "no point lies in that many silhouettes";
  if (plain.size() < views.size() || run.options.at_least) return vanished;
  for (const auto& set : views_without_common_point(plain, room.box, kMostSets, monitor)) {
    std::vector<std::string> names;
    for (const std::size_t i : set) names.push_back(views[i].name);
    if (vanished.sets.empty()) {
      const Camera& camera = place.cameras[set.back()];
      vanished.view = views[set.back()].name;
      if (set.size() > 1) {
        vanished.reason = "views " + list_of(names) + " have no point in common";
      } else if (!camera.is_parallel() && sgn(depth_range(camera, room.box).farthest) <= 0) {
        vanished.reason = "the whole box lies behind its camera (a matrix of the other sign?)";
      } else {
        vanished.reason = "it sees nothing of the box";
      }
    }
    vanished.sets.push_back(std::move(names));
  }
  return vanished;
}

/// At which view the last volume went, of a hull that has points, edges or facets only.
Vanished explain_flat(const Views& views, const Room& room, const std::vector<Part>& parts,
                      const nef::Monitor& monitor) {
  const nef::Polyhedron box = nef::make_box(room.box.low, room.box.high, monitor);
  const std::size_t view = vanishes_at(parts, box, true, monitor).value_or(parts.size() - 1);
  return {views[view].name, "what it leaves has no volume (only points, edges or facets)", {}};
}

/// A hull, or why there is none with a volume.
struct FoundHull {
  nef::Polyhedron hull;
  bool direct = false;  ///< made vertex by vertex
  std::optional<Vanished> vanished;
};

/// Cones -> Hull, where the direct way is not asked for or does not do.
FoundHull hull_of_cones(const Run& run, const Place& place, const Room& room, Views& views, PhaseReports& phases,
                        const nef::Monitor& monitor) {
  FoundHull found;
  std::vector<Part> parts;
  if (!room.empty) {
    timed(phases, Phase::kCones, monitor,
          [&](const nef::Monitor& watching) { parts = cones_of(run, views, place, room, watching); });
    timed(phases, Phase::kIntersection, monitor,
          [&](const nef::Monitor& watching) { found.hull = hull_of_parts(run, views, room, parts, watching); });
  }
  timed(phases, Phase::kIntersection, monitor, [&](const nef::Monitor& watching) {
    if (found.hull.is_empty()) {
      found.vanished = explain_empty(run, views, place, room, watching);
    } else if (nef::interior(found.hull, watching).is_empty()) {
      found.vanished = explain_flat(views, room, parts, watching);
    }
  });
  return found;
}

/// Silhouettes, Box -> Hull, in the coordinates of the place.
FoundHull hull_in_room(const Run& run, const Place& place, const Room& room, Views& views, PhaseReports& phases,
                       const nef::Monitor& monitor) {
  std::optional<nef::Polyhedron> made;
  if (!room.empty && run.options.way != Way::kCones && !run.options.at_least) {
    timed(phases, Phase::kIntersection, monitor,
          [&](const nef::Monitor& watching) { made = direct(run, views, place, room, watching); });
  }
  if (made) return {*std::move(made), true, std::nullopt};
  if (run.options.way == Way::kDirect) {
    throw nef::InputError(
        "--way direct does not work for these views (fewer than three, views that do not bound the hull without those "
        "that the frame cuts, a camera too close to it, or too many coincidences that doubles do not decide); use "
        "--way cones");
  }
  return hull_of_cones(run, place, room, views, phases, monitor);
}

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

}  // namespace

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
