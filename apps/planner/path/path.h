// SPDX-License-Identifier: Apache-2.0
//
// Exact paths through free space.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/free_space/segments.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// What kind of path is wanted.
struct PathOptions {
  bool raw = false;        ///< as the roadmap has it, without shortcuts
  bool clearance = false;  ///< way-points inside volumes rather than in contact, where there is a choice
  bool roomy = false;      ///< the best T first, then the best J, then short (else just short)
  int min_dimension = 0;   ///< stay where free space is locally at least this thick (T >= min_dimension)
  /// Look for the shortest of several ways round, as far as affordable, and pull until nothing is gained any more; else
  /// the first way found, pulled a few times.
  bool thorough = true;
  /// Round way-points to so many decimals where the motions stay within the options.
  std::optional<unsigned> digits;
  /// A path that answered the same question with the same options in a free space that held the present one: if it is
  /// free still, it is the answer again, since nothing can have become better.
  std::vector<Rational3> known;
};

/// A path with rational way-points. Every segment is known to lie in free space.
struct ExactPath {
  std::vector<Rational3> points;
  std::vector<int> segment_dimensions;  ///< smallest dimension of the cells each segment runs along
  std::vector<std::uint32_t> passages;  ///< tight passages in the order of their use
  Thinness thinness;                    ///< T and J of this very path
  double length = 0;
  std::uint64_t segments_checked = 0;
  /// Way-points between the ends with more decimals than were asked for, since no rounded ones that were tried are
  /// free.
  std::vector<std::size_t> unrounded;
};

/// A path between two free points, or nothing if there is none within the options: a proof, since
/// the roadmap is complete; it is made unless free space is large and a way is found without it. The points must be
/// free. Start equal to goal gives a path of one point. Can be interrupted until a first way is found.
std::optional<ExactPath> find_path(const FreeSpace& free, const Rational3& start, const Rational3& goal,
                                   const PathOptions& options = {}, const Monitor& monitor = {});

/// The length of each segment.
std::vector<double> lengths_of(const ExactPath& path);

/// Describes given way-points; nothing if a segment leaves free space.
std::optional<ExactPath> describe_path(const FreeSpace& free, std::vector<Rational3> points);

}  // namespace nef::planner
