// SPDX-License-Identifier: Apache-2.0
//
// `run` dispatches, cheapest first. After the usage check and reading come the questions that need no free space (a
// given path with rotations, a robot that turns, an end that is not free). Then, if only a path is asked for, a search
// for a path with room (`wide_answer`, `near_answer`). Otherwise a Problem computes the whole free space, and queries,
// a given path, OMPL's planners or the scene's own question are answered from it. Each branch writes its files, prints,
// and returns the exit code.
#include "apps/planner/command/run.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/planner/clearance/keep_clear.h"
#include "apps/planner/command/arguments.h"
#include "apps/planner/command/assembly_run.h"
#include "apps/planner/command/certify_run.h"
#include "apps/planner/command/clearance_run.h"
#include "apps/planner/command/notes.h"
#include "apps/planner/command/ompl_runs.h"
#include "apps/planner/command/proof_run.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/command/turning_run.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/path/near_answer.h"
#include "apps/planner/path/path_file.h"
#include "apps/planner/path/queries.h"
#include "apps/planner/path/question.h"
#include "apps/planner/path/wide_answer.h"
#include "apps/planner/rigid/pose_file.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"
#include "nef/program/exact_json.h"
#include "nef/program/numbers.h"
#include "nef/program/progress_bar.h"
#include "nef/program/run_program.h"

namespace nef::planner {
namespace {

// A position and, if the robot turns, degrees; if they are left out, those of the scene stay.
Rational3 end_of(const std::string& text, const std::string& option, Rational* degrees) {
  if (degrees == nullptr) return parse_triple(text, option);
  const std::vector<Rational> numbers = parse_numbers(text, option);
  if (numbers.size() != 3 && numbers.size() != 4) {
    throw InputError(option + ": expected x,y,z or x,y,z,degrees instead of '" + text + "'");
  }
  if (numbers.size() == 4) *degrees = numbers[3];
  return {numbers[0], numbers[1], numbers[2]};
}

Scene scene_of(const Arguments& a) {
  Scene scene = read_scene(a.scene);
  Rational* const no_angle = nullptr;
  if (!a.start.empty()) scene.start = end_of(a.start, "--start", scene.rotation ? &scene.rotation->start : no_angle);
  if (!a.goal.empty()) scene.goal = end_of(a.goal, "--goal", scene.rotation ? &scene.rotation->goal : no_angle);
  if (!a.contact.empty()) scene.contact = a.contact == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  return scene;
}

// Found out before any work is done.
void check_usage(const Arguments& a) {
  check_mesh_flags(a);
  if (!a.page.empty() && std::filesystem::path(a.page).extension() != ".html") {
    throw InputError("--page " + a.page + ": the extension must be .html");
  }
  if (!a.ompl.empty() && !a.benchmark.empty()) throw InputError("--ompl and --benchmark exclude each other");
  if (!a.given_path.empty() && !(a.ompl.empty() && a.benchmark.empty())) {
    throw InputError("--path checks a given path; it excludes --ompl and --benchmark");
  }
  if (!a.queries.empty() && !(a.ompl.empty() && a.benchmark.empty() && a.given_path.empty() && a.page.empty())) {
    throw InputError("--queries excludes --path, --page, --ompl and --benchmark");
  }
  for (const std::string& file : a.outputs) {
    if (!a.queries.empty() && std::filesystem::path(file).extension() != ".json") {
      throw InputError("-o " + file + ": with --queries the extension must be .json");
    }
  }
  check_clearance_usage(a);
  check_proof_usage(a);
  for (const std::string& name : a.planners) require_ompl_planner(name);
  if (!a.ompl.empty()) require_ompl_planner(a.ompl);
}

// A scene and the free space in which answers were looked for: all of it, or what has room.
struct Asked {
  // NOLINTNEXTLINE(google-explicit-constructor): a problem is both
  Asked(const Problem& problem) : scene(problem.scene()), free(problem.free_space()) {}
  Asked(const Scene& its_scene, const FreeSpace& wide) : scene(its_scene), free(wide), only_wide(true) {}
  const Scene& scene;
  const FreeSpace& free;
  bool only_wide = false;
};

// Everything about an answer, time stamps and the widest robot too, if they were asked for.
std::string report_of(const Arguments& a, const Answer& answer, const Asked& asked, const nlohmann::json& widest) {
  nlohmann::json more = nlohmann::json::object();
  if (answer.path && a.limits.speed > 0) more["times_s"] = times_along(*answer.path, a.limits);
  if (!widest.is_null()) more["widest"] = widest;
  if (asked.only_wide) more["components"] = more["tight"] = more["touching"] = nullptr;
  return report_text(answer_report(answer, asked.scene, asked.free, more));
}

// t,x,y,z, a way-point a line.
std::string timed_text(const ExactPath& path, const MotionLimits& limits) {
  const std::vector<double> times = times_along(path, limits);
  std::string out = "t,x,y,z\n";
  for (const std::size_t i : distinct_times(times)) {
    append_number(out, times[i]);
    for (const Rational& x : path.points[i]) append_number(out += ',', nearest_double(x));
    out += '\n';
  }
  return out;
}

// What a file holds: the report whatever the answer; other formats hold a path.
std::optional<std::string> rendered(const Arguments& a, const std::string& file, const Answer& answer,
                                    const Asked& asked, const nlohmann::json& widest) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".json") return report_of(a, answer, asked, widest);
  if (!answer.path) return std::nullopt;
  if (extension == ".csv") return timed_text(*answer.path, a.limits);
  if (extension == ".path" || a.se3) return path_matrix(*answer.path, a.se3);
  return path_text(*answer.path);
}

