// SPDX-License-Identifier: Apache-2.0
//
// A turn is written as whole quarters and a half-tangent (exact), a quaternion, and degrees for people. A proof is
// written with exact breakpoints and vertices, so that `read_turning_proof` restores exactly what the search found; the
// reader checks the shape of the JSON and leaves the truth to `complaint_about`. The times of the robot's motion count
// turns by the way of its farthest corner.
#include "apps/planner/command/runs/runs.h"

#include <cmath>
#include <iostream>

#include "apps/planner/clearance/timing.h"
#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/turning/turning_robot.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

using nlohmann::json;

// Exactly, and for people.
json turn_json(const Turn& turn, const TurningAxis& axis) {
  const Integer quarter = floor_of(turn);
  return {{"quarters", quarter.get_si()},
          {"half_tangent", to_string(Rational(turn - quarter))},
          {"quaternion", exact_json(axis.quaternion(turn))},
          {"degrees", axis.degrees_of(turn)}};
}

Turn turn_of(const JsonReader& value) {
  if (!value.has("quarters") || !value.has("half_tangent")) value.fail("a turn has 'quarters' and 'half_tangent'");
  return value["quarters"].number() + value["half_tangent"].number();
}

json axis_json(const Rational3& axis) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (axis[k] == 1 && axis[(k + 1) % 3] == 0 && axis[(k + 2) % 3] == 0) return std::string(1, "xyz"[k]);
  }
  return exact_json(axis);
}

json proof_json(const TurningProof& proof, const TurningAxis& axis) {
  json result;
  for (const Turn& turn : proof.breakpoints) result["breakpoints"].push_back(turn_json(turn, axis));
  for (const TurningProof::Cell& cell : proof.cells) {
    json inner = json::array();
    for (const std::vector<Rational3>& piece : cell.inner) inner.push_back(points_json(piece));
    result["cells"].push_back({{"inner", std::move(inner)}, {"start_side", points_json(cell.start_side)}});
  }
  return result;
}

json turning_json(const TurningAnswer& answer, const Scene& scene, const TurningAxis& axis) {
  json result{{"scene", scene.name},
              {"status", status_name(answer.status)},
              {"motions", kTranslationAndTurning},
              {"cells", answer.cells},
              {"cells_looked_at", answer.looked_at},
              {"axis", axis_json(scene.rotation->axis)},
              {"contact", scene.contact == ContactRule::kAllow ? "allow" : "forbid"}};
  for (const Pose& pose : answer.path) {
    result["path"].push_back({{"position", exact_json(pose.position)},
                              {"position_double", double_json(pose.position)},
                              {"turn", turn_json(pose.turn, axis)}});
  }
  if (!answer.path.empty()) result["unrounded"] = answer.unrounded;
  if (answer.collision) result["collision"] = collision_json(*answer.collision, scene);
  if (answer.proof) result["proof"] = proof_json(*answer.proof, axis);
  for (const TurnRange& range : answer.open_ranges) {
    result["undecided"].push_back({turn_json(range.low, axis), turn_json(range.high, axis)});
  }
  return result;
}

std::string turning_text(const TurningAnswer& answer, const TurningAxis& axis) {
  std::string out;
  for (const Pose& pose : answer.path) {
    for (const Rational& x : pose.position) {
      append_number(out, nearest_double(x));
      out += ' ';
    }
    append_number(out, axis.degrees_of(pose.turn));
    out += '\n';
  }
  return out;
}

TurningProof read_turning_proof(const std::string& file) {
  const json value = parse_exact_json(read_file(file), file);
  const JsonReader report(value, file);
  if (!report.has("proof")) report.fail("this report has no proof; only one with the status infeasible has");
  const JsonReader root = report["proof"];
  root.require_keys({"breakpoints", "cells"});
  TurningProof proof;
  proof.breakpoints = root["breakpoints"].list(turn_of);
  proof.cells = root["cells"].list([](const JsonReader& cell) {
    cell.require_keys({"inner", "start_side"});
    const auto points = [](const JsonReader& list) { return list.list(&JsonReader::point_of); };
    const auto piece = [&](const JsonReader& list) {
      if (list.value().empty()) list.fail("a piece without vertices");
      return points(list);
    };
    return TurningProof::Cell{cell["inner"].list(piece), points(cell["start_side"])};
  });
  return proof;
}

// How long each part of a path is, an angle being the way of the robot's farthest corner.
std::vector<double> lengths_of(const std::vector<Pose>& path, const Polyhedron& robot, const TurningAxis& axis) {
  const double reach = reach_of(robot);
  std::vector<double> lengths;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double turned = axis.degrees_of(path[i].turn) - axis.degrees_of(path[i - 1].turn);
    lengths.push_back(distance(path[i - 1].position, path[i].position) + std::abs(turned) * M_PI / 180 * reach);
  }
  return lengths;
}

// The turn from the first pose on as a unit quaternion w x y z. Angles are those of people, whose sum is not taken
// modulo a full turn, so that neighbours are near each other.
std::array<double, 4> quaternion_of(double degrees, const TurningAxis& axis) {
  const Vector3d direction = to_vector(axis.direction()).normalized();
  const double half = degrees * M_PI / 360;
  return {std::cos(half), std::sin(half) * direction[0], std::sin(half) * direction[1], std::sin(half) * direction[2]};
}

