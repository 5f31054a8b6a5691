// SPDX-License-Identifier: Apache-2.0
//
// One run: parse, read the scene, compute, write the files, print the report, and conclude with the exit code. Output
// for people, notes and the report go through the session, as in all programs.
#include "apps/visual_hull/command/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "apps/program/nearest_word.h"
#include "apps/program/run_program.h"
#include "apps/view/picture.h"
#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/command/calibrate_run.h"
#include "apps/visual_hull/command/combine_run.h"
#include "apps/visual_hull/command/frames.h"
#include "apps/visual_hull/command/hull_file.h"
#include "apps/visual_hull/command/hull_masks.h"
#include "apps/visual_hull/command/masks_run.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "apps/visual_hull/command/pictures/pictures.h"
#include "apps/visual_hull/command/report.h"
#include "apps/visual_hull/formats/write_scene.h"
#include "apps/visual_hull/points/point_cloud.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

std::string box_text(const WorldBox& box) {
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

// Which view disagrees with the others; without a clear one the first three, without a verdict.
void tell_suspects(nef::Session& session, const Result& result) {
  session.note_all(verdict_lines(result));
  if (!result.consistency) return;
  for (const std::string& line : suspects_table(result)) session.say(line);
}

// What of the image is object, in words.
std::string silhouette_line(const ViewResult& view) {
  const ViewSilhouette& s = view.silhouette;
  std::string line = view.name + ": ";
  if (s.image_size.empty()) {
    line += fmt::format("polygons of {} vertices", s.region.vertex_count());
  } else {
    double twice = 0;
    for (const Ring& ring : s.region.rings) twice += twice_area(ring);
    const double share = twice / 2 / static_cast<double>(s.image_size.area());
    line += fmt::format("the object is {:.1f} % of the image", 100 * (s.background ? 1 - share : share));
  }
  const std::size_t pieces = s.contours - s.holes;
  if (pieces > 1) line += ", " + nef::counted(pieces, "piece", "pieces");
  if (s.holes > 0) line += ", " + nef::counted(s.holes, "hole", "holes");
  if (s.cut_by_frame) line += ", cut by the frame";
  return line;
}

// The silhouettes that a hull would be made of, in words and, if asked for, in pictures.
void show_silhouettes(const Arguments& a, const Scene& scene, const Options& options) {
  const Result result = silhouettes_of(scene, scene_folder(a.scene), options);
  a.session.note_all(result.notes);
  for (const ViewResult& view : result.views) std::cout << silhouette_line(view) << "\n";
  if (a.overlay.empty()) return;
  a.session.show_phase("writing " + a.overlay);
  write_overlays(result, result.origin, a.overlay);
}

// What is understood, without a hull.
int check_scene(const Arguments& a, const Scene& scene, const Options& options) {
  std::vector<fs::path> images;
  std::string missing;
  nef::Messages notes;
  try {
    images = images_of(scene, scene_folder(a.scene), images_folder(a), &notes);
  } catch (const nef::Error& error) {
    missing = error.what();
  }
  std::cout << understood(scene) << "\n";
  if (!scene.guessed) {
    for (const std::string& line : view_lines(scene, images)) std::cout << line << "\n";
  }
  if (!missing.empty()) {
    a.session.note_all(notes);
    a.session.complain(missing);
    return nef::kBad;
  }
  if (a.mask.empty() && a.overlay.empty()) {
    a.session.note_all(notes);
  } else {
    show_silhouettes(a, scene, options);  // with the same notes
  }
  return nef::kYes;
}

// Tells people what has come out; the exit code: kNo if the hull is empty or flat, or --verify failed.
int conclude(nef::Session& session, const Scene& scene, const Result& result) {
  session.say(understood(scene));
  if (result.box_found && !result.vanished) session.say("box found: --box=" + box_text(result.box));
  tell_suspects(session, result);
  if (result.vanished) {
    session.complain(vanished_text(result));
    return nef::kNo;
  }
  session.say(summary(result, session.monitor));
  bool inside = true;
  for (const ViewResult& view : result.views) {
    if (!view.verification) continue;
    const Verification& v = *view.verification;
    inside = inside && v.inside;
    if (!v.inside) session.complain("view " + view.name + ": not inside: " + v.problem);
    std::ostringstream line;
    line << "view " << view.name << ": " << (v.inside ? "inside" : "NOT inside");
    if (v.area_known) line << ", differs by " << v.difference_area << " of " << v.silhouette_area << " square pixels";
    session.say(line.str());
  }
  return inside ? nef::kYes : nef::kNo;
}

// The scene as it was used: refined cameras, and the images that were found, relative to the file.
void write_refined_scene(const Arguments& a, Scene scene, const Result& result) {
  const std::vector<fs::path> images = images_of(scene, scene_folder(a.scene), images_folder(a));
  scene.origin = result.origin;
  if (result.refinement->accepted) scene.camera_error.reset();  // it was that of other cameras
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    scene.views[i].camera = result.refinement->views[i].camera;
    if (!images[i].empty()) scene.views[i].image = images[i];
  }
  write_scene_file(a.refined_scene, std::move(scene));
}

