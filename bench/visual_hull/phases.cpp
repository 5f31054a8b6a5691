// SPDX-License-Identifier: Apache-2.0
//
// The whole way of a hull, phase by phase, in processor seconds: from image files to a mesh file's bytes, and from
// masks in memory to a mesh in memory (HullStream); beside it voxel carving of the same masks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <opencv2/core.hpp>

#include "apps/program/reports/report.h"
#include "apps/visual_hull/command/report.h"
#include "apps/visual_hull/stream.h"
#include "bench/visual_hull/voxel_peer.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/query/measure.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::visual_hull::bench {
namespace {

struct Settings {
  int repeat = 5;
  double simplify = 1;
  int voxels = 256;
  unsigned threads = 1;
  Way way = Way::kBest;
  std::vector<std::string> scenes;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double seconds_of(const std::function<void()>& work) {
  const nef::ProcessStopwatch watch;
  work();
  return watch.seconds();
}

void measure(const std::string& file, const Settings& settings) {
  const Scene scene = read_scene(file);
  Options options;
  options.silhouette.simplify.tolerance = settings.simplify;
  options.way = settings.way;
  options.monitor = nef::Monitor().on_threads(settings.threads);
  std::array<std::vector<double>, kPhaseCount> phases;
  std::vector<double> exports;
  std::vector<double> totals;
  Result result;
  for (int k = 0; k < settings.repeat; ++k) {
    totals.push_back(seconds_of([&] { result = compute(scene, scene_folder(file), options); }));
    for (std::size_t i = 0; i < kPhaseCount; ++i) phases[i].push_back(result.phases[i].cpu_seconds);
    exports.push_back(seconds_of([&] {
      nef::MeshExportOptions format;
      format.keep_polygons = format.only_quads = true;
      static_cast<void>(nef::off_bytes(nef::to_mesh(result.hull, format).mesh));
    }));
  }
  std::vector<cv::Mat> masks;
  SilhouetteOptions reading;
  reading.origin = result.origin;
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    masks.push_back(read_mask(result.views[i].image, scene.views[i].name, reading));
  }
  const HullStream stream(scene, options);
  std::vector<double> frames;
  for (int k = 0; k < settings.repeat; ++k) {
    frames.push_back(
        seconds_of([&] { static_cast<void>(nef::to_rounded_mesh(stream.frame(masks, options.monitor).hull)); }));
  }
  const auto phase = [&](Phase p) { return median(phases[static_cast<std::size_t>(p)]); };
  const std::filesystem::path path(file);
  std::cout << fmt::format(
      "{:<24} {:>5} {:>7} {:>7} {:>6} {:>7.4f} {:>8.4f} {:>7.4f} {:>7.4f} {:>7.4f} {:>7.4f} {:>7.4f} {:>8.4f}",
      path.parent_path().filename().string(), result.views.size(),
      [&] {
        std::size_t sum = 0;
        for (const ViewResult& view : result.views) sum += view.silhouette.region.vertex_count();
        return sum;
      }(),
      nef::counts(result.hull).vertices, result.direct ? "direct" : "cones", phase(Phase::kLoad),
      phase(Phase::kContours), phase(Phase::kBox), phase(Phase::kCones), phase(Phase::kIntersection), median(exports),
      median(totals) + median(exports), median(frames));
  if (settings.voxels > 0) {
    double volume = 0;
    const double seconds = seconds_of([&] { volume = carve(masks, result, settings.voxels); });
    std::cout << fmt::format(" {:>8.3f} {:>+8.2f} %", seconds,
                             100 * (volume / nef::approximate_volume(result.hull).value - 1));
  }
  std::cout << std::endl;
}

}  // namespace
}  // namespace nef::visual_hull::bench

int main(int argc, char** argv) {
  using nef::visual_hull::bench::measure;
  using nef::visual_hull::bench::Settings;
  Settings settings;
  std::string way = "best";
  CLI::App app{"Visual hulls phase by phase, beside voxel carving"};
  app.add_option("SCENES", settings.scenes, "Scenes with images")->required();
  app.add_option("--simplify", settings.simplify, "Tolerance in pixels")->capture_default_str();
  app.add_option("--repeat", settings.repeat, "Runs (medians)")->capture_default_str();
  app.add_option("--voxels", settings.voxels, "Voxels along each side; 0: no carving")->capture_default_str();
  app.add_option("--threads", settings.threads, "Threads of the hull")->capture_default_str();
  app.add_option("--way", way, "As of visual_hull")->check(CLI::IsMember({"best", "direct", "cones"}));
  CLI11_PARSE(app, argc, argv);
  if (way != "best") settings.way = way == "direct" ? nef::visual_hull::Way::kDirect : nef::visual_hull::Way::kCones;
  std::cout << fmt::format(
      "{:<24} {:>5} {:>7} {:>7} {:>6} {:>7} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>10}\n",
      "processor seconds", "views", "polygon", "hull", "way", "load", "contours", "box", "cones", "hull", "export",
      "whole", "frame", "voxels", "volume");
  try {
    for (const std::string& scene : settings.scenes) measure(scene, settings);
  } catch (const std::exception& error) {
    std::cerr << "nef_bench_hull_phases: " << error.what() << "\n";
    return 2;
  }
  std::cout << fmt::format("peak memory {} MiB\n", nef::peak_memory_bytes() >> 20U);
  return 0;
}
