// SPDX-License-Identifier: Apache-2.0
//
// Slices: the exact translational free spaces of a robot at rotations, made when they are asked for.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "apps/planner/free_space/free_space.h"
#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A component of free space that has an inside, and some points of it that are spread over it.
struct SliceComponent {
  std::uint32_t component = 0;  ///< in the free space
  std::vector<Rational3> points;
  std::vector<Vector3d> rounded;  ///< the same in doubles
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
class Slices {
 public:
  explicit Slices(const Scene& scene, const Monitor& monitor = {});

  /// The slice of a canonical quaternion (rotations.h). A Minkowski sum of all obstacles with the robot, and a roadmap.
  const Slice& at(const Quaternion& rotation, const Monitor& monitor);
  /// How many were made.
  [[nodiscard]] std::size_t made() const { return slices_.size(); }
  /// Whether the slice of a rotation is there already.
  [[nodiscard]] bool has(const Quaternion& rotation) const { return slices_.count(shared(rotation)) > 0; }
  /// Rotations of the robot, as it is in its own file, onto itself: at least (1, 0, 0, 0).
  [[nodiscard]] const std::vector<Quaternion>& symmetries() const { return symmetries_; }

 private:
  [[nodiscard]] Quaternion shared(const Quaternion& rotation) const;
  [[nodiscard]] Slice made_at(const Quaternion& rotation, const Monitor& monitor) const;

  Scene scene_;
  std::vector<Quaternion> symmetries_;
  std::map<Quaternion, Slice> slices_;
};

}  // namespace nef::planner
