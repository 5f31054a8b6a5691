// SPDX-License-Identifier: Apache-2.0
//
// A facet contains a point if its plane does and the point is on no side's outer side. Doubles decide this for most
// facets; for the others, each side in doubt gets a plane across the facet, and signs are exact. That of a facet beyond
// the side will do: nothing has to be computed, and directions along the side are known by the planes of facets, as
// they are where the facets meet others. A point next to
// another one in a direction is found by trying ever shorter steps until no other facet, side or corner is in between.
#include "apps/minkowski/convolution/arrangement/facet_pyramids.h"

#include <algorithm>
#include <cmath>

#include "nef/base/threads/parallel.h"
#include "nef/geometry/compare_points.h"
#include "nef/geometry/plane_finder.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::minkowski {
namespace {

// The plane through a side and parallel to the axis of the projection, its positive side where the facet is.
PlaneId plane_across(ConvolutionFacets& facets, std::uint32_t facet, std::uint32_t side, PlaneFinder& finder) {
  const auto ring = facets.ring(facet);
  const PointId from{ring[side]};
  const PointId to{ring[side + 1 < ring.size() ? side + 1 : 0]};
  const auto [axis, sign] = projection_axis(facets.planes, facets.plane[facet]);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  Integer3 normal;
  const PointTable& points = facets.points;
  const auto difference = [&](std::size_t i) {
    return Integer(Integer(points.coordinate(to, i)) * Integer(points.coordinate(from, 3)) -
                   Integer(points.coordinate(from, i)) * Integer(points.coordinate(to, 3)));
  };
  normal[u] = -sign * difference(v);
  normal[v] = sign * difference(u);
  return finder.through(facets.planes, points, normal, from);
}

}  // namespace

// New planes are named on one thread, in order.
FacetPyramids::FacetPyramids(ConvolutionFacets& facets, const RoundedFacets& rounded, const SharedSides& at_side,
                             const BoxTree& tree, const Monitor& monitor)
    : facets_(facets), rounded_(rounded), at_side_(at_side), tree_(tree), side_plane_(facets.corners.size()) {
  constexpr std::size_t kAtOnce = 1024;
  parallel_for_ranges(facets.size(), kAtOnce, monitor, [&](std::size_t first, std::size_t last, const Monitor& own) {
    for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) {
      for (std::uint32_t i = 0; i < facets.ring(f).size(); ++i) {
        side_plane_[facets.begin[f] + i] = plane_beyond(f, i, own);
      }
    }
  });
  PlaneFinder finder;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (std::uint32_t i = 0; i < facets.ring(f).size(); ++i) {
      PlaneId& plane = side_plane_[facets.begin[f] + i];
      if (!plane.valid()) plane = plane_across(facets, f, i, finder);
    }
  }
}

// The plane of another facet at a side, turned so that its positive side is where this facet is. None if all of them
// are in one plane, or the side goes straight on at an end: then the next one must have the same plane.
PlaneId FacetPyramids::plane_beyond(std::uint32_t facet, std::uint32_t side, const Monitor& monitor) const {
  const auto ring = facets_.ring(facet);
  const auto size = static_cast<std::uint32_t>(ring.size());
  for (const std::uint32_t other : at_side_(facet, side)) {
    const PlaneId plane = facets_.plane[other];
    if (plane.row() == facets_.plane[facet].row()) continue;
    const auto sign_at = [&](std::uint32_t corner) {
      return side_of_plane(facets_.planes, plane, facets_.points, PointId{ring[corner % size]}, monitor);
    };
    const int before = sign_at(side + size - 1);
    if (before == 0 || sign_at(side + 2) == 0) return PlaneId();
    return before > 0 ? plane : plane.opposite();
  }
  return PlaneId();
}

bool FacetPyramids::locate(std::uint32_t facet, const PointTable& points, PointId point, FacetAtPoint& result,
                           const Monitor& monitor) const {
  const Double3& x = points.approximate(point);
  const RoundedFace& plane = rounded_.plane(facet);
  const double value = plane.value(x);
  if (value > plane.slack || value < -plane.slack) return false;
  const std::span<const RoundedSide> sides = rounded_.sides(facet);
  result = {facet, {}, {kNone, kNone}};
  std::uint64_t doubtful = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double inside = sides[i].value(x);
    const double doubt = sides[i].slack + sides[i].weight * rounded_.corner_error();
    if (inside < -doubt) return false;
    if (!(inside > doubt)) doubtful |= std::uint64_t{1} << std::min<std::size_t>(i, 63);
  }
  if (side_of_plane(facets_.planes, facets_.plane[facet], points, point, monitor) != 0) return false;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    if ((doubtful >> std::min(i, 63U) & 1U) == 0) continue;
    const PlaneId side = side_plane(facet, i);
    const int sign = side_of_plane(facets_.planes, side, points, point, monitor);
    if (sign < 0) return false;
    if (sign > 0 || side == result.sides[0] || side == result.sides[1]) continue;
    const std::size_t k = result.sides[0].valid() ? 1 : 0;
    result.sides[k] = side;
    result.numbers[k] = i;
  }
  return true;
}

