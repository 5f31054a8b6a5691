// SPDX-License-Identifier: Apache-2.0
//
// The questions that the program `planner` answers, each in a source of its own name. A run writes and prints what was
// asked for and returns the exit code; errors in data and options that it does not know are thrown as nef::Error. A
// `limit` has been running since the program began to read: what it stops before there is anything to tell is thrown as
// Interrupted.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/mechanism/range_of_motion.h"
#include "apps/planner/path/answer.h"
#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/view/layer.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {

/// The program: reads the command line, runs, and makes one line on stderr of an error. The exit code is the one that
/// the answer has in docs/planner.md, or 2 for bad input or usage.
int run_command(int argc, char** argv);

/// --range: the range of motion of a joint. Exit codes: 0, or 5 if a part of the range is undecided.
int run_range(const Arguments& a, const TimeLimit& limit);
/// The keys of a report on a range: mechanism, joint, parts.
nlohmann::json range_json(const RangeOfMotion& range, const Mechanism& mechanism);
/// A line for each part of a range.
void print_range(const RangeOfMotion& range, const Mechanism& mechanism);
/// True if a part of a range is undecided.
bool is_undecided(const RangeOfMotion& range);

/// --verdict: judges the parts of an assembly or a mechanism. 0, 3 parts overlap, 5 a range is undecided.
int run_verdict(const Arguments& a);

/// --assembly: takes it apart. 0 a sequence, 1 inseparable, 3 parts overlap, 5 undecided.
int run_assembly(const Arguments& a, const TimeLimit& limit);

/// --path with poses that are turned: certifies it, and shows the robot moving along it (a blocked path up to the pose
/// that collides). 0 every motion is free, 1 one collides, 5 undecided.
int run_certify(const Arguments& a, const Scene& scene, const std::vector<RigidPose>& poses, const TimeLimit& limit);

/// --linkage: the same for a path of the joints of a robot of several links.
int run_linkage(const Arguments& a, const TimeLimit& limit);
/// Parts of a motion in a report; neighbours are joined.
nlohmann::json parts_json(const std::vector<std::array<double, 2>>& parts);
/// What is known of a path, for people; of a blocked one only that it is. Without motions the time was over.
std::string certified_text(MotionVerdict::Status status, const std::vector<MotionVerdict::Status>& motions);
/// The exit code of what is known of a path.
int certified_exit_code(MotionVerdict::Status status);
/// The keys of a report on a path that was certified: scene, status, motions, path, verdicts, blocked_segment.
nlohmann::json certified_json(const CertifiedPath& path, const std::vector<RigidPose>& poses, const Scene& scene);
/// The robot moves along the path; a blocked one ends at the pose that is known to collide. `scene` has the robot as it
/// is in its own file.
std::vector<view::Layer> certified_layers(const CertifiedPath& path, std::vector<RigidPose> poses, const Scene& scene,
                                          const MotionChecker& checker);

/// A scene whose robot turns freely: a path whose motions are certified, or a proof that there is none. 0 a path, 1
/// there is none, 3 invalid start or goal, 5 undecided.
int run_rigid(const Arguments& a, const Scene& scene, const TimeLimit& limit);

/// A scene whose robot only translates: paths, queries, the path of --path (`given`), OMPL's planners. `widest`, if not
/// null, is reported, too. 0 path, 1 infeasible or blocked, 3 invalid start or goal, 4 no answer of an OMPL planner, 5
/// undecided.
int run_translations(const Arguments& a, const Scene& scene, const nlohmann::json& widest,
                     const std::vector<RigidPose>& given, const TimeLimit& limit);

/// The same for a robot that may turn about an axis; 0, 1, 3, 4, 5 as above.
int run_turning(const Arguments& a, const Scene& scene, const nlohmann::json& widest, const TimeLimit& limit);

/// --check-proof with a .proof file: checks it against the scene and the path of --path. 0 it holds, 1 it does not.
/// Nothing if the file is no .proof file.
std::optional<int> run_check_proof(const Arguments& a, const Scene& scene);

/// Writes the proof of an answer about a robot that turns about an axis, if --proof asks for it: of its path, or that
/// there is none. If there is no such proof, a note says so.
void write_turning_proof(const Arguments& a, const Scene& scene, const TurningAnswer& answer);

/// --widest and --widest-box: the robot of the scene becomes the widest that is known to pass (the smallest that was
/// tried if none is). Returns what to report: growth, low, high, undecided.
nlohmann::json make_widest(const Arguments& a, Scene& scene);
/// The same for people.
std::string widest_text(const nlohmann::json& widest);

/// Writes the proof of what is known of a path, if --proof asks for it; if that is kUndecided, a note says that there
/// is none.
void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses,
                      const CertifiedPath& known);
/// The same for a path that is not certified yet.
void write_path_proof(const Arguments& a, const MotionChecker& checker, const std::vector<RigidPose>& poses);

/// Writes the proof of an answer about translations, if --proof asks for it: of its path, or else of the given one, or
/// that there is none in all of free space, `free`, which else may be null. Throws InputError if there is no proof.
void write_translation_proof(const Arguments& a, const Scene& scene, const FreeSpace* free, const Answer& answer,
                             const std::vector<RigidPose>& given);

/// Prints what came of checking a proof: `complaint` is what does not hold, and `found` joins the report. Returns the
/// exit code: 0, it holds, 1, it does not.
int tell_check(const Arguments& a, const std::string& title, nlohmann::json found,
               const std::optional<std::string>& complaint, const std::string& what_holds, const Stopwatch& watch);

/// A robot that turns, to look at: layers as those of scene_layers; its farthest point is about as fast in turns as in
/// translations.
std::vector<view::Layer> turning_layers(const TurningAnswer& answer, const Scene& scene,
                                        const TurningQuestion& question);

}  // namespace nef::planner