// The files of a hull that has not vanished, but its mesh.
void write_hull_files(const Arguments& a, const Result& result, const nef::Monitor& monitor) {
  nef::Session& session = a.session;
  const HullColors colors = a.texture ? HullColors::kTexture : a.color ? HullColors::kVertices : HullColors::kPlain;
  const auto write = [&](const std::string& path, const std::function<void()>& work) {
    if (path.empty()) return;
    session.show_phase("writing " + path);
    work();
  };
  if (!a.page.empty() || !a.picture.empty()) {
    session.show_phase("drawing the hull");
    nef::view::Layer hull = hull_layer(result, result.origin, monitor, colors);
    write(a.picture, [&] { nef::view::write_picture({hull}, a.picture, {}); });
    write(a.page, [&] { write_page(result, result.origin, std::move(hull), a.page); });
  }
  write(a.hull_masks, [&] { write_hull_masks(result, a.hull_masks); });
  write(a.points, [&] {
    const PointCloud cloud = sample_hull(result, a.samples, monitor);
    session.note_all(cloud.notes);
    write_points(cloud, a.points);
  });
}

// What is asked for, into files; what there is to say of the mesh. A hull that vanished has pictures of its views only.
WrittenHull write_files(const Arguments& a, const Scene& scene, const Result& result, const nef::Monitor& monitor) {
  nef::Session& session = a.session;
  WrittenHull hull;
  if (!session.output.empty() && !result.vanished) {
    session.write(session.output, [&](nef::Messages& notes) {
      nef::PolyhedronWriteOptions format = session.write_options();
      format.monitor = monitor;
      hull = write_hull(session.output, result, a, format, notes);
      return hull.file;
    });
  }
  if (!a.overlay.empty()) {
    session.show_phase("writing " + a.overlay);
    write_overlays(result, result.origin, a.overlay);
  }
  if (!a.refined_scene.empty()) {
    session.show_phase("writing " + a.refined_scene);
    write_refined_scene(a, scene, result);
  }
  if (!result.vanished) write_hull_files(a, result, monitor);
  return hull;
}

void check_extension(const std::string& option, const std::string& file, const std::vector<std::string>& extensions) {
  if (file.empty()) return;
  const std::string extension = fs::path(file).extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  throw nef::InputError(option + " " + file + ": the extension must be " + nef::word_list(extensions, "or"));
}

void check_file_names(const Arguments& a) {
  check_extension("--page", a.page, {".html"});
  check_extension("--picture", a.picture, {".png"});
  check_extension("--points", a.points, {".ply", ".txt"});
}

int run(const Arguments& a) {
  nef::Session& session = a.session;
  check_output(a);
  if (!a.frames.empty()) return make_frames(a);
  check_file_names(a);
  if (!a.check) session.require_output();
  const Options options = to_options(a);
  const Scene scene = scene_of(a);
  if (a.check) return check_scene(a, scene, options);
  Result result = compute(scene, scene_folder(a.scene), options);
  session.note_all(result.notes);
  session.note_all(refinement_lines(result));
  if (const auto note = cut_note(result)) session.note(*note);
  WrittenHull written;
  timed(result.phases, Phase::kWrite, session.monitor,
        [&](const nef::Monitor& monitor) { written = write_files(a, scene, result, monitor); });
  if (!session.report.empty() || session.json) {
    session.show_phase("writing the report");
    tell_phases(session, result);
    nef::Json report = make_report(result, a.exact_volume);
    if (written.decimated) report["decimated"] = decimation_json(*written.decimated);
    if (written.texture) report["texture"] = texture_json(*written.texture);
    session.print("hull", report);
  }
  if (written.decimated) session.say(decimation_text(*written.decimated));
  return conclude(session, scene, result);
}

constexpr int kBadUsage = 2;

using Subcommand = int (*)(int argc, char** argv);
constexpr std::pair<const char*, Subcommand> kSubcommands[] = {{"masks", run_masks_command},
                                                               {"board", run_board_command},
                                                               {"calibrate", run_calibrate_command},
                                                               {"combine", run_combine_command}};

// A suggestion if a first word is almost a subcommand, and no scene.
std::string misspelt_subcommand(const std::string& word) {
  std::error_code error;
  if (word.empty() || std::filesystem::exists(word, error)) return {};
  std::vector<std::string> names;
  for (const auto& [name, run] : kSubcommands) names.emplace_back(name);
  return nef::did_you_mean(word, names);
}

}  // namespace

int run_command(int argc, char** argv) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are ours to tell
  cv::setNumThreads(1);                                                   // threads have whole views to work on
  const std::string first = argc > 1 ? argv[1] : "";
  nef::Session session("visual_hull", std::cout, std::cerr);
  for (const auto& [name, run_subcommand] : kSubcommands) {
    if (first != name) continue;
    const int code = run_subcommand(argc - 1, argv + 1);
    std::error_code error;
    if (code == kBadUsage && fs::is_directory(first, error)) {
      session.complain("'" + first + "' is a subcommand; if you mean the folder of this name, write ./" + first);
    }
    return code;
  }
  const nef::ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = session.monitor.telling(show);
  if (const std::string meant = misspelt_subcommand(first); !meant.empty()) {
    session.complain("there is no subcommand or file '" + first + "'" + meant + " (see visual_hull --help)");
    return kBadUsage;
  }
  Arguments arguments(session);
  CLI::App app{
      "Exact visual hulls from calibrated silhouettes: a closed solid, in rational numbers, without tolerance."};
  add_options(app, arguments);
  return nef::run_program(
      app, argc, argv, [&arguments] { return run(arguments); },
      [&session](const std::string& line) { session.complain(line); });
}

}  // namespace nef::visual_hull
