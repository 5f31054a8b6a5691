// SPDX-License-Identifier: Apache-2.0
//
// Parts of quarters by identities of arc tangents, and zeros of products by quadratic formulas, by angles that are
// known, and by changes of sign.
#include "apps/planner/mechanism/screw_contact.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Rational power_of_two(int exponent) {
  Rational result(1);
  if (exponent < 0) mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<unsigned>(-exponent));
  return result;
}

TEST_CASE("parts of quarters: identities of arc tangents hold to any digit", "[mechanism]") {
  // atan(a) + atan((1 - a) / (1 + a)) = 45 degrees.
  for (const Rational& a : {ratio(1, 2), ratio(1, 3), ratio(2, 3), ratio(7, 11), ratio(1, 1000), ratio(41, 99)}) {
    const Rational b = (1 - a) / (1 + a);
    for (const unsigned bits : {20U, 80U, 100U, 400U}) {
      const auto x = quarter_share(a, bits);
      const auto y = quarter_share(b, bits);
      CHECK(x[0] < x[1]);
      CHECK(x[1] - x[0] <= power_of_two(-static_cast<int>(bits)));
      CHECK(x[0] + y[0] < 1);
      CHECK(x[1] + y[1] > 1);
    }
    CHECK(nearest_double(quarter_share(a, 80)[0]) == Approx(std::atan(nearest_double(a)) * 4 / M_PI).margin(1e-15));
  }
  // Machin: 4 atan(1/5) - atan(1/239) = 45 degrees.
  const auto fifth = quarter_share(ratio(1, 5), 200);
  const auto rest = quarter_share(ratio(1, 239), 200);
  CHECK(4 * fifth[0] - rest[1] < 1);
  CHECK(4 * fifth[1] - rest[0] > 1);
  CHECK(quarters(3, 50) == std::array<Rational, 2>{3, 3});
  CHECK(nearest_double(quarters(ratio(-1, 2), 80)[0]) == Approx(-1 + std::atan(0.5) * 4 / M_PI));
  for (const ExactTurn& at : exact_turns(-2)) {
    const auto [low, high] = enclosure(at.turn, 90);
    CHECK(quarters(low, 80)[0] <= at.quarters);
    CHECK(quarters(high, 80)[1] >= at.quarters);
  }
}

TEST_CASE("zeros of products without a way are those of quadratic polynomials", "[mechanism]") {
  std::mt19937 random(3);
  const auto number = [&] { return ratio(static_cast<long>(random() % 41) - 20, 1 + static_cast<long>(random() % 6)); };
  const ScrewPart part{ratio(9, 4), ratio(23, 8)};
  unsigned several = 0;
  for (int i = 0; i < 300; ++i) {
    ScrewProduct product;
    for (Rational& x : product.still) x = number();
    if (product.vanishes()) continue;
    const std::array<Rational, 3>& b = product.still;
    const auto exact = roots_in_unit_interval({b[0], 2 * (b[1] - b[0]), b[0] - 2 * b[1] + b[2]});
    std::vector<QuadraticRoot> turns;
    for (const QuadraticRoot& root : exact) turns.push_back(moved(root, part.from, part.to - part.from));
    const auto enclosed = roots_of(product, part);
    for (const QuadraticRoot& turn : turns) {
      CHECK(std::count_if(enclosed.begin(), enclosed.end(), [&](const ScrewRoot& root) {
              return compare(turn, root.low) >= 0 && compare(turn, root.high) <= 0;
            }) >= 1);
    }
    CHECK(enclosed.size() == turns.size());
    for (const ScrewRoot& root : enclosed) {
      CHECK(root.single);
      CHECK(root.high - root.low <= power_of_two(-64));
    }
    several += turns.size() == 2 ? 1 : 0;
  }
  CHECK(several > 5);
}

TEST_CASE("zeros of products with a way: known angles, and all changes of sign", "[mechanism]") {
  // z - c with z the quarters: a zero where z = c, exact where that is known.
  const auto of_quarters = [](const Rational& c) {
    ScrewProduct product;
    for (Rational& x : product.still) x = -c;
    for (Rational& x : product.along) x = 1;
    return product;
  };
  const ScrewPart whole{4, 5};
  for (const Rational& c : {Rational(4), ratio(13, 3), ratio(9, 2), ratio(14, 3), Rational(5)}) {
    const auto roots = roots_of(of_quarters(c), whole);
    REQUIRE(roots.size() == 1);
    REQUIRE(roots.front().exact.has_value());
  }
  const auto other = roots_of(of_quarters(ratio(24, 5)), whole);  // 432 degrees
  REQUIRE(other.size() == 1);
  CHECK_FALSE(other.front().exact.has_value());
  CHECK(quarters(other.front().low, 100)[0] < ratio(24, 5));
  CHECK(quarters(other.front().high, 100)[1] > ratio(24, 5));
  CHECK(roots_of(of_quarters(6), whole).empty());
  // Random ones, in floating point on a grid.
  std::mt19937 random(4);
  const auto number = [&] { return ratio(static_cast<long>(random() % 41) - 20, 1 + static_cast<long>(random() % 6)); };
  unsigned found = 0;
  for (int i = 0; i < 200; ++i) {
    ScrewProduct product;
    for (Rational& x : product.along) x = number();
    // Near the way's part, so that there are zeros.
    for (std::size_t k = 0; k < 3; ++k) product.still[k] = number() / 8 - ratio(9, 2) * product.along[k];
    const auto roots = roots_of(product, whole);
    const auto value = [&](double u) {
      const double z = 4 + std::atan(u) * 4 / M_PI;
      const auto at = [&](std::size_t k) {
        return nearest_double(product.still[k]) + z * nearest_double(product.along[k]);
      };
      return (1 - u) * (1 - u) * at(0) + 2 * u * (1 - u) * at(1) + u * u * at(2);
    };
    std::size_t changes = 0;
    constexpr int kSteps = 4000;
    for (int s = 0; s < kSteps; ++s) {
      const double a = value(static_cast<double>(s) / kSteps);
      const double b = value(static_cast<double>(s + 1) / kSteps);
      if (a * b >= 0) continue;
      ++changes;
      CHECK(std::any_of(roots.begin(), roots.end(), [&](const ScrewRoot& root) {
        return nearest_double(root.low) < 4 + static_cast<double>(s + 1) / kSteps + 1e-9 &&
               nearest_double(root.high) > 4 + static_cast<double>(s) / kSteps - 1e-9;
      }));
    }
    CHECK(roots.size() >= changes);
    found += static_cast<unsigned>(roots.size());
  }
  CHECK(found > 60);
}

}  // namespace
}  // namespace nef::planner::test
