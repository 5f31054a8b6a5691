// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/mesh_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nef/number/int128.h"

namespace nef {
namespace {

// Coordinates below 2^40 give differences below 2^41, minors below 2^83 and determinants below 2^126.
constexpr std::int64_t kIntegerLimit = std::int64_t{1} << 40U;

void assign(Integer& to, Int128 value) {
  const Unsigned128 size = magnitude(value);
  const std::array<std::uint64_t, 2> words{static_cast<std::uint64_t>(size), static_cast<std::uint64_t>(size >> 64U)};
  mpz_import(to.get_mpz_t(), words.size(), -1, sizeof(std::uint64_t), 0, 0, words.data());
  if (value < 0) mpz_neg(to.get_mpz_t(), to.get_mpz_t());
}

}  // namespace

// b - a along an axis, scaled by the positive product of their denominators. Below 2^125, as homogeneous coordinates
// are below 2^62.
Int128 MeshPoints::short_difference(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
  const auto& p = homogeneous_[a];
  const auto& q = homogeneous_[b];
  return static_cast<Int128>(q[axis]) * p[3] - static_cast<Int128>(p[axis]) * q[3];
}

// b - a in homogeneous integers, scaled by the positive product of their denominators where these differ: the axes
// from `first` on, as many as there is room for (of two, the second may be the first axis).
void MeshPoints::difference(std::uint32_t a, std::uint32_t b, std::span<Integer> out, std::size_t first) const {
  if (!homogeneous_.empty()) {
    for (std::size_t k = 0; k < out.size(); ++k) assign(out[k], short_difference(a, b, (first + k) % 3));
    return;
  }
  const std::array<IntegerView, 4> p = table_.coordinates(PointId{a});
  const std::array<IntegerView, 4> q = table_.coordinates(PointId{b});
  const bool same = mpz_cmp(p[3], q[3]) == 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t axis = (first + k) % 3;
    mpz_ptr d = out[k].get_mpz_t();
    if (same) {
      mpz_sub(d, q[axis], p[axis]);
    } else {
      mpz_mul(d, q[axis], p[3]);
      mpz_submul(d, p[axis], q[3]);
    }
  }
}

// The plane through three points, up to a positive factor.
class MeshPoints::PlaneThrough {
 public:
  PlaneThrough(const MeshPoints& points, std::uint32_t a, std::uint32_t b, std::uint32_t c) : points_(points), a_(a) {
    Integer3 v;
    points.difference(a, b, u_);
    points.difference(a, c, v);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      mpz_mul(normal_[i].get_mpz_t(), u_[j].get_mpz_t(), v[k].get_mpz_t());
      mpz_submul(normal_[i].get_mpz_t(), u_[k].get_mpz_t(), v[j].get_mpz_t());
    }
  }

  // The sign of normal . (p - a).
  int side(std::uint32_t p) {
    points_.difference(a_, p, u_);
    mpz_mul(sum_.get_mpz_t(), normal_[0].get_mpz_t(), u_[0].get_mpz_t());
    mpz_addmul(sum_.get_mpz_t(), normal_[1].get_mpz_t(), u_[1].get_mpz_t());
    mpz_addmul(sum_.get_mpz_t(), normal_[2].get_mpz_t(), u_[2].get_mpz_t());
    return sgn(sum_);
  }

 private:
  const MeshPoints& points_;
  std::uint32_t a_;
  Integer3 u_, normal_;
  Integer sum_;
};

MeshPoints::MeshPoints(std::span<const Rational3> points) {
  approximate_.reserve(points.size());
  if (make_integers(points)) {
    approximate_integers();
    return;
  }
  table_.reserve(points.size());
  for (const Rational3& point : points) {
    table_.push(point);
    approximate_.push_back(table_.approximate(PointId{table_.size() - 1}));
  }
  find_margins(false);
}

MeshPoints::MeshPoints(PointTable points) : table_(std::move(points)) {
  approximate_.reserve(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) approximate_.push_back(table_.approximate(PointId{i}));
  find_margins(false);
}

MeshPoints::MeshPoints(const PointTable& points, std::span<const PointId> chosen) {
  approximate_.reserve(chosen.size());
  const bool is_short = read_homogeneous(points, chosen);
  if (is_short ? make_integers_of_homogeneous() : make_integers(points, chosen)) {
    homogeneous_.clear();
    approximate_integers();
    return;
  }
  for (const PointId p : chosen) approximate_.push_back(points.approximate(p));
  find_margins(false);
  if (is_short) return;
  table_.reserve(chosen.size());
  for (std::size_t i = 0; i < chosen.size();) {
    // Points that follow each other are copied at once.
    std::size_t count = 1;
    while (i + count < chosen.size() && chosen[i + count].index() == chosen[i].index() + count) ++count;
    table_.append(points, chosen[i].index(), count);
    i += count;
  }
}

