// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_tiles cubes [LEVEL...] [--limit N]: tiny cubes off spheres of 8 * 4^LEVEL triangles, in tiles and without.
// nef_bench_tiles chain [STEPS] [--limit N] [--size D]: many boxes, one after the other, off a sphere of 8 * 4^5
// triangles, in tiles and without.
// CPU seconds of one thread. What is compared runs in turn, in one process.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <random>

#include "bench/generators.h"
#include "bench/report.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::bench {
namespace {

double seconds_of(const std::function<void()>& body) {
  const Stopwatch watch;
  body();
  return watch.seconds();
}

// Sphere and centres of cubes on it: integers, the same on every machine.
class CubesOffSphere {
 public:
  explicit CubesOffSphere(int level) : mesh_(make_case("bigsmall-" + std::to_string(level)).operands[0].mesh) {}

  [[nodiscard]] const Mesh& sphere() const { return mesh_; }

  // A cube with its centre near the surface; `size` of the radius is half its side.
  Polyhedron next(double size) {
    constexpr double kRadius = 0x1p30;
    const auto uniform = [this] { return static_cast<double>(random_() >> 40U) * 0x1p-24; };
    const double z = 2 * uniform() - 1;
    const double angle = 6.283185307179586 * uniform();
    const double r = std::sqrt(1 - z * z);
    const std::array<double, 3> direction{r * std::cos(angle), r * std::sin(angle), z};
    Rational3 low;
    Rational3 high;
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = std::floor(kRadius * direction[i]);
      const double half = std::floor(kRadius * size);
      low[i] = exact_rational(at - half);
      high[i] = exact_rational(at + half);
    }
    return make_box(low, high);
  }

 private:
  Mesh mesh_;
  std::mt19937_64 random_{1};
};

void cubes(int level, const Tiling& tiling) {
  CubesOffSphere source(level);
  Polyhedron plain;
  const double build = seconds_of([&] { plain = from_mesh(source.sphere()); });
  TiledPolyhedron in_tiles;
  const double cutting = seconds_of([&] { in_tiles = TiledPolyhedron(plain, tiling); });
  std::vector<double> steps;
  std::vector<double> plain_steps;
  TiledPolyhedron cut = in_tiles;
  for (int i = 0; i < 300; ++i) {
    const Polyhedron cube = source.next(0.0005);
    steps.push_back(seconds_of([&] { cut = subtract(cut, cube); }));
    if (i % 150 == 0) plain_steps.push_back(seconds_of([&] { static_cast<void>(subtract(plain, cube)); }));
  }
  std::sort(steps.begin(), steps.end());
  Polyhedron whole;
  const double glue = seconds_of([&] { whole = in_tiles.polyhedron(); });
  const bool same = equal(whole, plain);
  std::printf(
      "%9zu triangles: from_mesh %.3f s, cutting %.2f of it, gluing %.2f; %zu tiles, %.2f times the vertices; cube: "
      "median %.3f ms, 95%% %.3f ms, plain %.2f ms; glued %s\n",
      source.sphere().face_count(), build, cutting / build, glue / build, in_tiles.tile_count(),
      static_cast<double>(in_tiles.vertex_count()) / static_cast<double>(plain.complex().vertex_count()),
      1e3 * steps[steps.size() / 2], 1e3 * steps[steps.size() * 95 / 100], 1e3 * median(plain_steps),
      same ? "the same" : "DIFFERENT");
}

void chain(int steps, double size, const Tiling& tiling) {
  CubesOffSphere source(5);
  Polyhedron plain = from_mesh(source.sphere());
  TiledPolyhedron in_tiles(plain, tiling);
  double first_hundred = 0;
  double tiled_sum = 0;
  double plain_sum = 0;
  for (int i = 1; i <= steps; ++i) {
    const Polyhedron box = source.next(size);
    tiled_sum += seconds_of([&] { in_tiles = subtract(in_tiles, box); });
    plain_sum += seconds_of([&] { plain = subtract(plain, box); });
    if (i % 100 != 0) continue;
    if (i == 100) first_hundred = tiled_sum;
    std::printf(
        "steps %4d to %4d: %zu vertices, plain %.2f ms, tiled %.2f ms, plain / tiled %.2f, tiled / first %.2f, %s\n",
        i - 99, i, plain.complex().vertex_count(), 10 * plain_sum, 10 * tiled_sum, plain_sum / tiled_sum,
        tiled_sum / first_hundred, equal(in_tiles.polyhedron(), plain) ? "the same" : "DIFFERENT");
    tiled_sum = plain_sum = 0;
  }
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) {
    std::fprintf(stderr,
                 "usage: nef_bench_tiles cubes [LEVEL...] [--limit N] | chain [STEPS] [--size D] [--limit N]\n");
    return 2;
  }
  try {
    nef::Tiling tiling;
    double size = 0.01;
    std::vector<int> numbers;
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (words[i] == "--limit" && i + 1 < words.size()) {
        tiling.limit = std::stoul(words[++i]);
      } else if (words[i] == "--size" && i + 1 < words.size()) {
        size = std::stod(words[++i]);
      } else {
        numbers.push_back(std::stoi(words[i]));
      }
    }
    if (words[0] == "chain") {
      nef::bench::chain(numbers.empty() ? 1000 : numbers[0], size, tiling);
    } else {
      if (numbers.empty()) numbers = {7, 8};
      for (const int level : numbers) nef::bench::cubes(level, tiling);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nef_bench_tiles: %s\n", error.what());
    return 2;
  }
  return 0;
}
