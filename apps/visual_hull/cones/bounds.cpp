// SPDX-License-Identifier: Apache-2.0
//
// Each side of the box is the optimum of a linear program in three unknowns. Seidel's incremental algorithm [Seidel
// 1991] solves it in doubles; then the few constraints that are nearly tight at its answer are tried three by three in
// rationals: their common point is the optimum if the objective is a combination of their normals with factors that are
// not negative (duality) and all other constraints allow the point. If no triple passes, the program is solved in
// rationals. Every unknown is bounded by a limit far beyond the numbers of a scene; an optimum near that limit means
// that the scene is unbounded.
#include "apps/visual_hull/cones/bounds.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/visual_hull/scene/camera_planes.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/geometry/monotone_chain.h"
#include "nef/number/floor.h"

namespace nef::visual_hull {
namespace {

// Beyond the numbers of a scene, in bits; what lies beyond the half of it is unbounded.
constexpr unsigned kLimitBits = 210;
constexpr double kLimit = 0x1p210;
constexpr std::size_t kMostBits = 400;  // of coefficients: with a point beyond the limit their products are doubles
static_assert(kLimit / 2 > kLargestNumber);

/// a . x <= b.
template <typename Number>
struct Constraint {
  std::vector<Number> a;
  Number b{};
};

template <typename Number>
using Optimum = std::optional<std::vector<Number>>;

int sign_of(const Rational& x) { return sgn(x); }
int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
Rational size_of(const Rational& x) { return abs(x); }
double size_of(double x) { return std::abs(x); }

// The largest objective * x of one unknown under all constraints.
template <typename Number>
Optimum<Number> solve_line(const std::vector<Constraint<Number>>& constraints, const Number& objective,
                           const Number& limit) {
  Number low = -limit;
  Number high = limit;
  for (const Constraint<Number>& c : constraints) {
    const int sign = sign_of(c.a[0]);
    if (sign == 0) {
      if (sign_of(c.b) < 0) return std::nullopt;
      continue;
    }
    const Number bound = c.b / c.a[0];
    if (sign > 0 && bound < high) high = bound;
    if (sign < 0 && bound > low) low = bound;
  }
  if (low > high) return std::nullopt;
  return std::vector<Number>{sign_of(objective) < 0 ? low : high};
}

// [Seidel 1991]: keep the optimum of the first i
// constraints; if the next one cuts it off, the new optimum is on its plane, a problem with one unknown less. Every
// unknown is also within [-limit, limit].
template <typename Number>
Optimum<Number> solve(const std::vector<Constraint<Number>>& constraints, const std::vector<Number>& objective,
                      const Number& limit) {
  const std::size_t dimension = objective.size();
  if (dimension == 1) return solve_line(constraints, objective[0], limit);
  std::vector<Number> best(dimension);
  for (std::size_t i = 0; i < dimension; ++i) best[i] = sign_of(objective[i]) < 0 ? Number(-limit) : limit;
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const Constraint<Number>& tight = constraints[k];
    Number value = -tight.b;
    for (std::size_t i = 0; i < dimension; ++i) value += tight.a[i] * best[i];
    if (sign_of(value) <= 0) continue;
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < dimension; ++i) {
      if (size_of(tight.a[i]) > size_of(tight.a[pivot])) pivot = i;
    }
    if (sign_of(tight.a[pivot]) == 0) return std::nullopt;  // 0 <= b with b < 0
    // x_pivot = constant - sum of ratio_i x_i.
    const Number constant = tight.b / tight.a[pivot];
    std::vector<Number> ratio;
    std::vector<Number> reduced_objective;
    for (std::size_t i = 0; i < dimension; ++i) {
      if (i == pivot) continue;
      ratio.push_back(tight.a[i] / tight.a[pivot]);
      reduced_objective.push_back(objective[i] - objective[pivot] * ratio.back());
    }
    const auto reduce = [&](const std::vector<Number>& a, const Number& b) {
      Constraint<Number> c;
      for (std::size_t i = 0, j = 0; i < dimension; ++i) {
        if (i != pivot) c.a.push_back(a[i] - a[pivot] * ratio[j++]);
      }
      c.b = b - a[pivot] * constant;
      return c;
    };
    std::vector<Constraint<Number>> reduced;
    for (const int sign : {1, -1}) {  // the pivot's own limits
      std::vector<Number> a(dimension);
      a[pivot] = sign;
      reduced.push_back(reduce(a, limit));
    }
    for (std::size_t i = 0; i < k; ++i) reduced.push_back(reduce(constraints[i].a, constraints[i].b));
    const Optimum<Number> lower = solve(reduced, reduced_objective, limit);
    if (!lower) return std::nullopt;
    best[pivot] = constant;
    for (std::size_t i = 0, j = 0; i < dimension; ++i) {
      if (i == pivot) continue;
      best[i] = (*lower)[j];
      best[pivot] -= ratio[j] * (*lower)[j];
      ++j;
    }
  }
  return best;
}

