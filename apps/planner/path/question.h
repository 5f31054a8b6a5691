// SPDX-License-Identifier: Apache-2.0
//
// From a scene to its free space and to answers, with the time each phase takes.
#pragma once

#include <memory>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/answer.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A scene with its free space. Build once, ask often.
class Problem {
 public:
  /// Computes the free positions and the roadmap. Throws InputError.
  explicit Problem(Scene scene, const Monitor& monitor = {});
  /// A problem whose free positions are known: those of the scene, as free_positions finds them.
  Problem(Scene scene, Polyhedron free);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const FreeSpace& free_space() const { return *free_; }
  [[nodiscard]] std::shared_ptr<const FreeSpace> shared_free_space() const { return free_; }

  /// A path or a proof that there is none. Start and goal default to the scene's; throws InputError
  /// if one is missing.
  [[nodiscard]] Answer solve(const PathOptions& options = {}, const Monitor& monitor = {}) const;
  [[nodiscard]] Answer solve(const Rational3& start, const Rational3& goal, const PathOptions& options,
                             const Monitor& monitor = {}) const;

  /// The answer that start or goal is not free, found without any free space; nothing if both are free. Says what a
  /// Problem of the scene would say about them.
  static std::optional<Answer> invalid_end(const Scene& scene, const Rational3& start, const Rational3& goal,
                                           const Monitor& monitor = {});

  /// Checks a given path (at least one point): kPath with its description, or kBlocked with the first segment that
  /// leaves free space and what it hits there.
  [[nodiscard]] Answer check(const std::vector<Rational3>& points, const Monitor& monitor = {}) const;

  /// Seconds per phase of the construction.
  [[nodiscard]] const std::map<std::string, double>& phases() const { return phases_; }

 private:
  Scene scene_;
  std::shared_ptr<const FreeSpace> free_;
  std::map<std::string, double> phases_;
};

}  // namespace nef::planner
