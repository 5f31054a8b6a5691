// SPDX-License-Identifier: Apache-2.0
//
// A part in which a product, or its derivative, has one sign, by bounds of the Bernstein polynomials and of z, has no
// zero, or one at most, which its signs at both ends tell; others are halved. A single zero is halved on by the sign in
// the middle.
#include "apps/planner/mechanism/screw_contact.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

constexpr unsigned kRootBits = 64;      // of what encloses a zero
constexpr unsigned kShareBits = 80;     // of z in bounds
constexpr unsigned kSpareBits = 14;     // for the roundings of z, fewer than 2^12 units
constexpr unsigned kMostHalvings = 60;  // of parts of which nothing is known

// Integers that are real numbers times 2^bits, rounded down and up.
struct Scaled {
  Integer low;
  Integer high;
};

Integer shifted(const Integer& x, unsigned bits) {
  Integer result;
  mpz_mul_2exp(result.get_mpz_t(), x.get_mpz_t(), bits);
  return result;
}

Integer quotient(const Integer& a, const Integer& b, bool up) {
  Integer result;
  (up ? mpz_cdiv_q : mpz_fdiv_q)(result.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return result;
}

// atan(x) for 0 <= x <= 1/2: the sum of (-1)^i x^(2 i + 1) / (2 i + 1), whose terms fall, so that two sums in a row
// enclose it. Powers are rounded down; 2 i + 2 roundings of at most one unit each are in the i-th power.
Scaled arc_tangent(const Rational& x, unsigned bits) {
  const Rational square = x * x;
  Integer power = quotient(shifted(x.get_num(), bits), x.get_den(), false);
  Integer sum = 0;
  Integer slack = 0;
  for (unsigned i = 0;; ++i) {
    const Integer term = power / (2 * i + 1);
    slack += 2;  // the power is off by less than 2 (square < 1/2), and so is the term; one more for the division
    if (i % 2 == 0) {
      sum += term;
    } else {
      sum -= term;
    }
    if (term == 0) break;  // what is left is less than this term and its error
    power = quotient(power * square.get_num(), square.get_den(), false);
  }
  return {sum - slack - 2, sum + slack + 2};
}

// pi / 4 = 4 atan(1/5) - atan(1/239) (Machin).
Scaled quarter_of_pi(unsigned bits) {
  const Scaled a = arc_tangent(Rational(1, 5), bits);
  const Scaled b = arc_tangent(Rational(1, 239), bits);
  return {4 * a.low - b.high, 4 * a.high - b.low};
}

Rational scaled_down(const Integer& x, unsigned bits) {
  Rational result(x);
  mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), bits);
  return result;
}

using RationalBounds = std::array<Rational, 2>;
using Form = std::array<Rational, 3>;  // Bernstein values

// A product over a part of its part.
struct ProductPiece {
  Form still;
  Form along;
  Rational from;  // turns
  Rational to;
  RationalBounds z;
};

RationalBounds bounds_of(const Form& f, std::size_t count = 3) {
  const auto [low, high] = std::minmax_element(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(count));
  return {*low, *high};
}

// The bounds of x y, of which x is in some bounds and y in others.
RationalBounds product_of(const RationalBounds& x, const RationalBounds& y) {
  const auto [low, high] =
      std::minmax({Rational(x[0] * y[0]), Rational(x[0] * y[1]), Rational(x[1] * y[0]), Rational(x[1] * y[1])});
  return {low, high};
}

bool has_zero(const RationalBounds& b) { return b[0] <= 0 && b[1] >= 0; }

// Bounds of still + z along for the first `count` values.
RationalBounds bounds_of(const Form& still, const Form& along, const RationalBounds& z, std::size_t count) {
  Form low;
  Form high;
  for (std::size_t i = 0; i < count; ++i) {
    const RationalBounds b = product_of({along[i], along[i]}, z);
    low[i] = still[i] + b[0];
    high[i] = still[i] + b[1];
  }
  return {bounds_of(low, count)[0], bounds_of(high, count)[1]};
}

// The derivative by u: still' + z along' + z' along, z' = 4/pi (to - from) / (1 + t^2).
bool is_monotone(const ProductPiece& p) {
  Form still;
  Form along;
  for (std::size_t i = 0; i < 2; ++i) {
    still[i] = 2 * (p.still[i + 1] - p.still[i]);
    along[i] = 2 * (p.along[i + 1] - p.along[i]);
  }
  RationalBounds sum = bounds_of(still, along, p.z, 2);
  const RationalBounds four_by_pi{Rational(1273, 1000), Rational(637, 500)};
  const Integer quarter = floor_of(p.from);
  const Rational begin = p.from - quarter;
  const Rational end = p.to - quarter;
  const Rational way = p.to - p.from;
  const RationalBounds speed{four_by_pi[0] * way / (1 + end * end), four_by_pi[1] * way / (1 + begin * begin)};
  const RationalBounds moved = product_of(speed, bounds_of(p.along));
  return !has_zero({sum[0] + moved[0], sum[1] + moved[1]});
}

