// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/facet_pyramids.h"

#include <algorithm>
#include <cmath>

#include "apps/minkowski/cells/exact_cells.h"
#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

LabelId outside_mark(PlaneId plane) { return plane.flipped() ? kOutsideBelow : kOutsideAbove; }

}  // namespace

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
  std::array<Integer, 3> normal;
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
  const Vector& x = facets_.points.approximate(point);
  const RoundedFace& plane = rounded_.plane(facet);
  const double value = plane.value(x);
  if (value > plane.slack || value < -plane.slack) return false;
  const std::span<const RoundedSide> sides = rounded_.sides(facet);
  result = {facet, {}};
  std::uint64_t doubtful = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double inside = sides[i].value(x);
    const double doubt = sides[i].slack + sides[i].weight * rounded_.corner_error();
    if (inside < -doubt) return false;
    if (!(inside > doubt)) doubtful |= std::uint64_t{1} << std::min<std::size_t>(i, 63);
  }
  if (side_of_plane(facets_.planes, facets_.plane[facet], facets_.points, point) != 0) return false;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    if ((doubtful >> std::min(i, 63U) & 1U) == 0) continue;
    const PlaneId side = side_plane(facet, i);
    const int sign = side_of_plane(facets_.planes, side, facets_.points, point);
    if (sign < 0) return false;
    if (sign > 0 || side == result.sides[0] || side == result.sides[1]) continue;
    result.sides[result.sides[0].valid() ? 1 : 0] = side;
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

LabelId FacetPyramids::label(std::uint8_t in_sum) const {
  const bool is_in = facets_.marks == BoundaryMarks::kMixed ? in_sum != 0 : facets_.marks == BoundaryMarks::kAll;
  return is_in ? kInSum : LabelId{0};
}

// Of the sides of a facet at a point of its border, and of the point.
FacetPyramids::BorderLabels FacetPyramids::border_labels(std::uint32_t facet, PointId point) const {
  if (facets_.marks != BoundaryMarks::kMixed) return {label(0), label(0), label(0)};
  const auto ring = facets_.ring(facet);
  const std::uint32_t begin = facets_.begin[facet];
  const auto order = [&](std::uint32_t corner, int axis) {
    return compare_coordinate(facets_.points, point, PointId{ring[corner]}, axis);
  };
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (order(i, 0) != 0 || order(i, 1) != 0 || order(i, 2) != 0) continue;
    const std::uint32_t before = i > 0 ? i - 1 : static_cast<std::uint32_t>(ring.size()) - 1;
    return {label(facets_.side_marks[begin + i]), label(facets_.side_marks[begin + before]),
            label(facets_.corner_marks[begin + i])};
  }
  // On the line of a side that is between its ends in every coordinate.
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t next = i + 1 < ring.size() ? i + 1 : 0;
    bool between = true;
    for (int axis = 0; axis < 3 && between; ++axis) between = order(i, axis) * order(next, axis) <= 0;
    if (!between || !is_on_side(facet, i, point)) continue;
    const LabelId mark = label(facets_.side_marks[begin + i]);
    return {mark, mark, mark};
  }
  NEF_ASSERT(false);  // the point is on the border
  return {};
}

bool FacetPyramids::is_on_side(std::uint32_t facet, std::uint32_t side, PointId point) const {
  const PlaneId plane = side_plane_[facets_.begin[facet] + side];
  return plane.valid() && side_of_plane(facets_.planes, plane, facets_.points, point) == 0;
}

bool FacetPyramids::is_void(std::uint32_t facet) const {
  if (facets_.marks != BoundaryMarks::kMixed) return true;  // all facets have the same marks
  if (facets_.inside_marks[facet] != 0) return false;
  for (std::uint32_t i = facets_.begin[facet]; i < facets_.begin[facet + 1]; ++i) {
    if ((facets_.side_marks[i] | facets_.corner_marks[i]) != 0) return false;
  }
  return true;
}

