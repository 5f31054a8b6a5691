// SPDX-License-Identifier: Apache-2.0
//
// A turn is written as whole quarters and a half-tangent (exact), a quaternion, and degrees for people. A proof is
// written with exact breakpoints and vertices, so that `read_turning_proof` restores exactly what the search found; the
// reader checks the shape of the JSON and leaves the truth to `complaint_about`.
#include "apps/planner/command/turning_report.h"

#include "apps/planner/command/report.h"
#include "apps/program/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"
#include "nef/number/floor.h"

namespace nef::planner {
namespace {

using nlohmann::json;

// Exactly, and for people.
json turn_json(const Turn& turn, const TurningAxis& axis) {
  const Integer quarter = floor_of(turn);
  json quaternion = json::array();
  for (const Rational& x : axis.quaternion(turn)) quaternion.push_back(to_string(x));
  return {{"quarters", quarter.get_si()},
          {"half_tangent", to_string(Rational(turn - quarter))},
          {"quaternion", std::move(quaternion)},
          {"degrees", axis.degrees_of(turn)}};
}

Turn turn_of(const json& value, const std::string& what) {
  if (!value.is_object() || !value.contains("quarters") || !value.contains("half_tangent")) {
    throw InputError(what + ": a turn has 'quarters' and 'half_tangent'");
  }
  return rational_of(value["quarters"], what) + rational_of(value["half_tangent"], what);
}

json axis_json(const Rational3& axis) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (axis[k] == 1 && axis[(k + 1) % 3] == 0 && axis[(k + 2) % 3] == 0) return std::string(1, "xyz"[k]);
  }
  return exact_json(axis);
}

std::vector<Rational3> points_of(const json& value, const std::string& what) {
  if (!value.is_array()) throw InputError(what + ": expected a list of points");
  std::vector<Rational3> result;
  for (const json& point : value) result.push_back(point_of(point, what));
  return result;
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

const json& list_in(const json& value, const char* key, const std::string& what) {
  if (!value.is_object() || !value.contains(key) || !value[key].is_array()) {
    throw InputError(what + " has no list '" + key + "'");
  }
  return value[key];
}

}  // namespace

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
  const json report = parse_exact_json(read_file(file), file);
  if (!report.is_object() || !report.contains("proof")) {
    throw InputError(file + ": no report with a proof (status infeasible)");
  }
  const std::string what = file + ": proof";
  TurningProof proof;
  for (const json& turn : list_in(report["proof"], "breakpoints", what)) {
    proof.breakpoints.push_back(turn_of(turn, what + ": breakpoints"));
  }
  for (const json& cell : list_in(report["proof"], "cells", what)) {
    TurningProof::Cell& entry = proof.cells.emplace_back();
    for (const json& piece : list_in(cell, "inner", what + ": a cell")) {
      entry.inner.push_back(points_of(piece, what + ": inner"));
      if (entry.inner.back().empty()) throw InputError(what + ": a piece without vertices");
    }
    entry.start_side = points_of(list_in(cell, "start_side", what + ": a cell"), what + ": start_side");
  }
  return proof;
}

}  // namespace nef::planner