// Below 2^40 every integer is a double.
void MeshPoints::approximate_integers() {
  for (const auto& p : integers_) {
    approximate_.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  }
  find_margins(true);
}

bool MeshPoints::read_homogeneous(const PointTable& points, std::span<const PointId> chosen) {
  homogeneous_.resize(chosen.size());
  PointTable::SmallReader reader(points);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    std::array<std::int64_t, 7> h;
    if (!reader.read(chosen[i], h)) {
      homogeneous_.clear();
      return false;
    }
    homogeneous_[i] = {h[0], h[1], h[2], h[3]};
  }
  return true;
}

// The common denominator grows where a coordinate is not a multiple of its inverse; what is there is scaled then, which
// happens forty times at most.
bool MeshPoints::enlarge_denominator(std::int64_t factor) {
  if (factor >= kIntegerLimit || static_cast<Int128>(denominator_) * factor >= kIntegerLimit) return false;
  denominator_ *= factor;
  for (auto& point : integers_) {
    for (std::int64_t& x : point) {
      const Int128 larger = static_cast<Int128>(x) * factor;
      if (larger >= kIntegerLimit || larger <= -kIntegerLimit) return false;
      x = static_cast<std::int64_t>(larger);
    }
  }
  return true;
}

bool MeshPoints::no_integers() {
  integers_.clear();
  denominator_ = 1;
  return false;
}

// The common denominator first. Most points have the denominator of the one before, or one that divides what is known
// of the common one; else the quotients are taken to lowest terms.
bool MeshPoints::find_denominator() {
  std::int64_t last = 1;
  for (const auto& [x, y, z, w] : homogeneous_) {
    if (w == last) continue;
    if (denominator_ % w != 0) {
      for (const std::int64_t numerator : {x, y, z}) {
        const std::int64_t rest = numerator % w;
        if (rest == 0) continue;
        const std::int64_t reduced = w / common_divisor(w, rest);
        const std::int64_t missing = reduced / common_divisor(reduced, denominator_);
        if (missing >= kIntegerLimit || static_cast<Int128>(denominator_) * missing >= kIntegerLimit) return false;
        denominator_ *= missing;
      }
      // Others with the same denominator need not be multiples.
      continue;
    }
    last = w;
  }
  return true;
}

bool MeshPoints::make_integers_of_homogeneous() {
  if (!find_denominator()) return no_integers();
  integers_.resize(homogeneous_.size());
  std::int64_t last = 0;
  std::int64_t factor = 0;  // the common denominator over `last`; 0 if that is no integer
  for (std::size_t i = 0; i < integers_.size(); ++i) {
    const std::array<std::int64_t, 4>& from = homogeneous_[i];
    const std::int64_t w = from[3];
    if (w != last) factor = denominator_ % w == 0 ? denominator_ / w : 0;
    last = w;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The quotient is an integer, as the common denominator is a multiple of the reduced one.
      const Int128 product = static_cast<Int128>(from[axis]) * (factor != 0 ? factor : denominator_);
      const Int128 scaled = factor != 0 ? product : product / w;
      if (scaled >= kIntegerLimit || scaled <= -kIntegerLimit) return no_integers();
      integers_[i][axis] = static_cast<std::int64_t>(scaled);
    }
  }
  return true;
}

// The same for numbers of any size, in GMP.
bool MeshPoints::make_integers(const PointTable& points, std::span<const PointId> chosen) {
  Integer scaled;
  Integer quotient;
  Integer rest;
  integers_.reserve(chosen.size());
  for (const PointId p : chosen) {
    const IntegerView w = points.coordinate(p, 3);
    std::array<std::int64_t, 3>& point = integers_.emplace_back();
    bool fits = true;
    for (std::size_t axis = 0; fits && axis < 3; ++axis) {
      const IntegerView x = points.coordinate(p, axis);
      mpz_mul_ui(scaled.get_mpz_t(), x, static_cast<unsigned long>(denominator_));
      mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), scaled.get_mpz_t(), w);
      if (rest != 0) {
        mpz_gcd(rest.get_mpz_t(), rest.get_mpz_t(), w);
        mpz_divexact(rest.get_mpz_t(), w, rest.get_mpz_t());
        fits = mpz_cmp_ui(rest.get_mpz_t(), kIntegerLimit) < 0 &&
               enlarge_denominator(static_cast<std::int64_t>(mpz_get_ui(rest.get_mpz_t())));
        mpz_mul(scaled.get_mpz_t(), scaled.get_mpz_t(), rest.get_mpz_t());
        mpz_divexact(quotient.get_mpz_t(), scaled.get_mpz_t(), w);
      }
      fits = fits && mpz_cmpabs_ui(quotient.get_mpz_t(), kIntegerLimit) < 0;
      if (fits) point[axis] = mpz_get_si(quotient.get_mpz_t());
    }
    if (!fits) return no_integers();
  }
  return true;
}

