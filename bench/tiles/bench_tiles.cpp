// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_tiles cubes [LEVEL...] [--limit N]: tiny cubes off spheres of 8 * 4^LEVEL triangles, in tiles and without.
// nef_bench_tiles cut [LEVEL [TURNS]] [--limit N] [--threads N]: the conversion of such a sphere, cutting and gluing in
// turn, medians.
// nef_bench_tiles chain [LEVEL [STEPS]] [--limit N] [--size D] [--every]: many boxes one after the other, plain, in
// tiles, and in tiles where that pays; with --every the ratio at each step.
// nef_bench_tiles fold [LEVEL [COUNT]] [--limit N] [--size D]: such boxes off a sphere, all at once and in tiles.
// nef_bench_tiles openings [COUNT]: square openings off a slab, all at once, one after the other by subtract() and by
// operators, whose steps wait until somebody looks, and so in tiles.
// nef_bench_tiles union [COUNT] [--size D] [--limit N] [--threads N] [--memory MB]: random tetrahedra, each of which
// meets a few others; pairs smallest first, unite_all, and region by region. With --stream the latter alone, each piece
// made when it is needed; with --no-tiles all but that, and with --only unite_all alone, both once. CPU seconds of one
// thread. What is compared runs in turn, in one process.
#ifdef NEF_WITH_JEMALLOC
#include <jemalloc/jemalloc.h>
#else
#include <malloc.h>
#endif

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>

