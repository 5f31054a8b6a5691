// SPDX-License-Identifier: Apache-2.0
//
// Each facet that bounds the set spans a cone with the origin. The cone is a signed sum of tetrahedra: origin, a corner
// of the facet, and a boundary edge. With V their volume and v_i their corners,
//     integral of x = V / 4 sum v_i,   integral of x x^T = V / 20 (s s^T + sum v_i v_i^T),   s = sum v_i.
#include "nef/query/moments.h"

#include "nef/complex/predicates_of_sets.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/measures/rational_sum.h"

namespace nef {
namespace {

class MomentSums {
 public:
  // The tetrahedron of the origin and three points, with the sign of their orientation.
  void add(const Rational3& u, const Rational3& v, const Rational3& w) {
    const Rational six_volumes = dot(u, cross(v, w));
    if (six_volumes == 0) return;
    volume_.add(six_volumes);
    const Rational3 sum{u[0] + v[0] + w[0], u[1] + v[1] + w[1], u[2] + v[2] + w[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      first_[i].add(six_volumes * sum[i]);
      for (std::size_t j = i; j < 3; ++j) {
        second_[i][j].add(six_volumes * (sum[i] * sum[j] + u[i] * u[j] + v[i] * v[j] + w[i] * w[j]));
      }
    }
  }

  Moments total() {
    Moments result;
    result.volume = volume_.total() / 6;
    for (std::size_t i = 0; i < 3; ++i) {
      result.first[i] = first_[i].total() / 24;
      for (std::size_t j = i; j < 3; ++j) result.second[i][j] = result.second[j][i] = second_[i][j].total() / 120;
    }
    return result;
  }

 private:
  RationalSum volume_;
  std::array<RationalSum, 3> first_;
  std::array<std::array<RationalSum, 3>, 3> second_;
};

}  // namespace

std::optional<Moments> moments(const Polyhedron& a) {
  const Complex& c = a.complex();
  if (!volume(c)) return std::nullopt;
  MomentSums sums;
  for (const Facet& facet : c.facets) {
    const bool above = is_selected(c.volumes[facet.volume_above].mark);
    const bool below = is_selected(c.volumes[facet.volume_below].mark);
    if (above == below) continue;
    // Cycles run counterclockwise as seen from above, so the sum is positive for a set that lies below.
    const std::span<const SHalfedgeId> corners = c.corners_of(facet);
    const Rational3 apex = c.points.rational(point_of(c.shalfedge_vertex(corners.front())));
    for (const SHalfedgeId corner : corners) {
      const VertexId u = c.shalfedge_vertex(corner);
      const VertexId v = c.target(c.corner_halfedge(corner));
      if (u == c.shalfedge_vertex(corners.front()) || v == c.shalfedge_vertex(corners.front())) continue;
      const Rational3 p = c.points.rational(point_of(u));
      const Rational3 q = c.points.rational(point_of(v));
      if (below) {
        sums.add(apex, p, q);
      } else {
        sums.add(apex, q, p);
      }
    }
  }
  return sums.total();
}

std::optional<Rational3> Moments::centroid() const {
  if (volume == 0) return std::nullopt;
  return Rational3{first[0] / volume, first[1] / volume, first[2] / volume};
}

Rational3x3 Moments::inertia(const Rational3& about) const {
  // The integrals of (x - a)(y - b): those of x y - a y - b x + a b.
  Rational3x3 centred;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      centred[i][j] = second[i][j] - about[i] * first[j] - about[j] * first[i] + about[i] * about[j] * volume;
    }
  }
  const Rational trace = centred[0][0] + centred[1][1] + centred[2][2];
  Rational3x3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = (i == j ? trace : Rational(0)) - centred[i][j];
  }
  return result;
}

}  // namespace nef
