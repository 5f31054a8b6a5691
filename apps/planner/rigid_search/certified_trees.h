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
/// many pieces; it does not find narrow places. The same in every run: random numbers have a fixed seed.
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
  struct Node {
    RigidPose pose;
    Vector3d position;
    Eigen::Quaterniond rotation;
    std::size_t parent;
  };
  using Tree = std::vector<Node>;
  enum class Step : std::uint8_t { kBlocked, kGone, kArrived };

  static void add(const RigidPose& pose, std::size_t parent, Tree& tree);
  [[nodiscard]] std::size_t nearest(const Tree& tree, const Vector3d& position,
                                    const Eigen::Quaterniond& rotation) const;
  Step extend(Tree& tree, std::size_t from, const Vector3d& position, const Eigen::Quaterniond& rotation,
              const RigidPose* arrival);
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
