// SPDX-License-Identifier: Apache-2.0
//
// Poses in the slices of a scene, to be drawn at random.
#pragma once

#include <ompl/base/StateSpace.h>
#include <ompl/util/RandomNumbers.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "apps/planner/ompl/cell_sampler.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid_search/slice_search.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/** \brief Free poses whose positions lie in components of slices, the exact free spaces at fixed rotations (slices.h).

    The slices are those that SliceSearch makes on its way from start to goal, one after another while states are drawn,
    in the proportion that find_rigid_path has: a planner that soon has an answer waits for none. Scenes whose slices
    take long (is_light) have none. All components of a slice are drawn from
    equally often, small ones in narrow places as well as large ones, and so are its tight passages. Thread-safe. */
class SlicePool {
 public:
  /** \brief \e checker must be that of the scene. Throws InputError as rigid_question_of does. */
  SlicePool(Scene scene, std::shared_ptr<const MotionChecker> checker);

  /** \brief What stops \e monitor stops slices that are made from now on, too; then no more are made. It is not asked,
      as any thread may draw. What it refers to must outlive the drawing. */
  void setMonitor(const Monitor& monitor);

  /** \brief A sampler is about to draw a state, in whatever way: makes a slice if it is time for one. */
  void countDraw();
  /** \brief Sets a state of an SE3StateSpace to a random pose of a random slice, which is free and within the bounds of
      the space. False if none was found: then the state is of no use. */
  bool draw(const ompl::base::StateSpace& space, ompl::base::State* state, ompl::RNG& rng) const;
  /** \brief Number of slices that were made. */
  std::size_t sliceCount() const;

 private:
  // A component of a slice, or its tight passages.
  struct Part {
    Quaternion rotation;
    std::shared_ptr<const FreeSpace> free;
    std::vector<ZoneId> zones;
    std::shared_ptr<const CellPool> tight;
  };

  void search(std::size_t slices);
  void add(const Quaternion& rotation, const Slice& slice);
  RigidPose poseIn(const Part& part, ompl::RNG& rng) const;

  Scene scene_;
  RigidQuestion question_;
  std::shared_ptr<const MotionChecker> checker_;
  mutable std::mutex mutex_;
  Monitor monitor_;
  std::unique_ptr<SliceSearch> search_;  // from the first slice on
  bool isDone_;                          // no more slices are made
  std::size_t drawsPerSlice_ = 1;
  std::size_t draws_ = 0;
  std::set<Quaternion> rotations_;  // of slices that are among the parts
  std::vector<Part> parts_;
};

}  // namespace nef::planner
