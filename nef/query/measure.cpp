// SPDX-License-Identifier: Apache-2.0
//
// Volume and area by boundary integrals. A facet in the plane n . x + d = 0 has the area vector
// A = 1/2 sum u x v over its boundary edges uv, which is area * n / |n|. With l the axis of the
// largest component of n (never zero), everything follows from A_l, a sum in two coordinates:
//     area = |A_l / n_l| |n|,   integral of x . n / |n| over the facet = -d A_l / n_l,
// and the volume is a third of the sum of the latter over facets, with normals outward.
#include "nef/query/measure.h"

#include <cmath>
#include <limits>

#include "nef/polyhedron.h"
#include "nef/query/predicates_of_sets.h"
#include "nef/query/rational_sum.h"

namespace nef {
namespace {

// A_l / n_l of a facet with finite vertices; positive.
class FacetRatio {
 public:
  explicit FacetRatio(const Complex& complex) : c_(complex) {}

  Rational operator()(const Facet& facet) {
    const std::array<double, 4>& n = c_.planes.approximate(facet.plane);
    std::size_t l = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::fabs(n[i]) > std::fabs(n[l])) l = i;
    }
    RationalSum sum;
    for (const std::uint32_t corner : c_.facet_corners(facet)) {
      const PointId u{c_.shalfedge_owner[corner]};
      const PointId v{c_.target(c_.corner_halfedge(corner))};
      sum.add(cross_component(u, v, (l + 1) % 3, (l + 2) % 3));
    }
    Rational result = sum.total();
    mpz_set(scratch_.get_num_mpz_t(), c_.planes.coefficient(facet.plane, l));
    mpz_set_ui(scratch_.get_den_mpz_t(), 2);
    scratch_.canonicalize();
    result /= scratch_;
    return result / 4;
  }

 private:
  // u_k v_m - u_m v_k
  Rational cross_component(PointId u, PointId v, std::size_t k, std::size_t m) {
    Rational result;
    mpz_mul(result.get_num_mpz_t(), c_.points.coordinate(u, k), c_.points.coordinate(v, m));
    mpz_submul(result.get_num_mpz_t(), c_.points.coordinate(u, m), c_.points.coordinate(v, k));
    mpz_mul(result.get_den_mpz_t(), c_.points.coordinate(u, 3), c_.points.coordinate(v, 3));
    result.canonicalize();
    return result;
  }

  const Complex& c_;
  Rational scratch_;
};

bool has_finite_vertices(const Complex& c, const Facet& facet) {
  for (const std::uint32_t corner : c.facet_corners(facet)) {
    if (is_box_vertex(c, c.shalfedge_owner[corner])) return false;
  }
  return true;
}

}  // namespace

std::optional<Rational> volume(const Complex& c) {
  if (is_selected(c.volumes[0].mark)) return std::nullopt;
  FacetRatio ratio(c);
  RationalSum sum;
  for (std::uint32_t f = 0; f < c.facet_count(); ++f) {
    const Facet& facet = c.facets[f];
    const bool above = is_selected(c.volumes[facet.volume_above].mark);
    const bool below = is_selected(c.volumes[facet.volume_below].mark);
    if (is_box_facet(c, f)) {
      if (above || below) return std::nullopt;
      continue;
    }
    if (above == below) continue;
    // What bounds a volume from one side only and reaches infinity bounds an infinite volume.
    if (!has_finite_vertices(c, facet)) continue;
    const Rational offset(c.planes.oriented_coefficient(facet.plane, 3));
    if (offset == 0) continue;
    const Rational part = ratio(facet) * offset;
    sum.add(below ? Rational(-part) : part);
  }
  return sum.total() / 3;
}

double surface_area(const Complex& c) {
  FacetRatio ratio(c);
  double area = 0;
  double lost = 0;  // Kahan's compensation
  for (std::uint32_t f = 0; f < c.facet_count(); ++f) {
    const Facet& facet = c.facets[f];
    if (is_box_facet(c, f)) continue;
    if (!has_finite_vertices(c, facet)) return std::numeric_limits<double>::infinity();
    // |n| may leave the range of doubles where the area does not: put n^2 into the rational.
    Rational square = ratio(facet);
    square *= square;
    Integer length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const IntegerView n = c.planes.coefficient(facet.plane, i);
      mpz_addmul(length.get_mpz_t(), n, n);
    }
    square *= length;
    const double term = std::sqrt(nearest_double(square)) - lost;
    const double next = area + term;
    lost = (next - area) - term;
    area = next;
  }
  return area;
}

std::optional<std::array<Rational3, 2>> bounding_box(const Complex& c) {
  std::array<std::array<PointId, 3>, 2> extreme;
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) {
    if (is_box_vertex(c, v)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t end = 0; end < 2; ++end) {
        PointId& best = extreme[end][axis];
        const int wanted = end == 0 ? -1 : 1;
        if (!best.valid() || compare_coordinate(c.points, PointId{v}, best, static_cast<int>(axis)) == wanted) {
          best = PointId{v};
        }
      }
    }
  }
  if (!extreme[0][0].valid()) return std::nullopt;
  std::array<Rational3, 2> result;
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t axis = 0; axis < 3; ++axis) result[end][axis] = c.points.rational(extreme[end][axis])[axis];
  }
  return result;
}

std::optional<Rational> volume(const Polyhedron& a) { return volume(a.complex()); }
double surface_area(const Polyhedron& a) { return surface_area(a.complex()); }
std::optional<std::array<Rational3, 2>> bounding_box(const Polyhedron& a) { return bounding_box(a.complex()); }

}  // namespace nef
