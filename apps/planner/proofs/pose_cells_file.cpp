// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/pose_cells_file.h"

#include <array>
#include <utility>

#include "apps/planner/proofs/proof_reader.h"
#include "apps/program/reports/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

using CellKind = PathProof::PoseCell::Kind;

constexpr std::array kSideWords{"start", "goal"};

json pose_cell_json(const PathProof::PoseCell& cell) {
  switch (cell.kind) {
    case CellKind::kStart:
    case CellKind::kGoal:
      return {{"side", kSideWords[cell.kind == CellKind::kStart ? 0 : 1]}};
    case CellKind::kBeyond:
      return {{"beyond", cell.side}};
    case CellKind::kBlocked: {
      json common = json::array();
      for (const Rational3& point : cell.common) common.push_back(exact_json(point));
      json result{{"robot", cell.robot}, {"obstacle", cell.obstacle}, {"common", std::move(common)}};
      for (const Rational3& way : cell.drift) result["drift"].push_back(exact_json(way));
      return result;
    }
    default:
      return {{"axis", cell.axis},
              {"at", to_string(cell.at)},
              {"halves", {pose_cell_json(cell.halves[0]), pose_cell_json(cell.halves[1])}}};
  }
}

CellKind read_side(const JsonReader& reader) {
  return reader.word(kSideWords) == 0 ? CellKind::kStart : CellKind::kGoal;
}

PathProof::PoseCell read_pose_cell(const JsonReader& reader) {
  PathProof::PoseCell cell;
  if (reader.has("side")) {
    reader.require_keys({"side"});
    cell.kind = read_side(reader["side"]);
  } else if (reader.has("beyond")) {
    reader.require_keys({"beyond"});
    cell.kind = CellKind::kBeyond;
    cell.side = proof_index(reader["beyond"]);
  } else if (reader.has("axis")) {
    reader.require_keys({"axis", "at", "halves"});
    cell.kind = CellKind::kCut;
    cell.axis = proof_index(reader["axis"]);
    cell.at = proof_number(reader["at"]);
    auto halves = reader["halves"].exactly<2>(read_pose_cell);
    cell.halves.reserve(2);  // nothing is copied
    for (PathProof::PoseCell& half : halves) cell.halves.push_back(std::move(half));
  } else {
    if (reader.has("drift")) {
      reader.require_keys({"robot", "obstacle", "common", "drift"});
      const auto drift = reader["drift"].exactly<3>(proof_point);
      cell.drift.assign(drift.begin(), drift.end());
    } else {
      reader.require_keys({"robot", "obstacle", "common"});
    }
    cell.kind = CellKind::kBlocked;
    cell.robot = proof_index(reader["robot"]);
    cell.obstacle = proof_index(reader["obstacle"]);
    const auto common = reader["common"].exactly<8>(proof_point);
    cell.common.assign(common.begin(), common.end());
  }
  return cell;
}

}  // namespace

json rotations_json(const std::vector<Quaternion>& rotations) {
  if (rotations.empty()) return "all";
  json chain = json::array();
  for (const Quaternion& q : rotations) chain.push_back(exact_json(q));
  return chain;
}

std::vector<Quaternion> read_rotations(const JsonReader& reader) {
  if (reader.value() == "all") return {};
  std::vector<Quaternion> chain = reader.list([](const JsonReader& q) { return q.exactly<4>(proof_number); });
  if (chain.empty()) reader.fail("expected \"all\" or a list of quaternions");
  return chain;
}

json pose_cells_json(const PathProof::PoseCells& cells, bool is_bounded) {
  json charts = json::array();
  for (const PathProof::PoseCell& cell : cells.charts) charts.push_back(pose_cell_json(cell));
  return {{"reference", exact_json(cells.reference)},
          {"bounds", {exact_json(cells.bounds[0]), exact_json(cells.bounds[1])}},
          {"outside", is_bounded ? json() : json(kSideWords[cells.outside_at_start ? 0 : 1])},
          {"charts", std::move(charts)}};
}

PathProof::PoseCells read_pose_cells(const JsonReader& reader, bool is_bounded) {
  reader.require_keys({"reference", "bounds", "outside", "charts"});
  PathProof::PoseCells cells;
  cells.reference = proof_point(reader["reference"]);
  cells.bounds = reader["bounds"].exactly<2>(proof_point);
  if (reader["outside"].value().is_null() != is_bounded) {
    reader.fail("\"outside\" is null if the claim has a box, and names a side otherwise");
  }
  cells.outside_at_start = !is_bounded && read_side(reader["outside"]) == CellKind::kStart;
  cells.charts = reader["charts"].list(read_pose_cell);
  return cells;
}

}  // namespace nef::planner
