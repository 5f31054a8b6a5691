// SPDX-License-Identifier: Apache-2.0
//
// One run: check the options, read the parts, take them apart, write files, print. The report, the text and the layers
// of pages are made from the same Disassembly. In a page each step takes an equal share of the time, and each part
// moves along its path at constant speed.
#include "apps/planner/command/runs/runs.h"

#include <iostream>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/number/brief_text.h"

namespace nef::planner {
namespace {

using nlohmann::json;

constexpr const char* kAllCovered = "all subassemblies";

// What is known of parts about which the search was stopped.
std::string covered_text(const Undecided& open) {
  if (open.proved_below <= 1) return "nothing";
  return "sets of fewer than " + std::to_string(open.proved_below) + " parts";
}

const char* status_of(const Disassembly& answer) {
  if (answer.overlap) return "overlap";
  if (!answer.inseparable.empty()) return "inseparable";
  return answer.undecided.empty() ? "sequence" : "undecided";
}

json names_of(const PartSet& parts, const Assembly& assembly) {
  json result = json::array();
  for (const std::size_t part : parts) result.push_back(assembly.names[part]);
  return result;
}

std::string list_of(const PartSet& parts, const Assembly& assembly) {
  std::string result;
  for (const std::size_t part : parts) result += (result.empty() ? "" : ", ") + assembly.names[part];
  return result;
}

json stuck_json(const Inseparable& stuck, const Assembly& assembly) {
  json blocked = json::object();
  for (const auto& [a, b] : stuck.blocked_by) blocked[assembly.names[a]].push_back(assembly.names[b]);
  return {{"parts", names_of(stuck.parts, assembly)},
          {"covered", kAllCovered},
          {"nothing_moves", stuck.nothing_moves},
          {"blocked_by", std::move(blocked)}};
}

// Each part in a layer of its own. A step takes the same time as any other, along its path at constant speed.
std::vector<view::Layer> layers_of(const Disassembly& answer, const Assembly& assembly) {
  std::vector<ShownSet> parts;
  for (std::size_t part = 0; part < assembly.parts.size(); ++part) {
    parts.push_back({assembly.names[part], assembly.parts[part], view::palette_color(part)});
  }
  std::vector<view::Layer> layers = layers_of(parts);
  if (answer.steps.empty()) return layers;
  const double slot = kPlaySeconds / static_cast<double>(answer.steps.size());
  for (std::size_t part = 0; part < layers.size(); ++part) {
    view::Motion& motion = layers[part].motion;
    view::Point at{0, 0, 0};
    motion.times.push_back(0);
    motion.offsets.push_back(at);
    for (std::size_t k = 0; k < answer.steps.size(); ++k) {
      const DisassemblyStep& step = answer.steps[k];
      const bool moves = std::find(step.parts.begin(), step.parts.end(), part) != step.parts.end();
      const view::Point begin = at;
      double length = 0;
      for (std::size_t i = 1; moves && i < step.path.size(); ++i) length += distance(step.path[i - 1], step.path[i]);
      double way = 0;
      for (std::size_t i = 1; moves && i < step.path.size(); ++i) {
        way += distance(step.path[i - 1], step.path[i]);
        for (std::size_t c = 0; c < 3; ++c) at[c] = begin[c] + nearest_double(step.path[i][c]);
        const double time = slot * (static_cast<double>(k) + way / length);
        if (!(time > motion.times.back())) continue;
        motion.times.push_back(time);
        motion.offsets.push_back(at);
      }
      const double end = slot * static_cast<double>(k + 1);
      if (end > motion.times.back()) {
        motion.times.push_back(end);
        motion.offsets.push_back(at);
      }
    }
  }
  return layers;
}

void print(const Disassembly& answer, const Assembly& assembly) {
  std::cout << status_of(answer);
  if (answer.overlap) {
    std::cout << ": " << assembly.names[answer.overlap->first] << " and " << assembly.names[answer.overlap->second];
  }
  std::cout << '\n';
  for (const DisassemblyStep& step : answer.steps) {
    std::cout << list_of(step.parts, assembly) << (step.straight ? ": straight" : ": by a path of")
              << (step.straight ? "" : " " + std::to_string(step.path.size()) + " way-points") << ", to";
    for (const Rational& x : step.path.back()) std::cout << ' ' << brief_text(x);
    std::cout << '\n';
    std::cout << unrounded_text(step.unrounded);
  }
  for (const Inseparable& stuck : answer.inseparable) {
    std::cout << "inseparable: " << list_of(stuck.parts, assembly)
              << (stuck.nothing_moves ? "; no subset of them can move" : "; no subset of them can leave") << " ("
              << kAllCovered << ")\n";
    for (const std::size_t part : stuck.parts) {
      PartSet by;
      for (const auto& [a, b] : stuck.blocked_by) {
        if (a == part) by.push_back(b);
      }
      std::cout << "  " << assembly.names[part] << " is blocked by " << list_of(by, assembly) << '\n';
    }
  }
  for (const Undecided& open : answer.undecided) {
    std::cout << "undecided: " << list_of(open.parts, assembly) << " (covered: " << covered_text(open)
              << "; try a longer --time)\n";
  }
}

// The cone of one part; with -o as a set, cut by the cube from -1 to 1.
int tell_free_directions(const Arguments& a, const Assembly& assembly) {
  const auto found = std::find(assembly.names.begin(), assembly.names.end(), a.free_directions);
  if (found == assembly.names.end()) {
    throw InputError("--free-directions " + a.free_directions + ": " + a.assembly + " has no such part");
  }
  Blocking blocking(assembly.parts, a.session.monitor);
  if (const auto overlap = blocking.overlapping()) {
    throw InputError(a.assembly + ": " + assembly.names[overlap->first] + " and " + assembly.names[overlap->second] +
                     " overlap");
  }
  const Stopwatch watch;
  const FreeDirections free =
      free_directions(blocking, static_cast<std::size_t>(found - assembly.names.begin()), a.session.monitor);
  json rays = json::array();
  for (const Integer3& ray : free.rays) {
    rays.push_back({ray[0].get_str(), ray[1].get_str(), ray[2].get_str()});
  }
  // Sets first: the report says what is to be known of their files.
  for (const std::string& file : a.outputs) {
    if (lower_extension(file) != "json") a.session.store_at(file, free.cone, a.session.write_options(file));
  }
  const auto report = [&] {
    Json members{{"assembly", assembly.name},
                 {"part", a.free_directions},
                 {"dimension", free.dimension},
                 {"everything", free.everything},
                 {"rays", rays}};
    a.session.add_offsets(members);
    return members;
  };
  const auto print_cone = [&free] {
    std::cout << (free.everything ? "every direction" : "dimension " + std::to_string(free.dimension)) << '\n';
    for (const Integer3& ray : free.rays) std::cout << ray[0] << ' ' << ray[1] << ' ' << ray[2] << '\n';
  };
  tell(a, {"free_directions", assembly.name, report, {{"op", watch.seconds(), {}}}, print_cone});
  return 0;
}

// The proof that nothing of the first parts that are stuck can begin to move.
void write_proof(const Arguments& a, const Disassembly& answer, const Assembly& assembly) {
  if (a.proof.empty()) return;
  if (answer.inseparable.empty()) {
    throw InputError("--proof " + a.proof + ": no parts are inseparable, so there is nothing to prove");
  }
  const std::optional<InseparableProof> proof =
      make_inseparable_proof(assembly, answer.inseparable.front().parts, a.session.monitor);
  if (!proof) {
    throw InputError(
        "--proof " + a.proof +
        ": some of these parts can begin to move, though none can leave; only parts that cannot move have a proof");
  }
  write_file(a.proof, proof_text(*proof));
  if (answer.inseparable.size() > 1) {
    a.session.note(a.proof + " covers only " + list_of(answer.inseparable.front().parts, assembly));
  }
}

int check_assembly_proof(const Arguments& a, const Assembly& assembly) {
  const Stopwatch watch;
  const InseparableProof proof = parse_inseparable_proof(read_file(a.check_proof), a.check_proof);
  std::optional<std::string> complaint = complaint_about(proof);
  if (!complaint) complaint = complaint_about(proof, assembly, a.session.monitor);
  std::string names;
  for (const InseparableProof::Part& part : proof.parts) names += (names.empty() ? "" : ", ") + part.name;
  return tell_check(a, assembly.name, {{"assembly", assembly.name}, {"claim", "inseparable"}}, complaint,
                    ": inseparable, " + names, watch);
}

json assembly_json(const Disassembly& answer, const Assembly& assembly) {
  json result{
      {"assembly", assembly.name}, {"status", status_of(answer)}, {"motions", kTranslation}, {"steps", json::array()}};
  for (const DisassemblyStep& step : answer.steps) {
    result["steps"].push_back({{"parts", names_of(step.parts, assembly)},
                               {"stay", names_of(step.stay, assembly)},
                               {"straight", step.straight},
                               {"path", points_json(step.path)},
                               {"unrounded", step.unrounded},
                               {"path_double", double_points_json(step.path)}});
  }
  for (const Inseparable& stuck : answer.inseparable) {
    result["inseparable"].push_back(stuck_json(stuck, assembly));
  }
  for (const Undecided& open : answer.undecided) {
    result["undecided"].push_back({{"parts", names_of(open.parts, assembly)}, {"covered", covered_text(open)}});
  }
  if (answer.overlap)
    result["overlap"] = {assembly.names[answer.overlap->first], assembly.names[answer.overlap->second]};
  return result;
}

}  // namespace

int run_assembly(const Arguments& a) {
  const TimeLimit limit(a.time, a.session.monitor);
  const Assembly assembly = read_assembly(a.assembly, a.session.mesh);
  a.session.note_all(assembly.messages);
  if (!a.free_directions.empty()) return tell_free_directions(a, assembly);
  if (!a.check_proof.empty()) return check_assembly_proof(a, assembly);
  const Disassembly answer = take_apart(assembly, a.path.digits, limit.monitor());
  tell(a, {"assembly",
           assembly.name,
           [&] { return assembly_json(answer, assembly); },
           {{"op", limit.passed(), {}}},
           [&] { print(answer, assembly); },
           nullptr,
           [&] { return layers_of(answer, assembly); }});
  write_proof(a, answer, assembly);
  if (answer.overlap) return 3;
  if (!answer.inseparable.empty()) return 1;
  return answer.undecided.empty() ? 0 : 5;
}

}  // namespace nef::planner
