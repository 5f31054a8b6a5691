// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/command/run.h"

#include <array>
#include <csignal>
#include <iostream>

#include "apps/minkowski/command/preview.h"
#include "apps/minkowski/command/write_cells.h"
#include "apps/minkowski/convex/tools.h"
#include "nef/base/stopwatch.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/program/numbers.h"
#include "nef/program/progress_bar.h"
#include "nef/program/report.h"

namespace nef::minkowski {
namespace {

// Ctrl-C ends the program at once, except while a file is written: then it waits until the file is
// whole (files are written beside their targets and renamed). A handler and not a mask, since a mask of this
// thread would leave the others to take the signal.
class SignalsHeld {
 public:
  SignalsHeld() {
    held_signal_ = 0;
    struct sigaction action {};
    action.sa_handler = [](int signal) { held_signal_ = signal; };
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
  }
  ~SignalsHeld() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
    if (held_signal_ != 0) raise(held_signal_);
  }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  static inline volatile std::sig_atomic_t held_signal_ = 0;
  std::array<struct sigaction, 3> before_{};
};

class Task {
 public:
  explicit Task(const Arguments& arguments) : a_(arguments) {}

  void run() {
    if (a_.decompose) {
      decompose_operand();
    } else {
      const Polyhedron result = a_.configuration_space ? free_space() : sum();
      store(result);
      preview(result);
      print_report(report(result));
      if (!a_.quiet && !a_.json) std::cout << summary(result) << "\n";
    }
  }

 private:
  Polyhedron load(const std::string& path) {
    const Stopwatch watch;
    Messages messages;
    MeshOptions options;
    options.strict = a_.strict;
    options.as_surface = a_.as_surface;
    Polyhedron set = read_polyhedron(path, options, &messages);
    load_s_ += watch.seconds();
    show(messages);
    return set;
  }

  void show(const Messages& messages) const {
    for (const std::string& line : messages) {
      if (!a_.quiet) std::cerr << "minkowski: " << line << "\n";
    }
  }

  void store(const Polyhedron& result) {
    const Stopwatch watch;
    const SignalsHeld held;
    Messages messages;
    write_polyhedron(a_.output, result, {.exact = a_.exact, .binary = a_.binary, .text = a_.text}, &messages);
    write_s_ += watch.seconds();
    show(messages);
  }

  void preview(const Polyhedron& result) {
    if (a_.preview.empty()) return;
    const SignalsHeld held;
    shown_.emplace_back(a_.configuration_space ? "free_space" : "sum", result);
    write_previews(a_.preview, shown_);
  }

  Polyhedron second_operand() {
    if (!a_.ball.empty()) {
      const std::vector<Rational> numbers = parse_numbers(a_.ball, 2, "--ball");
      if (numbers[1].get_den() != 1 || numbers[1] < 1 || numbers[1] > 64) {
        throw InputError("--ball R,N: N is a whole number from 1 to 64, not " + to_string(numbers[1]));
      }
      return to_polyhedron(ball(numbers[0], static_cast<int>(numbers[1].get_num().get_si())));
    }
    if (!a_.box_tool.empty()) {
      const std::vector<Rational> n = parse_numbers(a_.box_tool, 3, "--box-tool");
      return to_polyhedron(box_tool({n[0], n[1], n[2]}));
    }
    return load(a_.operands[1]);
  }

  MinkowskiOptions options(ProgressBar& bar) const {
    MinkowskiOptions options;
    options.threads = a_.threads;
    options.strategy = strategy(a_);
    options.progress = [&bar](std::size_t done, std::size_t all) {
      bar.show("pairs of cells", done, all);
      return true;
    };
    return options;
  }

  Polyhedron sum() {
    Polyhedron a = load(a_.operands[0]);
    Polyhedron b = second_operand();
    if (a_.open_a) a = interior(a);
    if (a_.open_b) b = interior(b);
    if (a_.negate_b) b = negate(b);
    shown_ = {{"a", a}, {"b", b}};
    ProgressBar bar(!a_.quiet);
    return minkowski_sum(a, b, options(bar), &report_);
  }

