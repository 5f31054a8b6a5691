// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/verify/empty_hull.h"

#include <algorithm>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

using Indices = std::vector<std::size_t>;

/// The cones of views, each made once and only when it is asked for.
class Cones {
 public:
  Cones(const std::vector<ComparedView>& views, const WorldBox& box, const nef::Monitor& monitor)
      : views_(views), box_(box), monitor_(monitor), solids_(views.size()), made_(views.size(), false) {}

  [[nodiscard]] nef::Polyhedron room() const { return nef::make_box(box_.low, box_.high, monitor_); }

  const nef::Polyhedron& operator[](std::size_t i) {
    if (!made_[i]) solids_[i] = make_cone(*views_[i].camera, *views_[i].silhouette, box_, monitor_);
    made_[i] = true;
    return solids_[i];
  }

  bool meet(const Indices& some) {
    nef::Polyhedron left = room();
    for (const std::size_t i : some) {
      left = nef::intersect(left, (*this)[i], monitor_);
      if (left.is_empty()) return false;
    }
    return true;
  }

 private:
  const std::vector<ComparedView>& views_;
  const WorldBox& box_;
  nef::Monitor monitor_;
  std::vector<nef::Polyhedron> solids_;
  std::vector<bool> made_;
};

// A set without common point from which no view can be left out: the view at which the intersection vanishes belongs to
// it; then those it vanishes at when one starts with what has been found: the additive method [Chinneck 2008].
Indices irreducible_set(Cones& cones, std::size_t count, const nef::Monitor& monitor) {
  Indices found;
  while (true) {
    nef::Polyhedron left = cones.room();
    for (const std::size_t i : found) left = nef::intersect(left, cones[i], monitor);
    if (left.is_empty()) break;
    std::size_t last = count;
    for (std::size_t i = 0; i < count && last == count; ++i) {
      left = nef::intersect(left, cones[i], monitor);
      if (left.is_empty()) last = i;
    }
    if (last == count) return {};
    found.push_back(last);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<Indices> views_without_common_point(const std::vector<ComparedView>& views, const WorldBox& box,
                                                std::size_t most, const nef::Monitor& monitor) {
  Cones cones(views, box, monitor);
  std::vector<Indices> confirmed;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool behind = !views[i].camera->is_parallel() && sgn(depth_range(*views[i].camera, box).farthest) <= 0;
    if (behind && confirmed.size() < most) confirmed.push_back({i});
  }
  if (!confirmed.empty()) return confirmed;
  // Lines of sight may miss a small common part, so each set is confirmed; many more than wanted are not asked for.
  for (Indices& candidate : disjoint_views(views, box, 4 * most, monitor)) {
    if (confirmed.size() >= most) break;
    // A view that sees nothing of the box needs no other.
    for (const std::size_t i : candidate) {
      if (!cones.meet({i})) return {{i}};
    }
    if (!cones.meet(candidate)) confirmed.push_back(std::move(candidate));
  }
  if (!confirmed.empty()) return confirmed;
  Indices last = irreducible_set(cones, views.size(), monitor);
  if (!last.empty()) confirmed.push_back(std::move(last));
  return confirmed;
}

}  // namespace nef::visual_hull
