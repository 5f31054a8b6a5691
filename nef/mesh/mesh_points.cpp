// SPDX-License-Identifier: Apache-2.0
//
// On construction the least common denominator of all coordinates is sought; if all points become integers below 2^40
// with it, doubles hold them exactly and determinants fit into 128 bits. For other points, the doubles have a margin
// for each axis, and a predicate takes the sign of the value in doubles if it exceeds the error bound that is derived
// beside it, and an exact determinant if not.
#include "nef/mesh/mesh_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

#include "nef/base/fast_path.h"
#include "nef/base/threads/parallel.h"
#include "nef/number/int128.h"

namespace nef {
namespace {

// See find_margins.
constexpr double kModerate = 1e75;

// Coordinates below 2^40 give differences below 2^41, minors below 2^83 and determinants below 2^126.
constexpr std::int64_t kIntegerLimit = std::int64_t{1} << 40U;

// b - a along an axis, scaled by the positive product of their denominators. Below 2^125.
Int128 short_difference(const MeshPoints::Small& a, const MeshPoints::Small& b, std::size_t axis) {
  return static_cast<Int128>(b[axis]) * a[3] - static_cast<Int128>(a[axis]) * b[3];
}

// Of a coordinate in lowest terms; kIntegerLimit if it is not below that.
std::int64_t reduced_denominator(const PointTable& points, PointId point, std::size_t axis) {
  const IntegerView w = points.coordinate(point, 3);
  Integer reduced;
  mpz_gcd(reduced.get_mpz_t(), points.coordinate(point, axis), w);
  mpz_divexact(reduced.get_mpz_t(), w, reduced.get_mpz_t());
  return mpz_cmp_ui(reduced.get_mpz_t(), kIntegerLimit) < 0 ? mpz_get_si(reduced.get_mpz_t()) : kIntegerLimit;
}

}  // namespace

// b - a in homogeneous integers, scaled by the positive product of their denominators where these differ: the axes
// from `first` on, as many as there is room for (of two, the second may be the first axis).
void MeshPoints::difference(std::uint32_t a, std::uint32_t b, std::span<Integer> out, std::size_t first) const {
  require_numbers();
  if (Small from{}, to{};
      kFastPaths && source().small_coordinates(place(a), from) && source().small_coordinates(place(b), to)) {
    for (std::size_t k = 0; k < out.size(); ++k) assign(out[k], short_difference(from, to, (first + k) % 3));
    return;
  }
  const std::array<IntegerView, 4> p = source().coordinates(place(a));
  const std::array<IntegerView, 4> q = source().coordinates(place(b));
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

MeshPoints::MeshPoints(std::span<const Rational3> points, const Monitor& monitor) {
  if (!make_integers(points, for_vertices(points.size(), monitor))) {
    own_.reserve(points.size());
    table_.reserve(points.size());
    for (const Rational3& point : points) {
      table_.push(point);
      own_.push_back(table_.approximate(PointId{table_.size() - 1}));
    }
  }
  approximate_ = own_;
  find_margins({});
}

MeshPoints::MeshPoints(PointTable points) : table_(std::move(points)) {
  own_.reserve(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) own_.push_back(table_.approximate(PointId{i}));
  approximate_ = own_;
  find_margins({});
}

// Half a unit in the last place is 2^-53 relative or 2^-1075, so the margins that follow from PointTable's doubles do.
MeshPoints MeshPoints::near(std::vector<std::array<double, 3>> doubles) {
  MeshPoints points;
  points.own_ = std::move(doubles);
  points.approximate_ = points.own_;
  points.only_doubles_ = true;
  points.find_margins({});
  return points;
}

MeshPoints::MeshPoints(const PointTable& table, std::span<const PointId> places,
                       std::span<const std::array<double, 3>> doubles, std::span<const std::uint32_t> asked)
    : approximate_(doubles), other_table_(&table), places_(places) {
  are_integers_ = find_denominator(asked) && scale_to_integers(doubles, asked);
  if (!are_integers_) {
    denominator_ = 1;
    own_.clear();
    approximate_ = doubles;
  }
  find_margins(asked);
}

// False if the common denominator becomes too large with one more.
bool MeshPoints::enlarge_denominator(std::int64_t more) {
  const std::int64_t missing = more / common_divisor(more, denominator_);
  if (missing >= kIntegerLimit || static_cast<Int128>(denominator_) * missing >= kIntegerLimit) return false;
  denominator_ *= missing;
  return true;
}

// The least common denominator. Most points have the denominator of the one before, or one that divides what is known
// of the common one; else the quotients are taken to lowest terms.
bool MeshPoints::find_denominator(std::span<const std::uint32_t> asked) {
  const std::size_t count = asked.empty() ? places_.size() : asked.size();
  std::int64_t last = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const PointId place = places_[asked.empty() ? i : asked[i]];
    Small h;
    if (!other_table_->small_coordinates(place, h)) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!enlarge_denominator(reduced_denominator(*other_table_, place, axis))) return false;
      }
      continue;
    }
    const std::int64_t w = h[3];
    if (w == last) continue;
    if (denominator_ % w == 0) {
      last = w;
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t rest = h[axis] % w;
      if (rest != 0 && !enlarge_denominator(w / common_divisor(w, rest))) return false;
    }
    // Others with the same denominator need not be multiples.
  }
  return true;
}