void FacetPyramids::facets_at(const PointTable& points, PointId point, std::vector<FacetAtPoint>& found,
                              const Monitor& monitor) const {
  Box box;
  box.add_rounded(points.approximate(point));
  found.clear();
  FacetAtPoint at;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (locate(f, points, point, at, monitor)) found.push_back(at);
  });
}

bool FacetPyramids::goes_on(const FacetAtPoint& at, const Direction& direction, const Monitor& monitor) const {
  const PlaneTable& planes = facets_.planes;
  if (side_of_circle(planes, facets_.plane[at.facet], direction, monitor) != 0) return false;
  return std::all_of(at.sides.begin(), at.sides.end(), [&](PlaneId side) {
    return !side.valid() || side_of_circle(planes, side, direction, monitor) >= 0;
  });
}

// A facet's inside is one item, and so is each side, which ends at corners even where it goes straight on: marks may
// change there.
bool FacetPyramids::is_same_item(const FacetAtPoint& at, const PointTable& points, PointId from, PointId to,
                                 const Monitor& monitor) const {
  FacetAtPoint there;
  if (!locate(at.facet, points, to, there, monitor)) return false;
  const PlaneTable& planes = facets_.planes;
  for (const PlaneId side : there.sides) {
    if (!side.valid()) continue;
    if (side != at.sides[0] && side != at.sides[1]) return false;
    const auto order = [&](PointId p, const PointTable& others, PointId q) {
      int sign = 0;
      for (int axis = 0; axis < 3 && sign == 0; ++axis) {
        sign = compare_coordinate(points, p, others, q, axis, monitor);
      }
      return sign;
    };
    const int way = order(from, points, to);
    for (const std::uint32_t corner : facets_.ring(at.facet)) {
      const PointId c{corner};
      if (side_of_plane(planes, side, facets_.points, c, monitor) != 0) continue;
      if (order(from, facets_.points, c) == way && order(to, facets_.points, c) != way) return false;
    }
  }
  return true;
}

bool FacetPyramids::holds(std::uint32_t facet, const PointTable& points, PointId point, const Monitor& monitor) const {
  FacetAtPoint unused;
  return locate(facet, points, point, unused, monitor);
}

Rational3 FacetPyramids::point_towards(const PointTable& points, PointId from, const Direction& direction,
                                       const Monitor& monitor) const {
  const Integer3& d = direction.integers();
  const Rational3 at = points.rational(from);
  std::vector<FacetAtPoint> here;
  facets_at(points, from, here, monitor);
  PointTable ends;  // the point, and the one that is tried
  const PointId start = ends.push_from(points, from);
  const Box bounds = tree_.bounds();
  double extent = 0;
  std::size_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max(extent, bounds.high[i] - bounds.low[i]);
    bits = std::max(bits, mpz_sizeinbase(d[i].get_mpz_t(), 2));
  }
  int exponent = 0;
  std::frexp(extent, &exponent);
  for (int step = exponent - static_cast<int>(bits) - 3;; step -= 2) {
    Rational factor(1);
    if (step < 0) {
      mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-step));
    } else {
      mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(step));
    }
    Rational3 x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = at[i] + factor * d[i];
    const PointId there = ends.push(x);
    // Facets are convex: those that do not go on are not met again.
    const bool clear =
        sees(ends, start, there, here, monitor) && std::all_of(here.begin(), here.end(), [&](const FacetAtPoint& f) {
          return !goes_on(f, direction, monitor) || is_same_item(f, ends, start, there, monitor);
        });
    ends.pop();
    if (clear) return x;
  }
}

bool FacetPyramids::sees(const PointTable& points, PointId from, PointId to, const std::vector<FacetAtPoint>& except,
                         const Monitor& monitor) const {
  const PlaneTable& planes = facets_.planes;
  Box box;
  box.add_rounded(points.approximate(from));
  box.add_rounded(points.approximate(to));
  bool clear = true;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (!clear || std::any_of(except.begin(), except.end(), [f](const FacetAtPoint& e) { return e.facet == f; }))
      return;
    const int side = side_of_plane(planes, facets_.plane[f], points, from, monitor);
    if (side != 0 && side_of_plane(planes, facets_.plane[f], points, to, monitor) == side) return;
    for (std::uint32_t i = 0; i < facets_.ring(f).size(); ++i) {
      const PlaneId across = side_plane(f, i);
      if (side_of_plane(planes, across, points, from, monitor) < 0 &&
          side_of_plane(planes, across, points, to, monitor) < 0)
        return;
    }
    clear = false;
  });
  return clear;
}

}  // namespace nef::minkowski
