// SPDX-License-Identifier: Apache-2.0
//
// A search for a path of a rigid body by random poses, from start and goal at once.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Two trees of certified motions (RRT-Connect, Kuffner and LaValle 2000). Quick where there is room, and for bodies of
/// many pieces; it does not find narrow places. The same in every run, on any number of threads: random numbers have a
/// fixed seed, and samples that are tried at once do not know of each other.
class CertifiedTrees {
 public:
  /// The checker must outlive it. Start and goal must be free.
  CertifiedTrees(const RigidQuestion& question, const MotionChecker& checker);

  /// Goes on until a path is found or so many samples are drawn in all. Each motion of the path is certified for
  /// MotionTiming::kSlerp. Throws Interrupted when the monitor stops it; it can go on afterwards.
  std::optional<std::vector<RigidPose>> run(std::size_t max_samples, const Monitor& monitor);

  /// How many samples were drawn.
  [[nodiscard]] std::size_t samples() const { return samples_; }

 private:
  // Rounded, as the search for the nearest node reads all of them.
  struct Place {
    Vector3d position;
    Eigen::Quaterniond rotation;
  };
  struct Tree {
    std::vector<RigidPose> poses;
    std::vector<Place> places;
    std::vector<std::size_t> parents;  // the root is its own
  };
  enum class Step : std::uint8_t { kBlocked, kGone, kArrived };

  // A random pose, and the tree that grows towards it.
  struct Sample {
    Vector3d position;
    Eigen::Quaterniond rotation;
    std::size_t tree = 0;
  };
  // What a sample adds to its tree and to the other one: poses one after another, from a node.
  struct Trial {
    std::size_t from = 0;
    std::vector<RigidPose> poses;
    std::size_t other_from = 0;
    std::vector<RigidPose> other_poses;
    bool arrives = false;  // both end in the same pose
  };

  static void add(const RigidPose& pose, std::size_t parent, Tree& tree);
  static void add(const std::vector<RigidPose>& poses, std::size_t from, Tree& tree);
  [[nodiscard]] std::size_t nearest(const Tree& tree, const Vector3d& position,
                                    const Eigen::Quaterniond& rotation) const;
  [[nodiscard]] std::size_t samples_at_once() const;
  Step extend(const RigidPose& from, const Sample& to, const RigidPose* arrival, std::vector<RigidPose>& poses,
              const Monitor& monitor) const;
  [[nodiscard]] Trial tried(const Sample& sample, const Monitor& monitor) const;
  [[nodiscard]] std::vector<RigidPose> path() const;

  const MotionChecker& checker_;
  PoseMetric metric_;
  Vector3d low_;
  Vector3d high_;
  double range_ = 0;
  RandomNumbers random_{1};
  std::array<Tree, 2> trees_;
  std::size_t turn_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace nef::planner
