// SPDX-License-Identifier: Apache-2.0
//
// Volume and area by boundary integrals. A facet in the plane n . x + d = 0 has the area vector
// A = 1/2 sum u x v over its boundary edges uv, which is area * n / |n|. With l the axis of the
// largest component of n (never zero), everything follows from A_l, a sum in two coordinates:
//     area = |A_l / n_l| |n|,   integral of x . n / |n| over the facet = -d A_l / n_l,
// and the volume is a third of the sum of the latter over facets, with normals outward.
#include "nef/query/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nef/complex/facet_plane.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/polyhedron.h"
#include "nef/query/measures/extreme_points.h"
#include "nef/query/measures/rational_sum.h"

namespace nef {
namespace {

// A_l / n_l of facets with finite vertices; positive. Not reduced: numerator and denominator stay
// apart, so that only those who need a rational pay for one.
class FacetRatio {
 public:
  explicit FacetRatio(const Complex& complex) : c_(complex) {}

  Integer numerator;
  Integer denominator;

  void set(const Facet& facet) {
    const PlaneAxes axes(c_.planes, facet.plane);
    k_ = static_cast<std::size_t>(axes.first);
    m_ = static_cast<std::size_t>(axes.second);
    const std::span<const SHalfedgeId> corners = c_.corners_of(facet);
    if (corners.size() <= kSmall) {
      sum_small(corners);
    } else {
      sum_large(corners);
    }
    mpz_mul(denominator.get_mpz_t(), denominator.get_mpz_t(),
            c_.planes.coefficient(facet.plane, static_cast<std::size_t>(axes.dropped)));
    denominator *= 2;
    if (sgn(denominator) < 0) {
      mpz_neg(denominator.get_mpz_t(), denominator.get_mpz_t());
      mpz_neg(numerator.get_mpz_t(), numerator.get_mpz_t());
    }
  }

 private:
  static constexpr std::size_t kSmall = 16;

  // Twice A_l over the least common denominator of the corners.
  void sum_small(std::span<const SHalfedgeId> corners) {
    mpz_ptr common = scratch_.get_mpz_t();
    mpz_set_ui(common, 1);
    for (const SHalfedgeId corner : corners) {
      const IntegerView w = c_.points.coordinate(point_of(c_.shalfedge_vertex(corner)), 3);
      if (mpz_divisible_p(common, w) == 0) mpz_lcm(common, common, w);
    }
    mpz_ptr sum = numerator.get_mpz_t();
    mpz_set_ui(sum, 0);
    for (const SHalfedgeId corner : corners) {
      const PointId u = point_of(c_.shalfedge_vertex(corner));
      const PointId v = point_of(c_.target(c_.corner_halfedge(corner)));
      mpz_divexact(factor_.get_mpz_t(), common, c_.points.coordinate(u, 3));
      mpz_divexact(other_.get_mpz_t(), common, c_.points.coordinate(v, 3));
      mpz_mul(factor_.get_mpz_t(), factor_.get_mpz_t(), other_.get_mpz_t());
      cross(u, v);
      mpz_addmul(sum, cross_.get_mpz_t(), factor_.get_mpz_t());
    }
    mpz_mul(denominator.get_mpz_t(), common, common);
  }

  // The same edge by edge: the common denominator of many corners may be far too long.
  void sum_large(std::span<const SHalfedgeId> corners) {
    RationalSum sum;
    for (const SHalfedgeId corner : corners) {
      const PointId u = point_of(c_.shalfedge_vertex(corner));
      const PointId v = point_of(c_.target(c_.corner_halfedge(corner)));
      cross(u, v);
      mpz_mul(factor_.get_mpz_t(), c_.points.coordinate(u, 3), c_.points.coordinate(v, 3));
      Rational term(cross_, factor_);
      term.canonicalize();
      sum.add(std::move(term));
    }
    const Rational total = sum.total();
    numerator = total.get_num();
    denominator = total.get_den();
  }

  // u_k v_m - u_m v_k, times the denominators of both.
  void cross(PointId u, PointId v) {
    mpz_mul(cross_.get_mpz_t(), c_.points.coordinate(u, k_), c_.points.coordinate(v, m_));
    mpz_submul(cross_.get_mpz_t(), c_.points.coordinate(u, m_), c_.points.coordinate(v, k_));
  }

  const Complex& c_;
  std::size_t k_ = 0;
  std::size_t m_ = 0;
  Integer scratch_, factor_, other_, cross_;
};

// ratio * sqrt(square), without overflow of its parts.
double times_root(const FacetRatio& ratio, const Integer& square) {
  long e0 = 0;
  long e1 = 0;
  long e2 = 0;
  const double numerator = mpz_get_d_2exp(&e0, ratio.numerator.get_mpz_t());
  const double denominator = mpz_get_d_2exp(&e1, ratio.denominator.get_mpz_t());
  double root = mpz_get_d_2exp(&e2, square.get_mpz_t());
  if (e2 % 2 != 0) {
    root *= 2;
    --e2;
  }
  const long exponent = std::clamp(e0 - e1 + e2 / 2, -100000L, 100000L);
  return std::ldexp(numerator / denominator * std::sqrt(root), static_cast<int>(exponent));
}

}  // namespace

std::optional<Rational> volume(const Complex& c) {
  if (is_selected(c.volumes[kOuterVolume].mark)) return std::nullopt;
  FacetRatio ratio(c);
  RationalSum sum;
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    const bool above = is_selected(c.volumes[facet.volume_above].mark);
    const bool below = is_selected(c.volumes[facet.volume_below].mark);
    if (is_box_facet(c, f)) {
      if (above || below) return std::nullopt;
      continue;
    }
    if (above == below) continue;
    // What bounds a volume from one side only and reaches infinity bounds an infinite volume.
    if (!has_finite_corners(c, facet)) continue;
    const Integer offset = c.planes.oriented_coefficient(facet.plane, 3);
    if (offset == 0) continue;
    ratio.set(facet);
    Rational part(below ? Integer(-ratio.numerator * offset) : Integer(ratio.numerator * offset), ratio.denominator);
    part.canonicalize();
    sum.add(std::move(part));
  }
  return sum.total() / 3;
}

double surface_area(const Complex& c) {
  FacetRatio ratio(c);
  double area = 0;
  double lost = 0;  // Kahan's compensation
  for (const FacetId f : c.facets.ids()) {
    const Facet& facet = c.facets[f];
    if (is_box_facet(c, f)) continue;
    if (!has_finite_corners(c, facet)) return std::numeric_limits<double>::infinity();
    Integer length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const IntegerView n = c.planes.coefficient(facet.plane, i);
      mpz_addmul(length.get_mpz_t(), n, n);
    }
    ratio.set(facet);
    const double term = times_root(ratio, length) - lost;
    const double next = area + term;
    lost = (next - area) - term;
    area = next;
  }
  return area;
}

std::optional<std::array<Rational3, 2>> bounding_box(const Complex& c, const Monitor& monitor) {
  ExtremePoints extreme(c.points, monitor);
  for (const VertexId v : c.vertex_ids()) {
    if (!is_box_vertex(c, v)) extreme.add(point_of(v));
  }
  return extreme.box();
}

std::optional<Rational> volume(const Polyhedron& a) { return volume(a.complex()); }
double surface_area(const Polyhedron& a) { return surface_area(a.complex()); }
std::optional<std::array<Rational3, 2>> bounding_box(const Polyhedron& a, const Monitor& monitor) {
  return bounding_box(a.complex(), monitor);
}

}  // namespace nef
