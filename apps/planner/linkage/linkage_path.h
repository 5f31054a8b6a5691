// SPDX-License-Identifier: Apache-2.0
//
// A path of a linkage: its file, and its certificate, motion by motion.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/linkage/linkage_checker.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What is known of a path of a linkage.
struct CertifiedLinkagePath {
  /// kFree: proved for every motion. kCollides: one of them surely collides. kUndecided: no motion is known to collide,
  /// and one at least could not be decided.
  MotionVerdict::Status status = MotionVerdict::Status::kFree;
  std::vector<LinkageVerdict> motions;  ///< from each values to the next ones; a path of one place has one, which stays
  std::optional<std::size_t> blocked;   ///< kCollides: the first motion that collides
};

/// Certifies all motions of a path of one place at least, each with a value for each joint. O(motions); see
/// LinkageChecker for one. `monitor` is told how many motions are done, and can stop it (Interrupted). Throws
/// InputError for an empty path, and for values that are too few, too many or not finite.
CertifiedLinkagePath certify(const LinkageChecker& checker, std::span<const std::vector<double>> path,
                             const CheckLimits& limits = {}, const Monitor& monitor = {});

/// The values of joints at a parameter of the motion, from 0 to 1.
std::vector<double> values_at(std::span<const double> from, std::span<const double> to, double parameter);

/// Lists of joint values in a file: lines of numbers, or JSON {"path": [[...], ...]}, rounded to doubles. Each has a
/// value for each of the named joints. Throws InputError "file:line: what" for another file and for one without values.
std::vector<std::vector<double>> read_joint_path(const std::string& file, const std::vector<std::string>& joints);

}  // namespace nef::planner
