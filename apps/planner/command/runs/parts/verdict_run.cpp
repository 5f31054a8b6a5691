// SPDX-License-Identifier: Apache-2.0
//
// One run: read the file, which is an assembly or a mechanism by its keys, judge its parts, and write one report with a
// witness for each answer. For people: a line for each pair that overlaps or touches, for the smallest gap, and for
// each part.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/runs/runs.h"
#include "apps/planner/mechanism/range_of_motion.h"
#include "apps/planner/verdict/verdict.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/report.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

using nlohmann::json;

// What a file has: parts, and how one of them moves.
struct Judged {
  Assembly assembly;
  std::optional<Mechanism> mechanism;
};

Judged read_parts(const Arguments& a) {
  Judged result;
  const std::string text = read_file(a.verdict);
  const std::string folder = std::filesystem::path(a.verdict).parent_path().string();
  const json root = parse_exact_json(text, a.verdict);
  if (root.is_object() && root.contains("moving")) {
    result.mechanism = parse_mechanism(text, folder, a.verdict, a.session.mesh);
    result.assembly = assembly_of(*result.mechanism);
  } else {
    result.assembly = parse_assembly(text, folder, a.verdict, a.session.mesh);
  }
  return result;
}

json vector_json(const Integer3& v) { return {v[0].get_str(), v[1].get_str(), v[2].get_str()}; }

json pair_json(const PairVerdict& pair, const Assembly& assembly) {
  json result{{"parts", {assembly.names[pair.a], assembly.names[pair.b]}},
              {"contact", contact_name(pair.distance.contact)},
              {"squared", to_string(pair.distance.squared)},
              {"distance", pair.distance.value()},
              {"on_a", exact_json(pair.distance.on_a)},
              {"on_b", exact_json(pair.distance.on_b)}};
  if (pair.touching) result["items"] = *pair.touching;
  if (pair.interference) {
    const Interference& found = *pair.interference;
    result["overlap"] = {{"volume", found.exact_volume ? json(to_string(*found.exact_volume)) : json()},
                         {"volume_double", found.volume.value},
                         {"volume_error", found.volume.error},
                         {"bbox_exact", {exact_json(found.box[0]), exact_json(found.box[1])}},
                         {"bbox", {double_json(found.box[0]), double_json(found.box[1])}}};
  }
  return result;
}

json part_json(const PartVerdict& part, std::size_t number, const Assembly& assembly) {
  json result{{"name", assembly.names[number]}, {"status", status_name(part.status)}};
  if (part.status == PartVerdict::Status::kOverlapping) return result;
  if (part.direction) result["direction"] = exact_json(*part.direction);
  json first{{"dimension", part.first.dimension}, {"everything", part.first.everything}};
  first["rays"] = json::array();
  for (const Integer3& ray : part.first.rays) first["rays"].push_back(vector_json(ray));
  first["stops"] = json::array();
  for (const FreeDirections::Stop& stop : part.first.stops) {
    json normals = json::array();
    for (const Integer3& n : stop.directions) normals.push_back(vector_json(n));
    first["stops"].push_back({{"part", assembly.names[stop.part]}, {"normals", std::move(normals)}});
  }
  result["first_motions"] = std::move(first);
  return result;
}

std::string stops_text(const PartVerdict& part, const Assembly& assembly) {
  std::set<std::size_t> by;
  for (const FreeDirections::Stop& stop : part.first.stops) by.insert(stop.part);
  std::string text;
  for (const std::size_t other : by) text += (text.empty() ? "" : ", ") + assembly.names[other];
  return text;
}

void print_pair(const PairVerdict& pair, const Assembly& assembly) {
  std::cout << assembly.names[pair.a] << " and " << assembly.names[pair.b];
  if (pair.interference) {
    const Interference& found = *pair.interference;
    std::cout << " overlap: volume "
              << (found.exact_volume ? to_string(*found.exact_volume) : json(found.volume.value).dump())
              << ", in the box from " << point_text(found.box[0]) << " to " << point_text(found.box[1]) << '\n';
  } else if (pair.touching) {
    std::cout << " touch at " << point_text(pair.distance.on_a) << " (" << (*pair.touching)[0] << " and "
              << (*pair.touching)[1] << ")\n";
  } else {
    std::cout << ": distance " << json(pair.distance.value()).dump() << ", from " << point_text(pair.distance.on_a)
              << " to " << point_text(pair.distance.on_b) << '\n';
  }
}

void print(const PartsVerdict& verdict, const Assembly& assembly) {
  const std::optional<std::size_t> smallest = verdict.smallest_gap();
  for (std::size_t i = 0; i < verdict.pairs.size(); ++i) {
    const PairVerdict& pair = verdict.pairs[i];
    if (pair.interference || pair.touching || i == smallest) print_pair(pair, assembly);
  }
  for (std::size_t part = 0; part < verdict.parts.size(); ++part) {
    const PartVerdict& judged = verdict.parts[part];
    std::cout << assembly.names[part] << ": " << status_name(judged.status);
    if (judged.direction) std::cout << " along " << point_text(*judged.direction);
    if (judged.status == PartVerdict::Status::kStuck) std::cout << ", blocked by " << stops_text(judged, assembly);
    if (judged.status == PartVerdict::Status::kUndecided) {
      std::cout << ": it can begin to move, but no straight line that was tried leads out; try --assembly";
    }
    std::cout << '\n';
  }
}

json verdict_json(const PartsVerdict& verdict, const Assembly& assembly) {
  json result{{"status", verdict.interferes() ? "overlap" : "clear"}};
  for (const PairVerdict& pair : verdict.pairs) result["pairs"].push_back(pair_json(pair, assembly));
  const std::optional<std::size_t> smallest = verdict.smallest_gap();
  result["smallest_gap"] = smallest ? json(*smallest) : json();
  for (std::size_t part = 0; part < verdict.parts.size(); ++part) {
    result["parts"].push_back(part_json(verdict.parts[part], part, assembly));
  }
  return result;
}

}  // namespace

int run_verdict(const Arguments& a) {
  const Stopwatch watch;
  const Judged judged = read_parts(a);
  const Assembly& assembly = judged.assembly;
  a.session.note_all(assembly.messages);
  const double setup_s = watch.seconds();
  const PartsVerdict found = verdict(assembly, {a.exact, a.session.monitor});
  std::optional<RangeOfMotion> range;
  if (judged.mechanism) range = range_of_motion(*judged.mechanism, a.session.monitor);
  const auto report = [&] {
    json answer = verdict_json(found, assembly);
    answer["assembly"] = assembly.name;
    if (range) answer["range"] = range_json(*range, *judged.mechanism);
    return answer;
  };
  const auto print_all = [&] {
    print(found, assembly);
    if (range) print_range(*range, *judged.mechanism);
  };
  tell(a,
       {"verdict", assembly.name, report, {{"setup", setup_s, {}}, {"op", watch.seconds() - setup_s, {}}}, print_all});
  if (found.interferes()) return 3;
  return range && is_undecided(*range) ? 5 : 0;
}

}  // namespace nef::planner
