// SPDX-License-Identifier: Apache-2.0
//
// Lines are products of the planes of svertices, computed once: integers in a pool of limbs, beside doubles. A number
// of its own for each of them would take most of the time and memory of large sums. Normals have their integers in the
// table of planes.
#include "apps/minkowski/convolution/facets/feature_directions.h"

#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

Integer3 copies(const IntegerView& x, const IntegerView& y, const IntegerView& z) {
  Integer3 result;
  mpz_set(result[0].get_mpz_t(), x);
  mpz_set(result[1].get_mpz_t(), y);
  mpz_set(result[2].get_mpz_t(), z);
  return result;
}

}  // namespace

Integer3 PlaneNormal::integers() const {
  const std::array<IntegerView, 5> of_plane = planes_->coefficients(plane_);
  Integer3 result = copies(of_plane[0], of_plane[1], of_plane[2]);
  if (plane_.flipped()) {
    for (Integer& value : result) mpz_neg(value.get_mpz_t(), value.get_mpz_t());
  }
  return result;
}

bool same_direction(const PlaneNormal& u, const PlaneNormal& v, const Monitor& monitor) {
  if (kFastPaths) {
    if (sure_sign_of_dot(u.near(), v.near()) < 0) return false;
    const NearVector product = near_cross(u.near(), v.near());
    for (const double x : product.at) {
      if (x > product.error || x < -product.error) return false;
    }
  }
  return same_direction(u.direction(), v.direction(), monitor);
}

EdgeLines::EdgeLines(const Complex& complex, const Monitor& monitor) : edge_of_(complex.svertex_count()) {
  struct Part {
    std::vector<NearVector> near;
    IntegerRows integers{3};
  };
  constexpr std::size_t kRange = 4096;
  std::vector<Part> parts((complex.svertex_count() + kRange - 1) / kRange);
  parallel_for_ranges(complex.svertex_count(), kRange, monitor, [&](std::size_t from, std::size_t to, const Monitor&) {
    Part& part = parts[from / kRange];
    for (HalfedgeId h{static_cast<std::uint32_t>(from)}; h.index() < to; ++h) {
      if (complex.twin[h] < h) continue;
      const Direction line = direction_of(complex.planes, complex.svertex(h));
      const Integer3& n = line.integers();
      part.near.push_back(near_vector(line));
      part.integers.push(std::array<mpz_srcptr, 3>{n[0].get_mpz_t(), n[1].get_mpz_t(), n[2].get_mpz_t()});
    }
  });
  near_.reserve(complex.svertex_count() / 2);
  for (Part& part : parts) {
    near_.insert(near_.end(), part.near.begin(), part.near.end());
    integers_.append(part.integers, 0, part.integers.size());
    part = Part();
  }
  std::uint32_t edge = 0;
  for (const HalfedgeId h : complex.halfedge_ids()) {
    edge_of_[h] = h < complex.twin[h] ? edge++ : edge_of_[complex.twin[h]];
  }
}

Integer3 EdgeLines::integers(std::uint32_t edge) const {
  const std::array<IntegerView, 3> line = integers_.first<3>(edge);
  return copies(line[0], line[1], line[2]);
}

Direction EdgeLines::direction(std::uint32_t edge) const {
  const Integer3 line = integers(edge);
  return Direction::exact(line[0], line[1], line[2]);
}

int EdgeLines::exact_sign_of_dot(std::uint32_t edge, const PlaneNormal& normal, const Monitor& monitor) const {
  monitor.count_exact();
  const std::array<IntegerView, 3> line = integers_.first<3>(edge);
  const std::array<IntegerView, 5> of_plane = normal.planes_->coefficients(normal.plane_);
  Integer dot;
  for (std::size_t i = 0; i < 3; ++i) mpz_addmul(dot.get_mpz_t(), line[i], of_plane[i]);
  return normal.plane_.flipped() ? -sgn(dot) : sgn(dot);
}

}  // namespace nef::minkowski
