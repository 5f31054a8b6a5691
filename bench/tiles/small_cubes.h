// SPDX-License-Identifier: Apache-2.0
//
// The cubes of the benchmark of small cuts, for all engines.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nef::bench {

/// The lowest and the highest corner of a box.
struct CubeCorners {
  std::array<long, 3> low{};
  std::array<long, 3> high{};
};

/// 50 cubes around points of a sphere of radius 2^30, along a spiral, with sides of 1/500 of the radius.
inline std::vector<CubeCorners> small_cubes() {
  constexpr long kRadius = 1L << 30;
  constexpr long kHalf = kRadius / 1000;
  constexpr double kGoldenAngle = 2.39996;
  constexpr int kCount = 50;
  std::vector<CubeCorners> result;
  for (int i = 0; i < kCount; ++i) {
    const double z = 1 - (2.0 * i + 1) / kCount;
    const double r = std::sqrt(1 - z * z);
    CubeCorners cube;
    const std::array<double, 3> at{r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z};
    for (std::size_t k = 0; k < 3; ++k) {
      const long middle = std::lround(static_cast<double>(kRadius) * at[k]);
      cube.low[k] = middle - kHalf;
      cube.high[k] = middle + kHalf;
    }
    result.push_back(cube);
  }
  return result;
}

}  // namespace nef::bench
