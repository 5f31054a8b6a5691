// SPDX-License-Identifier: Apache-2.0
//
// How long the hull takes from its silhouettes: three letters, synthetic views of growing number and detail, and
// any scene given on the command line; beside voxel carving, and CGAL on the same cones where it is installed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "apps/program/reports/report.h"
#include "apps/visual_hull/command/report.h"
#include "apps/visual_hull/cones/intersection.h"
#include "apps/visual_hull/viewing_edges/direct_hull.h"
#include "apps/visual_hull/visual_hull.h"
#include "bench/visual_hull/voxel_peer.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#ifdef NEF_BENCH_CGAL
#include "bench/visual_hull/cgal_peer.h"
#include "nef/base/freed_memory.h"
#endif

namespace nef::visual_hull::bench {
namespace {

struct Settings {
  int repeat = 5;
  double peer_limit = 20;  ///< seconds: CGAL is left out of a row that it is expected to exceed
  double simplify = 1;
  bool growth = true;
  int voxels = 256;    ///< along each side; 0: no carving
  bool cones = false;  ///< always by intersecting cones
  std::vector<std::string> scenes;
};

// Of the images that voxel carving asks.
constexpr int kWidth = 640;
constexpr int kHeight = 480;

// Processor time: a busy machine does not count.
double seconds_of(const std::function<void()>& work) {
  const nef::ThreadStopwatch watch;
  work();
  return watch.seconds();
}

struct Row {
  std::string name;
  std::size_t views = 0;
  std::size_t polygon_vertices = 0;
  double cones = 0;      ///< building them
  double operation = 0;  ///< median of the intersection
  nef::Counts counts;
  std::size_t facets_of_cones = 0;
};

void print_header() {
  std::cout << fmt::format("{:<26}  {:>5}  {:>8}  {:>9}  {:>11}  {:>9}  {:>9}  {:>6}  {:>8}  {:>11}  {:>7}\n", "case",
                           "views", "polygon", "cones s", "hull s", "vertices", "facets", "way", "voxels s", "CGAL s",
                           "ratio");
}

// A closed curve with bumps, the same for every program and run: the outline of a lumpy ball.
Ring bumpy_ring(std::size_t view, std::size_t vertices) {
  Ring ring;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(vertices);
    const double phase = 1.7 * static_cast<double>(view);
    const double radius = 180 + 22 * std::sin(5 * angle + phase) + 9 * std::sin(13 * angle - 2 * phase) +
                          4 * std::sin(37 * angle + 3 * phase);
    ring.push_back(Point2::from_doubles(std::round(16 * (320 + radius * std::cos(angle))) / 16,
                                        std::round(16 * (240 + radius * std::sin(angle))) / 16));
  }
  return ring;
}

// A camera at distance 10 on a spiral over the sphere that looks at the origin, rounded to six decimals.
Camera spiral_camera(std::size_t index, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(index) + 1) / static_cast<double>(count);
  const double angle = 2.399963 * static_cast<double>(index);
  const double r = std::sqrt(1 - z * z);
  const std::array<double, 3> forward{-r * std::cos(angle), -r * std::sin(angle), -z};
  const std::array<double, 3> right{-std::sin(angle), std::cos(angle), 0};
  const std::array<double, 3> down{forward[1] * right[2] - forward[2] * right[1],
                                   forward[2] * right[0] - forward[0] * right[2],
                                   forward[0] * right[1] - forward[1] * right[0]};
  const auto decimal = [](double value) { return nef::parse_rational(fmt::format("{:.6f}", value)); };
  const Matrix3 k{{{800, 0, 320}, {0, 800, 240}, {0, 0, 1}}};
  Matrix3 rotation;
  for (std::size_t j = 0; j < 3; ++j) {
    rotation[0][j] = decimal(right[j]);
    rotation[1][j] = decimal(down[j]);
    rotation[2][j] = decimal(forward[j]);
  }
  return Camera::from_parts(std::to_string(index), k, rotation, {0, 0, 10});
}

Scene synthetic(std::size_t views, std::size_t vertices) {
  Scene scene;
  for (std::size_t i = 0; i < views; ++i) {
    View view;
    view.name = std::to_string(i);
    view.camera = spiral_camera(i, views);
    view.polygons = std::vector<Ring>{bumpy_ring(i, vertices)};
    scene.views.push_back(std::move(view));
  }
  scene.box = WorldBox{{-5, -5, -5}, {5, 5, 5}};
  return scene;
}

