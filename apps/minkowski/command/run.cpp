// SPDX-License-Identifier: Apache-2.0
//
// One run: load the operands, change them as the flags say, call the function of the task with progress, then write the
// result, pictures and the report. Signals are held while files are written, so that each is whole or not there.
#include "apps/minkowski/command/run.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

#include "apps/minkowski/command/arguments.h"
#include "apps/minkowski/command/ball_words.h"
#include "apps/minkowski/command/preview.h"
#include "apps/minkowski/command/signals_held.h"
#include "apps/minkowski/command/write_cells.h"
#include "apps/minkowski/in_tiles.h"
#include "apps/minkowski/morphology.h"
#include "apps/minkowski/simplified/simplified_offset.h"
#include "apps/program/numbers.h"
#include "apps/program/reports/report.h"
#include "apps/program/run_program.h"
#include "apps/program/set_info.h"
#include "apps/program/tile_flags.h"
#include "apps/program/version.h"
#include "nef/base/counted.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/polyhedron_file.h"
#include "nef/number/brief_text.h"
#include "nef/operation/label_inputs.h"
#include "nef/polyhedron.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::minkowski {
namespace {

class Run {
 public:
  Run(Arguments& arguments, Task task) : a_(arguments), session_(arguments.session), task_(task) {
    options_.strategy = strategy(a_);
    session_.monitor = session_.monitor.telling(show_);
    options_.monitor = session_.monitor;
  }

  void run() {
    if (task_ == Task::kDecompose) {
      decompose_operand();
    } else if (task_ == Task::kPenetration) {
      tell_penetration();
    } else if (!a_.memory.empty()) {
      run_in_tiles();
    } else {
      finish(compute());
    }
  }

 private:
  void finish(const Polyhedron& result) {
    store(session_.output, result);
    preview(result);
    print_report([&] { return report(result); });
    session_.say(summary(result));
  }

  Polyhedron load(const std::string& path) { return session_.load(path); }

  // Writes a file by `write`, whose notes are shown.
  void write_timed(const std::string& path, const std::function<WrittenFile(Messages& notes)>& write) {
    const SignalsHeld held;
    session_.write(path, write);
  }

  void store(const std::string& path, const Polyhedron& result) {
    PolyhedronWriteOptions options = session_.write_options(path);
    const bool one_of_many = !(a_.touched.empty() && a_.untouched.empty() && a_.labels.empty());
    if (one_of_many && find_mesh_format(lower_extension(path)) == nullptr) options.manifold = options.recenter = false;
    const SignalsHeld held;
    session_.store_at(path, result, options);
  }

  void preview(const Polyhedron& result) {
    if (a_.preview.empty()) return;
    const SignalsHeld held;
    std::string title = name(task_);
    if (task_ == Task::kConfigurationSpace) title = "free_space";
    shown_.emplace_back(title, result);
    write_previews(a_.preview, shown_);
  }

  // R,N as an approximation of a ball, with what is reported of it.
  Polyhedron ball_tool() {
    const BallWords words = parse_ball(a_.ball, "--ball", std::nullopt);
    const Side side = a_.outer ? Side::kOuter : Side::kInner;
    const BallApproximation ball = ball_approximation(words.radius, words.splits, side);
    details_["ball"] = {{"side", side == Side::kInner ? "inner" : "outer"},
                        {"error", to_string(ball.error)},
                        {"vertices", ball.cell.mesh.vertices.size()}};
    tell_error("ball", side, ball.error);
    return to_polyhedron(ball.cell);
  }

  // For people; the report has the exact numbers.
  void tell_error(const std::string& what, Side side, const Rational& error) const {
    std::ostringstream line;
    line << what << ": " << (side == Side::kInner ? "inner" : "outer") << ", within " << nearest_double(error)
         << " of the round one";
    session_.say(line.str());
  }

  Polyhedron second_operand() {
    if (!a_.ball.empty()) return ball_tool();
    if (!a_.box_tool.empty()) {
      const std::vector<Rational> n = parse_numbers(a_.box_tool, 3, "--box-tool x,y,z");
      Rational3 low;
      for (std::size_t i = 0; i < 3; ++i) low[i] = n[i] / -2;
      for (const Rational& x : n) {
        if (sgn(x) < 0) throw InputError("an extent of a box must not be negative: " + brief_text(x));
      }
      return make_box(low, {Rational(-low[0]), Rational(-low[1]), Rational(-low[2])});
    }
    return load(a_.operands[1]);
  }

  Polyhedron compute() {
    switch (task_) {
      case Task::kConfigurationSpace:
        return free_space();
      case Task::kReach:
        return reached();
      case Task::kMillable:
        return milled();
      case Task::kOffset:
      case Task::kSweep:
      case Task::kHull:
        return of_one();
      default:
        return of_two();
    }
  }

