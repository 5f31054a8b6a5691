// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_search/shorten_poses.h"

#include <algorithm>

#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/first_true.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "nef/base/interruption.h"

namespace nef::planner {
namespace {

class Shortening {
 public:
  Shortening(const MotionChecker& checker, std::vector<RigidPose> path, const Monitor& monitor)
      : checker_(checker), metric_(checker.robot().nodes().front().reach), path_(std::move(path)), monitor_(monitor) {}

  std::vector<RigidPose> run() {
    try {
      leave_out();
      cut_corners();
      leave_out();
    } catch (const Interrupted&) {  // the path is free as it is
    }
    return std::move(path_);
  }

 private:
  [[nodiscard]] bool is_free(const RigidPose& from, const RigidPose& to) const {
    return moves_freely(checker_, from, to, monitor_);
  }

  // From each pose to the last one that is reached at once.
  void leave_out() {
    constexpr std::size_t kFarthest = 48;
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      const std::size_t farthest = std::min(path_.size() - 1, i + kFarthest);
      const std::size_t back = first_true(farthest - i - 1, monitor_, [&](std::size_t k, const Monitor& own) {
        return moves_freely(checker_, path_[i], path_[farthest - k], own);
      });
      const auto begin = path_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      path_.erase(begin, path_.begin() + static_cast<std::ptrdiff_t>(farthest - back));
    }
  }

  // Two random points on different motions, joined by one motion.
  void cut_corners() {
    RandomNumbers random(1);
    constexpr int kTries = 200;
    for (int i = 0; i < kTries && path_.size() > 2; ++i) {
      std::size_t a = random.below(path_.size() - 1);
      std::size_t b = random.below(path_.size() - 1);
      if (a == b) continue;
      if (a > b) std::swap(a, b);
      const RigidPose from = on_motion(a, random.uniform());
      const RigidPose to = on_motion(b, random.uniform());
      const std::vector<RigidPose> new_way{path_[a], from, to, path_[b + 1]};
      const std::vector<RigidPose> old_way(path_.begin() + static_cast<std::ptrdiff_t>(a),
                                           path_.begin() + static_cast<std::ptrdiff_t>(b) + 2);
      constexpr double kGain = 0.999;
      if (length(new_way) > kGain * length(old_way)) continue;
      if (!is_free(from, to) || !is_free(path_[a], from) || !is_free(to, path_[b + 1])) continue;
      const auto begin = path_.begin() + static_cast<std::ptrdiff_t>(a) + 1;
      const auto at = path_.erase(begin, path_.begin() + static_cast<std::ptrdiff_t>(b) + 1);
      path_.insert(at, {from, to});
    }
  }

  [[nodiscard]] RigidPose on_motion(std::size_t motion, double part) const {
    const RigidPose& to = path_[motion + 1];
    return metric_.between(path_[motion], to_vector(to.position), PoseMetric::rounded(to.quaternion), part);
  }

  [[nodiscard]] double length(const std::vector<RigidPose>& poses) const {
    double sum = 0;
    for (std::size_t i = 1; i < poses.size(); ++i) sum += metric_.distance(poses[i - 1], poses[i]);
    return sum;
  }

  const MotionChecker& checker_;
  PoseMetric metric_;
  std::vector<RigidPose> path_;
  const Monitor& monitor_;
};

}  // namespace

std::vector<RigidPose> shorten(const MotionChecker& checker, std::vector<RigidPose> path, const Monitor& monitor) {
  return Shortening(checker, std::move(path), monitor).run();
}

}  // namespace nef::planner
