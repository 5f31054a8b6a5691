// SPDX-License-Identifier: Apache-2.0
//
// The point where three planes meet is found by Cramer's rule: in integers of 128 bits if all coefficients are below
// 2^40, which bounds each determinant by 2^123, else in GMP integers that are kept for the next point. Coordinates are
// not reduced to lowest terms unless `push_reduced` asks for it, since the common factor costs more than it saves.
#include "nef/geometry/point_table.h"

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/number/int128.h"

namespace nef {

namespace {

// The homogeneous coordinates x, y, z, w of a point whose fractions are of one word each, as is their common
// denominator.
bool short_fractions(const Rational3& point, std::array<Int128, 7>& h) {
  static_assert(GMP_NUMB_BITS == 64);
  std::array<std::uint64_t, 3> denominator{};
  std::uint64_t w = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_srcptr den = point[i].get_den_mpz_t();
    if (mpz_size(den) > 1 || mpz_size(point[i].get_num_mpz_t()) > 1) return false;
    denominator[i] = mpz_getlimbn(den, 0);
    if (w == denominator[i] || w % denominator[i] == 0) continue;
    const Unsigned128 common =
        static_cast<Unsigned128>(w / greatest_common_divisor(w, denominator[i])) * denominator[i];
    if (common >> 64U != 0) return false;
    w = static_cast<std::uint64_t>(common);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_srcptr num = point[i].get_num_mpz_t();
    const Unsigned128 x = static_cast<Unsigned128>(mpz_getlimbn(num, 0)) * (w / denominator[i]);
    if (x >> 127U != 0) return false;
    h[i] = mpz_sgn(num) < 0 ? -static_cast<Int128>(x) : static_cast<Int128>(x);
  }
  h[3] = w;
  return true;
}

// The coefficients of three finite planes, if all are below 2^40.
bool small_coefficients(const PlaneTable& planes, const std::array<PlaneId, 3>& plane,
                        std::array<std::array<std::int64_t, 4>, 3>& out) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 40U;
  if (!kFastPaths) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<std::int64_t, 5> n{};
    if (!planes.small_coefficients(plane[i], n) || n[4] != 0) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      if (n[k] >= kLimit || n[k] <= -kLimit) return false;
      out[i][k] = n[k];
    }
  }
  return true;
}

// Cramer's rule as in push_intersection: minors are below 2^81, determinants below 2^123.
std::array<Int128, 4> small_intersection(const std::array<std::array<std::int64_t, 4>, 3>& n) {
  std::array<Int128, 4> h{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& u = n[(i + 1) % 3];
    const auto& v = n[(i + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t k1 = (k + 1) % 3;
      const std::size_t k2 = (k + 2) % 3;
      const Int128 minor = static_cast<Int128>(u[k1]) * v[k2] - static_cast<Int128>(u[k2]) * v[k1];
      if (i == 0) h[3] += n[0][k] * minor;
      h[k] -= n[i][3] * minor;
    }
  }
  if (h[3] < 0) {
    for (Int128& value : h) value = -value;
  }
  return h;
}

}  // namespace

PointId PointTable::push(const Rational3& point) {
  if (std::array<Int128, 7> words{}; short_fractions(point, words)) return push_homogeneous(words);  // no part in R
  std::array<Integer, 7> h;
  mpz_ptr w = h[3].get_mpz_t();
  mpz_lcm(w, point[0].get_den_mpz_t(), point[1].get_den_mpz_t());
  mpz_lcm(w, w, point[2].get_den_mpz_t());
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr x = h[i].get_mpz_t();
    mpz_divexact(x, w, point[i].get_den_mpz_t());
    mpz_mul(x, x, point[i].get_num_mpz_t());
  }
  return push_homogeneous(h);
}

PointId PointTable::push_homogeneous(const std::array<Int128, 7>& h) {
  NEF_ASSERT(h[3] > 0);
  rows_.push(h);
  return PointId{size() - 1};
}

PointId PointTable::push_homogeneous(std::array<Integer, 7>& h) {
  NEF_ASSERT(h[3] != 0);
  if (sgn(h[3]) < 0) {
    for (Integer& value : h) mpz_neg(value.get_mpz_t(), value.get_mpz_t());
  }
  std::array<mpz_srcptr, 7> row{};
  for (std::size_t i = 0; i < 7; ++i) row[i] = h[i].get_mpz_t();
  rows_.push(row);
  return PointId{size() - 1};
}