#include "bench/generators.h"
#include "bench/report.h"
#include "nef/base/freed_memory.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/native/native_binary.h"
#include "nef/operation/canonical_order.h"
#include "nef/operators.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "nef/tiles/step_sequence.h"
#include "nef/tiles/storage/tile_store.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::bench {
namespace {

double seconds_of(const std::function<void()>& body) {
  const Stopwatch watch;
  body();
  return watch.seconds();
}

// Bytes that malloc has given and not got back.
std::size_t allocated() {
#ifdef NEF_WITH_JEMALLOC
  std::uint64_t epoch = 1;  // its figures are those of the last time that somebody wrote it
  std::size_t bytes = 0;
  std::size_t size = sizeof bytes;
  if (mallctl("epoch", nullptr, nullptr, &epoch, sizeof epoch) != 0 ||
      mallctl("stats.allocated", &bytes, &size, nullptr, 0) != 0) {
    throw std::runtime_error("jemalloc was built without its statistics");
  }
  return bytes;
#else
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
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

// Medians of the seconds to make a set of a mesh, to cut it into tiles, and to glue it again.
struct ThereAndBack {
  double build = 0;
  double cutting = 0;
  double gluing = 0;
};

// In turns: a system that gives a process memory for the first time takes longer, whoever asks for it.
ThereAndBack there_and_back(const Mesh& mesh, int turns, const Tiling& tiling, const nef::Monitor& monitor) {
  std::array<std::vector<double>, 3> times;
  for (int turn = 0; turn < turns; ++turn) {
    Polyhedron plain;
    TiledPolyhedron in_tiles;
    Polyhedron glued;
    times[0].push_back(seconds_of([&] { plain = from_mesh(mesh); }));
    times[1].push_back(seconds_of([&] { in_tiles = TiledPolyhedron(plain, tiling, monitor); }));
    times[2].push_back(seconds_of([&] { glued = in_tiles.polyhedron(); }));
  }
  return {median(times[0]), median(times[1]), median(times[2])};
}

// A sphere of one size and what is measured of it.
class CubesRun {
 public:
  CubesRun(int level, const Tiling& tiling)
      : source_(level),
        times_(there_and_back(source_.sphere(), kTurns, tiling, {})),
        plain_(from_mesh(source_.sphere())) {
    for (int i = 0; i < 2; ++i) {
      const Polyhedron cube = source_.next(kSize);
      plain_steps_.push_back(seconds_of([&] { static_cast<void>(subtract(plain_, cube)); }));
    }
    const std::size_t before = allocated();
    in_tiles_ = TiledPolyhedron(plain_, tiling);
    one_version_ = static_cast<double>(allocated() - before);
    versions_.push_back(in_tiles_);
  }

  void step(int count) {
    const std::size_t before = allocated();
    for (int i = 0; i < count; ++i) {
      const Polyhedron cube = source_.next(kSize);
      steps_.push_back(seconds_of([&] { versions_.push_back(subtract(versions_.back(), cube)); }));
    }
    other_versions_ += static_cast<double>(allocated() - before);
  }

  // Returns the median of the steps.
  double report() {
    std::sort(steps_.begin(), steps_.end());
    const bool same = equal(in_tiles_.polyhedron(), plain_);
    std::printf(
        "%9zu triangles: from_mesh %.3f s, cutting %.2f of it, gluing %.2f; %zu tiles, %.2f times the vertices; cube: "
        "median %.3f ms, 95%% %.3f ms, plain %.2f ms; %.0f MB, with %zu versions %.2f times that; glued %s\n",
        source_.sphere().face_count(), times_.build, times_.cutting / times_.build, times_.gluing / times_.build,
        in_tiles_.tile_count(),
        static_cast<double>(in_tiles_.vertex_count()) / static_cast<double>(plain_.complex().vertex_count()),
        1e3 * steps_[steps_.size() / 2], 1e3 * steps_[steps_.size() * 95 / 100], 1e3 * median(plain_steps_),
        one_version_ / 1048576, steps_.size(), (one_version_ + other_versions_) / one_version_,
        same ? "the same" : "DIFFERENT");
    return steps_[steps_.size() / 2];
  }

 private:
  static constexpr double kSize = 0.0005;
  static constexpr int kTurns = 3;

  CubesOffSphere source_;
  ThereAndBack times_;
  Polyhedron plain_;
  TiledPolyhedron in_tiles_;
  std::vector<TiledPolyhedron> versions_;
  std::vector<double> plain_steps_, steps_;
  double one_version_ = 0, other_versions_ = 0;
};

// Steps of all sizes in turn, a hundred at a time.
void cubes(const std::vector<int>& levels, const Tiling& tiling) {
  std::vector<std::unique_ptr<CubesRun>> runs;
  for (const int level : levels) runs.push_back(std::make_unique<CubesRun>(level, tiling));
  for (int round = 0; round < 10; ++round) {
    for (const auto& run : runs) run->step(100);
  }
  std::vector<double> medians;
  for (const auto& run : runs) medians.push_back(run->report());
  std::printf("cube, slowest / fastest size: %.2f\n",
              *std::max_element(medians.begin(), medians.end()) / *std::min_element(medians.begin(), medians.end()));
}

void cut_and_glue(int level, int turns, const Tiling& tiling, const nef::Monitor& monitor) {
  const CubesOffSphere source(level);
  const ThereAndBack times = there_and_back(source.sphere(), turns, tiling, monitor);
  std::printf("%9zu triangles: from_mesh %.3f s, cutting %.2f of it, gluing %.2f (medians of %d)\n",
              source.sphere().face_count(), times.build, times.cutting / times.build, times.gluing / times.build,
              turns);
}

// Boxes taken off and put back (every fifth one a symmetric difference), plain, in tiles, and in tiles where that pays.
void chain(int level, int steps, double size, bool every, const Tiling& tiling) {
  CubesOffSphere source(level);
  const Polyhedron sphere = from_mesh(source.sphere());
  const auto count = static_cast<std::size_t>(steps);
  std::array<StepSequence, 3> runs{StepSequence(sphere, count, TileUse::kNever, tiling),
                                   StepSequence(sphere, count, TileUse::kAlways, tiling),
                                   StepSequence(sphere, count, TileUse::kWherePays, tiling)};
  std::array<double, 3> hundred{};
  std::array<double, 3> total{};
  double first_hundred = 0;
  double worst = 0;
  int worst_at = 0;
  int same_so_far = 0;
  for (int i = 1; i <= steps; ++i) {
    const Polyhedron box = source.next(size);
    const BooleanOperator op = i % 5 == 0 ? BooleanOperator::kSymmetricDifference : BooleanOperator::kDifference;
    for (std::size_t k = 0; k < 3; ++k) hundred[k] += seconds_of([&] { runs[k].apply(op, box); });
    // The first steps are the same in both, and too short to tell more than noise.
    const double ratio = (total[2] + hundred[2]) / (total[0] + hundred[0]);
    if (i >= 10 && ratio > worst) {
      worst = ratio;
      worst_at = i;
    }
    if (every) std::printf("step %d: auto / plain so far %.3f\n", i, ratio);
    if (i % 100 != 0 && i != steps) continue;
    if (i == 100) first_hundred = hundred[1];
    std::printf(
        "to step %4d: %zu vertices, plain %.2f ms a step, plain / tiled %.2f, plain / auto %.2f (%zu tiles), "
        "tiled / its first hundred %.2f\n",
        i, runs[0].vertex_count(), 10 * hundred[0], hundred[0] / hundred[1], hundred[0] / hundred[2],
        runs[2].tile_count(), hundred[1] / first_hundred);
    for (std::size_t k = 0; k < 3; ++k) total[k] += std::exchange(hundred[k], 0);
    if (!equal(runs[0].result(), runs[1].result())) {
      std::printf("glued at step %d: DIFFERENT\n", i);
    } else {
      ++same_so_far;
    }
  }
  std::printf("glued and plain compared as sets after every hundred steps: %d times the same\n", same_so_far);
  std::array<Polyhedron, 3> results;
  for (std::size_t k = 0; k < 3; ++k) total[k] += seconds_of([&] { results[k] = runs[k].result(); });
  const bool same =
      native_binary(results[0]) == native_binary(results[1]) && native_binary(results[0]) == native_binary(results[2]);
  std::printf(
      "result: plain %.2f s; tiled %.2f of it, auto %.2f (without cutting for tiled); auto / plain at the worst "
      "step so far, from the tenth on, %.3f (step %d); files %s\n",
      total[0], total[1] / total[0], total[2] / total[0], worst, worst_at, same ? "the same" : "DIFFERENT");
}

// All at once: the sphere minus the union of the boxes, with tiles and without.
void openings(int count, const Tiling& tiling) {
  constexpr int kInRow = 47;
  const Polyhedron slab = make_box({0, 0, 0}, {10 * kInRow, 10 * ((count + kInRow - 1) / kInRow), 10});
  std::vector<Polyhedron> boxes;
  for (int i = 0; i < count; ++i) {
    const int x = 10 * (i % kInRow);
    const int y = 10 * (i / kInRow);
    boxes.push_back(make_box({x + 3, y + 3, -1}, {x + 7, y + 7, 11}));
  }
  Polyhedron at_once;
  const double together = seconds_of([&] { at_once = subtract(slab, unite_all(boxes)); });
  Polyhedron one_by_one = slab;
  const double plain = seconds_of([&] {
    for (const Polyhedron& box : boxes) one_by_one = subtract(one_by_one, box);
  });
  Polyhedron waited = slab;
  const double operators = seconds_of([&] {
    for (const Polyhedron& box : boxes) waited = waited - box;
    waited.compute({});
  });
  Polyhedron glued;
  const double tiled = seconds_of([&] {
    TiledPolyhedron in_tiles(slab, tiling);
    for (const Polyhedron& box : boxes) in_tiles = subtract(in_tiles, box);
    glued = in_tiles.polyhedron();
  });
  Polyhedron chosen;
  const double where_it_pays = seconds_of([&] {
    StepSequence steps(slab, boxes.size(), TileUse::kWherePays, tiling);
    for (const Polyhedron& box : boxes) steps.apply(BooleanOperator::kDifference, box);
    chosen = steps.result();
  });
  const bool same =
      equal(one_by_one, at_once) && equal(waited, at_once) && equal(glued, at_once) && equal(chosen, at_once);
  std::printf("%d openings: at once %.3f s", count, together);
  const auto tell = [&](const char* what, double seconds) {
    std::printf("; %s %.3f s (x %.2f)", what, seconds, seconds / together);
  };
  tell("one by one", plain);
  tell("by operators", operators);
  tell("in tiles", tiled);
  tell("in tiles where that pays", where_it_pays);
  std::printf("; %s\n", same ? "the same" : "DIFFERENT");
}

void fold(int level, int count, double size, const Tiling& tiling) {
  CubesOffSphere source(level);
  const Polyhedron sphere = from_mesh(source.sphere());
  std::vector<Polyhedron> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(source.next(size));
  Polyhedron at_once;
  const double plain = seconds_of([&] { at_once = subtract(sphere, unite_all(boxes)); });
  TiledPolyhedron in_tiles;
  const double cutting = seconds_of([&] { in_tiles = TiledPolyhedron(sphere, tiling); });
  const double steps = seconds_of([&] {
    for (const Polyhedron& box : boxes) in_tiles = subtract(in_tiles, box);
  });
  Polyhedron glued;
  const double gluing = seconds_of([&] { glued = in_tiles.polyhedron(); });
  std::printf(
      "%9zu triangles minus %d boxes: minus their union %.3f s; in tiles %.3f s (cutting %.3f, steps %.3f, gluing "
      "%.3f), "
      "union / tiles %.2f, %s\n",
      source.sphere().face_count(), count, plain, cutting + steps + gluing, cutting, steps, gluing,
      plain / (cutting + steps + gluing), equal(glued, at_once) ? "the same" : "DIFFERENT");
}

// The corners of a tetrahedron, the same for the same number on every machine, on a grid of 2^-10 in a cube of volume
// COUNT.
using Corners = std::array<std::array<double, 3>, 4>;
Corners random_corners(std::uint32_t number, std::uint32_t count, double size) {
  std::mt19937_64 random(number + 1U);
  const double side = std::cbrt(static_cast<double>(count));
  const auto uniform = [&random] { return static_cast<double>(random() >> 40U) * 0x1p-24; };
  const std::array<double, 3> middle{side * uniform(), side * uniform(), side * uniform()};
  Corners corners;
  for (std::array<double, 3>& corner : corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = std::floor((middle[i] + size * (uniform() - 0.5)) * 0x1p10) * 0x1p-10;
    }
  }
  return corners;
}

Polyhedron tetrahedron(const Corners& corners) {
  std::array<Rational3, 4> exact;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) exact[k][i] = exact_rational(corners[k][i]);
  }
  return convex_hull(exact);
}

