// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turn.h"

#include <algorithm>
#include <cmath>

#include "apps/planner/rigid/rigid_motion.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"
#include "nef/number/simplest_between.h"
#include "nef/number/square_root.h"

namespace nef::planner {
namespace {

// What makes a vector about one long: exactly, if it can.
Rational scale_of(const Rational3& direction) {
  const Rational square = dot(direction, direction);
  if (square == 0) throw InputError("the axis of rotation must not be the zero vector");
  if (const std::optional<Rational> length = rational_square_root(square)) return 1 / *length;
  const Rational scale = exact_rational(1 / std::sqrt(nearest_double(square)));
  return simplest_between(scale * Rational(19, 20), scale * Rational(21, 20));
}

}  // namespace

Turn moved_above(const Turn& turn, const Turn& low) { return turn + 4 * ceiling_of((low - turn) / 4); }

TurningAxis::TurningAxis(const Rational3& direction) {
  const Rational scale = scale_of(direction);
  for (std::size_t k = 0; k < 3; ++k) n_[k] = scale * direction[k];
  square_ = dot(n_, n_);
}

TurningAxis::Half TurningAxis::half_of(const Turn& turn) const {
  const Integer quarter = floor_of(turn);
  const Rational t = turn - quarter;
  Half half{1, t};
  if (mpz_odd_p(quarter.get_mpz_t()) != 0) half = {1 - t, 1 + t / square_};
  // A half turn more: a factor of sqrt(-N). Two of them change the sign, which is the same rotation.
  Integer half_turns;
  mpz_fdiv_q_2exp(half_turns.get_mpz_t(), quarter.get_mpz_t(), 1);
  if (mpz_odd_p(half_turns.get_mpz_t()) != 0) half = {-half.s * square_, half.w};
  return half;
}

Rational3 TurningAxis::across(const Rational3& v) const {
  const Rational along = dot(v, n_) / square_;
  return {v[0] - along * n_[0], v[1] - along * n_[1], v[2] - along * n_[2]};
}

AffineMap TurningAxis::between(const Turn& a, const Turn& b) const {
  AffineMap map = AffineMap::identity();
  map.linear = rotation_between(quaternion(a), quaternion(b));
  return map;
}

AffineMap TurningAxis::rotation(const Turn& turn) const { return between(turn, turn); }

std::array<Rational, 4> TurningAxis::quaternion(const Turn& turn) const {
  const auto [w, s] = half_of(turn);
  return {w, s * n_[0], s * n_[1], s * n_[2]};
}

std::optional<Turn> TurningAxis::turn_between(const Rational3& from, const Rational3& to) const {
  const Rational3 a = across(from);
  const Rational3 b = across(to);
  if (is_zero(a) || is_zero(b)) return std::nullopt;
  const std::optional<Rational> lengths = rational_square_root(dot(a, a) * dot(b, b));
  if (!lengths) return std::nullopt;
  // tan(x / 2) = sin x / (1 + cos x)
  Half half{*lengths + dot(a, b), dot(n_, cross(a, b)) / square_};
  if (half.w == 0) return Turn(2);
  Turn base = 0;
  if (half.s / half.w < 0) {
    half = {half.s * square_, -half.w};  // a half turn less
    base = 2;
  }
  const Rational ratio = half.s / half.w;
  if (ratio < 1) return base + ratio;
  return base + 1 + square_ * (ratio - 1) / (square_ * ratio + 1);
}

Turn TurningAxis::turn_of_degrees(const Rational& degrees) const {
  const Integer half_turns = floor_of(degrees / 180);
  const Rational rest = degrees - 180 * half_turns;
  Turn base(2 * half_turns);
  if (rest == 0) return base;
  if (rest == 90 && square_ == 1) return base + 1;
  const double length = std::sqrt(nearest_double(square_));
  const double t = std::tan(nearest_double(rest) * M_PI / 360) / length;
  const bool first = t < 1;
  const double in_quarter = first ? t : length * length * (t - 1) / (length * length * t + 1);
  const Rational near = std::clamp(exact_rational(in_quarter), Rational(0), Rational(1));
  const Rational close = exact_rational(1e-12);
  const Rational low = std::max(Rational(0), Rational(near - close));
  return base + (first ? 0 : 1) + simplest_between(low, std::min(Rational(1), Rational(near + close)));
}

double TurningAxis::degrees_of(const Turn& turn) const {
  const Integer quarter = floor_of(turn);
  const double t = nearest_double(turn - quarter);
  const double length = std::sqrt(nearest_double(square_));
  Integer half_turns;
  mpz_fdiv_q_2exp(half_turns.get_mpz_t(), quarter.get_mpz_t(), 1);
  const bool odd = mpz_odd_p(quarter.get_mpz_t()) != 0;
  const double begin = odd ? (square_ == 1 ? 90 : 360 / M_PI * std::atan(length)) : 0;
  return 180 * half_turns.get_d() + begin + 360 / M_PI * std::atan(odd ? t / length : t * length);
}

}  // namespace nef::planner
