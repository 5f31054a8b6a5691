// SPDX-License-Identifier: Apache-2.0
//
// Cheapest first: is an end not free, and, if only a path is asked for, is there one in a part of free space
// (`partial_answer`)? Otherwise all of free space is computed, and queries, a given path, OMPL's planners or the
// scene's own question are answered from it.
#include "apps/planner/command/runs/runs.h"

#include <algorithm>
#include <iostream>
#include <sstream>

#include "apps/planner/clearance/timing.h"
#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/path/partial_answer.h"
#include "apps/planner/path/path_file.h"
#include "apps/planner/path/queries.h"
#include "apps/planner/path/question.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {
namespace {

class TranslationRun {
 public:
  TranslationRun(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                 const std::vector<RigidPose>& given, const TimeLimit& limit)
      : a_(a), scene_(scene), widest_(widest), given_(given), limit_(limit) {}

  int run() {
    try {
      return answer();
    } catch (const Interrupted&) {
      Answer answer;
      answer.status = Answer::Status::kUndecided;
      answer.phases["op"] = watch_.seconds();
      return tell_answer(answer, nullptr);
    }
  }

 private:
  int answer() {
    if (asks_for_a_path_only()) {
      if (scene_.start && scene_.goal) {
        const auto invalid = Problem::invalid_end(scene_, *scene_.start, *scene_.goal, limit_.monitor());
        if (invalid) return tell_answer(*invalid, nullptr);
      }
      if (const std::optional<Answer> found = partial_answer(scene_, a_.path, limit_.monitor())) {
        a_.session.note("tight passages were not searched, because there is a path without them; --tight lists them");
        return tell_answer(*found, nullptr);
      }
    }
    const Problem problem(scene_, limit_.monitor());
    a_.session.hide_phase();
    if (!a_.queries.empty()) return answer_queries(problem);
    if (!given_.empty()) return check_given_path(problem);
    if (!a_.benchmark.empty()) return run_benchmark(problem, a_);
    if (!a_.ompl.empty()) return run_stock_planner(problem);
    return answer_question(problem);
  }

  // Nothing about free space.
  [[nodiscard]] bool asks_for_a_path_only() const {
    return !a_.tight && !a_.path.raw && a_.page.empty() && given_.empty() && a_.queries.empty() && a_.ompl.empty() &&
           a_.benchmark.empty() && std::none_of(a_.outputs.begin(), a_.outputs.end(), is_view_file);
  }

  // `free` is all of free space, or null if only a part of it was made.
  int tell_answer(const Answer& answer, const FreeSpace* free) const {
    tell_answer(answer, free, [&] { print(answer); });
    return exit_code(answer.status);
  }
  void tell_answer(const Answer& answer, const FreeSpace* free, const std::function<void()>& for_people) const {
    write_translation_proof(a_, scene_, free, answer, given_);
    const std::vector<double> times =
        answer.path && a_.limits.speed > 0 ? times_of(lengths_of(*answer.path), a_.limits) : std::vector<double>();
    const auto report = [&] {
      nlohmann::json members = answer_report(answer, scene_, free);
      if (!times.empty()) members["times_s"] = times;
      if (!widest_.is_null()) members["widest"] = widest_;
      return members;
    };
    // The report whatever the answer; other formats hold a path.
    const auto text = [&](const std::string& extension) -> std::optional<std::string> {
      if (!answer.path) return std::nullopt;
      if (extension == "csv") {
        return timed_text("x,y,z", times, [&answer](std::size_t i) {
          const Vector3d at = to_vector(answer.path->points[i]);
          return std::vector<double>{at[0], at[1], at[2]};
        });
      }
      return extension == "path" || a_.se3 ? path_matrix(*answer.path, a_.se3) : path_text(*answer.path);
    };
    const auto print_all = [&] {
      for_people();
      std::cout << duration_text(times);
    };
    tell(a_, {"plan", scene_.name, report, report_phases(answer.phases), print_all, text,
              [&] { return view_layers(answer, scene_, free); }});
  }

  void print(const Answer& answer) const {
    if (!widest_.is_null()) std::cout << widest_text(widest_);
    std::cout << status_name(answer.status);
    if (answer.status == AnswerStatus::kInfeasible) std::cout << " by translation at this orientation";
    if (answer.status == AnswerStatus::kUndecided) std::cout << ": the time limit (--time) was reached";
    if (answer.blocked_segment) std::cout << ": segment " << *answer.blocked_segment << " leaves free space";
    if (answer.collision) std::cout << ": " << describe(*answer.collision, scene_);
    if (answer.status == AnswerStatus::kInfeasible) {
      std::cout << ": start is in component " << answer.start_component << ", goal in component "
                << answer.goal_component;
      if (answer.start_component == answer.goal_component) std::cout << ", joined only by thinner passages";
    }
    std::cout << '\n';
    if (answer.path) print_path(answer);
  }