// x D is an integer, and the double near x is off by 2^-51 of it at most: below 2^40, the product with D is off by less
// than half, and one that is not is found to be too large. A vertex may be asked twice, so what is scaled is never read
// again.
bool MeshPoints::scale_to_integers(std::span<const std::array<double, 3>> doubles,
                                   std::span<const std::uint32_t> asked) {
  const auto factor = static_cast<double>(denominator_);
  const std::size_t count = asked.empty() ? places_.size() : asked.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = asked.empty() ? i : asked[i];
    std::array<double, 3> scaled = doubles[p];
    for (double& x : scaled) {
      x *= factor;
      if (!(std::abs(x) < static_cast<double>(kIntegerLimit) - 1)) return false;
      x = static_cast<double>(static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5)));
    }
    if (own_.empty()) {
      if (scaled == doubles[p]) continue;
      own_.assign(doubles.begin(), doubles.end());
      approximate_ = own_;
    }
    own_[p] = scaled;
  }
  return true;
}

namespace {

// Of some points; 0 if it is not below the limit.
std::int64_t common_denominator(std::span<const Rational3> points) {
  std::int64_t denominator = 1;
  for (const Rational3& point : points) {
    for (const Rational& x : point) {
      const mpz_srcptr den = x.get_den_mpz_t();
      if (mpz_size(den) != 1 || mpz_getlimbn(den, 0) >= static_cast<mp_limb_t>(kIntegerLimit)) return 0;
      const auto d = static_cast<std::int64_t>(mpz_getlimbn(den, 0));
      if (d == 1 || d == denominator || denominator % d == 0) continue;
      const Int128 common = static_cast<Int128>(denominator / std::gcd(denominator, d)) * d;
      if (common >= kIntegerLimit) return 0;
      denominator = static_cast<std::int64_t>(common);
    }
  }
  return denominator;
}

// Times a multiple of its denominator; nothing if that is not below the limit.
std::optional<double> integer_of(const Rational& x, std::int64_t denominator) {
  const mpz_srcptr num = x.get_num_mpz_t();
  if (mpz_size(num) > 1) return std::nullopt;
  const auto den = static_cast<std::int64_t>(mpz_getlimbn(x.get_den_mpz_t(), 0));
  const Unsigned128 scaled = static_cast<Unsigned128>(mpz_getlimbn(num, 0)) *
                             static_cast<std::uint64_t>(den == denominator ? 1 : denominator / den);
  if (scaled >= static_cast<Unsigned128>(kIntegerLimit)) return std::nullopt;
  const auto size = static_cast<double>(static_cast<std::int64_t>(scaled));
  return mpz_sgn(num) < 0 ? -size : size;
}

}  // namespace

// Below 2^40 every integer is a double.
bool MeshPoints::make_integers(std::span<const Rational3> points, const Monitor& monitor) {
  constexpr std::size_t kBlock = 8192;
  const std::vector<std::int64_t> of_blocks =
      blocks_of(points.size(), kBlock, monitor, [&](std::size_t first, std::size_t last, const Monitor&) {
        return common_denominator(points.subspan(first, last - first));
      });
  const bool is_small = std::all_of(of_blocks.begin(), of_blocks.end(),
                                    [this](std::int64_t each) { return each != 0 && enlarge_denominator(each); });
  std::atomic<bool> fits = is_small;
  if (is_small) {
    own_ = vector_of(points.size(), monitor, [&](std::size_t i) {
      std::array<double, 3> result{};
      for (std::size_t axis = 0; axis < 3 && fits; ++axis) {
        const std::optional<double> x = integer_of(points[i][axis], denominator_);
        if (!x) fits = false;
        result[axis] = x.value_or(0);
      }
      return result;
    });
  }
  if (!fits) {
    own_.clear();
    denominator_ = 1;
  }
  are_integers_ = fits;
  return fits;
}

