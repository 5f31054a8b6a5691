// SPDX-License-Identifier: Apache-2.0
//
// The hull comes from one of two ways with the same result: vertex by vertex (viewing_edges/), which is faster for
// detailed outlines but covers fewer cases, or by intersecting cones as Nef polyhedra in a balanced tree (cones/). The
// first one returns nothing for what it does not cover, and then the second one follows.
#include "apps/visual_hull/pipeline/hull_in_room.h"

#include <utility>
#include <vector>

#include "apps/visual_hull/cones/at_least.h"
#include "apps/visual_hull/cones/intersection.h"
#include "apps/visual_hull/pipeline/vanished.h"
#include "apps/visual_hull/viewing_edges/background_view.h"
#include "apps/visual_hull/viewing_edges/direct_hull.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {
namespace {

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

}  // namespace

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

}  // namespace nef::visual_hull
