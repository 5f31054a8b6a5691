// SPDX-License-Identifier: Apache-2.0
//
// A facet contains a point if its plane does and the point is on no side's outer side. Doubles decide this for most
// facets; for the others, each side in doubt becomes a plane across the facet, and signs are exact. A point next to
// another one in a direction is found by trying ever shorter steps until no other facet, side or corner is in between.
#include "apps/minkowski/convolution/arrangement/facet_pyramids.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/plane_finder.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::minkowski {

// The plane through a side and parallel to the axis of the projection, its positive side where the facet is.
PlaneId FacetPyramids::side_plane(std::uint32_t facet, std::uint32_t side) {
  PlaneId& plane = side_plane_[facets_.begin[facet] + side];
  if (plane.valid()) return plane;
  const auto ring = facets_.ring(facet);
  const PointId from{ring[side]};
  const PointId to{ring[side + 1 < ring.size() ? side + 1 : 0]};
  const auto [axis, sign] = projection_axis(facets_.planes, facets_.plane[facet]);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  Integer3 normal;
  const PointTable& points = facets_.points;
  const auto difference = [&](std::size_t i) {
    return Integer(Integer(points.coordinate(to, i)) * Integer(points.coordinate(from, 3)) -
                   Integer(points.coordinate(from, i)) * Integer(points.coordinate(to, 3)));
  };
  normal[u] = -sign * difference(v);
  normal[v] = sign * difference(u);
  return plane = plane_through(facets_.planes, points, normal, from);
}

bool FacetPyramids::locate(std::uint32_t facet, PointId point, FacetAtPoint& result) {
  const Double3& x = facets_.points.approximate(point);
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
  if (side_of_plane(facets_.planes, facets_.plane[facet], facets_.points, point, monitor_) != 0) return false;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    if ((doubtful >> std::min(i, 63U) & 1U) == 0) continue;
    const PlaneId side = side_plane(facet, i);
    const int sign = side_of_plane(facets_.planes, side, facets_.points, point, monitor_);
    if (sign < 0) return false;
    if (sign > 0 || side == result.sides[0] || side == result.sides[1]) continue;
    const std::size_t k = result.sides[0].valid() ? 1 : 0;
    result.sides[k] = side;
    result.numbers[k] = i;
  }
  return true;
}

const std::vector<FacetAtPoint>& FacetPyramids::facets_at(PointId point) {
  Box box;
  box.add_rounded(facets_.points.approximate(point));
  found_.clear();
  FacetAtPoint at;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (locate(f, point, at)) found_.push_back(at);
  });
  return found_;
}

bool FacetPyramids::goes_on(const FacetAtPoint& at, const Direction& direction) const {
  const PlaneTable& planes = facets_.planes;
  if (side_of_circle(planes, facets_.plane[at.facet], direction, monitor_) != 0) return false;
  return std::all_of(at.sides.begin(), at.sides.end(), [&](PlaneId side) {
    return !side.valid() || side_of_circle(planes, side, direction, monitor_) >= 0;
  });
}

// A facet's inside is one item, and so is each side, which ends at corners even where it goes straight on: marks may
// change there.
bool FacetPyramids::is_same_item(const FacetAtPoint& at, PointId from, PointId to) {
  FacetAtPoint there;
  if (!locate(at.facet, to, there)) return false;
  const PlaneTable& planes = facets_.planes;
  const PointTable& points = facets_.points;
  for (const PlaneId side : there.sides) {
    if (!side.valid()) continue;
    if (side != at.sides[0] && side != at.sides[1]) return false;
    const auto order = [&](PointId p, PointId q) {
      int sign = 0;
      for (int axis = 0; axis < 3 && sign == 0; ++axis) sign = compare_coordinate(points, p, q, axis, monitor_);
      return sign;
    };
    for (const std::uint32_t corner : facets_.ring(at.facet)) {
      const PointId c{corner};
      if (side_of_plane(planes, side, points, c, monitor_) != 0) continue;
      if (order(from, c) == order(from, to) && order(c, to) != order(to, from)) return false;
    }
  }
  return true;
}

bool FacetPyramids::holds(std::uint32_t facet, PointId point) {
  FacetAtPoint unused;
  return locate(facet, point, unused);
}

Rational3 FacetPyramids::point_towards(PointId from, const Direction& direction) {
  const Integer3& d = direction.integers();
  const Rational3 at = facets_.points.rational(from);
  const std::vector<FacetAtPoint> here = facets_at(from);
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
    const PointId there = facets_.points.push(x);
    // Facets are convex: those that do not go on are not met again.
    const bool clear = sees(from, there, here) && std::all_of(here.begin(), here.end(), [&](const FacetAtPoint& f) {
                         return !goes_on(f, direction) || is_same_item(f, from, there);
                       });
    facets_.points.pop();
    if (clear) return x;
  }
}

bool FacetPyramids::sees(PointId from, PointId to, const std::vector<FacetAtPoint>& except) {
  const PlaneTable& planes = facets_.planes;
  const PointTable& points = facets_.points;
  Box box;
  box.add_rounded(points.approximate(from));
  box.add_rounded(points.approximate(to));
  bool clear = true;
  tree_.for_each_overlap(box, [&](std::uint32_t f) {
    if (!clear || std::any_of(except.begin(), except.end(), [f](const FacetAtPoint& e) { return e.facet == f; }))
      return;
    const int side = side_of_plane(planes, facets_.plane[f], points, from, monitor_);
    if (side != 0 && side_of_plane(planes, facets_.plane[f], points, to, monitor_) == side) return;
    for (std::uint32_t i = 0; i < facets_.ring(f).size(); ++i) {
      const PlaneId across = side_plane(f, i);
      if (side_of_plane(planes, across, points, from, monitor_) < 0 &&
          side_of_plane(planes, across, points, to, monitor_) < 0)
        return;
    }
    clear = false;
  });
  return clear;
}

}  // namespace nef::minkowski