PointId PointTable::push_from(const PointTable& other, PointId point) {
  rows_.push_from(other.rows_, point.index());
  return PointId{size() - 1};
}

PointId PointTable::push_reduced(const PointTable& other, PointId point) {
  Integer divisor;
  if (other.is_reduced(point, divisor)) return push_from(other, point);
  std::array<Integer, 7> h;
  for (std::size_t i = 0; i < 7; ++i) {
    mpz_divexact(h[i].get_mpz_t(), other.coordinate(point, i), divisor.get_mpz_t());
  }
  return push_homogeneous(h);
}

bool PointTable::is_reduced(PointId point, Integer& divisor) const {
  if (rows_.are_integers(point.index())) {
    divisor = 1;
    return true;
  }
  mpz_set(divisor.get_mpz_t(), coordinate(point, 3));
  for (std::size_t i = 0; i < 7 && divisor != 1; ++i) {
    mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), coordinate(point, i));
  }
  return divisor == 1;
}

void PointTable::append(const PointTable& other, std::size_t first, std::size_t count) {
  rows_.append(other.rows_, first, count);
}

std::optional<PointId> PointTable::push_intersection(const PlaneTable& planes, PlaneId p, PlaneId q, PlaneId r) {
  const std::array<PlaneId, 3> plane{p, q, r};
  if (std::array<std::array<std::int64_t, 4>, 3> n{}; small_coefficients(planes, plane, n)) {
    const std::array<Int128, 4> h = small_intersection(n);
    if (h[3] == 0) return std::nullopt;
    return push_homogeneous(std::array<Int128, 7>{h[0], h[1], h[2], h[3]});
  }
  // Cramer's rule with the adjugate's rows m_i = n_j x n_k: w = n_p . m_p, x = -(sum of d_i m_i).
  std::array<Integer, 7>& h = scratch_.coordinates;
  for (Integer& value : h) value = 0;
  mpz_ptr m = scratch_.minor.get_mpz_t();
  const auto coefficients = [&planes](PlaneId plane) {
    return std::array<IntegerView, 4>{planes.coefficient(plane, 0), planes.coefficient(plane, 1),
                                      planes.coefficient(plane, 2), planes.coefficient(plane, 3)};
  };
  const std::array<std::array<IntegerView, 4>, 3> n{coefficients(p), coefficients(q), coefficients(r)};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& u = n[(i + 1) % 3];
    const auto& v = n[(i + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t k1 = (k + 1) % 3;
      const std::size_t k2 = (k + 2) % 3;
      // Planes parallel to axes have zeros.
      const bool plus = u[k1].sign() != 0 && v[k2].sign() != 0;
      const bool minus = u[k2].sign() != 0 && v[k1].sign() != 0;
      if (!plus && !minus) continue;
      if (plus) {
        mpz_mul(m, u[k1], v[k2]);
        if (minus) mpz_submul(m, u[k2], v[k1]);
      } else {
        mpz_mul(m, u[k2], v[k1]);
        mpz_neg(m, m);
      }
      if (i == 0 && n[0][k].sign() != 0) mpz_addmul(h[3].get_mpz_t(), n[0][k], m);
      if (n[i][3].sign() != 0) mpz_submul(h[k].get_mpz_t(), n[i][3], m);
      if (planes.infimaximal(plane[i])) mpz_submul(h[4 + k].get_mpz_t(), planes.coefficient(plane[i], 4), m);
    }
    if (sgn(h[3]) == 0) return std::nullopt;
  }
  return push_homogeneous(h);
}

Rational3 PointTable::rational(PointId point) const {
  NEF_ASSERT(finite(point));
  Rational3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_set(result[i].get_num_mpz_t(), coordinate(point, i));
    mpz_set(result[i].get_den_mpz_t(), coordinate(point, 3));
    result[i].canonicalize();
  }
  return result;
}

std::vector<Rational3> PointTable::rationals() const {
  std::vector<Rational3> result;
  result.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) result.push_back(rational(PointId{i}));
  return result;
}

std::size_t PointTable::bytes() const { return rows_.bytes(); }

void PointTable::trim() { rows_.trim(); }

}  // namespace nef
