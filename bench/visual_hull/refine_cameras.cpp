// SPDX-License-Identifier: Apache-2.0
//
// How near --refine comes to the truth: unions of ellipsoids are rendered, all cameras are turned by half a degree and
// shifted by 5 pixels, the focal length by 1 %, and refined by the silhouettes. Differences in pixels are up to a
// similarity of space, volumes are those of the hulls of refined and true cameras. With --damage all cameras but one
// are right: it is shifted by 2 pixels or turned by a degree, or its mask has lost 15 % of its height.
//
//   nef_bench_refine [--views N] [--sets N] [--turntable] [--damage shift|turn|cut]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "nef/base/timing/stopwatch.h"
#include "tests/visual_hull/refine/camera_difference.h"

namespace {

namespace rendered = nef::visual_hull::testing;
using nef::visual_hull::refine::Fault;

// A line for each set: whether the damaged view was named and no other, and how near cameras come.
void damage_one(int views, unsigned sets, bool turntable, const std::string& damage) {
  fmt::print("| set | damaged | named | other cameras, px | the damaged one, px |\n| --- | --- | --- | --- | --- |\n");
  unsigned right = 0;
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    rendered::Set set = rendered::rendered_set(rendered::generic_object(seed), rendered::ring(views, turntable));
    const std::size_t wrong = seed * 5 % static_cast<std::size_t>(views);
    std::vector<rendered::Shot> given = set.truth;
    if (damage == "cut") {
      rendered::cut_lowest(set, wrong, 0.15);
    } else {
      given[wrong] = rendered::standing_off(given[wrong], damage == "turn", seed);
    }
    const nef::visual_hull::refine::Refinement refined = rendered::refined_cameras(set, given);
    const Fault expected = damage == "cut" ? Fault::kMask : Fault::kCamera;
    std::string named;
    for (std::size_t i = 0; i < refined.views.size(); ++i) {
      const Fault fault = refined.views[i].fault;
      if (fault != Fault::kNone) named += fmt::format("{}{} ", i, fault == expected ? "" : " (the other fault)");
    }
    if (named == fmt::format("{} ", wrong)) ++right;
    const rendered::Difference after = rendered::difference(rendered::cameras_by(refined), set.truth, {wrong});
    fmt::print("| {} | {} | {}| {:.3f} | {:.3f} |\n", seed, wrong, named, after.pixels, after.views[wrong]);
  }
  fmt::print("\nnamed, and no other view: {} of {}\n", right, sets);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How near --refine comes to the truth, on rendered sets");
  int views = 10;
  unsigned sets = 20;
  bool turntable = false;
  app.add_option("--views", views, "Views of a set")->check(CLI::Range(3, 1000))->capture_default_str();
  app.add_option("--sets", sets, "Sets")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--turntable", turntable, "Cameras at one height instead of three");
  std::string damage;
  app.add_option("--damage", damage, "Of one view, the others being right")
      ->check(CLI::IsMember({"shift", "turn", "cut"}));
  CLI11_PARSE(app, argc, argv);
  if (!damage.empty()) {
    damage_one(views, sets, turntable, damage);
    return 0;
  }
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
