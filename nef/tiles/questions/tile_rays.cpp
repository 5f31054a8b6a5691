// SPDX-License-Identifier: Apache-2.0
//
// A ray goes through the tiles along it, the near side of a cut first. What it meets inside of a tile is what it meets
// of the whole; at a seam the local pyramids of all tiles there tell what is there of the whole, if not a wall alone,
// and whether the ray runs on in it, which does not count as meeting it.
#include "nef/tiles/questions/tile_rays.h"

#include <utility>

#include "nef/geometry/vectors.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/tiles/questions/tile_queries.h"

namespace nef {
namespace {

using Kind = TileNode::Kind;

class RayThroughTiles {
 public:
  RayThroughTiles(const TileRef& tree, const Rational3& direction, const std::function<bool(const Location&)>& accept,
                  const Monitor& monitor)
      : tree_(tree), direction_(direction), accept_(accept), monitor_(monitor) {
    while (direction_[axis_] == 0) ++axis_;
  }

  // The first hit in the region of a subtree.
  std::optional<RayHit> first(const TileRef& at, const Region& region, const Rational3& origin) {
    if (at.node->kind == Kind::kUniform) return std::nullopt;
    if (at.node->kind == Kind::kTile) return in_tile(leaf_set(at, region, monitor_), origin);
    const AxisPlane& plane = at.node->plane;
    const auto [low, high] = children(at);
    const int side = cmp(origin[plane.axis], plane.at);
    const int way = sgn(direction_[plane.axis]);
    const bool in_low = side < 0 || (side == 0 && way <= 0) || way < 0;
    const bool in_high = side > 0 || (side == 0 && way >= 0) || way > 0;
    std::optional<RayHit> of_low;
    std::optional<RayHit> of_high;
    // What is met on the near side, on the cut at the latest, comes before all on the far side.
    if (in_low && way >= 0) of_low = first(low, region.below(plane), origin);
    if (of_low && way > 0) return of_low;
    if (in_high) of_high = first(high, region.above(plane), origin);
    if (of_high && way < 0) return of_high;
    if (in_low && way < 0) of_low = first(low, region.below(plane), origin);
    if (of_low && of_high) return before(of_high->point, of_low->point) ? of_high : of_low;
    return of_low ? of_low : of_high;
  }

 private:
  // Along the ray.
  [[nodiscard]] bool before(const Rational3& p, const Rational3& q) const {
    return cmp(p[axis_], q[axis_]) * sgn(direction_[axis_]) < 0;
  }

  [[nodiscard]] std::optional<RayHit> in_tile(const Polyhedron& set, Rational3 from) const {
    while (std::optional<RayHit> hit = shoot_ray(set, from, direction_, {}, monitor_)) {
      if (const std::optional<Location> met = item_met(hit->point)) return RayHit{*met, hit->point};
      from = std::move(hit->point);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Location> item_met(const Rational3& point) const {
    const PyramidInTiles there = pyramid_in_tiles(tree_, point, monitor_);
    const Location location = there.location(monitor_);
    if (location.kind == Location::Kind::kVolume || runs_in(there, location.kind)) return std::nullopt;
    if (accept_ && !accept_(location)) return std::nullopt;
    return location;
  }

  [[nodiscard]] bool runs_in(const PyramidInTiles& there, Location::Kind kind) const {
    if (kind == Location::Kind::kFacet) {
      Rational product = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        product += Rational(Integer(there.planes.coefficient(there.map.sloops[0].plane, i))) * direction_[i];
      }
      return product == 0;
    }
    if (kind != Location::Kind::kEdge) return false;
    const Integer3& along = direction_of(there.planes, there.map.svertices[0]).integers();
    return is_zero(cross(Rational3{along[0], along[1], along[2]}, direction_));
  }

  const TileRef& tree_;
  const Rational3& direction_;
  const std::function<bool(const Location&)>& accept_;
  Monitor monitor_;
  std::size_t axis_ = 0;  // along which the ray goes
};

}  // namespace

std::optional<RayHit> first_hit_in_tiles(const TileRef& tree, const Rational3& origin, const Rational3& direction,
                                         const std::function<bool(const Location&)>& accept, const Monitor& monitor) {
  return RayThroughTiles(tree, direction, accept, monitor).first(tree, Region{}, origin);
}

}  // namespace nef
