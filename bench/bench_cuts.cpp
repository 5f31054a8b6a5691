// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_cuts [PLANES [REPEAT]]: a cube that loses what lies beyond one plane after another, 100 planes as a rule,
// each at nearly the same distance from its middle, so that each leaves a facet and the solid has more and more of
// them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <vector>

#include "bench/report.h"
#include "nef/complex/complex.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::bench {
namespace {

// Towards random points of a cube's surface, without common factors as a rule.
std::vector<std::array<long, 3>> directions(std::size_t count) {
  constexpr long kSize = 1000;
  std::mt19937 random(17);
  const auto coordinate = [&] { return static_cast<long>(random() % (2 * kSize + 1)) - kSize; };
  std::vector<std::array<long, 3>> result;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<long, 3> n{coordinate(), coordinate(), coordinate()};
    n.at(i % 3) = i % 2 == 0 ? kSize : -kSize;
    result.push_back(n);
  }
  return result;
}

Polyhedron cut(Polyhedron solid, const std::vector<Polyhedron>& halfspaces) {
  for (const Polyhedron& halfspace : halfspaces) solid = intersect(solid, halfspace);
  return solid;
}

void run(std::size_t planes, int repeat) {
  const Polyhedron cube = make_box({-2000, -2000, -2000}, {2000, 2000, 2000});
  std::vector<Polyhedron> halfspaces;
  for (const auto& [a, b, c] : directions(planes)) {
    const long squared = a * a + b * b + c * c;
    // n.x <= 1000 |n| or so: a root would be no rational, and its whole part is good enough.
    const long length = static_cast<long>(std::sqrt(static_cast<double>(squared)));
    halfspaces.push_back(make_halfspace(a, b, c, -1000 * length));
  }
  std::vector<double> seconds;
  Polyhedron result;
  for (int i = 0; i < repeat; ++i) {
    const Stopwatch watch;
    result = cut(cube, halfspaces);
    seconds.push_back(watch.seconds());
  }
  const double best = *std::min_element(seconds.begin(), seconds.end());
  std::printf("{\"planes\": %zu, \"facets\": %zu, \"vertices\": %zu, \"best_s\": %.4g, \"cuts_per_s\": %.4g}\n", planes,
              result.complex().facet_count(), result.complex().vertex_count(), best,
              static_cast<double>(planes) / best);
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  try {
    nef::bench::run(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100, argc > 2 ? std::atoi(argv[2]) : 5);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "nef_bench_cuts: %s\n", e.what());
    return 1;
  }
  return 0;
}
