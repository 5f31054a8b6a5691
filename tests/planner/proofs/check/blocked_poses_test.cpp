// SPDX-License-Identifier: Apache-2.0
//
// The check of blocked poses in machine words against its twin in long integers: the same question, with all lengths
// multiplied.
#include "apps/planner/proofs/check/blocked_poses.h"

#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

#include "nef/geometry/vectors.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

std::vector<Rational3> box_corners(const Rational3& low, const Rational3& high) {
  std::vector<Rational3> result;
  for (unsigned i = 0; i < 8; ++i) {
    result.push_back(
        {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  }
  return result;
}

TEST_CASE("blocked poses are judged alike in words and in long integers", "[proofs]") {
  std::mt19937 random(11);
  const auto within = [&](long most, long divisor) {
    return ratio(static_cast<long>(random() % (2 * most + 1)) - most, divisor);
  };
  const Orientations orientations = Orientations::all();
  std::size_t held = 0;
  std::size_t refused = 0;
  for (int round = 0; round < 400; ++round) {
    // Divisors from short to beyond words.
    const long divisor = (1L << (random() % 28)) + static_cast<long>(random() % 3);
    const Rational half = ratio(1, 2) + within(1, 4 * divisor);
    const Rational3 top{half, half, half};
    PathProof::Claim claim;
    claim.robot = {box_corners(minus(Rational3{}, top), top)};
    claim.obstacles = {box_corners({-3, -3, -3}, {3, ratio(1, divisor), 3})};
    OrientationBox<Rational> box;
    box.chart = random() % 4;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = within(8 << (random() % 12), 16 << 12);
      box.high[k] = box.low[k] + ratio(1 + static_cast<long>(random() % 3), 8 << (random() % 16));
    }
    const Rational3 at{within(divisor, divisor), within(2, divisor), within(divisor, divisor)};
    const Rational width = ratio(1, 1 + divisor);
    const std::vector<Rational3> positions = box_corners(at, plus(at, Rational3{width, width, width}));
    const long far = 64;
    const Rational3 away{within(far * 5 / 8, far), ratio(-static_cast<long>(random() % 28), far),
                         within(far * 5 / 8, far)};
    std::vector<Rational3> common;
    for (const Rational3& position : positions) {
      common.push_back(plus(plus(position, away), Rational3{0, within(1, 16 * divisor), 0}));
    }
    std::vector<std::string> verdicts;
    for (const char* factor : {"1", "1000000007/3", "100000000000000000000000000000000000000007/3"}) {
      const Rational by(factor);
      const auto scaled = [&](const std::vector<Rational3>& points) {
        std::vector<Rational3> result;
        for (const Rational3& v : points) result.push_back(scaled_by(by, v));
        return result;
      };
      PathProof::Claim large;
      large.robot = {scaled(claim.robot[0])};
      large.obstacles = {scaled(claim.obstacles[0])};
      const BlockedPoses blocked(large, orientations, {0, 0, 0});
      verdicts.push_back(blocked.complaint(box, scaled(positions), 0, 0, scaled(common)).value_or("it holds"));
    }
    INFO(round << ": " << verdicts[0] << ", " << verdicts[1] << ", " << verdicts[2]);
    CHECK(verdicts[0] == verdicts[2]);
    CHECK(verdicts[1] == verdicts[2]);
    ++(verdicts[2] == "it holds" ? held : refused);
  }
  CHECK(held > 50);
  CHECK(refused > 50);
}

}  // namespace
}  // namespace nef::planner::test
