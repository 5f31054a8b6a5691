// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/bounds.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace visual_hull {
namespace {

/// a . x <= b.
struct Constraint {
  std::vector<Rational> a;
  Rational b;
};

using Optimum = std::optional<std::vector<Rational>>;

// The largest objective * x of one unknown under all constraints.
Optimum solve_line(const std::vector<Constraint>& constraints, const Rational& objective, const Rational& limit) {
  Rational low = -limit;
  Rational high = limit;
  for (const Constraint& c : constraints) {
    const int sign = sgn(c.a[0]);
    if (sign == 0) {
      if (sgn(c.b) < 0) return std::nullopt;
      continue;
    }
    const Rational bound = c.b / c.a[0];
    if (sign > 0 && bound < high) high = bound;
    if (sign < 0 && bound > low) low = bound;
  }
  if (low > high) return std::nullopt;
  return std::vector<Rational>{sgn(objective) < 0 ? low : high};
}

// Seidel: keep the optimum of the first i constraints; if the next one cuts it off, the new optimum is
// on its plane, a problem with one unknown less. Every unknown is also within [-limit, limit].
Optimum solve(const std::vector<Constraint>& constraints, const std::vector<Rational>& objective,
              const Rational& limit) {
  const std::size_t dimension = objective.size();
  if (dimension == 1) return solve_line(constraints, objective[0], limit);
  std::vector<Rational> best(dimension);
  for (std::size_t i = 0; i < dimension; ++i) best[i] = sgn(objective[i]) < 0 ? Rational(-limit) : limit;
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const Constraint& tight = constraints[k];
    Rational value = -tight.b;
    for (std::size_t i = 0; i < dimension; ++i) value += tight.a[i] * best[i];
    if (sgn(value) <= 0) continue;
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < dimension; ++i) {
      if (abs(tight.a[i]) > abs(tight.a[pivot])) pivot = i;
    }
    if (sgn(tight.a[pivot]) == 0) return std::nullopt;  // 0 <= b with b < 0
    // x_pivot = constant - sum of ratio_i x_i.
    const Rational constant = tight.b / tight.a[pivot];
    std::vector<Rational> ratio;
    std::vector<Rational> reduced_objective;
    for (std::size_t i = 0; i < dimension; ++i) {
      if (i == pivot) continue;
      ratio.push_back(tight.a[i] / tight.a[pivot]);
      reduced_objective.push_back(objective[i] - objective[pivot] * ratio.back());
    }
    const auto reduce = [&](const std::vector<Rational>& a, const Rational& b) {
      Constraint c;
      for (std::size_t i = 0, j = 0; i < dimension; ++i) {
        if (i != pivot) c.a.push_back(a[i] - a[pivot] * ratio[j++]);
      }
      c.b = b - a[pivot] * constant;
      return c;
    };
    std::vector<Constraint> reduced;
    for (const int sign : {1, -1}) {  // the pivot's own limits
      std::vector<Rational> a(dimension);
      a[pivot] = sign;
      reduced.push_back(reduce(a, limit));
    }
    for (std::size_t i = 0; i < k; ++i) reduced.push_back(reduce(constraints[i].a, constraints[i].b));
    const Optimum lower = solve(reduced, reduced_objective, limit);
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

}  // namespace

std::vector<HalfSpace> convex_cone(const Camera& camera, const Silhouette& silhouette) {
  Ring points;
  for (const Ring& ring : silhouette.rings) points.insert(points.end(), ring.begin(), ring.end());
  std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
    const int order = cmp(a.x, b.x);
    return order != 0 ? order < 0 : a.y < b.y;
  });
  Ring hull;
  for (int pass = 0; pass < 2; ++pass) {  // lower chain, then upper
    const std::size_t base = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= base + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  std::vector<HalfSpace> result;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    result.push_back(plane_through(camera, hull[i], hull[(i + 1) % hull.size()]));
  }
  return result;
}

Bounds bounds_of(const std::vector<HalfSpace>& half_spaces) {
  std::vector<Constraint> constraints;
  for (const HalfSpace& h : half_spaces) {
    constraints.push_back({{-h.normal[0], -h.normal[1], -h.normal[2]}, h.offset});
  }
  std::shuffle(constraints.begin(), constraints.end(), std::mt19937_64(12345));  // a fixed seed: the answer is exact
  const Rational limit(Integer(1) << 100);
  Bounds result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      std::vector<Rational> objective(3);
      objective[axis] = sign;
      const Optimum best = solve(constraints, objective, limit);
      if (!best) {
        result.kind = Bounds::Kind::kEmpty;
        return result;
      }
      // An optimum beyond half of the limit is the limit's, not the scene's.
      if (abs((*best)[axis]) * 2 > limit) result.kind = Bounds::Kind::kUnbounded;
      (sign < 0 ? result.box.low : result.box.high)[axis] = (*best)[axis];
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
    Integer low;
    Integer high;
    const Rational l = box.low[i] / step;
    const Rational h = box.high[i] / step;
    mpz_fdiv_q(low.get_mpz_t(), l.get_num_mpz_t(), l.get_den_mpz_t());
    mpz_cdiv_q(high.get_mpz_t(), h.get_num_mpz_t(), h.get_den_mpz_t());
    result.low[i] = Rational(low - 1) * step;
    result.high[i] = Rational(high + 1) * step;
  }
  return result;
}

}  // namespace visual_hull
