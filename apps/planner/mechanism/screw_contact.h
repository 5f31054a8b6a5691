// SPDX-License-Identifier: Apache-2.0
//
// When may two convex polytopes begin or cease to touch or to overlap, while a screw moves one of them?
//
// A contact product (contact_events.h) is linear in the position, and the position of a screw is z times its way of a
// quarter, z being the number of quarters that it has turned. With t the half-tangent within a quarter the product is,
// times a positive number, P(t) + z(t) Q(t), where P and Q are quadratic polynomials with rational coefficients and
// z(t) = k + 4/pi atan(t). For a rational t in (0, 1) z(t) is transcendental (Niven; Gelfond and Schneider), so the
// sign of a product at a rational t is always decided by enough digits: it is 0 only if P and Q are.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/planner/mechanism/quadratic_root.h"
#include "nef/number/number.h"

namespace nef::planner {

/// Two rational numbers that enclose 4/pi atan(t), 0 <= t <= 1, the part of a quarter that a half-tangent is: at most
/// 2^-bits apart, and equal at 0 and 1. O(bits) operations of numbers of so many digits.
std::array<Rational, 2> quarter_share(const Rational& half_tangent, unsigned bits);

/// How many quarters a turn (turn.h) of an axis of rational length is: as quarter_share.
std::array<Rational, 2> quarters(const Rational& turn, unsigned bits);

/// The same where both are known exactly: whole quarters, and 30, 45 and 60 degrees beyond them.
struct ExactTurn {
  QuadraticRoot turn;
  Rational quarters;
};
/// All of them in the quarter of a turn, in order, its end included.
std::array<ExactTurn, 5> exact_turns(const Integer& quarter);

/// A contact product while a screw goes from one turn to another within a quarter: the sum over i of B_i(u) (still[i] +
/// z along[i]), B_i the quadratic Bernstein polynomials, u from 0 to 1 as the turn goes from one to the other.
struct ScrewProduct {
  std::array<Rational, 3> still;
  std::array<Rational, 3> along;

  /// Whether it is 0 all the time.
  [[nodiscard]] bool vanishes() const;
  /// Its numbers, divided by the first one that is not 0: the same for multiples of one product.
  [[nodiscard]] std::array<Rational, 6> normalized() const;
};

/// The part of a screw's motion that products belong to: turns within one quarter.
struct ScrewPart {
  Rational from;
  Rational to;
};

/// A zero of a product: a turn between two rational numbers, 2^-64 apart or equal.
struct ScrewRoot {
  Rational low;
  Rational high;
  /// It is this one of exact_turns().
  std::optional<QuadraticRoot> exact;
  /// It is this one, a common zero of P and Q.
  std::optional<QuadraticRoot> algebraic;
  /// False if there may be no zero or several there, as where a product with a Q touches zero.
  bool single = true;
};

/// Encloses all zeros of a product that does not vanish, in order.
std::vector<ScrewRoot> roots_of(const ScrewProduct& product, const ScrewPart& part);

/// Whether two products, whose P and Q are p and q, have the same zeros, but for zeros of P and Q: if p1 q2 = p2 q1.
bool have_equal_quotients(const ScrewProduct& a, const ScrewProduct& b);

/// The sign of a product at a turn, and at all numbers of quarters between two numbers; nothing if it is not the same.
std::optional<int> sign_over(const ScrewProduct& product, const ScrewPart& part, const Rational& turn,
                             const std::array<Rational, 2>& quarters);

}  // namespace nef::planner