bool MeshPoints::make_integers(std::span<const Rational3> points) {
  std::int64_t denominator = 1;
  for (const Rational3& point : points) {
    for (const Rational& x : point) {
      const mpz_srcptr den = x.get_den_mpz_t();
      if (mpz_cmp_ui(den, kIntegerLimit) >= 0) return false;
      const auto d = static_cast<std::int64_t>(mpz_get_ui(den));
      if (denominator % d == 0) continue;
      const Int128 common = static_cast<Int128>(denominator / std::gcd(denominator, d)) * d;
      if (common >= kIntegerLimit) return false;
      denominator = static_cast<std::int64_t>(common);
    }
  }
  denominator_ = denominator;
  integers_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Rational& x = points[i][axis];
      bool fits = mpz_fits_slong_p(x.get_num_mpz_t()) != 0;
      if (fits) {
        const Int128 scaled = static_cast<Int128>(mpz_get_si(x.get_num_mpz_t())) *
                              (denominator / static_cast<std::int64_t>(mpz_get_ui(x.get_den_mpz_t())));
        fits = scaled < kIntegerLimit && scaled > -kIntegerLimit;
        integers_[i][axis] = static_cast<std::int64_t>(scaled);
      }
      if (!fits) return no_integers();
    }
  }
  return true;
}

// PointTable promises doubles within 2^-51 relative. Beyond 1e100 products of three may overflow: no filter then.
void MeshPoints::find_margins(bool exact) {
  std::array<double, 3> largest{};
  for (const auto& p : approximate_) {
    for (std::size_t axis = 0; axis < 3; ++axis) largest[axis] = std::max(largest[axis], std::abs(p[axis]));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(largest[axis] < 1e100)) filter_ = false;
    margin_[axis] = exact ? 0.0 : largest[axis] * 0x1p-50 + 1e-290;
  }
}

void MeshPoints::extend(Box& box, std::uint32_t p) const {
  if (!filter_) {
    box.low.fill(-HUGE_VAL);
    box.high.fill(HUGE_VAL);
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], approximate_[p][axis] - margin_[axis]);
    box.high[axis] = std::max(box.high[axis], approximate_[p][axis] + margin_[axis]);
  }
}

// The filter. Let s be the largest computed difference along an axis, m the margin of a coordinate and u = 2^-53. A
// computed difference is off by at most e = 2m + u s', s' = s + 2m + u s' being a bound on the true and the
// computed one. The determinant is a sum of six products x y z of differences, so the inexact inputs change it by at
// most 6 (ex sy sz + sx ey sz + sx sy ez) up to terms of second order, for which 7 instead of 6 is more than enough;
// its own evaluation rounds each product at most eight times: 48 u sx sy sz. Underflow adds less than 1e-200
// while all coordinates are below 1e100.
Approximation MeshPoints::determinant(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  if (!filter_) return {0, HUGE_VAL};
  const auto& p = approximate_[a];
  const auto& q = approximate_[b];
  const auto& r = approximate_[c];
  const auto& t = approximate_[d];
  std::array<double, 3> s;
  std::array<double, 3> e;
  std::array<std::array<double, 3>, 3> m;
  for (std::size_t i = 0; i < 3; ++i) {
    m[0][i] = q[i] - p[i];
    m[1][i] = r[i] - p[i];
    m[2][i] = t[i] - p[i];
    s[i] = std::max({std::abs(m[0][i]), std::abs(m[1][i]), std::abs(m[2][i])}) * (1 + 0x1p-50) + 2 * margin_[i];
    e[i] = 2 * margin_[i] + 0x1p-53 * s[i];
  }
  const double value = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                       m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const double error =
      7 * (e[0] * s[1] * s[2] + s[0] * e[1] * s[2] + s[0] * s[1] * e[2]) + 0x1p-47 * s[0] * s[1] * s[2] + 1e-200;
  return {value, error};
}

int MeshPoints::orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  return sign_by_ladder(determinant(a, b, c, d), [&] { return orientation_exact(a, b, c, d); });
}

int MeshPoints::orientation_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  if (!integers_.empty()) {
    std::array<std::array<Int128, 3>, 3> m;
    for (std::size_t i = 0; i < 3; ++i) {
      m[0][i] = integers_[b][i] - integers_[a][i];
      m[1][i] = integers_[c][i] - integers_[a][i];
      m[2][i] = integers_[d][i] - integers_[a][i];
    }
    return sign_of(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                   m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
  }
  return PlaneThrough(*this, a, b, c).side(d);
}

