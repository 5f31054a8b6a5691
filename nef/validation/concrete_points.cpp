// SPDX-License-Identifier: Apache-2.0
#include "nef/validation/concrete_points.h"

#include <algorithm>

namespace nef {

IndexedVector<VertexId, Rational3> concrete_points(const Complex& complex) {
  const PointTable& points = complex.points;
  // Signs of the checks are of polynomials of small degree in the coordinates; a power of two with
  // many times as many bits as any coordinate or coefficient dominates them all.
  std::size_t bits = 1;
  for (const VertexId v : complex.vertex_ids()) {
    for (std::size_t i = 0; i < 7; ++i) bits = std::max(bits, mpz_sizeinbase(points.coordinate(point_of(v), i), 2));
  }
  for (std::uint32_t p = 0; p < complex.planes.size(); ++p) {
    for (std::size_t i = 0; i < 5; ++i) {
      bits = std::max(bits, mpz_sizeinbase(complex.planes.coefficient(PlaneId{2 * p}, i), 2));
    }
  }
  const Integer infimaximal = Integer(1) << static_cast<mp_bitcnt_t>(16 * bits + 64);
  IndexedVector<VertexId, Rational3> result(complex.vertex_count());
  for (const VertexId v : complex.vertex_ids()) {
    Integer w;
    mpz_set(w.get_mpz_t(), points.coordinate(point_of(v), 3));
    for (std::size_t i = 0; i < 3; ++i) {
      Integer x;
      mpz_set(x.get_mpz_t(), points.coordinate(point_of(v), i));
      mpz_addmul(x.get_mpz_t(), infimaximal.get_mpz_t(), points.coordinate(point_of(v), 4 + i));
      result[v][i] = Rational(x, w);
      result[v][i].canonicalize();
    }
  }
  return result;
}

Winding winding_number(const std::vector<const Rational3*>& polygon, const Rational3& point, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  Winding winding;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Rational3& a = *polygon[i];
    const Rational3& b = *polygon[(i + 1) % polygon.size()];
    const bool up = a[y] <= point[y] && point[y] < b[y];
    const bool down = b[y] <= point[y] && point[y] < a[y];
    const bool level = a[y] == point[y] && b[y] == point[y];
    if (level) {
      if (std::min(a[x], b[x]) <= point[x] && point[x] <= std::max(a[x], b[x])) winding.on_boundary = true;
      continue;
    }
    if (a == point || b == point) winding.on_boundary = true;
    if (!up && !down) continue;
    const Rational turn = (b[x] - a[x]) * (point[y] - a[y]) - (b[y] - a[y]) * (point[x] - a[x]);
    if (turn == 0) winding.on_boundary = true;
    if (up && turn > 0) ++winding.number;
    if (down && turn < 0) --winding.number;
  }
  return winding;
}

std::vector<const Rational3*> cycle_points(const Complex& complex, const IndexedVector<VertexId, Rational3>& points,
                                           CycleId cycle) {
  std::vector<const Rational3*> result;
  for (const SHalfedgeId corner : complex.corners_of(cycle)) {
    result.push_back(&points[complex.shalfedge_vertex(corner)]);
  }
  return result;
}

}  // namespace nef