  Polyhedron first_operand() {
    Polyhedron a = load(a_.operands[0]);
    if (a_.open_a) a = interior(a);
    shown_.emplace_back("a", a);
    return a;
  }

  Polyhedron of_one() {
    const Polyhedron a = first_operand();
    if (task_ == Task::kHull) return minkowski::hull(a);
    if (task_ == Task::kSweep) {
      std::vector<Rational3> path;
      for (const std::string& point : a_.sweep) path.push_back(parse_triple(point, "--sweep"));
      return sweep(a, path, options_, &report_);
    }
    return a_.decimate != 0 || a_.digits ? simplified_offset_of(a) : offset_of(a);
  }

  Polyhedron simplified_offset_of(const Polyhedron& a) {
    const auto [radius, splits] = parse_ball(a_.offset, "--offset", 8);
    const Side side = a_.inner ? Side::kInner : Side::kOuter;
    SimplifyOptions simplify{.triangles = std::nullopt, .digits = a_.digits};
    if (a_.decimate != 0) simplify.triangles = a_.decimate;
    SimplifiedOffset found = simplified_offset(a, radius, splits, side, simplify, options_, &report_);
    session_.note_all(found.notes);
    tell_offset(radius, side, found.error);
    return std::move(found.set);
  }

  void tell_offset(const Rational& radius, Side side, const Rational& error) {
    details_["offset"] = {
        {"radius", to_string(radius)}, {"side", side == Side::kInner ? "inner" : "outer"}, {"error", to_string(error)}};
    tell_error("offset", side, error);
  }

  // Of a set, in tiles or not.
  template <typename Set>
  Set offset_of(const Set& a) {
    const auto [radius, splits] = parse_ball(a_.offset, "--offset", 8);
    const Side side = a_.inner ? Side::kInner : Side::kOuter;
    if (sgn(radius) != 0) {
      tell_offset(radius, side, ball_approximation(abs(radius), splits, ball_side(sgn(radius), side)).error);
    }
    return offset(a, radius, splits, side, options_, &report_);
  }

  std::pair<Polyhedron, Polyhedron> both_operands() {
    Polyhedron a = first_operand();
    Polyhedron b = changed_second_operand();
    shown_.emplace_back("b", b);
    return {std::move(a), std::move(b)};
  }

  Polyhedron changed_second_operand() {
    Polyhedron b = second_operand();
    if (a_.hull_b) b = minkowski::hull(b);
    if (a_.open_b) b = interior(b);
    if (a_.negate_b) b = negate(b);
    return b;
  }

  Polyhedron of_two() {
    const auto [a, b] = both_operands();
    Polyhedron result = task_ == Task::kNoFit ? no_fit_set(a, b, options_, &report_) : combined(a, b);
    offer_hull(b);
    return result;
  }

  // A is cut into tiles, or is in tiles already, and so is the result.
  void run_in_tiles() {
    const std::string& path = a_.operands[0];
    const Tiling tiling = choose_tiles({.memory = a_.memory}, session_, path).tiling;
    TiledPolyhedron a = load_tiled(session_, path, tiling);
    if (a_.open_a) a = interior(a, session_.monitor);
    const TiledPolyhedron result = task_ == Task::kOffset ? offset_of(a) : combined(a, changed_second_operand());
    const SignalsHeld held;
    if (names_tile_folder(session_.output)) {
      tell_phases();
      finish_tiled(session_, name(task_), result, report_.seconds_total, base_report());
      return;
    }
    session_.show_phase("gluing");
    const Stopwatch watch;
    const Polyhedron whole = result.polyhedron(session_.monitor);
    session_.spent("glue", watch.seconds());
    finish(whole);
  }

  void offer_hull(const Polyhedron& b) {
    const std::optional<Rational> excess = excess_of_hull(b);
    if (!excess) return;
    session_.note("B is convex but for " + scientific(*excess) +
                  " of its volume; --hull-b uses its convex hull, a superset");
  }

  // Of a set, in tiles or not, and B.
  template <typename Set>
  Set combined(const Set& a, const Polyhedron& b) {
    switch (task_) {
      case Task::kErode:
        return erode(a, b, options_, &report_);
      case Task::kOpen:
        return opening(a, b, options_, &report_);
      case Task::kClose:
        return closing(a, b, options_, &report_);
      default:
        return minkowski_sum(a, b, options_, &report_);
    }
  }

  static std::string scientific(const Rational& value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0e", nearest_double(value));
    return text.data();
  }

