// SPDX-License-Identifier: Apache-2.0
//
// Each function turns one kind of answer into JSON or text; `answer_report` joins them with the phases and messages of
// the run. Exact coordinates are strings, and each has a double beside it.
#include "apps/planner/command/report.h"

#include <sstream>

#include "apps/planner/clearance/timing.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/number_text.h"
#include "nef/number/brief_text.h"
#include "nef/query/location_name.h"

namespace nef::planner {
namespace {

using nlohmann::json;

json cell_json(const FreeSpace& free, CellId cell) {
  return {{"cell", free.name(cell)},
          {"dimension", free.cells().dimension(cell)},
          {"vertices", points_json(free.vertices(cell))}};
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

void add_path(const ExactPath& path, json& result) {
  result["path"] = points_json(path.points);
  result["path_double"] = double_points_json(path.points);
  result["length"] = path.length;
  result["cells"] = path.segment_dimensions;
  result["path_thinnest_piece"] = path.thinness.piece;
  result["path_thinnest_junction"] = path.thinness.junction;
  result["passages_used"] = path.passages;
  result["unrounded"] = path.unrounded;
}

json passages_json(const FreeSpace& free) {
  json result = json::array();
  for (const TightPassage& passage : free.passages()) {
    json entry{{"dimension", passage.dimension},
               {"component", passage.component},
               {"cells", cells_json(free, passage.cells)},
               {"mouths", cells_json(free, passage.mouths)},
               {"joins", names_json(free, passage.volumes)}};
    if (passage.bottleneck) {
      entry["bottleneck"] = {{"piece", passage.bottleneck->piece}, {"junction", passage.bottleneck->junction}};
    }
    result.push_back(std::move(entry));
  }
  return result;
}

json touching_json(const FreeSpace& free) {
  json result = json::array();
  for (const TouchingVolumes& touching : free.touching_volumes()) {
    result.push_back({{"dimension", touching.dimension},
                      {"component", touching.component},
                      {"cells", cells_json(free, touching.cells)},
                      {"joins", names_json(free, touching.volumes)}});
  }
  return result;
}

}  // namespace

json collision_json(const Collision& collision, const Scene& scene) {
  json result{{"point", exact_json(collision.point)}, {"text", describe(collision, scene)}};
  if (collision.outside_box) {
    result["outside_box"] = true;
    return result;
  }
  result["obstacle"] = collision.obstacle;
  result["obstacle_name"] = scene.obstacle_names[collision.obstacle];
  result["cell"] = std::string(location_name(collision.cell.kind)) + " " + std::to_string(collision.cell.index);
  return result;
}

json points_json(const std::vector<Rational3>& points) {
  json result = json::array();
  for (const Rational3& point : points) result.push_back(exact_json(point));
  return result;
}

json double_points_json(const std::vector<Rational3>& points) {
  json result = json::array();
  for (const Rational3& point : points) result.push_back(double_json(point));
  return result;
}

int exit_code(AnswerStatus status, bool of_ompl) {
  switch (status) {
    case AnswerStatus::kInfeasible:
    case AnswerStatus::kBlocked:
      return 1;
    case AnswerStatus::kInvalidStart:
    case AnswerStatus::kInvalidGoal:
      return 3;
    case AnswerStatus::kUndecided:
      return of_ompl ? 4 : 5;
    default:
      return 0;
  }
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

json free_space_json(const Scene& scene, const FreeSpace* free) {
  json result{{"scene", scene.name},   {"motions", kTranslation},
              {"components", nullptr}, {"tight", nullptr},
              {"touching", nullptr},   {"contact", scene.contact == ContactRule::kAllow ? "allow" : "forbid"}};
  if (free == nullptr) return result;
  result["components"] = json::array();
  for (const Component& component : free->components()) {
    result["components"].push_back(
        {{"dimension", component.dimension}, {"bounded", component.bounded}, {"cells", component.cells}});
  }
  result["tight"] = passages_json(*free);
  result["touching"] = touching_json(*free);
  return result;
}

json answer_report(const Answer& answer, const Scene& scene, const FreeSpace* free) {
  json result = free_space_json(scene, free);
  result.update(answer_json(answer, scene));
  return result;
}

std::string unrounded_text(const std::vector<std::size_t>& waypoints) {
  if (waypoints.empty()) return "";
  std::string text = "way-points with more decimals than --digits, because none with fewer are free:";
  for (const std::size_t i : waypoints) text += ' ' + std::to_string(i);
  return text + '\n';
}

std::string duration_text(std::span<const double> times) {
  if (times.empty()) return "";
  std::ostringstream line;
  line << "takes " << times.back() << " s\n";
  return line.str();
}

std::string timed_text(const std::string& columns, const std::vector<double>& times,
                       const std::function<std::vector<double>(std::size_t waypoint)>& row) {
  std::string out = "t," + columns + '\n';
  for (const std::size_t i : distinct_times(times)) {
    append_number(out, times[i]);
    for (const double value : row(i)) append_number(out += ',', value);
    out += '\n';
  }
  return out;
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
    if (!passage.volumes.empty()) {
      out << ", joins";
      names(passage.volumes);
    }
    if (passage.bottleneck) {
      out << ", bottleneck: piece " << passage.bottleneck->piece << ", junction " << passage.bottleneck->junction;
    }
    out << '\n';
    for (const CellId cell : passage.cells) list("  ", cell);
    for (const CellId cell : passage.mouths) list("  mouth ", cell);
  }
  for (const TouchingVolumes& touching : free.touching_volumes()) {
    out << "touch: dimension " << touching.dimension << ", component " << touching.component << ", joins";
    names(touching.volumes);
    out << '\n';
    for (const CellId cell : touching.cells) list("  ", cell);
  }
  return out.str();
}

}  // namespace nef::planner
