// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/turning_run.h"

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "apps/planner/turning/turning_search.h"
#include "nef/base/error.h"
#include "nef/base/stopwatch.h"
#include "nef/io/file_bytes.h"
#include "nef/program/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;
using Status = TurningAnswer::Status;

void check_options(const Arguments& a) {
  const bool other = a.tight || !a.page.empty() || !a.given_path.empty() || !a.queries.empty() || !a.ompl.empty() ||
                     !a.benchmark.empty() || a.path.min_dimension > 0 || a.path.clearance || a.se3;
  if (other) throw InputError("a scene with a rotation knows --json, --quiet, -o, --max-cells and --time only");
  for (const std::string& file : a.outputs) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension != ".json" && extension != ".txt") {
      throw InputError("-o " + file + ": for a scene with a rotation the extension must be .json or .txt");
    }
  }
}

const char* name_of(Status status) {
  switch (status) {
    case Status::kPath:
      return "path";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kInvalidStart:
      return "invalid_start";
    case Status::kInvalidGoal:
      return "invalid_goal";
    default:
      return "undecided";
  }
}

int exit_code_of(Status status) {
  switch (status) {
    case Status::kPath:
      return 0;
    case Status::kInfeasible:
      return 1;
    case Status::kUndecided:
      return 5;
    default:
      return 3;
  }
}

// Exactly, and for people.
json turn_json(const Turn& turn, const TurningAxis& axis) {
  Integer quarter;
  mpz_fdiv_q(quarter.get_mpz_t(), turn.get_num_mpz_t(), turn.get_den_mpz_t());
  json quaternion = json::array();
  for (const Rational& x : axis.quaternion(turn)) quaternion.push_back(to_string(x));
  return {{"quarters", quarter.get_si()},
          {"half_tangent", to_string(Rational(turn - quarter))},
          {"quaternion", std::move(quaternion)},
          {"degrees", axis.degrees_of(turn)}};
}

json axis_json(const Rational3& axis) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (axis[k] == 1 && axis[(k + 1) % 3] == 0 && axis[(k + 2) % 3] == 0) return std::string(1, "xyz"[k]);
  }
  return exact_json(axis);
}

json report(const TurningAnswer& answer, const Scene& scene, const TurningAxis& axis, double seconds) {
  json result{{"scene", scene.name},
              {"status", name_of(answer.status)},
              {"cells", answer.cells},
              {"cells_looked_at", answer.looked_at},
              {"axis", axis_json(scene.rotation->axis)},
              {"contact", scene.contact == ContactRule::kAllow ? "allow" : "forbid"},
              {"phases", {{"turning", seconds}}}};
  for (const Pose& pose : answer.path) {
    result["path"].push_back({{"position", exact_json(pose.position)},
                              {"position_double", double_json(pose.position)},
                              {"turn", turn_json(pose.turn, axis)}});
  }
  for (const Turn& turn : answer.breakpoints) result["proof"]["breakpoints"].push_back(turn_json(turn, axis));
  for (const TurnRange& range : answer.open_ranges) {
    result["undecided"].push_back({turn_json(range.low, axis), turn_json(range.high, axis)});
  }
  if (!scene.messages.empty()) result["messages"] = scene.messages;
  return result;
}

// x y z degrees, a way-point a line.
std::string text_of(const TurningAnswer& answer, const TurningAxis& axis) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (const Pose& pose : answer.path) {
    for (const Rational& x : pose.position) out << nearest_double(x) << ' ';
    out << axis.degrees_of(pose.turn) << '\n';
  }
  return out.str();
}

void print(const Arguments& a, const TurningAnswer& answer, const Scene& scene, const TurningAxis& axis) {
  for (const std::string& message : scene.messages) std::cout << "note: " << message << '\n';
  std::cout << name_of(answer.status) << ", " << answer.cells << " cells of angles";
  if (answer.status == Status::kUndecided) {
    std::cout << "; open:";
    for (const TurnRange& range : answer.open_ranges) {
      std::cout << ' ' << axis.degrees_of(range.low) << ".." << axis.degrees_of(range.high);
    }
  }
  std::cout << '\n';
  if (a.outputs.empty()) std::cout << text_of(answer, axis);
}

}  // namespace

int run_turning(const Arguments& a, const Scene& scene) {
  check_options(a);
  const Stopwatch watch;
  TurningLimits limits;
  limits.max_cells = a.max_cells;
  if (a.time_given) limits.stop = [&] { return watch.seconds() >= a.seconds; };
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer = find_turning_path(scene, question, limits);
  const std::string text = report(answer, scene, question.axis, watch.seconds())
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                           "\n";
  for (const std::string& file : a.outputs) {
    const bool as_json = std::filesystem::path(file).extension() == ".json";
    if (as_json || answer.status == Status::kPath) write_file(file, as_json ? text : text_of(answer, question.axis));
  }
  if (a.json) {
    std::cout << text;
  } else if (!a.quiet) {
    print(a, answer, scene, question.axis);
  }
  return exit_code_of(answer.status);
}

}  // namespace nef::planner
