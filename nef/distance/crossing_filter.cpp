// SPDX-License-Identifier: Apache-2.0
#include "nef/distance/crossing_filter.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/ray_parity.h"

namespace nef {

CrossingFilter::CrossingFilter(const Complex& complex, std::span<const Rational3> points) {
  for (const Rational3& p : points)
    points_.push_back({approximation_of(p[0]), approximation_of(p[1]), approximation_of(p[2])});
  constexpr std::size_t kMany = 64;
  begin_.push_back(0);
  for (const Facet& facet : complex.facets) {
    Plane& plane = planes_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      plane.normal[i] = approximation_of(Rational(Integer(complex.planes.coefficient(facet.plane, i))));
      if (std::fabs(plane.normal[i].value) > std::fabs(plane.normal[plane.axis].value)) plane.axis = i;
    }
    plane.offset = approximation_of(Rational(Integer(complex.planes.coefficient(facet.plane, 3))));
    if (complex.isolated_vertices_of(facet).empty()) {
      for (const SHalfedgeId corner : complex.corners_of(facet)) {
        sides_.push_back(
            {complex.shalfedge_vertex(corner).index(), complex.target(complex.corner_halfedge(corner)).index()});
      }
    }
    const std::span sides = std::span(sides_).subspan(begin_.back());
    if (sides.size() >= kMany) {
      std::array<Rows, 2> rows;
      if (make_rows(sides, (plane.axis + 1) % 3, rows[0]) && make_rows(sides, (plane.axis + 2) % 3, rows[1])) {
        plane.rows = static_cast<std::uint32_t>(rows_.size());
        for (Rows& r : rows) rows_.push_back(std::move(r));
      } else {
        sides_.resize(begin_.back());
      }
    }
    begin_.push_back(static_cast<std::uint32_t>(sides_.size()));
  }
}

// A row has the sides that come nearer to it than an eighth of its height; it answers for points that are nearer than a
// sixteenth. Rows are much higher than what is rounded off of their places.
bool CrossingFilter::make_rows(std::span<const std::array<std::uint32_t, 2>> sides, std::size_t axis,
                               Rows& rows) const {
  std::vector<std::array<double, 2>> ranges;
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const auto& [p, q] : sides) {
    const Approximation& a = points_[p][axis];
    const Approximation& b = points_[q][axis];
    ranges.push_back({std::min(a.value - a.error, b.value - b.error), std::max(a.value + a.error, b.value + b.error)});
    low = std::min(low, ranges.back()[0]);
    high = std::max(high, ranges.back()[1]);
  }
  const std::size_t count = std::clamp<std::size_t>(sides.size() / 4, 16, 1024);
  rows.low = low;
  rows.height = (high - low) / static_cast<double>(count);
  if (!(rows.height > 0x1p-30 * std::max(std::fabs(low), std::fabs(high))) || !(rows.height < HUGE_VAL)) return false;
  const auto row_of = [&](double x) {
    return static_cast<std::size_t>(std::clamp((x - low) / rows.height, 0.0, static_cast<double>(count - 1)));
  };
  constexpr std::size_t kMost = 64;  // rows a side, on average
  std::vector<std::vector<std::uint32_t>> by_row(count);
  std::size_t entries = 0;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    const std::size_t first = row_of(ranges[i][0] - rows.height / 8);
    const std::size_t last = row_of(ranges[i][1] + rows.height / 8);
    entries += last - first + 1;
    if (entries > kMost * sides.size()) return false;
    for (std::size_t row = first; row <= last; ++row) by_row[row].push_back(i);
  }
  rows.begin.push_back(0);
  for (const std::vector<std::uint32_t>& row : by_row) {
    rows.sides.insert(rows.sides.end(), row.begin(), row.end());
    rows.begin.push_back(static_cast<std::uint32_t>(rows.sides.size()));
  }
  return true;
}

Approximation CrossingFilter::value(const Approximation3& normal, const Approximation& offset,
                                    const Approximation3& at) const {
  return dot(normal, at) + offset;
}

std::optional<bool> CrossingFilter::holds(FacetId facet, const Approximation3& at, std::size_t u, std::size_t v) const {
  RayParity parity(at, u, v);
  const Plane& plane = planes_[facet.index()];
  if (plane.rows != kNoRows) {
    // Sides of other rows are surely above or below the ray.
    const Rows& rows = rows_[plane.rows + (v == (plane.axis + 1) % 3 ? 0 : 1)];
    const auto last = static_cast<double>(rows.begin.size() - 2);
    const double place = (at[v].value - rows.low) / rows.height;
    if (!(at[v].error < rows.height / 32) || !(place > -1) || !(place < last + 2)) return std::nullopt;
    const double row = std::clamp(std::floor(place), 0.0, last);
    const auto number = static_cast<std::size_t>(row);
    for (std::uint32_t i = rows.begin[number]; i < rows.begin[number + 1]; ++i) {
      const auto& [p, q] = sides_[begin_[facet.index()] + rows.sides[i]];
      if (!parity.add(points_[p], points_[q])) return std::nullopt;
    }
    return parity.is_inside();
  }
  for (std::uint32_t s = begin_[facet.index()]; s < begin_[facet.index() + 1]; ++s) {
    if (!parity.add(points_[sides_[s][0]], points_[sides_[s][1]])) return std::nullopt;
  }
  return parity.is_inside();
}

EdgeCrossing CrossingFilter::ask(FacetId facet, const Approximation3& from, const Approximation3& to) const {
  const Plane& plane = planes_[facet.index()];
  const Approximation of_from = value(plane.normal, plane.offset, from);
  const Approximation of_to = value(plane.normal, plane.offset, to);
  const int side = of_from.sign().value_or(0);
  const int other = of_to.sign().value_or(0);
  if (side == 0 || other == 0) return EdgeCrossing::kUnsure;
  if (side == other) return EdgeCrossing::kApart;
  if (begin_[facet.index()] == begin_[facet.index() + 1]) return EdgeCrossing::kUnsure;
  const Approximation part = of_from / (of_from - of_to);
  Approximation3 at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = from[i] + part * (to[i] - from[i]);
  // Sides along an axis are common, so if a ray along one axis passes near a corner, the other one may not.
  const std::size_t u = (plane.axis + 1) % 3;
  const std::size_t v = (plane.axis + 2) % 3;
  std::optional<bool> inside = holds(facet, at, u, v);
  if (!inside) inside = holds(facet, at, v, u);
  if (!inside) return EdgeCrossing::kUnsure;
  return *inside ? EdgeCrossing::kCrosses : EdgeCrossing::kApart;
}

}  // namespace nef