// Doubles find the optimum, rationals prove it.
class ProvenOptimum {
 public:
  explicit ProvenOptimum(const std::vector<Constraint<Rational>>& exact) : exact_(exact) {
    for (const Constraint<Rational>& c : exact) {
      Constraint<double> rounded;
      double length = 0;
      for (const Rational& x : c.a) {
        rounded.a.push_back(nef::nearest_double(x));
        length += rounded.a.back() * rounded.a.back();
      }
      length = std::sqrt(length);
      for (double& x : rounded.a) x /= length;
      rounded.b = nef::nearest_double(c.b) / length;
      rounded_.push_back(std::move(rounded));
    }
  }

  /// The largest sign * x[axis] under all constraints, as x[axis]; nothing where doubles do not find it.
  [[nodiscard]] std::optional<Rational> operator()(std::size_t axis, int sign) const {
    std::vector<double> objective(3);
    objective[axis] = sign;
    const Optimum<double> found = solve(rounded_, objective, kLimit);
    if (!found || !(std::abs((*found)[axis]) < kLimit / 2)) return std::nullopt;
    // The constraints that are tight there, or nearly.
    std::vector<std::pair<double, std::size_t>> slack;
    for (std::size_t k = 0; k < rounded_.size(); ++k) {
      double rest = rounded_[k].b;
      for (std::size_t i = 0; i < 3; ++i) rest -= rounded_[k].a[i] * (*found)[i];
      slack.emplace_back(std::abs(rest), k);
    }
    const std::size_t near = std::min(kNear, slack.size());
    std::partial_sort(slack.begin(), slack.begin() + static_cast<std::ptrdiff_t>(near), slack.end());
    for (std::size_t a = 0; a < near; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        for (std::size_t c = 0; c < b; ++c) {
          if (const auto x = vertex({slack[a].second, slack[b].second, slack[c].second}, axis, sign)) {
            return (*x)[axis];
          }
        }
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kNear = 5;

  // Where three planes meet, if that is the optimum: the objective is a combination of their normals without negative
  // factors (so no point that they allow is better), and all constraints allow it.
  [[nodiscard]] std::optional<Rational3> vertex(const std::array<std::size_t, 3>& k, std::size_t axis, int sign) const {
    const auto& p = exact_[k[0]].a;
    const auto& q = exact_[k[1]].a;
    const auto& r = exact_[k[2]].a;
    const auto cross = [](const std::vector<Rational>& u, const std::vector<Rational>& v) {
      return Rational3{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    };
    const Rational3 qr = cross(q, r);
    const Rational3 rp = cross(r, p);
    const Rational3 pq = cross(p, q);
    const Rational determinant = p[0] * qr[0] + p[1] * qr[1] + p[2] * qr[2];
    const int orientation = sgn(determinant);
    if (orientation == 0) return std::nullopt;
    for (const Rational3* dual : {&qr, &rp, &pq}) {
      if (sgn((*dual)[axis]) * orientation * sign < 0) return std::nullopt;
    }
    Rational3 x;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = (exact_[k[0]].b * qr[i] + exact_[k[1]].b * rp[i] + exact_[k[2]].b * pq[i]) / determinant;
    }
    return allowed(x) ? std::optional(x) : std::nullopt;
  }

  // Rounded constraints first: most are far from tight.
  [[nodiscard]] bool allowed(const Rational3& x) const {
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = nef::nearest_double(x[i]);
    for (std::size_t k = 0; k < rounded_.size(); ++k) {
      double rest = rounded_[k].b;
      double size = std::abs(rest);
      for (std::size_t i = 0; i < 3; ++i) {
        rest -= rounded_[k].a[i] * at[i];
        size += std::abs(rounded_[k].a[i] * at[i]);
      }
      // Rounded are each coefficient (twice, and the length once more), the coordinates, products and sums: less than
      // 16 roundings of 2^-53 on each term. What vanishes is 2^-1074, times at most kLimit.
      if (rest > size * 0x1p-48 + 1e-250) continue;
      Rational exact = exact_[k].b;
      for (std::size_t i = 0; i < 3; ++i) exact -= exact_[k].a[i] * x[i];
      if (sgn(exact) < 0) return false;
    }
    return true;
  }

  const std::vector<Constraint<Rational>>& exact_;
  std::vector<Constraint<double>> rounded_;
};

}  // namespace

std::vector<HalfSpace> convex_cone(const Camera& camera, const Silhouette& silhouette, const nef::Monitor& monitor) {
  Ring points;
  for (const Ring& ring : silhouette.rings) points.insert(points.end(), ring.begin(), ring.end());
  std::sort(points.begin(), points.end(), lexicographically_less);
  const auto left_turn = [&monitor](const Point2& a, const Point2& b, const Point2& c) {
    return orientation(a, b, c, monitor) > 0;
  };
  const Ring hull = nef::convex_hull_of_sorted(std::move(points), left_turn);
  std::vector<HalfSpace> result;
  const CameraPlanes planes(camera);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::array<Integer, 4> plane = planes.through(hull[i], hull[(i + 1) % hull.size()]);
    result.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
    // Within the range of doubles.
    std::size_t bits = 0;
    for (const Integer& value : plane) bits = std::max(bits, mpz_sizeinbase(value.get_mpz_t(), 2));
    if (bits <= kMostBits) continue;
    HalfSpace& scaled = result.back();
    for (Rational* value : {&scaled.normal[0], &scaled.normal[1], &scaled.normal[2], &scaled.offset}) {
      mpq_div_2exp(value->get_mpq_t(), value->get_mpq_t(), bits - kMostBits);
    }
  }
  return result;
}

