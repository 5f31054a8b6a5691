// SPDX-License-Identifier: Apache-2.0
//
// Each function turns one kind of answer into JSON or text; `answer_report` joins them with the phases and messages of
// the run. Exact coordinates are strings, and each has a double beside it.
#include "apps/planner/command/report.h"

#include <sstream>

#include "nef/base/error.h"
#include "nef/number/brief_text.h"
#include "nef/program/exact_json.h"

namespace nef::planner {
namespace {

using nlohmann::json;

json cell_json(const FreeSpace& free, CellId cell) {
  json vertices = json::array();
  for (const Rational3& vertex : free.vertices(cell)) vertices.push_back(exact_json(vertex));
  return {{"cell", free.name(cell)}, {"dimension", free.cells().dimension(cell)}, {"vertices", std::move(vertices)}};
}

json cells_json(const FreeSpace& free, const std::vector<CellId>& cells) {
  json result = json::array();
  for (const CellId cell : cells) result.push_back(cell_json(free, cell));
  return result;
}

json names_json(const FreeSpace& free, const std::vector<CellId>& cells) {
  json result = json::array();
  for (const CellId cell : cells) result.push_back(free.name(cell));
  return result;
}

json collision_json(const Collision& collision, const Scene& scene) {
  json result{{"point", exact_json(collision.point)}, {"text", describe(collision, scene)}};
  if (collision.outside_box) {
    result["outside_box"] = true;
    return result;
  }
  static constexpr std::array<const char*, 4> kKinds{"vertex", "edge", "facet", "volume"};
  result["obstacle"] = collision.obstacle;
  result["obstacle_name"] = scene.obstacle_names[collision.obstacle];
  result["cell"] =
      std::string(kKinds[static_cast<std::size_t>(collision.cell.kind)]) + " " + std::to_string(collision.cell.index);
  return result;
}

void add_path(const ExactPath& path, json& result) {
  json exact = json::array();
  json doubles = json::array();
  for (const Rational3& point : path.points) {
    exact.push_back(exact_json(point));
    doubles.push_back(double_json(point));
  }
  result["path"] = std::move(exact);
  result["path_double"] = std::move(doubles);
  result["length"] = path.length;
  result["cells"] = path.segment_dimensions;
  result["path_thinnest_piece"] = path.thinness.piece;
  result["path_thinnest_junction"] = path.thinness.junction;
  result["passages_used"] = path.passages;
  result["unrounded"] = path.unrounded;
}

}  // namespace

int exit_code(const Answer& answer) {
  switch (answer.status) {
    case Answer::Status::kInfeasible:
    case Answer::Status::kBlocked:
      return 1;
    case Answer::Status::kInvalidStart:
    case Answer::Status::kInvalidGoal:
      return 3;
    default:
      return 0;
  }
}

std::string status_name(Answer::Status status) {
  static constexpr std::array<const char*, 6> kNames{"path",         "infeasible", "invalid_start",
                                                     "invalid_goal", "free_space", "blocked"};
  return kNames[static_cast<std::size_t>(status)];
}

json passages_json(const FreeSpace& free) {
  json result = json::array();
  for (const TightPassage& passage : free.passages()) {
    json entry{{"dimension", passage.dimension},
               {"component", passage.component},
               {"cells", cells_json(free, passage.cells)},
               {"mouths", cells_json(free, passage.mouths)},
               {"joins", names_json(free, passage.rooms)}};
    if (passage.bottleneck) {
      entry["bottleneck"] = {{"piece", passage.bottleneck->piece}, {"junction", passage.bottleneck->junction}};
    }
    result.push_back(std::move(entry));
  }
  return result;
}

json touching_json(const FreeSpace& free) {
  json result = json::array();
  for (const TouchingRooms& place : free.touching_rooms()) {
    result.push_back({{"dimension", place.dimension},
                      {"component", place.component},
                      {"cells", cells_json(free, place.cells)},
                      {"joins", names_json(free, place.rooms)}});
  }
  return result;
}

json answer_json(const Answer& answer, const Scene& scene) {
  json result{{"status", status_name(answer.status)}};
  if (answer.path) add_path(*answer.path, result);
  if (answer.thinness) {
    result["thinnest_piece"] = answer.thinness->piece;
    result["thinnest_junction"] = answer.thinness->junction;
  }
  if (answer.collision) result["collision"] = collision_json(*answer.collision, scene);
  if (answer.blocked_segment) result["blocked_segment"] = *answer.blocked_segment;
  if (answer.status == Answer::Status::kInfeasible) {
    result["proof"] = {{"start_component", answer.start_component}, {"goal_component", answer.goal_component}};
  }
  return result;
}

json free_space_json(const Scene& scene, const FreeSpace& free) {
  json components = json::array();
  for (const Component& component : free.components()) {
    components.push_back(
        {{"dimension", component.dimension}, {"bounded", component.bounded}, {"cells", component.cells}});
  }
  json result{{"scene", scene.name}, {"motions", kTranslation}};
  result["components"] = std::move(components);
  result["tight"] = passages_json(free);
  result["touching"] = touching_json(free);
  result["contact"] = scene.contact == ContactRule::kAllow ? "allow" : "forbid";
  return result;
}

Json answer_report(const Answer& answer, const Scene& scene, const FreeSpace& free, const json& more) {
  json found = free_space_json(scene, free);
  found.update(answer_json(answer, scene));
  found.update(more);
  return run_report("plan", found, report_phases(answer.phases), scene.messages);
}

std::string unrounded_text(const std::vector<std::size_t>& waypoints) {
  std::string text = "more decimals than --digits, for want of free way-points with fewer:";
  for (const std::size_t i : waypoints) text += ' ' + std::to_string(i);
  return text + '\n';
}

std::vector<ReportPhase> report_phases(const std::map<std::string, double>& seconds) {
  std::vector<ReportPhase> list;
  for (const auto& [name, value] : seconds) list.push_back({name, value, {}});
  return list;
}

std::string passages_text(const FreeSpace& free) {
  std::ostringstream out;
  const auto list = [&](const char* before, CellId cell) {
    out << before << free.name(cell) << ':';
    for (const Rational3& v : free.vertices(cell)) {
      out << ' ' << brief_text(v);
    }
    out << '\n';
  };
  const auto names = [&](const std::vector<CellId>& cells) {
    for (const CellId cell : cells) out << ' ' << free.name(cell);
  };
  if (free.passages().empty()) out << "no tight passage\n";
  for (std::size_t i = 0; i < free.passages().size(); ++i) {
    const TightPassage& passage = free.passages()[i];
    out << "passage " << i << ": dimension " << passage.dimension << ", component " << passage.component;
    if (!passage.rooms.empty()) {
      out << ", joins";
      names(passage.rooms);
    }
    if (passage.bottleneck) {
      out << ", bottleneck: piece " << passage.bottleneck->piece << ", junction " << passage.bottleneck->junction;
    }
    out << '\n';
    for (const CellId cell : passage.cells) list("  ", cell);
    for (const CellId cell : passage.mouths) list("  mouth ", cell);
  }
  for (const TouchingRooms& place : free.touching_rooms()) {
    out << "touch: dimension " << place.dimension << ", component " << place.component << ", joins";
    names(place.rooms);
    out << '\n';
    for (const CellId cell : place.cells) list("  ", cell);
  }
  return out.str();
}

}  // namespace nef::planner
