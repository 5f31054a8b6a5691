// SPDX-License-Identifier: Apache-2.0
//
// A search for a path of a rigid body through slices.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/rigid_search/slices.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Nodes are components of exact free spaces at rotations of a grid (slices.h), and at those at which faces of the
/// robot are parallel to faces of the obstacles (orientation/aligned_rotations.h), where it fits exactly if it ever
/// does. Two nodes of neighbouring rotations are joined by a certified motion between points of both, which turns and
/// moves at once and whose positions are fitted between the obstacles (motion_fit.h). Where there is none, the slice
/// halfway is made, so the arc is halved. Inside a node all points are connected, by exact translational paths. Grids
/// and arcs get finer round by round. One tree of nodes grows from each end (slice_tree.h), both at once if the monitor
/// has threads; the result does not depend on that.
class SliceSearch {
 public:
  /// The checker, which must outlive it, is that of the scene. Its start and goal are those of the question, and free.
  SliceSearch(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker,
              const Monitor& monitor = {});
  ~SliceSearch();
  SliceSearch(const SliceSearch&) = delete;
  SliceSearch& operator=(const SliceSearch&) = delete;

  /// Goes on until a path is found or so many slices are made in all. Poses from start to goal, each motion certified
  /// for MotionTiming::kSlerp; or nothing; then it can go on with more. Throws Interrupted when the monitor stops it,
  /// which ends the search.
  std::optional<std::vector<RigidPose>> run(std::size_t max_slices, const Monitor& monitor);

  /// How many slices were made.
  [[nodiscard]] std::size_t slices() const;
  /// Those slices, by the least of the rotations that share one. They stay where they are.
  [[nodiscard]] std::map<Quaternion, const Slice*> made() const;
  /// See Slices::symmetries.
  [[nodiscard]] const std::vector<Quaternion>& symmetries() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace nef::planner
