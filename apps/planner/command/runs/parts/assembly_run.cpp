// SPDX-License-Identifier: Apache-2.0
//
// One run: check the options, read the parts, take them apart, write files, print. The report, the text and the layers
// of pages (assembly_view.h) are made from the same Disassembly.
#include "apps/planner/command/runs/runs.h"

#include <iostream>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/clearance/clear_disassembly.h"
#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/parts/assembly_view.h"
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

// With a clearance, parts are "too_close" instead of overlapping.
const char* status_of(const Disassembly& answer, bool with_clearance) {
  if (answer.overlap) return with_clearance ? "too_close" : "overlap";
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
          {"interlocked", names_of(stuck.interlocked, assembly)},
          {"interlocked_is_least", stuck.interlocked_is_least},
          {"blocked_by", std::move(blocked)}};
}

std::string vector_text(const Rational3& v) {
  std::string text;
  for (const Rational& x : v) text += ' ' + brief_text(x);
  return text;
}

void print(const Disassembly& answer, const Assembly& assembly, bool with_clearance) {
  std::cout << status_of(answer, with_clearance);
  if (answer.overlap) {
    std::cout << ": " << assembly.names[answer.overlap->first] << " and " << assembly.names[answer.overlap->second];
  }
  std::cout << '\n';
  for (const DisassemblyStep& step : answer.steps) {
    if (!step.vectors.empty()) {
      std::cout << "at once, in different directions:\n";
      for (std::size_t i = 0; i < step.parts.size(); ++i) {
        std::cout << "  " << assembly.names[step.parts[i]] << " to" << vector_text(step.vectors[i]) << '\n';
      }
      continue;
    }
    if (step.turning) {
      std::cout << list_of(step.parts, assembly) << ": turning, by " << step.path.size() << " poses, to"
                << vector_text(step.path.back()) << '\n';
      continue;
    }
    std::cout << list_of(step.parts, assembly) << (step.straight ? ": straight" : ": by a path of")
              << (step.straight ? "" : " " + std::to_string(step.path.size()) + " way-points") << ", to"
              << vector_text(step.path.back()) << '\n';
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
    if (stuck.interlocked != stuck.parts) {
      std::cout << (stuck.interlocked_is_least ? "  interlocked: " : "  interlocked, perhaps with fewer: ")
                << list_of(stuck.interlocked, assembly) << '\n';
    }
  }
  for (const Undecided& open : answer.undecided) {
    std::cout << "undecided: " << list_of(open.parts, assembly) << " (covered: " << covered_text(open)
              << (assembly.turns() ? "; try a longer --time or more --max-cells)\n" : "; try a longer --time)\n");
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
  if (assembly.turns()) {
    throw InputError("--proof " + a.proof + ": such proofs are about translations only; remove 'rotation' from " +
                     a.assembly);
  }
  if (answer.inseparable.empty()) {
    throw InputError("--proof " + a.proof + ": no parts are inseparable, so there is nothing to prove");
  }
  // A few parts that hold each other are a shorter proof, unless these can begin to move by themselves.
  const Inseparable& stuck = answer.inseparable.front();
  std::optional<InseparableProof> proof = make_inseparable_proof(assembly, stuck.interlocked, a.session.monitor);
  if (!proof && stuck.interlocked != stuck.parts) {
    proof = make_inseparable_proof(assembly, stuck.parts, a.session.monitor);
  }
  if (!proof) {
    throw InputError(
        "--proof " + a.proof +
        ": some of these parts can begin to move, though none can leave; only parts that cannot move have a proof");
  }
  write_file(a.proof, proof_text(*proof));
  if (proof->parts.size() < assembly.parts.size()) {
    std::string names;
    for (const InseparableProof::Part& part : proof->parts) names += (names.empty() ? "" : ", ") + part.name;
    a.session.note(a.proof + " covers only " + names);
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

// How parts turn: about a pivot, by the quaternions of poses, whose positions are in the path.
json turning_json(const TurningWay& way) {
  json quaternions = json::array();
  for (const RigidPose& pose : way.poses) quaternions.push_back(exact_json(pose.quaternion));
  return {{"pivot", exact_json(way.pivot)}, {"quaternions", std::move(quaternions)}};
}

json assembly_json(const Disassembly& answer, const Assembly& assembly, bool with_clearance) {
  const char* const motions = assembly.turns_freely ? kRigid : assembly.turns() ? kTranslationAndTurning : kTranslation;
  json result{{"assembly", assembly.name},
              {"status", status_of(answer, with_clearance)},
              {"motions", motions},
              {"steps", json::array()}};
  for (const DisassemblyStep& step : answer.steps) {
    json& told = result["steps"].emplace_back(json{{"parts", names_of(step.parts, assembly)},
                                                   {"stay", names_of(step.stay, assembly)},
                                                   {"straight", step.straight},
                                                   {"path", points_json(step.path)},
                                                   {"unrounded", step.unrounded},
                                                   {"path_double", double_points_json(step.path)}});
    if (step.turning) told["turning"] = turning_json(*step.turning);
    for (std::size_t i = 0; i < step.vectors.size(); ++i) {
      told["vectors"][assembly.names[step.parts[i]]] = exact_json(step.vectors[i]);
    }
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

int run_assembly(const Arguments& a, const TimeLimit& limit) {
  const Stopwatch watch;
  const Assembly assembly = read_assembly(a.assembly, a.session.mesh);
  a.session.note_all(assembly.messages);
  if (!a.free_directions.empty()) return tell_free_directions(a, assembly);
  if (!a.check_proof.empty()) return check_assembly_proof(a, assembly);
  const std::size_t max_cells = a.app->count("--max-cells") > 0 ? a.max_cells : DisassemblyOptions().max_cells;
  const DisassemblyOptions options{a.path.digits, a.simultaneous, max_cells};
  const Disassembly answer = a.keep_clear.empty()
                                 ? take_apart(assembly, options, limit.monitor())
                                 : take_apart_clear(assembly, parse_rational(a.keep_clear), options, limit.monitor());
  const bool clear = !a.keep_clear.empty();
  tell(a, {"assembly",
           assembly.name,
           [&] { return assembly_json(answer, assembly, clear); },
           {{"op", watch.seconds(), {}}},
           [&] { print(answer, assembly, clear); },
           nullptr,
           [&] { return assembly_layers(answer, assembly); }});
  write_proof(a, answer, assembly);
  if (answer.overlap) return 3;
  if (!answer.inseparable.empty()) return 1;
  return answer.undecided.empty() ? 0 : 5;
}

}  // namespace nef::planner
