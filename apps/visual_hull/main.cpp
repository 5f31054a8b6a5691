// SPDX-License-Identifier: Apache-2.0
//
// visual_hull SCENE [options]: the exact visual hull of calibrated silhouettes.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>

#include "apps/visual_hull/overlay.h"
#include "apps/visual_hull/progress.h"
#include "apps/visual_hull/report.h"
#include "apps/visual_hull/scene_json.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/io/polyhedron_file.h"

namespace {

namespace fs = std::filesystem;
using visual_hull::Phase;

constexpr int kDone = 0;
constexpr int kNo = 1;   // the hull is empty or flat, or --verify failed
constexpr int kBad = 2;  // bad input or usage

struct Arguments {
  std::string scene;
  std::string output;
  double simplify = 0;
  bool outer = false;
  std::string border = "outside";
  std::string box;
  std::string origin = "center";
  std::string threshold;
  bool invert = false;
  std::vector<std::string> silhouettes;
  std::string images;
  std::string overlay;
  std::string report;
  bool verify = false;
  bool quiet = false;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("SCENE", a.scene, "Cameras: JSON, Middlebury *_par.txt, text with 3x4 matrices, or .vsh")->required();
  app.add_option("-o,--output", a.output, "Write the hull (format by extension)");
  app.add_option("--simplify", a.simplify, "Simplify polygons within this many pixels")->check(CLI::NonNegativeNumber);
  app.add_flag("--outer", a.outer, "Simplified polygons contain the contour: the hull is an outer bound");
  app.add_option("--border", a.border,
                 "A silhouette that the image frame cuts ends there (outside) or may go on (unknown)")
      ->check(CLI::IsMember({"outside", "unknown"}));
  app.add_option("--box", a.box, "x0,y0,z0,x1,y1,z1: the part of space to look at; found from the cones if missing")
      ->type_name("BOX");
  app.add_option("--pixel-origin", a.origin,
                 "Whole image coordinates are the center or the upper left corner of a pixel")
      ->check(CLI::IsMember({"center", "corner"}));
  app.add_option("--threshold", a.threshold,
                 "N or otsu: brighter than this is object (default: half of the range, or alpha)");
  app.add_flag("--invert", a.invert, "The object is darker than the background");
  app.add_option("--silhouette", a.silhouettes,
                 "[VIEW=]FILE.json: polygons in place of a view's image; without VIEW for the views in their order")
      ->take_all();
  app.add_option("--images", a.images, "Directory whose images, by name, are those of the views in order");
  app.add_option("--overlay", a.overlay, "Directory for a picture per view: image, polygon, projection of the hull");
  app.add_option("--report", a.report, "Write a report as JSON ('-': standard output)");
  app.add_flag("--verify", a.verify, "Project the hull back into every view; exit code 1 if it is not inside");
  app.add_flag("-q,--quiet", a.quiet, "Print nothing but errors");
}

visual_hull::Options to_options(const Arguments& a) {
  visual_hull::Options options;
  options.silhouette.simplify = {a.simplify, a.outer};
  options.silhouette.border = a.border == "unknown" ? visual_hull::Border::kUnknown : visual_hull::Border::kOutside;
  options.silhouette.origin =
      a.origin == "corner" ? visual_hull::PixelOrigin::kCorner : visual_hull::PixelOrigin::kCenter;
  if (!a.threshold.empty()) options.silhouette.threshold = visual_hull::parse_threshold(a.threshold);
  options.silhouette.threshold.invert = a.invert;
  if (!a.box.empty()) options.box = visual_hull::parse_box(a.box);
  if (!a.images.empty()) options.images = a.images;
  options.verify = a.verify;
  return options;
}

// Replaces images by the polygons of --silhouette.
void take_silhouettes(visual_hull::Scene& scene, const std::vector<std::string>& arguments) {
  std::size_t position = 0;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    const std::string name = equals == std::string::npos ? "" : argument.substr(0, equals);
    const std::string file = equals == std::string::npos ? argument : argument.substr(equals + 1);
    visual_hull::View* target = nullptr;
    if (equals == std::string::npos) {
      if (position >= scene.views.size()) {
        throw nef::InputError("--silhouette " + file + ": the scene has only " + std::to_string(position) + " views");
      }
      target = &scene.views[position++];
    } else {
      for (visual_hull::View& view : scene.views) {
        if (view.name == name) target = &view;
      }
      if (target == nullptr) throw nef::InputError("--silhouette: the scene has no view '" + name + "'");
    }
    target->polygons = visual_hull::read_polygons(file);
    target->image.clear();
  }
}

