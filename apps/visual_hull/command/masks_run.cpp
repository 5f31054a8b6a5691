// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/masks_run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <set>

#include "apps/program/run_program.h"
#include "apps/program/session.h"
#include "apps/visual_hull/command/arguments.h"
#include "apps/visual_hull/command/photographs.h"
#include "apps/visual_hull/command/pictures/mask_overview.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "apps/visual_hull/masks/cut_out.h"
#include "apps/visual_hull/silhouette/opacity.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

/// The command line.
struct MaskArguments {
  nef::Session session{"visual_hull", std::cout, std::cerr};
  std::vector<std::string> photographs;
  std::string mask = "auto";
  bool soft = false;
  std::string overview;
};

// DIR/NAME.png for each photograph. Names that would meet, or would be those of the photographs themselves, are
// refused.
std::vector<fs::path> targets_of(const std::vector<fs::path>& photographs, const fs::path& folder) {
  std::vector<fs::path> targets;
  std::set<fs::path> seen;
  for (const fs::path& file : photographs) {
    targets.push_back(folder / (file.stem().string() + ".png"));
    if (!seen.insert(targets.back()).second) {
      throw nef::InputError(file.string() +
                            ": another photograph has the same name, so one mask would replace the other");
    }
    std::error_code error;
    if (fs::equivalent(file, targets.back(), error)) {
      throw nef::InputError("-o " + folder.string() + ": the mask would replace the photograph " + file.string());
    }
  }
  return targets;
}

void write_picture(const fs::path& file, const cv::Mat& picture) { nef::write_file(file.string(), png_of(picture)); }

void write_masks(const CutOuts& cut, const std::vector<fs::path>& photographs, const std::vector<fs::path>& targets,
                 const std::string& overview) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    cv::Mat picture;
    cv::cvtColor(cut.masks[i], picture, cv::COLOR_GRAY2BGR);
    write_picture(targets[i], picture);
  }
  std::vector<cv::Mat> objects;
  for (const cv::Mat& mask : cut.masks) objects.push_back(object_of(mask));
  write_picture(overview, mask_overview(photographs, objects));
}

nef::Json report_of(const CutOuts& cut, const std::vector<fs::path>& photographs) {
  nef::Json report{{"chosen", cut.chosen}, {"masks", nef::Json::array()}};
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    const cv::Mat& mask = cut.masks[i];
    report["masks"].push_back(
        {{"photograph", photographs[i].string()},
         {"share", static_cast<double>(cv::countNonZero(object_of(mask))) / static_cast<double>(mask.total())},
         {"quality", cut.quality[i]}});
  }
  return report;
}

int run(MaskArguments& a) {
  nef::Session& session = a.session;
  MaskMethod method = parse_mask_method(a.mask);
  method.soft = a.soft;
  const std::vector<fs::path> photographs = photographs_of(a.photographs);
  const fs::path folder = session.output;
  const std::vector<fs::path> targets = targets_of(photographs, folder);
  // In a folder of its own: the masks alone are the images of theirs.
  if (a.overview.empty()) a.overview = (folder / "overview" / "masks.png").string();
  session.show_phase("cutting out", 0, photographs.size());
  const nef::Stopwatch cutting;
  const CutOuts cut = cut_out(photographs, method, session.monitor);
  session.spent("op", cutting.seconds());
  session.note_all(cut.notes);
  make_folder("-o", folder);
  const fs::path beside = fs::path(a.overview).parent_path();
  if (!beside.empty()) make_folder("--overview", beside);
  session.show_phase("writing " + session.output);
  const nef::Stopwatch writing;
  write_masks(cut, photographs, targets, a.overview);
  session.spent("write", writing.seconds());
  if (session.json || !session.report.empty()) session.print("masks", report_of(cut, photographs));
  session.say(fmt::format("{} masks by {}; all of them in one picture: {}", cut.masks.size(), cut.chosen, a.overview));
  return nef::kYes;
}

}  // namespace

int run_masks_command(int argc, char** argv) {
  MaskArguments a;
  CLI::App app("Makes masks of photographs of one object: white where the object is, by one method for all of them.");
  app.name("visual_hull masks");
  app.footer(
      "Each mask is DIR/NAME.png. Masks to check are named on stderr: no object, an odd size, an outline that\n"
      "hardly separates anything. Exit codes: 0 success, 2 bad input or usage.");
  app.add_option("PHOTOGRAPHS", a.photographs, "A folder of photographs, or files")->required();
  app.add_option("-o,--output", a.session.output, "Directory for the masks")->required()->type_name("DIR");
  app.add_option("--mask", a.mask, mask_help())->type_name("METHOD")->capture_default_str();
  app.add_flag("--soft", a.soft,
               "Shades of grey along the outlines, for visual_hull --soft: outlines to a fraction of a pixel (not from "
               "grabcut)");
  app.add_option("--overview", a.overview,
                 "A picture of all masks over their photographs (default: DIR/overview/masks.png)")
      ->type_name("FILE.png");
  app.add_option("--report", a.session.report, "Write a report as JSON ('-': standard output)")->type_name("FILE.json");
  nef::add_run_flags(&app, a.session);
  return nef::run_program(
      app, argc, argv, [&a] { return run(a); }, [&a](const std::string& line) { a.session.complain(line); });
}

}  // namespace nef::visual_hull