// Regions over tetrahedra none of which has been made yet: their corners tell their boxes.
RegionalUnion regions_of_tetrahedra(std::uint32_t count, double size) {
  std::vector<Box> boxes(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const std::array<double, 3>& corner : random_corners(i, count, size)) boxes[i].add_rounded(corner);
  }
  return {std::move(boxes), kSetsOfARegion};
}

// Pairs of sets of about the same size, wherever they lie: the order before that of neighbours, to compare with.
Polyhedron unite_smallest_first(std::vector<Polyhedron> left, const nef::Monitor& monitor) {
  while (left.size() > 1) {
    std::stable_sort(left.begin(), left.end(), [](const Polyhedron& x, const Polyhedron& y) {
      return x.complex().vertex_count() < y.complex().vertex_count();
    });
    const std::size_t pairs = left.size() / 2;
    std::vector<Polyhedron> next(pairs);
    parallel_for(pairs, monitor,
                 [&](std::size_t i, const nef::Monitor& own) { next[i] = unite(left[2 * i], left[2 * i + 1], own); });
    next.insert(next.end(), left.begin() + static_cast<std::ptrdiff_t>(2 * pairs), left.end());
    left = std::move(next);
  }
  return left.front();
}

// What a step gives, after a line that tells how long it took.
template <typename Make>
auto timed(const char* what, const Make& make) {
  const nef::Stopwatch wall;
  const Stopwatch watch;
  auto result = make();
  std::printf("%s: %.2f s CPU, %.2f s\n", what, watch.seconds(), wall.seconds());
  std::fflush(stdout);
  return result;
}

