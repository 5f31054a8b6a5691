// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums: the thesis' table 10.1 (a mushroom plus a cube by each union strategy), stars,
// spheres, decompositions, open against closed; CGAL's minkowski_sum_3 beside them where it is
// installed. Times are processor seconds, the best of some runs, single-threaded, without reading
// and conversion of the meshes.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>

#include "apps/minkowski/minkowski.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/mesh/mesh_reader.h"
#include "tests/support/shapes/minkowski_shapes.h"
#include "tests/support/union_orders.h"
#ifdef NEF_BENCH_CGAL
#include "bench/minkowski/cgal_peer.h"
#include "nef/base/freed_memory.h"
#include "nef/polyhedron.h"
#endif

namespace {

using nef::Mesh;
using nef::Polyhedron;
using nef::Rational;
using nef::minkowski::minkowski_sum;
using nef::minkowski::MinkowskiOptions;
using nef::minkowski::MinkowskiReport;
using nef::minkowski::UnionStrategy;

Mesh cube(const Rational& half) {
  std::vector<nef::Rational3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? half : Rational(-half), (i & 2) != 0 ? half : Rational(-half),
                       (i & 4) != 0 ? half : Rational(-half)});
  }
  return nef::convex_hull_mesh(corners);
}

struct Case {
  std::string name;
  Mesh a, b;
  bool peer = true;  // CGAL takes minutes for some
};

struct Settings {
  int repeat = 3;
  bool peer = true;
  bool slow_peer = false;
  std::string only;  // run cases whose names hold this

  [[nodiscard]] bool wants(const std::string& name) const { return name.find(only) != std::string::npos; }
};

void print_sum(const std::string& name, const Polyhedron& sum, const MinkowskiReport& r, double seconds) {
  const nef::Counts c = nef::counts(sum);
  std::printf("%-34s %9.4f s  (on the clock: decomposition %.4f, sums %.4f, union %.4f)  %zu x %zu cells  %zu/%zu\n",
              name.c_str(), seconds, r.seconds_decomposition, r.seconds_convex_sums, r.seconds_union, r.cells_a,
              r.cells_b, c.vertices, c.facets);
  std::fflush(stdout);
}

double time_sum(const std::string& name, const Polyhedron& a, const Polyhedron& b, UnionStrategy strategy,
                const Settings& settings) {
  double best = 1e300;
  MinkowskiReport report;
  Polyhedron sum;
  for (int i = 0; i < settings.repeat; ++i) {
    MinkowskiReport r;
    MinkowskiOptions options;
    options.strategy = strategy;
    // Of this thread: both engines use one, and other programs do not count.
    const nef::ThreadStopwatch watch;
    sum = minkowski_sum(a, b, options, &r);
    const double seconds = watch.seconds();
    if (seconds < best) {
      best = seconds;
      report = r;
    }
  }
  print_sum(name, sum, report, best);
  return best;
}

void run_peer([[maybe_unused]] const Case& test, [[maybe_unused]] const Settings& settings) {
#ifdef NEF_BENCH_CGAL
  if (!settings.peer || !(test.peer || settings.slow_peer)) return;
  const nef::bench::PeerResult r = nef::bench::cgal_minkowski_sum(test.a, test.b);
  std::printf("%-34s %9.4f s  %zu pieces  %zu/%zu\n", ("  CGAL: " + test.name).c_str(), r.seconds, r.pieces, r.vertices,
              r.facets);
  std::fflush(stdout);
#endif
}

void run_case(const Case& test, const Settings& settings) {
  if (!settings.wants(test.name)) return;
  const Polyhedron a = nef::from_mesh(test.a);
  const Polyhedron b = nef::from_mesh(test.b);
  const double closed = time_sum(test.name, a, b, UnionStrategy::kQueue, settings);
  const double open = time_sum(test.name + ", B open", a, nef::interior(b), UnionStrategy::kQueue, settings);
  std::printf("%-34s %9.2f\n", "  open / closed", open / closed);
  run_peer(test, settings);
}

void time_order(const std::string& name, const Polyhedron& a, const Polyhedron& b, nef::test::UnionOrder order,
                const Settings& settings) {
  double best = 1e300;
  Polyhedron sum;
  for (int i = 0; i < settings.repeat; ++i) {
    const nef::ThreadStopwatch watch;
    sum = united(nef::test::sums_of_cells(a, b), order);
    best = std::min(best, watch.seconds());
  }
  std::printf("  %-32s %9.4f s  %zu/%zu\n", name.c_str(), best, nef::counts(sum).vertices, nef::counts(sum).facets);
  std::fflush(stdout);
}

void run_table(const Settings& settings) {
  if (!settings.wants("table")) return;
  std::printf("Table 10.1: the generated mushroom plus a cube, by union strategy\n");
  const Polyhedron a = nef::from_mesh(nef::test::mushroom());
  const Polyhedron b = nef::from_mesh(cube(Rational(1, 10)));
  for (const auto& [name, order] : nef::test::kUnionOrders) time_order(std::string(name), a, b, order, settings);
  time_sum("  many at once", a, b, UnionStrategy::kQueue, settings);
}

void run_decomposition(const std::string& name, const Mesh& mesh, const Settings& settings) {
  if (!settings.wants("decompose " + name)) return;
  const Polyhedron a = nef::from_mesh(mesh);
  double best = 1e300;
  std::size_t cells = 0;
  for (int i = 0; i < settings.repeat; ++i) {
    const nef::ThreadStopwatch watch;
    cells = nef::minkowski::decompose(a).size();
    best = std::min(best, watch.seconds());
  }
  std::printf("%-34s %9.4f s  %zu cells\n", ("decompose " + name).c_str(), best, cells);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  CLI::App app("Minkowski sums beside CGAL's");
  Settings settings;
  std::vector<std::string> meshes;
  bool no_peer = false;
  app.add_option("--repeat", settings.repeat, "runs of each case; the best counts")->check(CLI::PositiveNumber);
  app.add_flag("--no-cgal", no_peer, "leave the peer out");
  app.add_flag("--slow-cgal", settings.slow_peer, "run the peer also where it takes minutes (stars of 50 vertices)");
  app.add_option("--only", settings.only, "run only cases whose names hold this: table, mushroom, star 50, ...");
  app.add_option("--decompose", meshes, "more meshes to decompose")->expected(-1);
  CLI11_PARSE(app, argc, argv);
  settings.peer = !no_peer;
  try {
    run_table(settings);
    run_case({"mushroom + cube", nef::test::mushroom(), cube(Rational(1, 10))}, settings);
    const Mesh small = nef::test::star(1, 2.5);
    run_case({"star 14 + star 14", small, small}, settings);
    const Mesh large = nef::test::star(2, 2.5);
    run_case({"star 50 + star 50", large, large, false}, settings);
    run_case({"sphere 252 + sphere 252", nef::test::geodesic_sphere(5, 1, 0), nef::test::geodesic_sphere(5, 0.75, 0.3)},
             settings);
    run_decomposition("mushroom", nef::test::mushroom(), settings);
    for (const std::string& path : meshes) run_decomposition(path, nef::read_mesh(path), settings);
  } catch (const nef::Error& error) {
    std::fprintf(stderr, "nef_bench_minkowski: %s\n", error.what());
    return 2;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory %.0f MB\n", static_cast<double>(usage.ru_maxrss) / 1024);
  return 0;
}