// PointTable promises doubles within 2^-51 relative, and within 2^-1074 below 2^-1022; the margin is twice the first
// and far above the second. Filters of meshes multiply up to four differences and add up to 48 such products: below
// 1e75 these are below 48 (2e75)^4 < 1e304, so nothing overflows. Beyond, no filter is asked; beyond 1e300 nothing is
// known of boxes either.
void MeshPoints::find_margins(std::span<const std::uint32_t> asked) {
  std::array<double, 3> largest{};
  const std::size_t count = asked.empty() ? approximate_.size() : asked.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 3>& p = approximate_[asked.empty() ? i : asked[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) largest[axis] = std::max(largest[axis], std::abs(p[axis]));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!kFastPaths || !(largest[axis] < kModerate)) filter_ = false;
    margin_[axis] = are_integers_ ? 0.0 : largest[axis] * 0x1p-50 + 1e-290;
    if (!(largest[axis] < 1e300)) margin_[axis] = HUGE_VAL;
  }
}

void MeshPoints::extend(Box& box, std::uint32_t p) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (margin_[axis] == HUGE_VAL) {
      box.low[axis] = -HUGE_VAL;
      box.high[axis] = HUGE_VAL;
      continue;
    }
    box.low[axis] = std::min(box.low[axis], approximate_[p][axis] - margin_[axis]);
    box.high[axis] = std::max(box.high[axis], approximate_[p][axis] + margin_[axis]);
  }
}

// The filter. Let s be the largest computed difference along an axis, m the margin of a coordinate and u = 2^-53. A
// computed difference is off by at most e = 2m + u s', s' = s + 2m + u s' being a bound on the true and the
// computed one. The determinant is a sum of six products x y z of differences, so the inexact inputs change it by at
// most 6 (ex sy sz + sx ey sz + sx sy ez) up to terms of second order, for which 7 instead of 6 is more than enough;
// its own evaluation rounds each product at most eight times: 48 u sx sy sz. A product of two that underflows is off by
// 2^-1075 and is multiplied by less than 2e75, so underflow adds less than 1e-240.
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

int MeshPoints::orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                            const Monitor& monitor) const {
  return sign_by_ladder(determinant(a, b, c, d), monitor, [&] { return orientation_exact(a, b, c, d); });
}

int MeshPoints::orientation_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  if (are_integers_) {
    const std::array<std::int64_t, 3> origin = integers(a);
    const std::array<std::array<std::int64_t, 3>, 3> to{integers(b), integers(c), integers(d)};
    std::array<std::array<Int128, 3>, 3> m;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) m[k][i] = to[k][i] - origin[i];
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
    if (are_integers_) {
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

int MeshPoints::orientation_along(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis,
                                  const Monitor& monitor) const {
  return sign_by_ladder(component(a, b, c, axis), monitor, [&] { return orientation_along_exact(a, b, c, axis); });
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
  if (are_integers_) {
    const std::array<std::int64_t, 3> p = integers(a);
    const std::array<std::int64_t, 3> q = integers(b);
    const std::array<std::int64_t, 3> r = integers(c);
    return sign_of(static_cast<Int128>(q[i] - p[i]) * (r[j] - p[j]) - static_cast<Int128>(r[i] - p[i]) * (q[j] - p[j]));
  }
  require_numbers();
  if (Small p{}, q{}, r{}; read_small(a, p) && read_small(b, q) && read_small(c, r)) {
    return orientation_along(p, q, r, axis);
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

bool MeshPoints::collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Monitor& monitor) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (component(a, b, c, axis).sign().value_or(0) == 0) continue;
    monitor.count_filter();
    return false;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (orientation_along(a, b, c, axis, monitor) != 0) return false;
  }
  return true;
}

std::size_t MeshPoints::projection_axis(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                        const Monitor& monitor) const {
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
    if (orientation_along(a, b, c, axis, monitor) != 0) return axis;
  }
  return order[0];
}

int MeshPoints::orientation_along(const Small& a, const Small& b, const Small& c, std::size_t axis) {
  const std::size_t i = axis == 2 ? 0 : axis + 1;
  const std::size_t j = i == 2 ? 0 : i + 1;
  return compare_products(short_difference(a, b, i), short_difference(a, c, j), short_difference(a, c, i),
                          short_difference(a, b, j));
}

int MeshPoints::compare(const Small& a, const Small& b, std::size_t axis) {
  return sign_of(short_difference(b, a, axis));
}

bool MeshPoints::read_small(std::uint32_t p, Small& out) const {
  return kFastPaths && !are_integers_ && !only_doubles_ && source().small_coordinates(place(p), out);
}

int MeshPoints::compare_exact(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
  if (Small p{}, q{}; read_small(a, p) && read_small(b, q)) return compare(p, q, axis);
  Integer gap;
  difference(b, a, std::span(&gap, 1), axis);
  return sgn(gap);
}

int MeshPoints::compare(std::uint32_t a, std::uint32_t b) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (const int order = compare(a, b, axis); order != 0) return order;
  }
  return 0;
}

}  // namespace nef