  Polyhedron free_space() {
    const Polyhedron robot = load(a_.robot);
    std::vector<Polyhedron> obstacles;
    for (const std::string& path : a_.obstacles) obstacles.push_back(load(path));
    shown_ = {{"robot", robot}, {"obstacles", a_.preview.empty() ? Polyhedron() : unite_all(obstacles, a_.threads)}};
    std::optional<std::array<Rational3, 2>> box;
    if (!a_.box.empty()) {
      const std::vector<Rational> low = parse_numbers(a_.box[0], 3, "--box");
      const std::vector<Rational> high = parse_numbers(a_.box[1], 3, "--box");
      for (std::size_t i = 0; i < 3; ++i) {
        if (low[i] <= high[i]) continue;
        throw InputError("--box: give the lower corner first; " + to_string(low[i]) + " exceeds " + to_string(high[i]));
      }
      box = {Rational3{low[0], low[1], low[2]}, Rational3{high[0], high[1], high[2]}};
    }
    ProgressBar bar(!a_.quiet);
    return minkowski::configuration_space(robot, obstacles, box, options(bar), &report_);
  }

  void decompose_operand() {
    Polyhedron a = load(a_.operands[0]);
    if (a_.open_a) a = interior(a);
    const Stopwatch watch;
    const std::vector<ConvexCell> cells = decompose(a);
    report_.seconds_decomposition = report_.seconds_total = watch.seconds();
    report_.cells_a = cells.size();
    {
      const Stopwatch writing;
      const SignalsHeld held;
      Messages messages;
      write_cells(a_.output, cells, a_.format.empty() ? "off" : a_.format, a_.exact, messages);
      write_s_ = writing.seconds();
      show(messages);
      if (!a_.preview.empty()) {
        write_previews(a_.preview, {{"a", a}});
        write_cell_preview(a_.preview, cells);
      }
    }
    Json object = report(a);
    std::array<std::size_t, 4> count{};
    for (const ConvexCell& cell : cells) ++count[static_cast<std::size_t>(cell.dimension)];
    object["cells_by_dimension"] = count;
    print_report(object);
    if (!a_.quiet && !a_.json) std::cout << cells.size() << (cells.size() == 1 ? " cell\n" : " cells\n");
  }

  [[nodiscard]] Json report(const Polyhedron& result) const {
    Json object;
    object["command"] = a_.decompose ? "decompose" : a_.configuration_space ? "configuration-space" : "sum";
    object["union"] = a_.union_name;
    object["cells"] = {report_.cells_a, report_.cells_b};
    object["pairs"] = report_.pairs;
    object["pairs_dropped"] = report_.pairs_dropped;
    object["phases"] = {{"load_s", load_s_},
                        {"decomposition_s", report_.seconds_decomposition},
                        {"convex_sums_s", report_.seconds_convex_sums},
                        {"union_s", report_.seconds_union},
                        {"op_s", report_.seconds_total},
                        {"write_s", write_s_}};
    object["predicates"] = {{"decomposition", predicates_json(report_.predicates_decomposition)},
                            {"convex_sums", predicates_json(report_.predicates_convex_sums)},
                            {"union", predicates_json(report_.predicates_union)}};
    object["peak_memory_bytes"] = peak_memory_bytes();
    object["result"] = info_json(result);
    return object;
  }

  void print_report(const Json& object) const {
    if (a_.json) std::cout << object.dump() << "\n";
    if (a_.report.empty()) return;
    const SignalsHeld held;
    write_file(a_.report, object.dump(2) + "\n");
  }

  const Arguments& a_;
  MinkowskiReport report_;
  std::vector<std::pair<std::string, Polyhedron>> shown_;  // for the preview
  double load_s_ = 0;
  double write_s_ = 0;
};

}  // namespace

void run(const Arguments& arguments) {
  check(arguments);
  Task(arguments).run();
}

}  // namespace nef::minkowski
