// SPDX-License-Identifier: Apache-2.0
//
// How near --refine comes to the truth: unions of ellipsoids are rendered, all cameras are turned by half a degree and
// shifted by 5 pixels, the focal length by 1 %, and refined by the silhouettes. Differences in pixels are up to a
// similarity of space, volumes are those of the hulls of refined and true cameras.
//
//   nef_bench_refine [--views N] [--sets N] [--turntable]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "nef/base/timing/stopwatch.h"
#include "tests/visual_hull/refine/camera_difference.h"

int main(int argc, char** argv) {
  namespace rendered = nef::visual_hull::testing;
  CLI::App app("How near --refine comes to the truth, on rendered sets");
  int views = 10;
  unsigned sets = 20;
  bool turntable = false;
  app.add_option("--views", views, "Views of a set")->check(CLI::Range(3, 1000))->capture_default_str();
  app.add_option("--sets", sets, "Sets")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--turntable", turntable, "Cameras at one height instead of three");
  CLI11_PARSE(app, argc, argv);
  fmt::print(
      "| set | before, px | after, px | volume off by, % | model | CPU seconds |\n| --- | --- | --- | --- | --- | --- "
      "|\n");
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    const rendered::Set set = rendered::rendered_set(rendered::generic_object(seed), rendered::ring(views, turntable));
    const std::vector<rendered::Shot> given = rendered::disturbed(set.truth, 0.5, 5, 1.01, 7 * seed);
    const nef::ProcessStopwatch watch;
    const nef::visual_hull::refine::Refinement refined = rendered::refined_cameras(set, given);
    const double seconds = watch.seconds();
    const rendered::Difference after = rendered::difference(rendered::cameras_by(refined), set.truth);
    const double volume = rendered::volume_of_hull(set, rendered::cameras_by(refined)) / std::pow(after.scale, 3);
    const double truth = rendered::volume_of_hull(set, rendered::cameras_by(set.truth));
    fmt::print("| {} | {:.2f} | {:.3f} | {:+.2f} | {} | {:.2f} |\n", seed,
               rendered::difference(rendered::cameras_by(given), set.truth).pixels, after.pixels,
               100 * (volume / truth - 1), nef::visual_hull::refine::model_name(refined.model), seconds);
  }
  return 0;
}