std::array<Form, 2> halves(const Form& f) {
  const Rational a = (f[0] + f[1]) / 2;
  const Rational b = (f[1] + f[2]) / 2;
  const Rational middle = (a + b) / 2;
  return {Form{f[0], a, middle}, Form{middle, b, f[2]}};
}

RationalBounds quarters_of(const Rational& turn) { return quarters(turn, kShareBits); }

std::array<ProductPiece, 2> halves(const ProductPiece& p) {
  const auto still = halves(p.still);
  const auto along = halves(p.along);
  const Rational middle = (p.from + p.to) / 2;
  const RationalBounds z = quarters_of(middle);
  return {ProductPiece{still[0], along[0], p.from, middle, {p.z[0], z[1]}},
          ProductPiece{still[1], along[1], middle, p.to, {z[0], p.z[1]}}};
}

// Of still + z along at a turn.
int sign_at(const Rational& still, const Rational& along, const Rational& turn) {
  if (along == 0) return sgn(still);
  for (unsigned bits = kShareBits;; bits *= 2) {
    const RationalBounds z = quarters(turn, bits);
    const int low = sgn(Rational(still + z[0] * along));
    if (low == sgn(Rational(still + z[1] * along))) return low;
  }
}

int sign_at_begin(const ProductPiece& p) { return sign_at(p.still[0], p.along[0], p.from); }
int sign_at_end(const ProductPiece& p) { return sign_at(p.still[2], p.along[2], p.to); }

class RootSearch {
 public:
  std::vector<ScrewRoot> run(const ProductPiece& whole) {
    if (sign_at_begin(whole) == 0) roots_.push_back({whole.from, whole.from, {}, {}, true});
    search(whole, 0);
    return std::move(roots_);
  }

 private:
  // Zeros in the piece without its beginning.
  void search(const ProductPiece& p, unsigned depth) {
    if (!has_zero(bounds_of(p.still, p.along, p.z, 3))) return;
    if (is_monotone(p)) return narrow(p);
    if (depth == kMostHalvings) {
      roots_.push_back({p.from, p.to, {}, {}, false});
      return;
    }
    for (const ProductPiece& half : halves(p)) search(half, depth + 1);
  }

  void narrow(ProductPiece p) {
    const int begin = sign_at_begin(p);
    const int end = sign_at_end(p);
    if (end == 0) {
      roots_.push_back({p.to, p.to, {}, {}, true});
      return;
    }
    if (begin == 0 || begin == end) return;
    const Rational narrow = scaled_down(1, kRootBits);
    while (p.to - p.from > narrow) {
      auto parts = halves(p);
      const int middle = sign_at_end(parts[0]);
      if (middle == 0) {
        roots_.push_back({parts[0].to, parts[0].to, {}, {}, true});
        return;
      }
      p = middle == begin ? std::move(parts[1]) : std::move(parts[0]);
    }
    roots_.push_back({p.from, p.to, {}, {}, true});
  }

  std::vector<ScrewRoot> roots_;
};

// A quadratic polynomial at a turn.
Surd value_at(const Form& form, const ScrewPart& part, const QuadraticRoot& turn) {
  const Surd u = (Surd::of(turn) - Surd(part.from)) / Surd(Rational(part.to - part.from));
  const Surd v = Surd(1) - u;
  return v * v * Surd(form[0]) + Surd(2) * u * v * Surd(form[1]) + u * u * Surd(form[2]);
}

bool is_zero_form(const Form& form) {
  return std::all_of(form.begin(), form.end(), [](const Rational& x) { return x == 0; });
}

bool is_inside(const QuadraticRoot& turn, const ScrewRoot& root) {
  return compare(turn, root.low) >= 0 && compare(turn, root.high) <= 0;
}

// The common zeros of P and Q in the part.
std::vector<QuadraticRoot> common_zeros(const ScrewProduct& product, const ScrewPart& part) {
  const bool is_still = is_zero_form(product.along);
  const Form& b = is_still ? product.still : product.along;
  std::vector<QuadraticRoot> result;
  for (const QuadraticRoot& u : roots_in_unit_interval({b[0], 2 * (b[1] - b[0]), b[0] - 2 * b[1] + b[2]})) {
    const QuadraticRoot turn = moved(u, part.from, part.to - part.from);
    if (is_still || value_at(product.still, part, turn).sign() == 0) result.push_back(turn);
  }
  return result;
}

// The coefficients of the product of two quadratic polynomials, in the Bernstein polynomials of degree 4, times 6.
std::array<Rational, 5> multiplied(const Form& a, const Form& b) {
  return {6 * a[0] * b[0], 3 * (a[0] * b[1] + a[1] * b[0]), a[0] * b[2] + 4 * a[1] * b[1] + a[2] * b[0],
          3 * (a[1] * b[2] + a[2] * b[1]), 6 * a[2] * b[2]};
}

