// SPDX-License-Identifier: Apache-2.0
//
// The normal is the product of two sides of the triangle, divided by the common factor of its parts; what then is
// common to it and the offset is a divisor of the denominator. Numbers of one word are brought over one denominator and
// multiplied in machine integers, up to the whole plane if that is short, too; of numbers of two words the normal is
// computed so, and longer ones are left to GMP.
#include "nef/geometry/plane_finder.h"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "nef/base/fast_path.h"
#include "nef/number/int128.h"

namespace nef {
namespace {

// x, y, z, w where they are below 2^62, and zeros.
using Homogeneous = std::array<std::int64_t, 7>;

// Brings three points over one denominator below 2^64, with all numbers below 2^kWidth; false if that cannot be.
template <int kWidth, typename Point>
bool over_one_denominator(std::array<Point, 3>& points) {
  using Number = typename Point::value_type;
  const auto fits = [](Unsigned128 value) { return bit_width(value) <= std::min(kWidth, 64); };
  auto common = static_cast<Unsigned128>(points[0][3]);
  if (!fits(common)) return false;
  for (std::size_t k = 1; k < 3; ++k) {
    const auto w = static_cast<Unsigned128>(points[k][3]);
    if (w == common) continue;
    if (!fits(w)) return false;
    common *= w / greatest_common_divisor(static_cast<std::uint64_t>(w), static_cast<std::uint64_t>(common));
    if (!fits(common)) return false;
  }
  for (Point& p : points) {
    if (p[3] == static_cast<Number>(common)) continue;
    const Number factor = static_cast<Number>(common) / p[3];
    for (std::size_t i = 0; i < 3; ++i) {
      if (bit_width(magnitude(p[i])) + bit_width(magnitude(factor)) > kWidth) return false;
      p[i] *= factor;
    }
    p[3] *= factor;
  }
  return true;
}

std::uint64_t bits_of(const std::array<std::int64_t, 3>& v) {
  return static_cast<std::uint64_t>(std::abs(v[0])) | static_cast<std::uint64_t>(std::abs(v[1])) |
         static_cast<std::uint64_t>(std::abs(v[2]));
}

}  // namespace

// Two sides of a triangle and the corner where they begin, in numbers over one denominator; all are below 2^62.
struct PlaneFinder::SmallSides {
  SmallSides(const std::array<std::array<std::int64_t, 3>, 3>& corners, std::int64_t over)
      : origin(corners[0]), denominator(over) {
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = corners[1][i] - corners[0][i];
      v[i] = corners[2][i] - corners[0][i];
    }
  }

  std::array<std::int64_t, 3> origin;
  std::int64_t denominator;
  std::array<std::int64_t, 3> u{};
  std::array<std::int64_t, 3> v{};
};

namespace {

// The corners of a triangle over one denominator, in numbers below 2^62; nothing if they are not small.
struct SmallCorners {
  std::array<std::array<std::int64_t, 3>, 3> at;
  std::int64_t denominator;
};
std::optional<SmallCorners> small_corners(const PointTable& points, const std::array<PointId, 3>& triangle) {
  std::array<Homogeneous, 3> read;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!points.small_coordinates(triangle[k], read[k])) return std::nullopt;
  }
  if (!over_one_denominator<62>(read)) return std::nullopt;
  SmallCorners result{{}, read[0][3]};
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(read[k].begin(), 3, result.at[k].begin());
  return result;
}

// x, y, z, w where they are below 2^126.
using WideHomogeneous = std::array<Int128, 4>;

bool read_wide(const PointTable& points, PointId point, WideHomogeneous& out) {
  static_assert(GMP_NUMB_BITS == 64);
  const std::array<IntegerView, 4> at = points.coordinates(point);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t size = mpz_size(at[i]);
    const mp_limb_t high = size < 2 ? 0 : mpz_getlimbn(at[i], 1);
    if (size > 2 || high >> 62U != 0) return false;
    const auto value = static_cast<Int128>(static_cast<Unsigned128>(high) << 64U | mpz_getlimbn(at[i], 0));
    out[i] = at[i].sign() < 0 ? -value : value;
  }
  return true;
}

Unsigned128 bits_of(const std::array<Int128, 3>& v) { return magnitude(v[0]) | magnitude(v[1]) | magnitude(v[2]); }

// The product of the sides of a triangle in integers of two words: the sides are differences of numbers below 2^126,
// and the parts of their product differences of two products of numbers whose widths add up to 126 bits at most, so
// below 2^127. False if numbers are longer.
bool wide_normal(const PointTable& points, const std::array<PointId, 3>& triangle, Integer3& n) {
  std::array<WideHomogeneous, 3> at;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!read_wide(points, triangle[k], at[k])) return false;
  }
  if (!over_one_denominator<126>(at)) return false;
  std::array<Int128, 3> u;
  std::array<Int128, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = at[1][i] - at[0][i];
    v[i] = at[2][i] - at[0][i];
  }
  if (bit_width(bits_of(u)) + bit_width(bits_of(v)) > 126) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    assign(n[i], u[j] * v[k] - u[k] * v[j]);
  }
  return true;
}

