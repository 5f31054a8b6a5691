// SPDX-License-Identifier: Apache-2.0
//
// `run` dispatches, cheapest first. After the usage check and reading come the questions that need no free space (a
// given path with rotations, a robot that turns, an end that is not free). Then, if only a path is asked for, a search
// for a path in a part of free space (`partial_answer`). Otherwise a Problem computes the whole free space, and
// queries, a given path, OMPL's planners or the scene's own question are answered from it. Each branch writes its
// files, prints, and returns the exit code.
#include "apps/planner/command/run.h"

#include <algorithm>
#include <iostream>

#include "apps/planner/clearance/keep_clear.h"
#include "apps/planner/command/arguments.h"
#include "apps/planner/command/assembly_run.h"
#include "apps/planner/command/certify_run.h"
#include "apps/planner/command/clearance_run.h"
#include "apps/planner/command/ompl_runs.h"
#include "apps/planner/command/proof_run.h"
#include "apps/planner/command/range_run.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/command/turning_run.h"
#include "apps/planner/path/partial_answer.h"
#include "apps/planner/path/path_file.h"
#include "apps/planner/path/queries.h"
#include "apps/planner/path/question.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/program/exact_json.h"
#include "apps/program/numbers.h"
#include "apps/program/run_program.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"

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
  Scene scene = read_scene(a.scene, a.session.mesh);
  Rational* const no_angle = nullptr;
  if (!a.start.empty()) scene.start = end_of(a.start, "--start", scene.rotation ? &scene.rotation->start : no_angle);
  if (!a.goal.empty()) scene.goal = end_of(a.goal, "--goal", scene.rotation ? &scene.rotation->goal : no_angle);
  if (!a.contact.empty()) scene.contact = a.contact == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  return scene;
}

// A scene and the free space in which answers were looked for: all of it, or a part.
struct Asked {
  // NOLINTNEXTLINE(google-explicit-constructor): a problem is both
  Asked(const Problem& problem) : scene(problem.scene()), free(problem.free_space()) {}
  Asked(const Scene& its_scene, const FreeSpace& part) : scene(its_scene), free(part), is_partial(true) {}
  const Scene& scene;
  const FreeSpace& free;
  bool is_partial = false;
};

// Everything about an answer, time stamps and the widest robot too, if they were asked for.
std::string report_of(const Arguments& a, const Answer& answer, const Asked& asked, const nlohmann::json& widest) {
  nlohmann::json more = nlohmann::json::object();
  if (answer.path && a.limits.speed > 0) more["times_s"] = times_of(lengths_of(*answer.path), a.limits);
  if (!widest.is_null()) more["widest"] = widest;
  if (asked.is_partial) more["components"] = more["tight"] = more["touching"] = nullptr;
  return report_text(answer_report(answer, asked.scene, asked.free, more));
}

// What a file holds: the report whatever the answer; other formats hold a path.
std::optional<std::string> rendered(const Arguments& a, const std::string& file, const Answer& answer,
                                    const Asked& asked, const nlohmann::json& widest) {
  const std::string extension = lower_extension(file);
  if (extension == "json") return report_of(a, answer, asked, widest);
  if (!answer.path) return std::nullopt;
  if (extension == "csv") {
    return timed_text("x,y,z", times_of(lengths_of(*answer.path), a.limits), [&answer](std::size_t i) {
      const Vector3d at = to_vector(answer.path->points[i]);
      return std::vector<double>{at[0], at[1], at[2]};
    });
  }
  if (extension == "path" || a.se3) return path_matrix(*answer.path, a.se3);
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
  const auto print_answer = [&] {
    if (!widest.is_null()) std::cout << widest_text(widest);
    std::cout << status_name(answer.status);
    if (answer.status == AnswerStatus::kInfeasible) std::cout << " by translation at this orientation";
    if (answer.status == AnswerStatus::kUndecided) std::cout << ": the --time was up";
    if (answer.blocked_segment) std::cout << ": segment " << *answer.blocked_segment << " leaves free space";
    if (answer.collision) std::cout << ": " << describe(*answer.collision, asked.scene);
    if (answer.status == AnswerStatus::kInfeasible) {
      std::cout << ": start is in component " << answer.start_component << ", goal in component "
                << answer.goal_component;
      if (answer.start_component == answer.goal_component) std::cout << ", joined only by thinner passages";
    }
    std::cout << '\n';
    if (answer.path) print_path(a, answer);
  };
  print_result(
      a, [&] { return report_of(a, answer, asked, widest); }, print_answer);
}

