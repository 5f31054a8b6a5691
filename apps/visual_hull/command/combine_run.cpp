// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/combine_run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <iostream>

#include "apps/program/run_program.h"
#include "apps/visual_hull/combine/combine.h"
#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/formats/write_scene.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::visual_hull {
namespace {

nef::Json series_json(const PlacedSeries& series) {
  const Placement& p = series.placement;
  const refine::Similarity map = p.to_first();
  nef::Json rotation = nef::Json::array();
  for (int i = 0; i < 3; ++i) rotation.push_back({map.rotation(i, 0), map.rotation(i, 1), map.rotation(i, 2)});
  return {{"scene", series.name},
          {"views", series.views},
          {"fits", p.fits()},
          {"ambiguous", p.ambiguous()},
          {"rotation", std::move(rotation)},
          {"scale", map.scale},
          {"scaled", p.scaled},
          {"translation", {map.shift.x(), map.shift.y(), map.shift.z()}},
          {"alone_px", p.alone_px},
          {"together_px", p.together_px},
          {"held_out_px", p.held_out_px},
          {"runner_up_px", std::isfinite(p.runner_up_px) ? nef::Json(p.runner_up_px) : nef::Json(nullptr)}};
}

std::string series_text(const PlacedSeries& series) {
  const Placement& p = series.placement;
  const double turned = Eigen::AngleAxisd(p.map.rotation).angle() * 180 / M_PI;
  return fmt::format(
      "{}: {} views, turned by {:.2f} degrees, {}; its outlines and those before it are off by {:.3f} px, "
      "within each series by {:.3f} px",
      series.name, series.views, turned,
      p.scaled ? fmt::format("its lengths times {:.5g}", 1 / p.map.scale) : "same unit of length", p.together_px,
      p.alone_px);
}

int run(const Arguments& a, const std::vector<std::string>& scenes) {
  nef::Session& session = a.session;
  const nef::Stopwatch working;
  const Combined found = combine({scenes.begin(), scenes.end()}, to_options(a));
  session.spent("op", working.seconds());
  session.note_all(found.notes);
  for (const PlacedSeries& series : found.series) {
    if (series.placement.fits()) continue;
    session.complain(
        fmt::format("{}: no place found: the outlines of both series are off by {:.2f} px at best, within "
                    "each by {:.2f} px; are these the same rigid object, and its masks and cameras right?",
                    series.name, series.placement.together_px, series.placement.alone_px));
  }
  const nef::Stopwatch writing;
  if (found.fits()) write_scene_file(session.output, found.scene);
  session.spent("write", writing.seconds());
  if (session.json || !session.report.empty()) {
    nef::Json report{{"views", found.scene.views.size()}, {"series", nef::Json::array()}};
    for (const PlacedSeries& series : found.series) report["series"].push_back(series_json(series));
    session.print("combined", report);
  }
  if (!found.fits()) return nef::kNo;
  for (const PlacedSeries& series : found.series) session.say(series_text(series));
  session.say(understood(found.scene));
  return nef::kYes;
}

}  // namespace

int run_combine_command(int argc, char** argv) {
  nef::Session session("visual_hull", std::cout, std::cerr);
  const nef::ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = session.monitor.telling(show);
  Arguments a(session);
  std::vector<std::string> scenes;
  CLI::App app(
      "Combines series of photographs of one rigid object that was turned over in between, by their silhouettes: one "
      "scene, in the space of the first, whose hull is the intersection of the hulls of all series.");
  app.name("visual_hull combine");
  app.footer(
      "A series that fits nowhere is named, and nothing is written. Exit codes: 0 success, 1 a series fits nowhere, 2 "
      "bad input or usage.");
  app.add_option("SCENES", scenes, "Two scenes or more, one for each pose, with their images")->required();
  app.add_option("-o,--output", session.output, "The scene with all cameras, and the paths of the images")
      ->required()
      ->type_name("SCENE.json");
  add_mask_options(app, a);
  app.add_option("--report", session.report, "Write a report as JSON ('-': standard output)")->type_name("FILE.json");
  nef::add_run_flags(&app, session);
  return nef::run_program(
      app, argc, argv, [&] { return run(a, scenes); }, [&](const std::string& line) { session.complain(line); });
}

}  // namespace nef::visual_hull
