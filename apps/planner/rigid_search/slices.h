// SPDX-License-Identifier: Apache-2.0
//
// Slices: the exact translational free spaces of a robot at rotations, made when they are asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "apps/minkowski/sum/fixed_obstacles.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid_search/made_once.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// How many pairs of pieces, one of the robot and one of the obstacles, a slice is a sum of.
std::size_t pairs_of(const MotionChecker& checker);
/// Slices of scenes of more pairs take long.
inline constexpr std::size_t kLightPairs = 2000;
/// Whether a scene has no more.
inline bool is_light(const MotionChecker& checker) { return pairs_of(checker) <= kLightPairs; }

/// A component of free space that has an inside, and some points of it that are spread over it.
struct SliceComponent {
  std::uint32_t component = 0;  ///< in the free space
  std::vector<Rational3> points;
  std::vector<Vector3d> rounded;  ///< the same in doubles
  std::vector<ZoneId> zones;  ///< of the roadmap, three-dimensional, that it consists of; none if it is all of space
};

/// The free space at one rotation.
struct Slice {
  std::shared_ptr<const FreeSpace> free;
  std::vector<SliceComponent> components;

  /// The place in `components` of the one that holds a position; nothing if the position is not free, or is in a
  /// component without inside.
  [[nodiscard]] std::optional<std::size_t> component_at(const Rational3& position) const;
};

/// All slices of a scene that were asked for. Rotations that place the robot alike, since it is symmetric, share one.
/// Of the symmetries only those are found that permute the coordinate axes (24 rotations about the reference point).
/// Several threads may ask at once; if they ask for the same slice, one makes it, and the others wait.
class Slices {
 public:
  /// `are_light`: cutting up the bodies takes no time beside a slice (see is_light). Slices are the same without.
  explicit Slices(const Scene& scene, const Monitor& monitor = {}, bool are_light = true);

  /// The slice of a canonical quaternion (rotations.h). A Minkowski sum of all obstacles with the robot, and a roadmap.
  /// `meanwhile`: as that of MadeOnce::at.
  const Slice& at(const Quaternion& rotation, const Monitor& monitor, const std::function<bool()>& meanwhile = {});
  /// What is known of that slice without making it, or waiting for it.
  [[nodiscard]] MadeOnce<Quaternion, Slice>::Known known(const Quaternion& rotation) {
    return slices_.known(shared(rotation));
  }
  /// The least of the canonical quaternions whose slice is that of a rotation. It stays where it is.
  [[nodiscard]] const Quaternion& shared(const Quaternion& rotation);
  /// Rotations of the robot, as it is in its own file, onto itself: at least (1, 0, 0, 0).
  [[nodiscard]] const std::vector<Quaternion>& symmetries() const { return symmetries_; }

 private:
  [[nodiscard]] Quaternion least_alike(const Quaternion& rotation) const;

  [[nodiscard]] Polyhedron free_positions_at(const Quaternion& rotation, const Monitor& monitor) const;
  [[nodiscard]] Slice made_at(const Quaternion& rotation, const Monitor& monitor) const;

  Scene scene_;
  // Of a solid robot, if there are few pairs of convex pieces: both sides cut up once, instead of for each slice.
  std::optional<minkowski::FixedObstacles> obstacles_;
  std::vector<Mesh> pieces_;
  std::vector<Quaternion> symmetries_;
  MadeOnce<Quaternion, Slice> slices_;  // by the least of the rotations that share one
  std::mutex mutex_;                    // of the other table
  std::map<Quaternion, Quaternion> shared_;
};

}  // namespace nef::planner