// `given` are the points of a path that is checked.
void write_answer(const Arguments& a, const Answer& answer, const Asked& asked, const nlohmann::json& widest = nullptr,
                  const std::vector<Rational3>& given = {}) {
  write_outputs(
      a, asked.scene.name, [&](const std::string& file) { return rendered(a, file, answer, asked, widest); },
      [&] { return view_layers(answer, asked.scene, asked.free); });
  write_translation_proof(a, asked.scene, asked.free.set(), answer, given);
}

void print_path(const Arguments& a, const Answer& answer) {
  const Thinness& of_path = answer.path->thinness;
  std::cout << "length " << answer.path->length << ", thinnest piece " << of_path.piece << ", thinnest junction "
            << of_path.junction;
  const bool better =
      answer.thinness && (answer.thinness->piece > of_path.piece || answer.thinness->junction > of_path.junction);
  if (better) {
    std::cout << " (another path: " << answer.thinness->piece << ", " << answer.thinness->junction
              << "; try --prefer roomy)";
  }
  std::cout << '\n';
  if (!answer.path->unrounded.empty()) std::cout << unrounded_text(answer.path->unrounded);
  if (a.outputs.empty()) std::cout << path_text(*answer.path);
}

void print(const Arguments& a, const Answer& answer, const Asked& asked, const nlohmann::json& widest = nullptr) {
  if (a.json) {
    std::cout << report_of(a, answer, asked, widest);
    return;
  }
  if (a.quiet) return;
  if (!widest.is_null()) std::cout << widest_text(widest);
  std::cout << status_name(answer.status);
  if (answer.status == Answer::Status::kInfeasible) std::cout << " by translation at this orientation";
  if (answer.blocked_segment) std::cout << ": segment " << *answer.blocked_segment << " leaves free space";
  if (answer.collision) std::cout << ": " << describe(*answer.collision, asked.scene);
  if (answer.status == Answer::Status::kInfeasible) {
    std::cout << ": start is in component " << answer.start_component << ", goal in component "
              << answer.goal_component;
    if (answer.start_component == answer.goal_component) std::cout << ", joined only by thinner passages";
  }
  std::cout << '\n';
  if (answer.path) print_path(a, answer);
}