bool MeshPoints::coplanar(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::span<const std::uint32_t> others) const {
  std::optional<PlaneThrough> plane;
  for (const std::uint32_t p : others) {
    if (determinant(a, b, c, p).sign()) return false;  // never 0: a determinant has an error
    if (!integers_.empty()) {
      if (orientation_exact(a, b, c, p) != 0) return false;
      continue;
    }
    if (!plane) plane.emplace(*this, a, b, c);
    if (plane->side(p) != 0) return false;
  }
  return true;
}

// The same filter with two products of two differences.
Approximation MeshPoints::component(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const {
  if (!filter_) return {0, HUGE_VAL};
  const std::size_t i = axis == 2 ? 0 : axis + 1;
  const std::size_t j = i == 2 ? 0 : i + 1;
  const auto& p = approximate_[a];
  const double x1 = approximate_[b][i] - p[i];
  const double y1 = approximate_[b][j] - p[j];
  const double x2 = approximate_[c][i] - p[i];
  const double y2 = approximate_[c][j] - p[j];
  const double sx = std::max(std::abs(x1), std::abs(x2)) * (1 + 0x1p-50) + 2 * margin_[i];
  const double sy = std::max(std::abs(y1), std::abs(y2)) * (1 + 0x1p-50) + 2 * margin_[j];
  const double value = x1 * y2 - x2 * y1;
  // Of small integers everything is exact.
  if (margin_[i] == 0 && margin_[j] == 0 && sx * sy < 0x1p51) return {value, 0};
  const double ex = 2 * margin_[i] + 0x1p-53 * sx;
  const double ey = 2 * margin_[j] + 0x1p-53 * sy;
  return {value, 3 * (ex * sy + sx * ey) + 0x1p-49 * sx * sy + 1e-290};
}

int MeshPoints::orientation_along(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const {
  return sign_by_ladder(component(a, b, c, axis), [&] { return orientation_along_exact(a, b, c, axis); });
}

std::array<std::int8_t, 3> MeshPoints::filtered_turns(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  std::array<std::int8_t, 3> result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis] = static_cast<std::int8_t>(component(a, b, c, axis).sign().value_or(0));
  }
  return result;
}

int MeshPoints::orientation_along_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const {
  const std::size_t i = axis == 2 ? 0 : axis + 1;
  const std::size_t j = i == 2 ? 0 : i + 1;
  if (!integers_.empty()) {
    const auto& p = integers_[a];
    const auto& q = integers_[b];
    const auto& r = integers_[c];
    return sign_of(static_cast<Int128>(q[i] - p[i]) * (r[j] - p[j]) - static_cast<Int128>(r[i] - p[i]) * (q[j] - p[j]));
  }
  if (!homogeneous_.empty()) {
    return compare_products(short_difference(a, b, i), short_difference(a, c, j), short_difference(a, c, i),
                            short_difference(a, b, j));
  }
  std::array<Integer, 2> u;
  std::array<Integer, 2> v;
  Integer sum;
  difference(a, b, u, i);
  difference(a, c, v, i);
  mpz_mul(sum.get_mpz_t(), u[0].get_mpz_t(), v[1].get_mpz_t());
  mpz_submul(sum.get_mpz_t(), v[0].get_mpz_t(), u[1].get_mpz_t());
  return sgn(sum);
}

bool MeshPoints::collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (orientation_along(a, b, c, axis) != 0) return false;
  }
  return true;
}

std::size_t MeshPoints::projection_axis(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  std::array<double, 3> size{};
  const auto& p = approximate_[a];
  const auto& q = approximate_[b];
  const auto& r = approximate_[c];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t i = axis == 2 ? 0 : axis + 1;
    const std::size_t j = i == 2 ? 0 : i + 1;
    size[axis] = std::abs((q[i] - p[i]) * (r[j] - p[j]) - (r[i] - p[i]) * (q[j] - p[j]));
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return size[i] != size[j] ? size[i] > size[j] : i < j; });
  for (const std::size_t axis : order) {
    if (orientation_along(a, b, c, axis) != 0) return axis;
  }
  return order[0];
}

int MeshPoints::compare(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
  const double gap = approximate_[a][axis] - approximate_[b][axis];
  // The margins are far above the rounding of this difference unless they are zero, when the doubles are exact.
  if (filter_ && std::abs(gap) > 4 * margin_[axis]) return gap > 0 ? 1 : -1;
  if (!integers_.empty()) {
    return (integers_[a][axis] > integers_[b][axis]) - (integers_[a][axis] < integers_[b][axis]);
  }
  if (!homogeneous_.empty()) return sign_of(short_difference(b, a, axis));
  Integer gap_along;
  difference(b, a, std::span(&gap_along, 1), axis);
  return sgn(gap_along);
}

int MeshPoints::compare(std::uint32_t a, std::uint32_t b) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (const int order = compare(a, b, axis); order != 0) return order;
  }
  return 0;
}

}  // namespace nef
