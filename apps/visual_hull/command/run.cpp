// SPDX-License-Identifier: Apache-2.0
//
// One run: parse, read the scene, compute, write the files, print the report, and conclude with the exit code. Output
// for people goes to standard output, and to stderr if the report is to have standard output for itself.
#include "apps/visual_hull/command/run.h"

#include <cstdio>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/command/frames.h"
#include "apps/visual_hull/command/hull_file.h"
#include "apps/visual_hull/command/overlay.h"
#include "apps/visual_hull/command/pictures.h"
#include "apps/visual_hull/command/report.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/program/notes.h"
#include "nef/program/progress_bar.h"
#include "nef/program/run_program.h"
#include "nef/program/run_report.h"

namespace visual_hull {
namespace {

namespace fs = std::filesystem;

constexpr int kDone = 0;
constexpr int kBad = 2;  // bad input or usage
constexpr int kNo = 1;   // the hull is empty or flat, or --verify failed

void complain(const std::string& text) { std::cerr << "visual_hull: " << nef::one_line(text) << "\n"; }

void write_text(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text;
  } else {
    nef::write_file(path, text);
  }
}

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
void tell_suspects(const Arguments& a, const Result& result, std::ostream& say) {
  if (!a.quiet) nef::print_notes(std::cerr, "visual_hull", verdict_lines(result));
  if (a.quiet || a.json || !result.consistency) return;
  for (const std::string& line : suspects_table(result)) say << line << "\n";
}

// What is understood, without a hull.
int check_scene(const Arguments& a, const Scene& scene) {
  std::vector<fs::path> images;
  std::string missing;
  nef::Messages notes;
  try {
    images = images_of(scene, scene_folder(a.scene),
                       a.images.empty() ? std::nullopt : std::optional<fs::path>(a.images), &notes);
  } catch (const nef::Error& error) {
    missing = error.what();
  }
  std::cout << understood(scene) << "\n";
  for (const std::string& line : view_lines(scene, images)) std::cout << line << "\n";
  if (!a.quiet) nef::print_notes(std::cerr, "visual_hull", notes);
  if (missing.empty()) return kDone;
  complain(missing);
  return kBad;
}

// Tells people what has come out; the exit code.
int conclude(const Arguments& a, const Scene& scene, const Result& result) {
  const bool talk = !a.quiet && !a.json;
  std::ostream& say = a.report == "-" ? std::cerr : std::cout;
  if (talk) say << understood(scene) << "\n";
  if (talk && result.box_found && !result.vanished) say << "box found: --box=" << box_text(result.box) << "\n";
  tell_suspects(a, result, say);
  if (result.vanished) {
    complain(vanished_text(result));
    return kNo;
  }
  if (talk) say << summary(result, a.threads) << "\n";
  bool inside = true;
  for (const ViewResult& view : result.views) {
    if (!view.verification) continue;
    const Verification& v = *view.verification;
    inside = inside && v.inside;
    if (!v.inside) complain("view " + view.name + ": not inside: " + v.problem);
    if (!talk) continue;
    say << "view " << view.name << ": " << (v.inside ? "inside" : "NOT inside");
    if (v.area_known) say << ", differs by " << v.difference_area << " of " << v.silhouette_area << " square pixels";
    say << "\n";
  }
  return inside ? kDone : kNo;
}

// What is asked for, into files; returns what is to be known of that of the hull. A hull that vanished has pictures of
// its views only.
WrittenHull write_files(const Arguments& a, const Result& result, nef::ProgressBar& bar, nef::Messages& notes,
                        const nef::Monitor& monitor) {
  WrittenHull written;
  const auto step = [&](const std::string& target, bool solid, const std::function<void()>& write) {
    if (target.empty() || (solid && result.vanished)) return;
    bar.show("write " + target);
    write();
  };
  step(a.output, true, [&] { written = write_hull(a.output, result, a, notes, monitor); });
  step(a.overlay, false, [&] { write_overlays(result, result.origin, a.overlay); });
  step(a.preview, true, [&] { write_preview(result, a.preview, monitor); });
  step(a.page, true, [&] { write_page(result, result.origin, a.page, monitor); });
  return written;
}

void check_page_name(const std::string& page) {
  if (!page.empty() && fs::path(page).extension() != ".html") {
    throw nef::InputError("--page " + page + ": the extension must be .html");
  }
}

int run(const Arguments& a) {
  check_output(a);
  if (!a.frames.empty()) return make_frames(a);
  check_page_name(a.page);
  nef::ProgressBar bar(!a.quiet);
  const Options options = to_options(a);
  const Scene scene = scene_of(a);
  if (a.check) return check_scene(a, scene);
  Result result = compute(scene, scene_folder(a.scene), options,
                          [&bar](Phase phase, const std::string& view, std::size_t done, std::size_t total) {
                            bar.show(std::string(phase_name(phase)) + " " + view, done, total);
                          });
  nef::Messages about = result.notes;
  if (const auto note = cut_note(result)) about.push_back(*note);
  WrittenHull written;
  timed(result.phases, Phase::kWrite, {},
        [&](const nef::Monitor& monitor) { written = write_files(a, result, bar, about, monitor); });
  bar.clear();
  nef::Notes notes("visual_hull", std::cerr, a.quiet);
  notes.note(about);
  notes.wrote(a.output, written.file);
  if (!a.report.empty() || a.json) {
    bar.show("write report");
    nlohmann::ordered_json report = make_report(result, notes.list(), a.exact_volume);
    if (written.decimated) report["decimated"] = decimation_json(*written.decimated);
    notes.add_offsets(report);
    const std::string text = nef::report_text(report);
    bar.clear();
    if (!a.report.empty()) write_text(a.report, text);
    if (a.json && a.report != "-") write_text("-", text);
  }
  bar.clear();
  if (!a.quiet && !a.json && written.decimated) {
    (a.report == "-" ? std::cerr : std::cout) << decimation_text(*written.decimated) << "\n";
  }
  return conclude(a, scene, result);
}

}  // namespace

int run_command(int argc, char** argv) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // errors are ours to tell
  cv::setNumThreads(1);                                                   // threads have whole views to work on
  Arguments arguments;
  CLI::App app{
      "Exact visual hulls from calibrated silhouettes: a closed solid, in rational numbers, without tolerance."};
  add_options(app, arguments);
  return nef::run_program(app, argc, argv, [&arguments] { return run(arguments); });
}

}  // namespace visual_hull