void write_text(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text;
    return;
  }
  const std::string temporary = path + ".part";
  std::ofstream stream(temporary, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(temporary, path, error);
  if (!stream || error) {
    fs::remove(temporary, error);
    throw nef::InputError("cannot write " + path);
  }
}

std::string box_text(const visual_hull::WorldBox& box) {
  std::string text;
  for (const auto* corner : {&box.low, &box.high}) {
    for (const auto& c : *corner) {
      char number[40];
      std::snprintf(number, sizeof number, "%.10g", nef::nearest_double(c));
      text += (text.empty() ? "" : ",") + std::string(number);
    }
  }
  return text;
}

int conclude(const Arguments& a, const visual_hull::Result& result) {
  std::ostream& say = a.report == "-" ? std::cerr : std::cout;
  if (!a.quiet && result.box_found && !result.vanished) say << "box found: --box=" << box_text(result.box) << "\n";
  if (result.vanished) {
    std::cerr << "visual_hull: the hull is " << (result.hull.is_empty() ? "empty" : "flat") << ": it vanished at view "
              << result.vanished->view << ": " << result.vanished->reason << "\n";
    return kNo;
  }
  if (!a.quiet) say << visual_hull::summary(result) << "\n";
  bool inside = true;
  for (const visual_hull::ViewResult& view : result.views) {
    if (!view.verification) continue;
    const visual_hull::Verification& v = *view.verification;
    inside = inside && v.inside;
    if (!v.inside) std::cerr << "visual_hull: view " << view.name << ": not inside: " << v.problem << "\n";
    if (a.quiet) continue;
    say << "view " << view.name << ": " << (v.inside ? "inside" : "NOT inside");
    if (v.area_known) say << ", differs by " << v.difference_area << " of " << v.silhouette_area << " square pixels";
    say << "\n";
  }
  return inside ? kDone : kNo;
}

int run(const Arguments& a) {
  visual_hull::ProgressBar bar;
  const visual_hull::Options options = to_options(a);
  visual_hull::Scene scene = visual_hull::read_scene(a.scene);
  take_silhouettes(scene, a.silhouettes);
  visual_hull::Result result = visual_hull::compute(scene, fs::path(a.scene).parent_path(), options,
                                                    [&bar](Phase phase, const std::string& view, std::size_t done,
                                                           std::size_t total) { bar.show(phase, view, done, total); });
  bar.clear();
  visual_hull::timed(result.phases, Phase::kWrite, [&] {
    if (!a.output.empty() && !result.vanished) nef::write_polyhedron(a.output, result.hull);
    if (!a.overlay.empty()) visual_hull::write_overlays(result, options.silhouette.origin, a.overlay);
  });
  if (!a.report.empty()) write_text(a.report, visual_hull::make_report(result).dump(2) + "\n");
  return conclude(a, result);
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are ours to tell
  Arguments arguments;
  CLI::App app{
      "Exact visual hulls from calibrated silhouettes.\nExit codes: 0 done, 1 empty hull or failed --verify, 2 bad "
      "input or usage."};
  add_options(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "visual_hull: " << one_line(error.what()) << " (see --help)\n";
    return kBad;
  }
  try {
    return run(arguments);
  } catch (const std::bad_alloc&) {
    std::cerr << "visual_hull: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "visual_hull: " << one_line(error.what()) << "\n";
  }
  return kBad;
}