int check_given_path(const Arguments& a, const Problem& problem) {
  const std::vector<Rational3> points = read_waypoints(a.given_path);
  const Answer answer = problem.check(points);
  write_answer(a, answer, problem, nullptr, points);
  print(a, answer, problem);
  if (answer.path && a.tight && !a.json && !a.quiet) {
    std::cout << passages_text(problem.free_space()) << "uses passages:";
    for (const std::uint32_t passage : answer.path->passages) std::cout << ' ' << passage;
    std::cout << (answer.path->passages.empty() ? " none\n" : "\n");
  }
  return exit_code(answer);
}

// One line for each question, or one report with all answers.
int answer_queries(const Arguments& a, const Problem& problem) {
  PathOptions options = a.path;
  options.roomy = a.prefer == "roomy";
  const bool report = a.json || !a.outputs.empty();
  int code = 0;
  nlohmann::json answers = nlohmann::json::array();
  for (const Query& query : read_queries(a.queries)) {
    const Answer answer = problem.solve(query.start, query.goal, options);
    code = std::max(code, exit_code(answer));
    if (report) {
      nlohmann::json entry = answer_json(answer, problem.scene());
      entry["start"] = exact_json(query.start);
      entry["goal"] = exact_json(query.goal);
      entry["query_s"] = answer.phases.at("query");
      answers.push_back(std::move(entry));
    }
    if (a.json || a.quiet) continue;
    std::cout << status_name(answer.status);
    if (answer.path) std::cout << ", length " << answer.path->length;
    if (answer.collision) std::cout << ": " << describe(*answer.collision, problem.scene());
    std::cout << '\n';
  }
  if (!report) return code;
  nlohmann::json result = free_space_json(problem.scene(), problem.free_space());
  result["queries"] = std::move(answers);
  const std::string text =
      report_text(run_report("queries", result, report_phases(problem.phases()), problem.scene().messages));
  for (const std::string& file : a.outputs) write_file(file, text);
  if (a.json) std::cout << text;
  return code;
}

int run_stock_planner(const Arguments& a, const Problem& problem) {
  const OmplOutcome outcome = run_ompl(problem, {a.ompl, a.seconds, a.runs, a.path.digits});
  write_answer(a, outcome.answer, problem);
  if (!a.quiet && !a.json) std::cout << outcome.summary << '\n';
  if (a.json || outcome.answer.path) print(a, outcome.answer, problem);
  return outcome.exit_code;
}

int answer_question(const Arguments& a, const Problem& problem, const nlohmann::json& widest) {
  const Scene& scene = problem.scene();
  const bool list_only = a.tight && a.outputs.empty();
  // There is something to show without a question, too.
  const bool needs_no_question = a.tight || !a.page.empty();
  Answer answer;
  answer.phases = problem.phases();
  if ((scene.start && scene.goal) || !needs_no_question) {
    PathOptions options = a.path;
    options.roomy = a.prefer == "roomy";
    answer = problem.solve(options);
  }
  write_answer(a, answer, problem, widest);
  if (!list_only || a.json) print(a, answer, problem, widest);
  if (a.tight && !a.json && !a.quiet) std::cout << passages_text(problem.free_space());
  return list_only ? 0 : exit_code(answer);
}

// True if only a path is asked for, and nothing about free space.
bool asks_for_a_path_only(const Arguments& a) {
  return !a.tight && !a.path.raw && a.page.empty() && a.given_path.empty() && a.queries.empty() && a.ompl.empty() &&
         a.benchmark.empty() && std::none_of(a.outputs.begin(), a.outputs.end(), is_view_file);
}

