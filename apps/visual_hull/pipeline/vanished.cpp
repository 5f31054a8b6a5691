// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/pipeline/vanished.h"

#include <string>

#include "apps/visual_hull/verify/empty_hull.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull {
namespace {

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

}  // namespace

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

Vanished explain_flat(const Views& views, const Room& room, const std::vector<Part>& parts,
                      const nef::Monitor& monitor) {
  const nef::Polyhedron box = nef::make_box(room.box.low, room.box.high, monitor);
  const std::size_t view = vanishes_at(parts, box, true, monitor).value_or(parts.size() - 1);
  return {views[view].name, "what it leaves has no volume (only points, edges or facets)", {}};
}

}  // namespace nef::visual_hull