struct UnionBench {
  bool stream = false;  // pieces made when they are needed, and only tiles
  bool with_old_order = true;
  bool with_tiles = true;
  int turns = 2;
  nef::Monitor monitor;
  double size = 1.2;  // of the box of a piece; there is one for each cube of side 1
};

void unite_tetrahedra(std::uint32_t count, const UnionBench& bench, const Tiling& tiling) {
  const PieceSource made_when_needed{.count = count, .set = [count, &bench](std::uint32_t i, const nef::Monitor&) {
                                       return tetrahedron(random_corners(i, count, bench.size));
                                     }};
  std::printf("%u tetrahedra, %u threads\n", count, bench.monitor.threads());
  std::size_t vertices = 0;
  std::size_t tiles = 0;
  if (bench.stream) {
    const nef::Stopwatch wall;
    const Stopwatch watch;
    const TiledPolyhedron united =
        union_in_tiles(made_when_needed, regions_of_tetrahedra(count, bench.size), tiling, bench.monitor);
    std::printf("in tiles, pieces made when needed: %.2f s CPU, %.2f s\n", watch.seconds(), wall.seconds());
    vertices = united.vertex_count();
    tiles = united.tile_count();
  } else {
    std::vector<Polyhedron> pieces;
    for (std::uint32_t i = 0; i < count; ++i) pieces.push_back(tetrahedron(random_corners(i, count, bench.size)));
    for (int turn = 0; turn < bench.turns; ++turn) {
      Polyhedron by_size;
      if (bench.with_old_order) {
        by_size = timed("pairs smallest first", [&] { return unite_smallest_first(pieces, bench.monitor); });
      }
      const Polyhedron plain = timed("unite_all", [&] { return unite_all(pieces, bench.monitor); });
      if (bench.with_old_order) {
        std::printf("files in canonical order: %s\n",
                    native_binary(in_canonical_order(plain)) == native_binary(in_canonical_order(by_size))
                        ? "the same"
                        : "DIFFERENT");
      }
      if (!bench.with_tiles) continue;
      const TiledPolyhedron united =
          timed("region by region", [&] { return TiledPolyhedron(pieces, tiling, bench.monitor); });
      const Polyhedron glued = timed("glued", [&] { return united.polyhedron(); });
      std::printf("file: %s\n",
                  native_binary(glued) == native_binary(in_canonical_order(plain)) ? "the same" : "DIFFERENT");
      vertices = united.vertex_count();
      tiles = united.tile_count();
    }
  }
  std::printf("%zu vertices in %zu tiles, peak %zu MB\n", vertices, tiles, static_cast<std::size_t>(peak_kb()) / 1024);
}

}  // namespace
}  // namespace nef::bench

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) {
    std::fprintf(stderr,
                 "usage: nef_bench_tiles cubes [LEVEL...] | cut [LEVEL [TURNS]] | chain [LEVEL [STEPS]] | fold [LEVEL "
                 "[COUNT]] | openings [COUNT] | union "
                 "[COUNT], [--size D] [--every] "
                 "[--limit N] [--threads N] [--memory MB] [--stream | --no-tiles | --only]\n");
    return 2;
  }
  try {
    nef::Tiling tiling;
    if (words[0] == "union") tiling.limit = nef::kVerticesOfTileInFile;
    double size = 0.01;
    nef::bench::UnionBench union_bench;
    bool every = false;
    std::vector<int> numbers;
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (words[i] == "--limit" && i + 1 < words.size()) {
        tiling.limit = std::stoul(words[++i]);
      } else if (words[i] == "--threads" && i + 1 < words.size()) {
        union_bench.monitor = nef::Monitor().on_threads(static_cast<unsigned>(std::stoul(words[++i])));
      } else if (words[i] == "--memory" && i + 1 < words.size()) {
        tiling.store = std::make_shared<nef::TileStore>(".", std::stoull(words[++i]) << 20U);
      } else if (words[i] == "--stream") {
        union_bench.stream = true;
      } else if (words[i] == "--no-tiles") {
        union_bench.with_tiles = false;
        union_bench.turns = 1;
      } else if (words[i] == "--only") {
        union_bench.with_old_order = union_bench.with_tiles = false;
        union_bench.turns = 1;
      } else if (words[i] == "--every") {
        every = true;
      } else if (words[i] == "--size" && i + 1 < words.size()) {
        size = union_bench.size = std::stod(words[++i]);
      } else {
        numbers.push_back(std::stoi(words[i]));
      }
    }
    if (words[0] == "cut") {
      nef::bench::cut_and_glue(numbers.empty() ? 7 : numbers[0], numbers.size() < 2 ? 5 : numbers[1], tiling,
                               union_bench.monitor);
    } else if (words[0] == "chain") {
      nef::bench::chain(numbers.empty() ? 5 : numbers[0], numbers.size() < 2 ? 1000 : numbers[1], size, every, tiling);
    } else if (words[0] == "union") {
      nef::bench::unite_tetrahedra(numbers.empty() ? 10000U : static_cast<std::uint32_t>(numbers[0]), union_bench,
                                   tiling);
    } else if (words[0] == "openings") {
      nef::bench::openings(numbers.empty() ? 1175 : numbers[0], tiling);
    } else if (words[0] == "fold") {
      nef::bench::fold(numbers.empty() ? 6 : numbers[0], numbers.size() < 2 ? 1000 : numbers[1], size, tiling);
    } else {
      if (numbers.empty()) numbers = {7, 8};
      nef::bench::cubes(numbers, tiling);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nef_bench_tiles: %s\n", error.what());
    return 2;
  }
  return 0;
}