// With its inside to the left, the side of a plane S runs along n_S x n_P. At a corner the facet goes counterclockwise
// from the side that leaves to the one that arrives, backwards.
void FacetPyramids::draw_facet(const FacetAtPoint& at, PointId point, SphereMapBuffer& out) {
  const PlaneId plane = facets_.plane[at.facet];
  const LabelId bits = outside_mark(plane);
  const std::uint8_t inside = facets_.marks == BoundaryMarks::kMixed ? facets_.inside_marks[at.facet] : 0;
  const auto mark = static_cast<LabelId>(bits | label(inside));
  const PlaneTable& planes = facets_.planes;
  if (!at.sides[0].valid()) {
    out.assign_circle(plane, mark, 0, 0);
    out.mark = mark;
    return;
  }
  PlaneId leaving = at.sides[0];
  PlaneId arriving = at.sides[1].valid() ? at.sides[1] : leaving;
  if (at.sides[1].valid() && orientation_on_circle(planes, plane, Direction::cross(planes, arriving, plane),
                                                   Direction::cross(planes, leaving, plane)) < 0) {
    std::swap(leaving, arriving);
  }
  const BorderLabels border = border_labels(at.facet, point);
  drawing_.clear();
  drawing_.centre = bits | border.centre;
  drawing_.nodes.resize(2);
  drawing_.nodes[0].direction = Direction::cross(planes, leaving, plane);
  drawing_.nodes[0].mark = bits | border.leaving;
  drawing_.nodes[1].direction = Direction::cross(planes, plane, arriving);
  drawing_.nodes[1].mark = bits | border.arriving;
  drawing_.arcs.push_back({plane, 0, 1, mark, 0, 0});
  drawing_.sort_around_nodes(planes);
  drawing_.simplify_and_assemble(planes, out);
}

SphereMapBuffer FacetPyramids::draw(const std::vector<FacetAtPoint>& at, PointId point) {
  SphereMapBuffer* map = &maps_[0];
  SphereMapBuffer* next = &maps_[1];
  struct Whole {
    PlaneId plane;
    LabelId mark = 0;
  };
  std::vector<Whole> whole;  // planes whose circle is there
  const auto find_whole = [&](PlaneId plane) {
    return std::find_if(whole.begin(), whole.end(), [plane](const Whole& w) { return w.plane == plane; });
  };
  for (const FacetAtPoint& f : at) {
    if (f.sides[0].valid()) continue;
    const PlaneId plane = facets_.plane[f.facet];
    const LabelId in_sum = label(facets_.marks == BoundaryMarks::kMixed ? facets_.inside_marks[f.facet] : 0);
    if (find_whole(plane) == whole.end()) whole.push_back({plane, outside_mark(plane)});
    find_whole(plane)->mark |= in_sum;
  }
  bool first = true;
  const auto add = [&] {
    if (first) {
      std::swap(*map, maps_[2]);
    } else {
      overlay_.overlay(facets_.planes, map->view(), maps_[2].view(), or_, *next);
      std::swap(map, next);
    }
    first = false;
  };
  for (const Whole& w : whole) {
    maps_[2].assign_circle(w.plane, w.mark, 0, 0);
    maps_[2].mark = w.mark;
    add();
  }
  for (const FacetAtPoint& f : at) {
    const auto under = find_whole(facets_.plane[f.facet]);
    if (under != whole.end() && ((under->mark & kInSum) != 0 || is_void(f.facet))) continue;
    draw_facet(f, point, maps_[2]);
    add();
  }
  return *map;
}

bool FacetPyramids::goes_on(const FacetAtPoint& at, const Direction& direction) const {
  const PlaneTable& planes = facets_.planes;
  if (side_of_circle(planes, facets_.plane[at.facet], direction) != 0) return false;
  return std::all_of(at.sides.begin(), at.sides.end(),
                     [&](PlaneId side) { return !side.valid() || side_of_circle(planes, side, direction) >= 0; });
}

bool FacetPyramids::holds(std::uint32_t facet, PointId point) {
  FacetAtPoint unused;
  return locate(facet, point, unused);
}

Rational3 FacetPyramids::point_towards(PointId from, const Direction& direction) {
  const std::array<Integer, 3>& d = direction.integers();
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
    // Facets are convex: those that do not go on are not met again, and of the others the point must be one.
    const bool clear = sees(from, there, here) && std::all_of(here.begin(), here.end(), [&](const FacetAtPoint& f) {
                         return !goes_on(f, direction) || holds(f.facet, there);
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
    const int side = side_of_plane(planes, facets_.plane[f], points, from);
    if (side != 0 && side_of_plane(planes, facets_.plane[f], points, to) == side) return;
    for (std::uint32_t i = 0; i < facets_.ring(f).size(); ++i) {
      const PlaneId across = side_plane(f, i);
      if (side_of_plane(planes, across, points, from) < 0 && side_of_plane(planes, across, points, to) < 0) return;
    }
    clear = false;
  });
  return clear;
}

}  // namespace nef::minkowski
