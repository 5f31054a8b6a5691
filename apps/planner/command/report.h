// SPDX-License-Identifier: Apache-2.0
//
// Answers of the planner as data: JSON, text, OMPL's path matrix.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/path/answer.h"
#include "apps/program/reports/run_report.h"

namespace nef::planner {

/// Exit code of the command: 0 path (or no question), 1 infeasible (or a given path is blocked), 3 invalid start or
/// goal, 5 undecided; 4 instead of that for a planner of OMPL.
int exit_code(AnswerStatus status, bool of_ompl = false);

/// What an answer is about, key `motions` of reports: translations at one orientation, turns about an axis, too, or all
/// rigid motions.
inline constexpr const char* kTranslation = "translation";
inline constexpr const char* kTranslationAndTurning = "translation and turning";
inline constexpr const char* kRigid = "rigid";

/// A line that names way-points which could not be rounded; nothing if there are none.
std::string unrounded_text(const std::vector<std::size_t>& waypoints);

/// A line for people: how long a motion with these time stamps takes; nothing without time stamps.
std::string duration_text(std::span<const double> times);

/// Way-points with time stamps, a line each: t and the numbers of `row`, which stand under `columns`.
std::string timed_text(const std::string& columns, const std::vector<double>& times,
                       const std::function<std::vector<double>(std::size_t waypoint)>& row);

/// Points as exact strings, and as doubles.
nlohmann::json points_json(const std::vector<Rational3>& points);
nlohmann::json double_points_json(const std::vector<Rational3>& points);

/// What an invalid start or goal, or a blocked path, collides with.
nlohmann::json collision_json(const Collision& collision, const Scene& scene);

/// The keys of one answer: status, path, proof, collision.
nlohmann::json answer_json(const Answer& answer, const Scene& scene);
/// Those of the scene and its free space: components, passages, contact. `free` is null if not all of it is known.
nlohmann::json free_space_json(const Scene& scene, const FreeSpace* free);
/// Both.
nlohmann::json answer_report(const Answer& answer, const Scene& scene, const FreeSpace* free);
/// The phases of an answer for a report.
std::vector<ReportPhase> report_phases(const std::map<std::string, double>& seconds);
/// Tight passages, and where volumes only touch, for people.
std::string passages_text(const FreeSpace& free);

}  // namespace nef::planner