  void print_path(const Answer& answer) const {
    const Thinness& of_path = answer.path->thinness;
    std::cout << "length " << answer.path->length << ", thinnest piece " << of_path.piece << ", thinnest junction "
              << of_path.junction;
    const bool better =
        answer.thinness && (answer.thinness->piece > of_path.piece || answer.thinness->junction > of_path.junction);
    if (better) {
      std::cout << " (--prefer roomy finds a path with " << answer.thinness->piece << " and "
                << answer.thinness->junction << ")";
    }
    std::cout << '\n' << unrounded_text(answer.path->unrounded);
    if (a_.outputs.empty()) std::cout << path_text(*answer.path);
  }

  int check_given_path(const Problem& problem) const {
    std::vector<Rational3> points;
    for (const RigidPose& pose : given_) points.push_back(pose.position);
    const Answer answer = problem.check(points);
    const auto for_people = [&] {
      print(answer);
      if (!answer.path || !a_.tight) return;
      std::cout << passages_text(problem.free_space()) << "uses passages:";
      for (const std::uint32_t passage : answer.path->passages) std::cout << ' ' << passage;
      std::cout << (answer.path->passages.empty() ? " none\n" : "\n");
    };
    tell_answer(answer, &problem.free_space(), for_people);
    return exit_code(answer.status);
  }

  // One line for each question, or one report with all answers.
  int answer_queries(const Problem& problem) const {
    const bool wants_report = a_.session.json || !a_.outputs.empty();
    int code = 0;
    std::ostringstream lines;
    nlohmann::json answers = nlohmann::json::array();
    for (const Query& query : read_queries(a_.queries)) {
      const Answer answer = problem.solve(query.start, query.goal, a_.path, limit_.monitor());
      code = std::max(code, exit_code(answer.status));
      if (wants_report) {
        nlohmann::json& entry = answers.emplace_back(answer_json(answer, scene_));
        entry["start"] = exact_json(query.start);
        entry["goal"] = exact_json(query.goal);
        entry["query_s"] = answer.phases.at("query");
      }
      lines << status_name(answer.status);
      if (answer.path) lines << ", length " << answer.path->length;
      if (answer.collision) lines << ": " << describe(*answer.collision, scene_);
      lines << '\n';
    }
    const auto report = [&] {
      nlohmann::json members = free_space_json(scene_, &problem.free_space());
      members["queries"] = std::move(answers);
      return members;
    };
    tell(a_, {"queries", scene_.name, report, report_phases(problem.phases()), [&] { std::cout << lines.str(); }});
    return code;
  }

  int run_stock_planner(const Problem& problem) const {
    const OmplOutcome outcome = run_ompl(problem, {a_.ompl, a_.time.value_or(kOmplSeconds), a_.runs, a_.path.digits});
    const auto for_people = [&] {
      std::cout << outcome.summary << '\n';
      if (outcome.answer.path) print(outcome.answer);
    };
    tell_answer(outcome.answer, &problem.free_space(), for_people);
    return outcome.exit_code;
  }

  int answer_question(const Problem& problem) const {
    const bool list_only = a_.tight && a_.outputs.empty();
    // There is something to show without a question, too.
    const bool needs_no_question = a_.tight || !a_.page.empty();
    Answer answer;
    answer.phases = problem.phases();
    if ((scene_.start && scene_.goal) || !needs_no_question) answer = problem.solve(a_.path, limit_.monitor());
    const auto for_people = [&] {
      if (!list_only) print(answer);
      if (a_.tight) std::cout << passages_text(problem.free_space());
    };
    tell_answer(answer, &problem.free_space(), for_people);
    return list_only ? 0 : exit_code(answer.status);
  }

  const Arguments& a_;
  const Scene& scene_;
  const nlohmann::json& widest_;
  const std::vector<RigidPose>& given_;
  const TimeLimit& limit_;
  Stopwatch watch_;
};

}  // namespace

int run_translations(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                     const std::vector<RigidPose>& given, const TimeLimit& limit) {
  return TranslationRun(a, scene, widest, given, limit).run();
}

}  // namespace nef::planner
