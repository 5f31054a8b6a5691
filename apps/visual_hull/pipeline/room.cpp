// SPDX-License-Identifier: Apache-2.0
//
// The box is the smallest one around the convex hulls of the cones, found by linear programs (cones/bounds.h), unless
// one is given.
#include "apps/visual_hull/pipeline/room.h"

#include <algorithm>
#include <cstddef>

#include "apps/visual_hull/cones/at_least.h"
#include "apps/visual_hull/cones/bounds.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

constexpr std::size_t kDirectVertices = 150;  // of all polygons: with fewer the general way is as fast

constexpr std::size_t kFewestViews = 3;  // that are left when suspects are dropped

std::size_t polygon_vertices(const Views& views) {
  std::size_t vertices = 0;
  for (const ViewResult& view : views) {
    if (!view.silhouette.background) vertices += view.silhouette.region.vertex_count();
  }
  return vertices;
}

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

}  // namespace

std::vector<ComparedView> compared(const Views& views, const Place& place) {
  std::vector<ComparedView> result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewSilhouette& s = views[i].silhouette;
    if (!s.background) result.push_back({&place.cameras[i], &s.region, s.cut_by_frame});
  }
  return result;
}

bool worth_direct(const Views& views) { return polygon_vertices(views) >= kDirectVertices; }

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

}  // namespace nef::visual_hull
