// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nef/construct/solid.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// Coordinate `axis` of a corner and the plane of its wall, over the common denominator w.
void set_corner(std::array<Integer, 7>& h, std::size_t axis, const AxisPlane* wall, int sign) {
  if (wall == nullptr) {
    h[4 + axis] = sign * h[3];
  } else {
    h[axis] = wall->at.get_num() * (h[3] / wall->at.get_den());
  }
}

PlaneId wall_plane(PlaneTable& planes, std::size_t axis, const AxisPlane* wall, int sign) {
  if (wall != nullptr) {
    const PlaneId plane = wall->intern(planes);
    return sign > 0 ? plane : plane.opposite();
  }
  Integer3 n;
  n[axis] = sign;
  return planes.intern(n[0], n[1], n[2], 0, -1);
}

// The eight corners with outward planes.
SolidFaces region_faces(const Region& region) {
  SolidFaces f;
  Integer denominator = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const AxisPlane* wall : {region.low[axis], region.high[axis]}) {
      if (wall != nullptr) denominator = lcm(denominator, wall->at.get_den());
    }
  }
  for (unsigned i = 0; i < 8; ++i) {
    std::array<Integer, 7> h;
    h[3] = denominator;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (i >> axis & 1U) != 0;
      set_corner(h, axis, upper ? region.high[axis] : region.low[axis], upper ? 1 : -1);
    }
    f.points.push_homogeneous(h);
  }
  // Counterclockwise from outside: -x, +x, -y, +y, -z, +z.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t axis = i / 2;
    f.plane.push_back(i % 2 == 0 ? wall_plane(f.planes, axis, region.low[axis], -1)
                                 : wall_plane(f.planes, axis, region.high[axis], 1));
    f.corners.insert(f.corners.end(), kSides[i].begin(), kSides[i].end());
    f.begin.push_back(static_cast<std::uint32_t>(f.corners.size()));
  }
  return f;
}

// Marked 0 outside and 1 inside and on the walls.
Complex remarked(const Complex& box, LabelId mark, const Monitor& monitor) {
  PlaneTable planes = box.planes;
  ComplexBuilder builder(planes, monitor);
  const std::array<LabelId, 2> marks{kOutside, mark};
  builder.copy(box, {}, marks);
  return builder.finish(kOutside);
}

}  // namespace

AxisPlane::AxisPlane(std::size_t axis_of_it, Rational position) : axis(axis_of_it), at(std::move(position)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = nearest_double(at);
  const bool exact = std::isfinite(nearest) && exact_rational(nearest) == at;
  bounds = exact ? std::array<double, 2>{nearest, nearest}
                 : std::array<double, 2>{std::nextafter(nearest, -kInfinity), std::nextafter(nearest, kInfinity)};
}

PlaneId AxisPlane::intern(PlaneTable& planes) const {
  Integer3 n;
  n[axis] = at.get_den();
  return planes.intern(n[0], n[1], n[2], Integer(-at.get_num()));
}

Region Region::below(const AxisPlane& plane) const {
  Region result = *this;
  result.high[plane.axis] = &plane;
  return result;
}

Region Region::above(const AxisPlane& plane) const {
  Region result = *this;
  result.low[plane.axis] = &plane;
  return result;
}

bool Region::unbounded() const {
  const auto open = [](const AxisPlane* wall) { return wall == nullptr; };
  return std::all_of(low.begin(), low.end(), open) && std::all_of(high.begin(), high.end(), open);
}

Complex uniform_tile(const Region& region, LabelId mark, const Monitor& monitor) {
  return remarked(make_solid(region_faces(region), {1, 1, 0}, monitor), mark, monitor);
}

Complex infimaximal_corners(LabelId mark, const Monitor& monitor) {
  Complex corners = make_infimaximal_box(monitor);
  PatternTable::for_each_mark(corners.patterns, [mark](LabelId& item) { item = item == 0 ? kOutside : mark; });
  return corners;
}

}  // namespace nef
