// SPDX-License-Identifier: Apache-2.0
//
// Motions of an arm of six joints among twenty boxes, certified: microseconds of CPU a motion, by what is told of it.
#include <array>
#include <ctime>
#include <iostream>
#include <random>

#include "apps/planner/linkage/linkage_checker.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

RigidBody box_body(const Rational3& low, const Rational3& high) { return RigidBody::of_set(make_box(low, high)); }

Linkage arm() {
  using Kind = LinkageJoint::Kind;
  const RigidBody bone = box_body({Rational(-1, 8), Rational(-1, 8), 0}, {Rational(1, 8), Rational(1, 8), 1});
  const std::array<Vector3d, 6> axes{Vector3d(0, 0, 1), Vector3d(0, 1, 0), Vector3d(0, 1, 0),
                                     Vector3d(0, 0, 1), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};
  Linkage result;
  result.links.push_back({"base", std::nullopt, {}});
  for (std::size_t i = 0; i < axes.size(); ++i) {
    result.links.push_back({"bone", bone, {Kind::kRevolute, i, {0, 0, i == 0 ? 0.0 : 1.0}, {1, 0, 0, 0}, axes[i]}});
  }
  return result;
}

int run() {
  constexpr int kBoxes = 20;
  constexpr int kMotions = 2000;
  std::mt19937 random(1);
  std::vector<RigidBody> boxes;
  const auto coordinate = [&] { return Rational(static_cast<long>(random() % 97) - 48, 12); };
  for (int k = 0; k < kBoxes; ++k) {
    Rational3 at{coordinate(), coordinate(), coordinate()};
    for (Rational& x : at) x.canonicalize();
    boxes.push_back(box_body(at, {at[0] + Rational(1, 2), at[1] + Rational(1, 2), at[2] + Rational(1, 2)}));
  }
  const LinkageChecker checker(arm(), RigidBody::together(boxes));
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  CheckLimits limits;
  limits.depth = 12;
  limits.max_cells = 1024;
  std::array<double, 3> seconds{};
  std::array<std::size_t, 3> count{};
  std::array<std::size_t, 3> cells{};
  for (int k = 0; k < kMotions; ++k) {
    std::vector<double> from;
    std::vector<double> to;
    for (int i = 0; i < 6; ++i) {
      from.push_back(angle(random));
      to.push_back(from.back() + angle(random) / 5);  // half a radian a joint, as planners step
    }
    const std::clock_t begin = std::clock();
    const LinkageVerdict verdict = checker.check(from, to, limits);
    const auto which = static_cast<std::size_t>(verdict.status);
    seconds[which] += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    ++count[which];
    cells[which] += verdict.cells;
  }
  constexpr std::array kNames{"free", "collides", "undecided"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (count[i] == 0) continue;
    std::cout << kNames[i] << ": " << count[i] << " motions, " << 1e6 * seconds[i] / static_cast<double>(count[i])
              << " us each, " << static_cast<double>(cells[i]) / static_cast<double>(count[i]) << " parts\n";
  }
  return 0;
}

}  // namespace
}  // namespace nef::planner

int main() { return nef::planner::run(); }
