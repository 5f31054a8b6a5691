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
  struct Corner {
    std::size_t first = 0;  // motions
    std::size_t last = 0;
    std::vector<RigidPose> new_way;  // none if it gains nothing
    RandomNumbers after;             // what is drawn behind it
  };

  [[nodiscard]] Corner next_corner(RandomNumbers random) const {
    std::size_t a = random.below(path_.size() - 1);
    std::size_t b = random.below(path_.size() - 1);
    if (a == b) return {a, b, {}, random};
    if (a > b) std::swap(a, b);
    const RigidPose from = on_motion(a, random.uniform());
    const RigidPose to = on_motion(b, random.uniform());
    std::vector<RigidPose> new_way{path_[a], from, to, path_[b + 1]};
    const std::vector<RigidPose> old_way(path_.begin() + static_cast<std::ptrdiff_t>(a),
                                         path_.begin() + static_cast<std::ptrdiff_t>(b) + 2);
    constexpr double kGain = 0.999;
    if (length(new_way) > kGain * length(old_way)) new_way.clear();
    return {a, b, std::move(new_way), random};
  }

  [[nodiscard]] bool is_free(const std::vector<RigidPose>& way, const Monitor& monitor) const {
    return !way.empty() && moves_freely(checker_, way[1], way[2], monitor) &&
           moves_freely(checker_, way[0], way[1], monitor) && moves_freely(checker_, way[2], way[3], monitor);
  }

  // Most are in vain, so several threads look at several at once; those behind the first one that is cut are drawn
  // anew, from the path as it is then.
  void cut_corners() {
    RandomNumbers random(1);
    constexpr std::size_t kTries = 200;
    const std::size_t at_once = monitor_.threads() == 1 ? 1 : 8;
    for (std::size_t i = 0; i < kTries && path_.size() > 2;) {
      std::vector<Corner> corners;
      while (corners.size() < std::min(at_once, kTries - i)) {
        corners.push_back(next_corner(corners.empty() ? random : corners.back().after));
      }
      const std::size_t free = first_true(corners.size(), monitor_, [&](std::size_t k, const Monitor& own) {
        return is_free(corners[k].new_way, own);
      });
      if (free < corners.size()) {
        const Corner& corner = corners[free];
        const auto begin = path_.begin() + static_cast<std::ptrdiff_t>(corner.first) + 1;
        const auto at = path_.erase(begin, path_.begin() + static_cast<std::ptrdiff_t>(corner.last) + 1);
        path_.insert(at, {corner.new_way[1], corner.new_way[2]});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(free) + 1, corners.end());
      }
      i += corners.size();
      random = corners.back().after;
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