int check_given_path(const Arguments& a, const Problem& problem) {
  const std::vector<Rational3> points = read_waypoints(a.given_path);
  const Answer answer = problem.check(points);
  write_answer(a, answer, problem, nullptr, points);
  print(a, answer, problem);
  if (answer.path && a.tight && !a.session.json && !a.session.quiet) {
    std::cout << passages_text(problem.free_space()) << "uses passages:";
    for (const std::uint32_t passage : answer.path->passages) std::cout << ' ' << passage;
    std::cout << (answer.path->passages.empty() ? " none\n" : "\n");
  }
  return exit_code(answer.status);
}

// One line for each question, or one report with all answers.
int answer_queries(const Arguments& a, const Problem& problem, const Monitor& monitor) {
  PathOptions options = a.path;
  options.roomy = a.prefer == "roomy";
  const bool report = a.session.json || !a.outputs.empty();
  int code = 0;
  nlohmann::json answers = nlohmann::json::array();
  for (const Query& query : read_queries(a.queries)) {
    const Answer answer = problem.solve(query.start, query.goal, options, monitor);
    code = std::max(code, exit_code(answer.status));
    if (report) {
      nlohmann::json entry = answer_json(answer, problem.scene());
      entry["start"] = exact_json(query.start);
      entry["goal"] = exact_json(query.goal);
      entry["query_s"] = answer.phases.at("query");
      answers.push_back(std::move(entry));
    }
    if (a.session.json || a.session.quiet) continue;
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
  if (a.session.json) std::cout << text;
  return code;
}

int run_stock_planner(const Arguments& a, const Problem& problem) {
  const OmplOutcome outcome = run_ompl(problem, {a.ompl, a.time.value_or(kOmplSeconds), a.runs, a.path.digits});
  write_answer(a, outcome.answer, problem);
  if (!a.session.quiet && !a.session.json) std::cout << outcome.summary << '\n';
  if (a.session.json || outcome.answer.path) print(a, outcome.answer, problem);
  return outcome.exit_code;
}

int answer_question(const Arguments& a, const Problem& problem, const nlohmann::json& widest, const Monitor& monitor) {
  const Scene& scene = problem.scene();
  const bool list_only = a.tight && a.outputs.empty();
  // There is something to show without a question, too.
  const bool needs_no_question = a.tight || !a.page.empty();
  Answer answer;
  answer.phases = problem.phases();
  if ((scene.start && scene.goal) || !needs_no_question) {
    PathOptions options = a.path;
    options.roomy = a.prefer == "roomy";
    answer = problem.solve(options, monitor);
  }
  write_answer(a, answer, problem, widest);
  if (!list_only || a.session.json) print(a, answer, problem, widest);
  if (a.tight && !a.session.json && !a.session.quiet) std::cout << passages_text(problem.free_space());
  return list_only ? 0 : exit_code(answer.status);
}

// True if only a path is asked for, and nothing about free space.
bool asks_for_a_path_only(const Arguments& a) {
  return !a.tight && !a.path.raw && a.page.empty() && a.given_path.empty() && a.queries.empty() && a.ompl.empty() &&
         a.benchmark.empty() && std::none_of(a.outputs.begin(), a.outputs.end(), is_view_file);
}

// Writes and prints an answer that was found before free space was made.
int tell_without_free_space(const Arguments& a, const Answer& answer, const Scene& scene,
                            const nlohmann::json& widest) {
  a.session.hide_phase();
  const FreeSpace not_made{Polyhedron()};
  const Asked asked(scene, not_made);
  write_answer(a, answer, asked, widest);
  print(a, answer, asked, widest);
  return exit_code(answer.status);
}

// Asks whether start and goal are free before any free space is made; nothing if they are.
std::optional<int> answer_invalid_end(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                                      const Monitor& monitor) {
  if (!asks_for_a_path_only(a) || !scene.start || !scene.goal) return std::nullopt;
  const std::optional<Answer> answer = Problem::invalid_end(scene, *scene.start, *scene.goal, monitor);
  if (!answer) return std::nullopt;
  return tell_without_free_space(a, *answer, scene, widest);
}

// Looks for a path without cells and tight passages; nothing if there is none like that.
std::optional<int> answer_from_a_part(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                                      const Monitor& monitor) {
  if (!asks_for_a_path_only(a)) return std::nullopt;
  PathOptions options = a.path;
  options.roomy = a.prefer == "roomy";
  const std::optional<PartialAnswer> found = partial_answer(scene, options, monitor);
  if (!found) return std::nullopt;
  a.session.hide_phase();
  Scene told = scene;
  told.messages.emplace_back("tight passages were not looked for, since there is a path with room; --tight lists them");
  a.session.note(told.messages.back());
  const Asked asked(told, *found->free);
  write_answer(a, found->answer, asked, widest);
  print(a, found->answer, asked, widest);
  return exit_code(found->answer.status);
}

int answer_about_translations(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                              const Monitor& monitor) {
  if (const std::optional<int> code = answer_invalid_end(a, scene, widest, monitor)) return *code;
  if (const std::optional<int> code = answer_from_a_part(a, scene, widest, monitor)) return *code;
  const Problem problem(scene, monitor);
  a.session.hide_phase();
  if (!a.queries.empty()) return answer_queries(a, problem, monitor);
  if (!a.given_path.empty()) return check_given_path(a, problem);
  if (!a.benchmark.empty())
    return run_benchmark(problem, a.planners, a.time.value_or(kOmplSeconds), a.runs, a.benchmark, a.session.quiet);
  if (!a.ompl.empty()) return run_stock_planner(a, problem);
  return answer_question(a, problem, widest, monitor);
}

int run(const Arguments& a) {
  check_usage(a);
  a.session.mesh.monitor = a.session.monitor;
  if (!a.range.empty()) return run_range(a);
  if (!a.assembly.empty()) return run_assembly(a);
  a.session.show_phase("reading " + a.scene);
  Scene scene = scene_of(a);
  if (!a.keep_clear.empty()) keep_clear(scene, parse_rational(a.keep_clear), a.session.monitor);
  a.session.hide_phase();
  a.session.note_all(scene.messages);
  if (const std::optional<int> code = run_check_proof(a, scene)) return *code;
  if (!a.given_path.empty()) {
    if (const auto poses = read_poses(a.given_path)) return run_certify(a, scene, *poses);
  }
  nlohmann::json widest;
  if (a.widest || a.widest_box) widest = make_widest(a, scene);
  if (scene.rotation) {
    a.session.hide_phase();
    return run_turning(a, scene, widest);
  }
  if (!a.check_proof.empty())
    throw InputError("--check-proof " + a.check_proof + ": no .proof file, and the scene has no rotation");
  // An OMPL planner has the time for itself.
  const bool timed = a.ompl.empty() && a.benchmark.empty();
  const TimeLimit limit(timed ? a.time : std::nullopt, a.session.monitor);
  try {
    return answer_about_translations(a, scene, widest, limit.monitor());
  } catch (const Interrupted&) {
    Answer answer;
    answer.status = Answer::Status::kUndecided;
    answer.phases["op"] = limit.passed();
    return tell_without_free_space(a, answer, scene, widest);
  }
}

}  // namespace

int run_command(int argc, char** argv) {
  CLI::App app("Plans the motion of a translating robot exactly: a path, or a proof that there is none.", "planner");
  app.set_version_flag("--version", std::string("planner " NEF_VERSION));
  Session session("planner", std::cout, std::cerr);
  const ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = session.monitor.telling(show);
  Arguments arguments(session);
  declare(app, arguments);
  return run_program(
      app, argc, argv, [&] { return run(arguments); }, [&](const std::string& line) { session.complain(line); });
}

}  // namespace nef::planner