Bounds bounds_of(const std::vector<HalfSpace>& half_spaces) {
  std::vector<Constraint<Rational>> constraints;
  for (const HalfSpace& h : half_spaces) {
    constraints.push_back({{-h.normal[0], -h.normal[1], -h.normal[2]}, h.offset});
  }
  std::shuffle(constraints.begin(), constraints.end(), std::mt19937_64(12345));  // a fixed seed: the answer is exact
  const ProvenOptimum proven(constraints);
  const Rational limit(Integer(1) << kLimitBits);
  Bounds result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      Rational& side = (sign < 0 ? result.box.low : result.box.high)[axis];
      if (const std::optional<Rational> best = proven(axis, sign)) {
        side = *best;
        continue;
      }
      std::vector<Rational> objective(3);
      objective[axis] = sign;
      const Optimum<Rational> best = solve(constraints, objective, limit);
      if (!best) {
        result.kind = Bounds::Kind::kEmpty;
        return result;
      }
      // An optimum beyond half of the limit is the limit's, not the scene's.
      if (abs((*best)[axis]) * 2 > limit) result.kind = Bounds::Kind::kUnbounded;
      side = (*best)[axis];
    }
  }
  return result;
}

WorldBox loosen(const WorldBox& box) {
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) size = std::max(size, nef::nearest_double(Rational(box.high[i] - box.low[i])));
  if (size == 0) size = 1;
  // A step of a power of ten, so that the box reads well: between 1/1000 and 1/100 of the size.
  const int exponent = static_cast<int>(std::floor(std::log10(size))) - 2;
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  const Rational step = exponent < 0 ? Rational(1, power) : Rational(power);
  WorldBox result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = Rational(nef::floor_of(Rational(box.low[i] / step)) - 1) * step;
    result.high[i] = Rational(nef::ceiling_of(Rational(box.high[i] / step)) + 1) * step;
  }
  return result;
}

}  // namespace nef::visual_hull
