// SPDX-License-Identifier: Apache-2.0
#include "nef/query/measures/approximate_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "nef/base/threads/parallel.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

double size_of(const Double3& a) { return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])}); }

// Twice the area vector of a facet about one of its corners: the products are as small as the facet.
struct Area {
  Double3 vector{};
  double error = 0;  // of a component
};

// Coordinates are off by e at most.
Area twice_area(const Complex& c, const Facet& facet, const Double3& corner0, double e) {
  Area area;
  double products = 0;  // two of them make a component of a cross product
  double vague = 0;     // by how much their factors are off
  std::size_t corners = 0;
  for (const CycleId k : facet.cycles()) {
    for (const SHalfedgeId corner : c.corners_of(k)) {
      const Double3 p = minus(c.points.approximate(point_of(c.shalfedge_vertex(corner))), corner0);
      const Double3 q = minus(c.points.approximate(point_of(c.target(c.corner_halfedge(corner)))), corner0);
      const Double3 product = cross(p, q);
      for (std::size_t i = 0; i < 3; ++i) area.vector[i] += product[i];
      products += 2 * size_of(p) * size_of(q);
      vague += 2 * e * (size_of(p) + size_of(q) + e);
      ++corners;
    }
  }
  // Its factors, two roundings a product, one a term of the sum.
  area.error = vague + products * static_cast<double>(corners + 4) * 0x1p-52;
  return area;
}

// Sums over some facets.
struct Sums {
  double value = 0;
  double sizes = 0;  // of the products that are summed
  double error = 0;  // of each of them
  std::size_t terms = 0;

  void add(const Sums& other) {
    value += other.value;
    sizes += other.sizes;
    error += other.error;
    terms += other.terms;
  }
};

// Relative to the origin; coordinates are off by e at most.
Sums sums_over(const Complex& c, IdRange<FacetId> facets, const Double3& origin, double e) {
  Sums sums;
  for (const FacetId f : facets) {
    const Facet facet = c.facets[f];
    const bool above = c.volumes[facet.volume_above].mark != 0;
    const bool below = c.volumes[facet.volume_below].mark != 0;
    if (above == below || facet.cycle_count == 0) continue;
    const Double3 corner0 = c.points.approximate(point_of(c.shalfedge_vertex(c.corners_of(facet.first_cycle).front())));
    const Area area = twice_area(c, facet, corner0, e);
    const std::array<double, 4>& n = c.planes.approximate(facet.plane);
    const bool upward = (dot(area.vector, {n[0], n[1], n[2]}) > 0) != facet.plane.flipped();
    const Double3 place = minus(corner0, origin);
    sums.value += (upward == below ? 1 : -1) * dot(place, area.vector);
    const double reach = size_of(place);
    const double size = 3 * reach * size_of(area.vector);
    // Thrice, for facets so small that the sign of their area may be wrong.
    sums.error += 3 * (3 * reach * area.error + 3 * e * (size_of(area.vector) + area.error) + size * 0x1p-50);
    sums.sizes += size;
    ++sums.terms;
  }
  return sums;
}

// Coordinates are off by e at most.
Sums areas_over(const Complex& c, IdRange<FacetId> facets, double e) {
  Sums sums;
  for (const FacetId f : facets) {
    const Facet facet = c.facets[f];
    if (facet.cycle_count == 0) continue;
    const Double3 corner0 = c.points.approximate(point_of(c.shalfedge_vertex(c.corners_of(facet.first_cycle).front())));
    const Area area = twice_area(c, facet, corner0, e);
    const double size = std::sqrt(dot(area.vector, area.vector)) / 2;
    sums.value += size;
    // Half of the error of a vector, and the roundings of its length.
    sums.error += 0.87 * area.error + size * 0x1p-50;
    sums.sizes += size;
    ++sums.terms;
  }
  return sums;
}

// By how much a difference of two coordinates may be off: each is off by 2^-51 of itself (PointTable::approximate).
double error_of_differences(const Complex& c) {
  double largest = 0;
  for (const VertexId v : c.vertex_ids()) {
    largest = std::max(largest, size_of(c.points.approximate(point_of(v))));
  }
  return largest * 0x1p-49;
}

constexpr std::size_t kFacets = 4096;  // of a task

// over(facets) for all facets, some thousands at a time: the sums do not depend on the threads.
template <typename Over>
Sums summed(const Complex& c, unsigned threads, const Monitor& monitor, const Over& over) {
  const std::size_t facets = c.facets.size();
  std::vector<Sums> sums((facets + kFacets - 1) / kFacets);
  parallel_for(sums.size(), threads, monitor, [&](std::size_t task, const Monitor&) {
    const std::size_t first = task * kFacets;
    sums[task] = over(IdRange(FacetId{first}, FacetId{std::min(first + kFacets, facets)}));
  });
  Sums all;
  for (const Sums& some : sums) all.add(some);
  // Of each term, and of adding them.
  all.error += all.sizes * static_cast<double>(all.terms) * 0x1p-52;
  return all;
}

}  // namespace

MeasuredVolume approximate_volume(const Polyhedron& bounded, unsigned threads, const Monitor& monitor) {
  const Complex& c = bounded.complex();
  if (c.vertex_count() == 0) return {};
  // Relative to a point of the set: little is lost by cancellation.
  const Double3 origin = c.points.approximate(PointId(0U));
  const double e = error_of_differences(c);
  const Sums sums = summed(c, threads, monitor, [&](IdRange<FacetId> some) { return sums_over(c, some, origin, e); });
  return {sums.value / 6, sums.error / 6};
}

MeasuredArea approximate_area(const Polyhedron& bounded, unsigned threads, const Monitor& monitor) {
  const Complex& c = bounded.complex();
  const double e = error_of_differences(c);
  const Sums sums = summed(c, threads, monitor, [&](IdRange<FacetId> some) { return areas_over(c, some, e); });
  return {sums.value, sums.error};
}

}  // namespace nef