  void tell_penetration() {
    const auto [a, b] = both_operands();
    const Penetration p = penetration(a, b, options_, &report_);
    const bool overlap = p.kind == Penetration::Kind::kOverlapping;
    const std::string kind(contact_name(p.kind));
    Json object = base_report();
    object["penetration"] = {{"kind", kind},
                             {"translation", point_json(p.translation)},
                             {"squared_length", to_string(p.squared_length)},
                             {"length", std::sqrt(nearest_double(p.squared_length))}};
    print_report([&] { return object; });
    std::ostringstream line;
    line << kind;
    if (p.kind != Penetration::Kind::kTouching) {
      line << ": move B by " << point_text(p.translation) << (overlap ? " to separate them" : " to contact") << " ("
           << std::sqrt(nearest_double(p.squared_length)) << ")";
    }
    session_.say(line.str());
  }

  Polyhedron reached() {
    const Polyhedron tool = load(a_.operands[0]);
    const Polyhedron part = load(a_.operands[1]);
    std::optional<Rational3> from;
    if (!a_.from.empty()) from = parse_triple(a_.from, "--from");
    const Reach found = reach(tool, part, from, options_, &report_);
    shown_ = {{"tool", tool}, {"part", part}, {"touched", found.touched}, {"untouched", found.untouched}};
    if (!a_.preview.empty()) {
      const SignalsHeld held;
      write_joint_preview(a_.preview, "labels", {{"touched", found.touched}, {"untouched", found.untouched}});
    }
    if (!a_.touched.empty()) store(a_.touched, found.touched);
    if (!a_.untouched.empty()) store(a_.untouched, found.untouched);
    if (!a_.labels.empty()) store_labels(part, found);
    details_["touched_area"] = surface_area(found.touched);
    details_["untouched_area"] = surface_area(found.untouched);
    return found.positions;
  }

  Polyhedron milled() {
    const auto [part, tool] = both_operands();
    const Approach approach = a_.axes == 3 ? Approach::kFromAbove : Approach::kAnywhere;
    const Millable found = millable(part, tool, approach, options_, &report_);
    details_["unreached"] = Json::array();
    for (const Polyhedron& region : found.unreached) {
      details_["unreached"].push_back(set_info(region, {.exact = a_.exact_volume, .bounds = true}));
    }
    if (!a_.labels.empty()) store_regions(found.unreached);
    session_.say(counted(found.unreached.size(), "region", "regions") + " beyond the part not reached by the tool");
    return found.shape;
  }

  // What the tool leaves beyond the part, face by face with the region that it bounds.
  void store_regions(const std::vector<Polyhedron>& regions) {
    const LabeledPolyhedron<InputSet> labeled = label_inputs(regions, session_.monitor);
    BoundaryGroups groups;
    groups.selected = [&](LabelId mark) { return mark < labeled.labels().size() && !labeled.label(mark).empty(); };
    groups.name = [&](LabelId inside, LabelId, LabelId) {
      return "region" + std::to_string(labeled.label(inside).front() + 1);
    };
    store_faces(labeled.polyhedron(), groups);
  }

  // The part's boundary, face by face with what the tool can do there.
  void store_labels(const Polyhedron& part, const Reach& found) {
    enum : LabelId { kBody = 1, kTouched = 2 };
    const Polyhedron labeled = overlay(closure(part), found.touched, [](LabelId body, LabelId touched) -> LabelId {
      return touched != 0 ? LabelId{kTouched} : body;
    });
    BoundaryGroups groups;
    groups.selected = [](LabelId mark) { return mark == kBody || mark == kTouched; };
    groups.name = [](LabelId, LabelId, LabelId facet) { return facet == kTouched ? "touched" : "untouched"; };
    store_faces(labeled, groups);
  }

  void store_faces(const Polyhedron& labeled, const BoundaryGroups& groups) {
    PolyhedronWriteOptions options = session_.write_options(a_.labels);
    options.manifold = false;  // which cuts faces, so that they can have no groups
    write_timed(a_.labels, [&](Messages& notes) {
      WrittenFile written;
      details_["faces"] = write_groups(a_.labels, labeled, groups, options, &notes, &written);
      return written;
    });
  }

  Polyhedron free_space() {
    const Polyhedron robot = load(a_.robot);
    const std::vector<Polyhedron> obstacles = session_.load_all(a_.obstacles);
    shown_ = {{"robot", robot},
              {"obstacles", a_.preview.empty() ? Polyhedron() : unite_all(obstacles, session_.monitor)}};
    std::optional<std::array<Rational3, 2>> box;
    if (!a_.box.empty()) {
      const std::vector<Rational> n = parse_numbers(a_.box, 6, "--box x0,y0,z0,x1,y1,z1");
      const Rational3 low{n[0], n[1], n[2]};
      const Rational3 high{n[3], n[4], n[5]};
      for (std::size_t i = 0; i < 3; ++i) {
        if (low[i] <= high[i]) continue;
        throw InputError("--box: give the lower corner first; " + brief_text(low[i]) + " exceeds " +
                         brief_text(high[i]));
      }
      box = {low, high};
    }
    return minkowski::configuration_space(robot, obstacles, box, options_, &report_);
  }

