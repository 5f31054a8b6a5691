// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/calibrate_run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/program/run_program.h"
#include "apps/program/session.h"
#include "apps/visual_hull/calibrate/board_sheet.h"
#include "apps/visual_hull/calibrate/calibrate.h"
#include "apps/visual_hull/command/photographs.h"
#include "apps/visual_hull/formats/write_scene.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

const char* const kBoardHelp =
    "charuco:COLUMNSxROWS,SQUARE,MARKER,DICTIONARY: squares of the chessboard, their side, that of the markers in them "
    "(mm unless m, cm or in follows), and OpenCV's dictionary (DICT_4X4 to DICT_7X7)";

/// The command lines.
struct BoardArguments {
  nef::Session session{"visual_hull", std::cout, std::cerr};
  std::string board = kUsualBoard;
};

struct CalibrateArguments : BoardArguments {
  std::vector<std::string> photographs;
  std::vector<std::string> lens;
};

int run_board(BoardArguments& a) {
  const Board board = parse_board(a.board);
  nef::write_file(a.session.output, board_file(board, fs::path(a.session.output).extension().string()));
  a.session.say(fmt::format("{}: {:g} x {:g} mm", board.text(), board.width(), board.height()));
  return nef::kYes;
}

nef::Json calibrated_json(const CalibratedView& view) {
  nef::Json entry{{"photograph", view.photograph.string()}, {"corners", view.corners}};
  if (view.refused.empty()) {
    entry["borders"] = view.borders;
    entry["error_px"] = view.error_px;
  } else {
    entry["refused"] = view.refused;
  }
  return entry;
}

nef::Json calibration_report(const Calibration& calibration, const Board& board) {
  const BoardLens& lens = calibration.lens;
  nef::Json report{{"board", board.text()},
                   {"error_px", calibration.error_px},
                   {"camera_error_px", calibration.scene().camera_error.value_or(0)},
                   {"lens",
                    {{"focal_px", {lens.lens.fx, lens.lens.fy}},
                     {"focal_deviation", lens.focal_share},
                     {"principal_point", {lens.lens.cx, lens.lens.cy}},
                     {"principal_point_assumed", lens.centred},
                     {"distortion", lens.lens.distortion},
                     {"error_px", lens.error_px}}},
                   {"views", nef::Json::array()},
                   {"lens_views", nef::Json::array()}};
  for (const CalibratedView& view : calibration.views) report["views"].push_back(calibrated_json(view));
  for (const CalibratedView& view : calibration.lens_views) report["lens_views"].push_back(calibrated_json(view));
  return report;
}

void say_views(nef::Session& session, const Calibration& calibration) {
  for (const CalibratedView& view : calibration.views) {
    if (!view.refused.empty()) continue;
    session.say(fmt::format("{}: {} corners, {} places on borders, off by {:.3f} pixels",
                            view.photograph.filename().string(), view.corners, view.borders, view.error_px));
  }
  const Lens& lens = calibration.lens.lens;
  session.say(fmt::format("focal length {:.1f} pixels (standard deviation {:.2g} %), principal point {:.1f}, {:.1f}",
                          lens.fx, 100 * calibration.lens.focal_share, lens.cx, lens.cy));
  session.say(understood(calibration.scene()));
}

int run_calibrate(CalibrateArguments& a) {
  nef::Session& session = a.session;
  const Board board = parse_board(a.board);
  const std::vector<fs::path> photographs = photographs_of(a.photographs);
  session.show_phase("looking for the board", 0, photographs.size());
  const nef::Stopwatch working;
  const Calibration found = calibrate(photographs, board, photographs_of(a.lens), session.monitor);
  session.spent("op", working.seconds());
  session.note_all(found.notes);
  const nef::Stopwatch writing;
  write_scene_file(session.output, found.scene());
  session.spent("write", writing.seconds());
  if (session.json || !session.report.empty()) session.print("calibration", calibration_report(found, board));
  say_views(session, found);
  return nef::kYes;
}

}  // namespace

int run_board_command(int argc, char** argv) {
  BoardArguments a;
  CLI::App app("Makes a board for the calibration of cameras. Print it at 100 % and measure the line below it.");
  app.name("visual_hull board");
  app.add_option("-o,--output", a.session.output, "The sheet; a PNG contains the board only")
      ->required()
      ->type_name("FILE.pdf|svg|png");
  app.add_option("--board", a.board, kBoardHelp)->type_name("BOARD")->capture_default_str();
  nef::add_run_flags(&app, a.session);
  return nef::run_program(
      app, argc, argv, [&a] { return run_board(a); }, [&a](const std::string& line) { a.session.complain(line); });
}

int run_calibrate_command(int argc, char** argv) {
  CalibrateArguments a;
  CLI::App app(
      "Finds the cameras, in millimetres, of photographs of an object that lies on a board or turns with it. The "
      "origin is "
      "the middle of the sheet; z points up.");
  app.name("visual_hull calibrate");
  app.footer(
      "Photographs that are left out are named on stderr, with the reason. Exit codes: 0 success, 2 bad input or "
      "usage.");
  app.add_option("PHOTOGRAPHS", a.photographs, "A folder of photographs, or files")->required();
  app.add_option("-o,--output", a.session.output, "The scene with the cameras and the names of the photographs")
      ->required()
      ->type_name("SCENE.json");
  app.add_option("--board", a.board, kBoardHelp)->type_name("BOARD")->capture_default_str();
  app.add_option("--lens", a.lens,
                 "Photographs (a folder or files) of the board at several tilts, by the same camera at the same zoom "
                 "and focus, "
                 "which determine the lens")
      ->type_name("PHOTOGRAPHS");
  app.add_option("--report", a.session.report, "Write a report as JSON ('-': standard output)")->type_name("FILE.json");
  nef::add_run_flags(&app, a.session);
  return nef::run_program(
      app, argc, argv, [&a] { return run_calibrate(a); }, [&a](const std::string& line) { a.session.complain(line); });
}

}  // namespace nef::visual_hull