// Asks whether start and goal are free before any free space is made; nothing if they are.
std::optional<int> answer_invalid_end(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                                      ProgressBar& bar) {
  if (!asks_for_a_path_only(a) || !scene.start || !scene.goal) return std::nullopt;
  const std::optional<Answer> answer = Problem::invalid_end(scene, *scene.start, *scene.goal);
  if (!answer) return std::nullopt;
  bar.clear();
  const FreeSpace not_made{Polyhedron()};
  const Asked asked(scene, not_made);
  write_answer(a, *answer, asked, widest);
  print(a, *answer, asked, widest);
  return exit_code(*answer);
}

// Looks for a path without cells and tight passages; nothing if there is none like that.
std::optional<int> answer_without_tight_passages(const Arguments& a, const Scene& scene, const BuildOptions& build,
                                                 const nlohmann::json& widest, ProgressBar& bar) {
  if (!asks_for_a_path_only(a)) return std::nullopt;
  PathOptions options = a.path;
  options.roomy = a.prefer == "roomy";
  std::optional<WideAnswer> found;
  if (may_have_wide_answer(scene)) {
    found = wide_answer(scene, options, build);
  } else if (may_have_near_answer(scene)) {
    found = near_answer(scene, options, build);
  }
  if (!found) return std::nullopt;
  bar.clear();
  Scene told = scene;
  told.messages.emplace_back("tight passages were not looked for, since there is a path with room; --tight lists them");
  print_notes(a, {told.messages.back()});
  const Asked asked(told, *found->free);
  write_answer(a, found->answer, asked, widest);
  print(a, found->answer, asked, widest);
  return exit_code(found->answer);
}

int run(const Arguments& a) {
  if (!a.assembly.empty()) return run_assembly(a);
  if (!a.free_directions.empty()) throw InputError("--free-directions asks about a part of an --assembly");
  if (a.scene.empty()) throw InputError("scene is required: planner SCENE, or planner --assembly PARTS.json");
  check_usage(a);
  ProgressBar bar(!a.quiet && !a.json);
  BuildOptions build;
  build.threads = a.threads;
  build.progress = [&bar](const std::string& phase, std::size_t done, std::size_t total) {
    bar.show(phase, done, total);
  };
  bar.show("reading " + a.scene, 0, 0);
  Scene scene = scene_of(a);
  if (!a.keep_clear.empty()) keep_clear(scene, parse_rational(a.keep_clear));
  bar.clear();
  print_notes(a, scene.messages);
  if (const std::optional<int> code = run_check_proof(a, scene)) return *code;
  if (!a.given_path.empty()) {
    if (const auto poses = read_poses(a.given_path)) return run_certify(a, scene, *poses);
  }
  nlohmann::json widest;
  if (a.widest || a.widest_box) widest = make_widest(a, scene);
  if (scene.rotation) {
    bar.clear();
    return run_turning(a, scene, widest);
  }
  if (!a.check_proof.empty())
    throw InputError("--check-proof " + a.check_proof + ": no .proof file, and the scene has no rotation");
  if (const std::optional<int> code = answer_invalid_end(a, scene, widest, bar)) return *code;
  if (const std::optional<int> code = answer_without_tight_passages(a, scene, build, widest, bar)) return *code;
  const Problem problem(std::move(scene), build);
  bar.clear();
  if (!a.queries.empty()) return answer_queries(a, problem);
  if (!a.given_path.empty()) return check_given_path(a, problem);
  if (!a.benchmark.empty()) return run_benchmark(problem, a.planners, a.seconds, a.runs, a.benchmark, a.quiet);
  if (!a.ompl.empty()) return run_stock_planner(a, problem);
  return answer_question(a, problem, widest);
}

}  // namespace

int run_command(int argc, char** argv) {
  CLI::App app("Plans the motion of a translating robot exactly: a path, or a proof that there is none.", "planner");
  app.set_version_flag("--version", std::string("planner " NEF_VERSION));
  Arguments arguments;
  declare(app, arguments);
  return run_program(app, argc, argv, [&arguments] { return run(arguments); });
}

}  // namespace nef::planner