// p - o up to a positive factor: over the least common denominator, for what their denominators have in common would go
// through all that follows, twice. Decimals have a lot in common. `scratch` is two numbers.
void difference(const PointTable& points, PointId p, PointId o, Integer3& out, std::span<Integer, 2> scratch) {
  const std::array<IntegerView, 4> from = points.coordinates(o);
  const std::array<IntegerView, 4> to = points.coordinates(p);
  if (mpz_cmp(from[3], to[3]) == 0) {
    for (std::size_t i = 0; i < 3; ++i) mpz_sub(out[i].get_mpz_t(), to[i], from[i]);
    return;
  }
  mpz_ptr factor_of_to = scratch[0].get_mpz_t();
  mpz_ptr factor_of_from = scratch[1].get_mpz_t();
  mpz_ptr common = out[0].get_mpz_t();
  mpz_gcd(common, from[3], to[3]);
  mpz_divexact(factor_of_to, from[3], common);
  mpz_divexact(factor_of_from, to[3], common);
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_mul(out[i].get_mpz_t(), to[i], factor_of_to);
    mpz_submul(out[i].get_mpz_t(), from[i], factor_of_from);
  }
}

}  // namespace

PlaneId PlaneFinder::through(PlaneTable& planes, const PointTable& points, const Integer3& normal, PointId o) {
  n_ = normal;
  return with_normal(planes, points, o);
}

// The same in machine integers, for points whose numbers over one denominator D are below 2^62: with N the product of
// two differences of these numbers, the plane is N.(x D) = N.(a D). The factors of N, which is below 2^63 as the widths
// of the differences add up to 62 bits at most, are divided out first; what then remains between N D and the offset is
// a divisor of D. N D is below 2^125, and the offset, a sum of three such products, below 2^127.
std::optional<PlaneId> PlaneFinder::through_small(PlaneTable& planes, const SmallSides& sides) {
  const auto& [origin, denominator, u, v] = sides;
  if (std::bit_width(bits_of(u)) + std::bit_width(bits_of(v)) > 62) return std::nullopt;
  std::array<std::int64_t, 3> n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  const auto size = [&n](std::size_t i) { return static_cast<std::uint64_t>(std::abs(n[i])); };
  auto divisor = static_cast<std::int64_t>(greatest_common_divisor(size(0), size(1)));
  if (divisor == 0) {
    divisor = static_cast<std::int64_t>(size(2));
  } else if (divisor != 1) {
    // A small one as a rule: after a division it takes few steps.
    const auto so_far = static_cast<std::uint64_t>(divisor);
    divisor = static_cast<std::int64_t>(greatest_common_divisor(so_far, size(2) % so_far));
  }
  if (divisor == 0) return PlaneId();
  Int128 offset = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (divisor != 1) n[i] /= divisor;
    offset -= static_cast<Int128>(n[i]) * origin[i];
  }
  const std::int64_t common = common_divisor(denominator, offset);
  Int128 factor = denominator;
  if (common != 1) {
    factor = denominator / common;
    offset /= common;
  }
  return planes.intern_primitive(
      std::array<Int128, 5>{factor * n[0], factor * n[1], factor * n[2], offset});  // no part in R
}

std::optional<PlaneId> PlaneFinder::through(PlaneTable& planes,
                                            const std::array<std::array<std::int64_t, 3>, 3>& corners,
                                            std::int64_t denominator) {
  return through_small(planes, {corners, denominator});
}

PlaneId PlaneFinder::through(PlaneTable& planes, const PointTable& points, PointId o, PointId p, PointId q) {
  if (kFastPaths) {
    if (const std::optional<SmallCorners> corners = small_corners(points, {o, p, q})) {
      if (const auto plane = through_small(planes, {corners->at, corners->denominator})) return *plane;
    }
  }
  if (!kFastPaths || !wide_normal(points, {o, p, q}, n_)) {
    const std::span<Integer, 2> scratch = std::span(n_).first<2>();
    difference(points, p, o, u_, scratch);
    difference(points, q, o, v_, scratch);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      mpz_mul(n_[i].get_mpz_t(), u_[j].get_mpz_t(), v_[k].get_mpz_t());
      mpz_submul(n_[i].get_mpz_t(), u_[k].get_mpz_t(), v_[j].get_mpz_t());
    }
  }
  if (is_zero(n_)) return PlaneId();
  return with_normal(planes, points, o);
}

// Short normals first: a common factor, mostly 1, would go through all that follows. The plane is w n.x + offset = 0, w
// being the point's denominator, and what w n and the offset have in common is a divisor of w.
PlaneId PlaneFinder::with_normal(PlaneTable& planes, const PointTable& points, PointId o) {
  const std::array<IntegerView, 4> at = points.coordinates(o);
  mpz_ptr offset = offset_.get_mpz_t();
  mpz_set_ui(offset, 0);
  Integer& divisor = u_[0];
  mpz_gcd(divisor.get_mpz_t(), n_[0].get_mpz_t(), n_[1].get_mpz_t());
  mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), n_[2].get_mpz_t());
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_ptr n = n_[i].get_mpz_t();
    if (divisor > 1) mpz_divexact(n, n, divisor.get_mpz_t());
    mpz_submul(offset, n, at[i]);
  }
  mpz_gcd(divisor.get_mpz_t(), at[3], offset);
  Integer& factor = u_[1];
  mpz_divexact(factor.get_mpz_t(), at[3], divisor.get_mpz_t());
  if (divisor > 1) mpz_divexact(offset, offset, divisor.get_mpz_t());
  if (factor > 1) {
    for (Integer& n : n_) mpz_mul(n.get_mpz_t(), n.get_mpz_t(), factor.get_mpz_t());
  }
  return planes.intern_primitive({n_[0].get_mpz_t(), n_[1].get_mpz_t(), n_[2].get_mpz_t(), offset});
}

}  // namespace nef
