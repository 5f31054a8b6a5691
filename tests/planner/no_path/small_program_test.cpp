// SPDX-License-Identifier: Apache-2.0
//
// The two solvers of linear programs against each other, where a program is one of both.
#include "apps/planner/no_path/small_program.h"

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/rigid_search/linear_program.h"

namespace nef::planner::test {
namespace {

TEST_CASE("programs in four variables: both solvers find the same maximum") {
  std::mt19937 random(2);
  const auto number = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int round = 0; round < 300; ++round) {
    const int planes = 1 + static_cast<int>(random() % 20);
    SmallProgram<4> small;
    Eigen::MatrixXd a(planes + 4, 4);
    Eigen::VectorXd b(planes + 4);
    for (int r = 0; r < planes + 4; ++r) {
      SmallProgram<4>::Row row{};
      for (int k = 0; k < 4; ++k) {
        // No coordinate is above 8, or below 0.
        row[static_cast<std::size_t>(k)] = r < planes ? number(-1, 1) : r - planes == k ? 1 : 0;
        a(r, k) = row[static_cast<std::size_t>(k)];
      }
      b[r] = r < planes ? number(0, 3) : 8;
      small.add(row, b[r]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      SmallProgram<4>::Row row{};
      row[k] = -1;
      small.add(row, 0);
    }
    SmallProgram<4>::Row objective{};
    Eigen::VectorXd c(4);
    for (int k = 0; k < 4; ++k) c[k] = objective[static_cast<std::size_t>(k)] = number(-1, 1);
    const auto found = small.maximize(objective, 100, -1e6);
    REQUIRE(found.has_value());
    double value = 0;
    for (std::size_t k = 0; k < 4; ++k) value += objective[k] * (*found)[k];
    CHECK(value == Approx(c.dot(maximize(a, b, c))).margin(1e-8));
    // Known not to exceed more than that.
    CHECK_FALSE(small.maximize(objective, 100, value + 1e-6).has_value());
    CHECK(small.maximize(objective, 100, value - 1e-6).has_value());
  }
}

}  // namespace
}  // namespace nef::planner::test