  void decompose_operand() {
    const Polyhedron a = first_operand();
    const Stopwatch watch;
    const std::vector<ConvexCell> cells = decompose(a);
    report_.seconds_decomposition = report_.seconds_total = watch.seconds();
    report_.cells_a = cells.size();
    write_timed(session_.output, [&](Messages& notes) {
      return write_cells(session_.output, cells,
                         {.format = a_.format.empty() ? "off" : a_.format,
                          .exact = session_.exact,
                          .binary = session_.binary,
                          .recenter = session_.mesh_file.recenter,
                          .lenient = session_.mesh_file.lenient},
                         notes);
    });
    if (!a_.preview.empty()) {
      const SignalsHeld held;
      write_previews(a_.preview, {{"a", a}});
      write_cell_preview(a_.preview, cells);
    }
    Json object = report(a);
    std::array<std::size_t, 4> count{};
    for (const ConvexCell& cell : cells) ++count[static_cast<std::size_t>(cell.dimension)];
    object["cells_by_dimension"] = count;
    print_report([&] { return object; });
    session_.say(counted(cells.size(), "cell", "cells"));
  }

  [[nodiscard]] Json report(const Polyhedron& result) const {
    Json object = base_report();
    object["result"] = set_info(result, {.exact = a_.exact_volume, .bounds = true});
    return object;
  }

  [[nodiscard]] Json base_report() const {
    Json object;
    object["union"] = a_.union_name;
    for (const StrategyChoice& choice : report_.choices) {
      Json entry = {{"chosen", choice.chosen}, {"why", choice.why}};
      if (choice.pairs_of_cells != 0) {
        entry["estimates"] = {{"pairs_of_cells", choice.pairs_of_cells},
                              {"convolution_facets", choice.convolution_facets}};
      }
      object["strategies"].push_back(std::move(entry));
    }
    object["cells"] = {report_.cells_a, report_.cells_b};
    object["pairs"] = report_.pairs;
    object["pairs_dropped"] = report_.pairs_dropped;
    object["united"] = {{"at_once", report_.united_at_once}, {"two_by_two", report_.united_two_by_two}};
    if (report_.convolution_facets > 0) {
      object["convolution"] = {{"facets", report_.convolution_facets},
                               {"intervals", report_.convolution_intervals},
                               {"points", report_.convolution_points},
                               {"regions_tested", report_.convolution_regions}};
    }
    for (const auto& [key, value] : details_.items()) object[key] = value;
    return object;
  }

  void tell_phases() {
    session_.spent("decomposition", report_.seconds_decomposition, report_.predicates_decomposition);
    session_.spent("convex_sums", report_.seconds_convex_sums, report_.predicates_convex_sums);
    session_.spent("union", report_.seconds_union, report_.predicates_union);
  }

  // Makes the report if one is wanted.
  void print_report(const std::function<Json()>& found) {
    if (!session_.json && session_.report.empty()) return;
    tell_phases();
    session_.spent("op", report_.seconds_total);
    if (session_.output.empty()) session_.spent("write", 0);  // all reports of the program have it
    const SignalsHeld held;
    session_.print(name(task_), found());
  }

  const Arguments& a_;
  Session& session_;
  Task task_;
  ProgressFunction show_ = [this](const char* phase, std::size_t done, std::size_t total) {
    session_.show_phase(phase, done, total);
  };
  MinkowskiOptions options_;
  MinkowskiReport report_;
  Json details_ = Json::object();                          // of the task, for the report
  std::vector<std::pair<std::string, Polyhedron>> shown_;  // for the preview
};

}  // namespace

int run_command(int argc, char** argv) {
  CLI::App app("Exact Minkowski sums of any two polyhedral sets: minkowski A B -o OUT");
  app.name("minkowski");
  app.set_version_flag("--version", version_text("minkowski"));
  app.footer("Exit codes: 0 done, 2 bad input or usage.");
  Arguments arguments;
  declare(app, arguments);
  const auto run = [&arguments] {
    Run(arguments, check(arguments)).run();
    return 0;
  };
  return run_program(app, argc, argv, run, [&](const std::string& line) { arguments.session.complain(line); });
}

}  // namespace nef::minkowski