void print(const Arguments& a, const TurningAnswer& answer, const Scene& scene, const TurningAxis& axis) {
  std::cout << status_name(answer.status);
  if (answer.collision) {
    std::cout << ": " << describe(*answer.collision, scene) << '\n';
    return;
  }
  if (a.ompl.empty()) std::cout << ", " << counted(answer.cells, "cell", "cells") << " of angles";
  if (answer.status == TurningAnswer::Status::kUndecided && !a.ompl.empty()) {
    std::cout << ": " << a.ompl << kNoPathInTime;
  } else if (answer.status == TurningAnswer::Status::kUndecided) {
    std::cout << "; open:";
    for (const TurnRange& range : answer.open_ranges) {
      std::cout << ' ' << axis.degrees_of(range.low) << ".." << axis.degrees_of(range.high);
    }
  }
  std::cout << '\n';
  std::cout << unrounded_text(answer.unrounded);
  if (a.outputs.empty()) std::cout << turning_text(answer, axis);
}

int check_proof(const Arguments& a, const Scene& scene) {
  const Stopwatch watch;
  const TurningProof proof = read_turning_proof(a.check_proof);
  const std::optional<std::string> complaint = complaint_about(proof, scene, question_of(scene));
  const std::size_t cells = proof.cells.size();
  return tell_check(a, scene.name, {{"scene", scene.name}, {"cells", cells}}, complaint,
                    ", " + counted(cells, "cell", "cells") + " of angles", watch);
}

}  // namespace

std::vector<view::Layer> turning_layers(const TurningAnswer& answer, const Scene& scene,
                                        const TurningQuestion& question) {
  const auto placed = [&](const Pose& pose) {
    AffineMap map = question.axis.rotation(pose.turn);
    map.translation = pose.position;
    return map;
  };
  std::vector<view::Layer> layers =
      scene_layers(scene, placed(question.start), placed(question.goal), !answer.path.empty(), nullptr);
  std::vector<Rational3> points;
  for (const Pose& pose : answer.path) points.push_back(pose.position);
  const auto turn = [&](std::size_t i) {
    const double first = question.axis.degrees_of(answer.path.front().turn);
    return quaternion_of(question.axis.degrees_of(answer.path[i].turn) - first, question.axis);
  };
  move_along(points, lengths_of(answer.path, scene.robot, question.axis), turn, layers);
  return layers;
}

int run_turning(const Arguments& a, const Scene& scene, const nlohmann::json& widest, const TimeLimit& limit) {
  exclude(a, "a scene with a rotation",
          {"--tight", "--path", "--queries", "--benchmark", "--min-dimension", "--clearance", "--raw", "--quick",
           "--prefer", "--se3"});
  require_extensions(a, "for a scene with a rotation", {"json", "txt", "csv", "glb", "html"});
  if (!a.ompl.empty() && a.path.digits) {
    throw InputError("--digits: OMPL's paths of a robot that turns cannot be rounded");
  }
  if (!a.check_proof.empty()) return check_proof(a, scene);
  const Stopwatch watch;
  TurningLimits limits;
  limits.max_cells = a.max_cells;
  limits.digits = a.path.digits;
  const TurningQuestion question = question_of(scene);
  const auto asked = [&] {
    if (a.ompl.empty()) return find_turning_path(scene, question, limits, limit.monitor());
    const auto invalid = invalid_turning_end(scene, question, a.session.monitor);
    return invalid ? *invalid : run_turning_ompl(scene, a.ompl, a.time.value_or(kOmplSeconds));
  };
  const TurningAnswer answer = asked();
  write_turning_proof(a, scene, answer);
  std::vector<double> times;
  if (!answer.path.empty() && a.limits.speed > 0)
    times = times_of(lengths_of(answer.path, scene.robot, question.axis), a.limits);
  const auto report = [&] {
    nlohmann::json members = turning_json(answer, scene, question.axis);
    if (!times.empty()) members["times_s"] = times;
    if (!widest.is_null()) members["widest"] = widest;
    return members;
  };
  const auto for_people = [&] {
    if (!widest.is_null()) std::cout << widest_text(widest);
    print(a, answer, scene, question.axis);
    std::cout << duration_text(times);
  };
  // The report whatever the answer; other formats hold a path.
  const auto text = [&](const std::string& extension) -> std::optional<std::string> {
    if (answer.status != TurningAnswer::Status::kPath) return std::nullopt;
    if (extension != "csv") return turning_text(answer, question.axis);
    return timed_text("x,y,z,degrees", times, [&](std::size_t i) {
      const Vector3d at = to_vector(answer.path[i].position);
      return std::vector<double>{at[0], at[1], at[2], question.axis.degrees_of(answer.path[i].turn)};
    });
  };
  tell(a, {"turning", scene.name, report, {{"op", watch.seconds(), {}}}, for_people, text, [&] {
             return turning_layers(answer, scene, question);
           }});
  return exit_code(answer.status, !a.ompl.empty());
}

}  // namespace nef::planner
