// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/camera_planes.h"

namespace nef::visual_hull {
namespace {

// Numerators over the (positive) least common denominator.
template <std::size_t kSize>
void to_integers(const std::array<const Rational*, kSize>& values, const std::array<Integer*, kSize>& result) {
  Integer denominator = 1;
  for (const Rational* value : values) {
    mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(), value->get_den_mpz_t());
  }
  for (std::size_t i = 0; i < kSize; ++i) {
    Integer& target = *result[i];
    mpz_divexact(target.get_mpz_t(), denominator.get_mpz_t(), values[i]->get_den_mpz_t());
    target *= values[i]->get_num();
  }
}

}  // namespace

CameraPlanes::CameraPlanes(const Camera& camera) : camera_(camera) {
  std::array<const Rational*, 12> values{};
  std::array<Integer*, 12> integers{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      values[4 * i + j] = &camera.matrix()[i][j];
      integers[4 * i + j] = &matrix_[i][j];
    }
  }
  to_integers(values, integers);
}

std::array<Integer, 4> CameraPlanes::through(const Point2& a, const Point2& b) const {
  std::array<Integer, 4> plane;
  if (!a.lattice || !b.lattice) {
    const RationalPlane exact = plane_through(camera_, a, b);
    to_integers<4>({&exact.normal[0], &exact.normal[1], &exact.normal[2], &exact.offset},
                   {&plane[0], &plane[1], &plane[2], &plane[3]});
    return plane;
  }
  // The line a x b, times 2^16: coordinates times 2^8 are integers of 24 bits.
  constexpr double kLattice = 256;
  const auto ax = static_cast<long>(a.approximate[0] * kLattice);
  const auto ay = static_cast<long>(a.approximate[1] * kLattice);
  const auto bx = static_cast<long>(b.approximate[0] * kLattice);
  const auto by = static_cast<long>(b.approximate[1] * kLattice);
  const std::array<long, 3> line{(ay - by) * 256, (bx - ax) * 256, ax * by - ay * bx};
  Integer term;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      mpz_mul_si(term.get_mpz_t(), matrix_[i][j].get_mpz_t(), line[i]);
      plane[j] += term;
    }
  }
  return plane;
}

}  // namespace nef::visual_hull