// The zeros of a product that does not depend on the way of the screw.
std::vector<ScrewRoot> roots_without_way(const ScrewProduct& product, const ScrewPart& part) {
  std::vector<ScrewRoot> roots;
  const std::array<ExactTurn, 5> known = exact_turns(floor_of(part.from));
  for (const QuadraticRoot& turn : common_zeros(product, part)) {
    const std::array<Rational, 2> bounds = enclosure(turn, kRootBits);
    ScrewRoot root{std::max(bounds[0], part.from), std::min(bounds[1], part.to), {}, turn, true};
    if (std::any_of(known.begin(), known.end(), [&](const ExactTurn& at) { return compare(at.turn, turn) == 0; })) {
      root.exact = turn;
    }
    roots.push_back(std::move(root));
  }
  return roots;
}

}  // namespace

std::array<Rational, 2> quarter_share(const Rational& half_tangent, unsigned bits) {
  NEF_ASSERT(half_tangent >= 0 && half_tangent <= 1);
  if (half_tangent == 0 || half_tangent == 1) return {half_tangent, half_tangent};
  // 1 - 4/pi atan((1 - t) / (1 + t)) is the same; the fraction is below 1/2 if t is above 1/3.
  const bool turned = half_tangent > Rational(1, 2);
  const Rational x = turned ? Rational((1 - half_tangent) / (1 + half_tangent)) : half_tangent;
  const unsigned more = bits + kSpareBits;
  const Scaled angle = arc_tangent(x, more);
  static const Scaled kUsual = quarter_of_pi(kShareBits + kSpareBits);
  const Scaled unit = bits == kShareBits ? kUsual : quarter_of_pi(more);
  const Rational low = scaled_down(quotient(shifted(angle.low, more), unit.high, false), more);
  const Rational high = scaled_down(quotient(shifted(angle.high, more), unit.low, true), more);
  if (turned) return {1 - high, 1 - low};
  return {low, high};
}

std::array<Rational, 2> quarters(const Rational& turn, unsigned bits) {
  const Integer quarter = floor_of(turn);
  const std::array<Rational, 2> share = quarter_share(turn - quarter, bits);
  return {quarter + share[0], quarter + share[1]};
}

std::array<ExactTurn, 5> exact_turns(const Integer& quarter) {
  const auto at = [&](const Rational& rational, const Rational& square, int sign, const Rational& share) {
    QuadraticRoot turn(quarter + rational);
    turn.square = square;
    turn.sign = sign;
    return ExactTurn{turn, quarter + share};
  };
  // tan 15 = 2 - sqrt 3, tan 22.5 = sqrt 2 - 1, tan 30 = sqrt(1/3).
  return {at(0, 0, 0, 0), at(2, 3, -1, Rational(1, 3)), at(-1, 2, 1, Rational(1, 2)),
          at(0, Rational(1, 3), 1, Rational(2, 3)), at(1, 0, 0, 1)};
}

bool ScrewProduct::vanishes() const { return is_zero_form(still) && is_zero_form(along); }

std::array<Rational, 6> ScrewProduct::normalized() const {
  std::array<Rational, 6> result{still[0], still[1], still[2], along[0], along[1], along[2]};
  const auto first = std::find_if(result.begin(), result.end(), [](const Rational& x) { return x != 0; });
  const Rational divisor = first == result.end() ? Rational(1) : *first;
  for (Rational& x : result) x /= divisor;
  return result;
}

std::vector<ScrewRoot> roots_of(const ScrewProduct& product, const ScrewPart& part) {
  if (is_zero_form(product.along)) return roots_without_way(product, part);
  const RationalBounds begin = quarters_of(part.from);
  const RationalBounds end = quarters_of(part.to);
  std::vector<ScrewRoot> roots =
      RootSearch().run({product.still, product.along, part.from, part.to, {begin[0], end[1]}});
  for (const ExactTurn& at : exact_turns(floor_of(part.from))) {
    for (ScrewRoot& root : roots) {
      if (!root.single || !is_inside(at.turn, root)) continue;
      Form form;
      for (std::size_t i = 0; i < 3; ++i) form[i] = product.still[i] + at.quarters * product.along[i];
      if (value_at(form, part, at.turn).sign() == 0) root.exact = at.turn;
    }
  }
  for (const QuadraticRoot& turn : common_zeros(product, part)) {
    for (ScrewRoot& root : roots) {
      if (root.single && is_inside(turn, root)) root.algebraic = turn;
    }
  }
  return roots;
}

bool have_equal_quotients(const ScrewProduct& a, const ScrewProduct& b) {
  return multiplied(a.still, b.along) == multiplied(b.still, a.along);
}

std::optional<int> sign_over(const ScrewProduct& product, const ScrewPart& part, const Rational& turn,
                             const std::array<Rational, 2>& quarters) {
  const Rational u = (turn - part.from) / (part.to - part.from);
  const Rational v = 1 - u;
  const auto value = [&](const Form& f) { return Rational(v * v * f[0] + 2 * u * v * f[1] + u * u * f[2]); };
  const Rational still = value(product.still);
  const Rational along = value(product.along);
  const int low = sgn(Rational(still + quarters[0] * along));
  if (low != sgn(Rational(still + quarters[1] * along))) return std::nullopt;
  return low;
}

}  // namespace nef::planner