void measure(const std::string& name, const Scene& scene, const std::filesystem::path& folder, const Settings& settings,
             double simplify) {
  Options options;
  options.silhouette.simplify.tolerance = simplify;
  Result result = compute(scene, folder, options);
  Row row{name, result.views.size(), 0, 0, 0, nef::counts(result.hull), 0};
  std::vector<Part> parts;
  for (const ViewResult& view : result.views) row.polygon_vertices += view.silhouette.region.vertex_count();
  row.cones = seconds_of([&] {
    for (const ViewResult& view : result.views) {
      const auto& axis = view.camera.matrix()[2];
      parts.push_back({make_cone(view.camera, view.silhouette.region, result.box, {}), {axis[0], axis[1], axis[2]}});
    }
  });
  parts.push_back({nef::make_box(result.box.low, result.box.high), {}});
  std::vector<DirectView> inputs;
  for (const ViewResult& view : result.views) inputs.push_back({&view.camera, &view.silhouette.region});
  // As the program does it; --cones shows the general way instead.
  const bool direct = result.direct && !settings.cones;
  const auto operation = [&] {
    if (direct) {
      static_cast<void>(direct_hull(inputs, *result.enclosing, {}));
    } else {
      static_cast<void>(intersect_parts(parts));
    }
  };
  std::vector<double> times;
  do {
    times.push_back(seconds_of(operation));
  } while (static_cast<int>(times.size()) < settings.repeat && static_cast<double>(times.size()) * times[0] < 10);
  std::sort(times.begin(), times.end());
  row.operation = times[times.size() / 2];
  std::string peer = fmt::format("{:>11}  {:>7}", "-", "-");
#ifdef NEF_BENCH_CGAL
  if (row.operation * 1000 < settings.peer_limit) {
    const PeerResult cgal = intersect_with_cgal(result.views, result.box);
    const bool same = cgal.vertices == row.counts.vertices && cgal.facets == row.counts.facets;
    peer = fmt::format("{:>11.4f}  {:>7.1f}{}", cgal.seconds, cgal.seconds / row.operation,
                       same ? "" : fmt::format("  CGAL counts {} vertices, {} facets", cgal.vertices, cgal.facets));
  }
#endif
  std::string voxels = "-";
  if (settings.voxels > 0) {
    const std::vector<cv::Mat> masks = drawn_masks(result, kWidth, kHeight);
    voxels = fmt::format("{:.3f}", seconds_of([&] { static_cast<void>(carve(masks, result, settings.voxels)); }));
  }
  std::cout << fmt::format("{:<26}  {:>5}  {:>8}  {:>9.4f}  {:>11.5f}  {:>9}  {:>9}  {:>6}  {:>8}  {}", row.name,
                           row.views, row.polygon_vertices, row.cones, row.operation, row.counts.vertices,
                           row.counts.facets, direct ? "direct" : "cones", voxels, peer)
            << std::endl;
}

void run(const Settings& settings) {
  print_header();
  const std::filesystem::path letters = std::filesystem::path(NEF_SOURCE_DIR) / "data/visual_hull/letters/nef.vsh";
  measure("letters N E F", read_scene(letters), letters.parent_path(), settings, 0);
  const std::filesystem::path mpi = letters.parent_path() / "mpi.vsh";
  measure("letters M P I", read_scene(mpi), mpi.parent_path(), settings, 0);
  measure("8 views of 200", synthetic(8, 200), {}, settings, 0);
  if (settings.growth) {
    for (const std::size_t views : {4, 8, 16, 32, 64, 128}) {
      measure(fmt::format("{} views of 100", views), synthetic(views, 100), {}, settings, 0);
    }
    for (const std::size_t vertices : {25, 50, 100, 200, 400, 800}) {
      measure(fmt::format("8 views of {}", vertices), synthetic(8, vertices), {}, settings, 0);
    }
  }
  for (const std::string& name : settings.scenes) {
    const std::filesystem::path file(name);
    measure(file.parent_path().filename().string() + "/" + file.filename().string(), read_scene(file),
            file.parent_path(), settings, settings.simplify);
  }
  std::cout << fmt::format("peak memory {} MiB\n", nef::peak_memory_bytes() >> 20U);
}

}  // namespace
}  // namespace nef::visual_hull::bench

int main(int argc, char** argv) {
  nef::keep_freed_memory();
  nef::visual_hull::bench::Settings settings;
  bool no_growth = false;
  CLI::App app{"Times of the visual hull's intersection, beside CGAL where it is installed"};
  app.add_option("SCENES", settings.scenes, "Further scenes to measure");
  app.add_option("--simplify", settings.simplify, "Tolerance for these, in pixels");
  app.add_option("--repeat", settings.repeat, "Runs per case (median)");
  app.add_option("--cgal-limit", settings.peer_limit, "Leave CGAL out where it may take longer (seconds)");
  app.add_option("--voxels", settings.voxels, "Voxels along each side; 0: no carving");
  app.add_flag("--cones", settings.cones, "Always intersect cones, never go vertex by vertex");
  app.add_flag("--no-growth", no_growth, "Leave out the tables of growth");
  CLI11_PARSE(app, argc, argv);
  settings.growth = !no_growth;
  try {
    nef::visual_hull::bench::run(settings);
  } catch (const std::exception& error) {
    std::cerr << "nef_bench_visual_hull: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
