// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_search/certified_trees.h"

#include <algorithm>
#include <limits>

#include "apps/planner/rigid/certified_path.h"

namespace nef::planner {

CertifiedTrees::CertifiedTrees(const RigidQuestion& question, const MotionChecker& checker)
    : checker_(checker), metric_(checker.robot().nodes().front().reach) {
  const RigidPose start{question.start.position, canonical(question.start.quaternion)};
  const RigidPose goal{question.goal.position, canonical(question.goal.quaternion)};
  add(start, 0, trees_[0]);
  add(goal, 0, trees_[1]);
  if (checker.box()) {
    low_ = to_vector((*checker.box())[0]);
    high_ = to_vector((*checker.box())[1]);
  } else {
    // Around start, goal and obstacles.
    low_ = trees_[0][0].position.cwiseMin(trees_[1][0].position);
    high_ = trees_[0][0].position.cwiseMax(trees_[1][0].position);
    for (const RigidBody::Piece& piece : checker.obstacles().pieces()) {
      for (const Vector3d& p : piece.points) {
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
      }
    }
    low_.array() -= metric_.reach();
    high_.array() += metric_.reach();
  }
  constexpr double kRange = 0.2;  // of the largest distance, as in OMPL
  range_ = kRange * ((high_ - low_).norm() + metric_.reach() * 2 * std::sqrt(2.0));
}

void CertifiedTrees::add(const RigidPose& pose, std::size_t parent, Tree& tree) {
  tree.push_back({pose, to_vector(pose.position), PoseMetric::rounded(pose.quaternion), parent});
}

std::size_t CertifiedTrees::nearest(const Tree& tree, const Vector3d& position,
                                    const Eigen::Quaterniond& rotation) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const double away = metric_.distance(tree[i].position, tree[i].rotation, position, rotation);
    if (away >= least) continue;
    least = away;
    best = i;
  }
  return best;
}

// One step from a node towards a pose; if that is near, to `arrival` itself, if it is given.
CertifiedTrees::Step CertifiedTrees::extend(Tree& tree, std::size_t from, const Vector3d& position,
                                            const Eigen::Quaterniond& rotation, const RigidPose* arrival) {
  const double away = metric_.distance(tree[from].position, tree[from].rotation, position, rotation);
  const bool arrives = away <= range_;
  const RigidPose next = arrives && arrival != nullptr
                             ? *arrival
                             : metric_.between(tree[from].pose, position, rotation, arrives ? 1 : range_ / away);
  if (!moves_freely(checker_, tree[from].pose, next)) return Step::kBlocked;
  add(next, from, tree);
  return arrives ? Step::kArrived : Step::kGone;
}

std::optional<std::vector<RigidPose>> CertifiedTrees::run(std::size_t max_samples, const Monitor& monitor) {
  for (; samples_ < max_samples; ++samples_) {
    monitor.check_interruption();
    Vector3d position;
    for (Eigen::Index k = 0; k < 3; ++k) position[k] = low_[k] + random_.uniform() * (high_[k] - low_[k]);
    const Eigen::Quaterniond rotation = random_.rotation();
    Tree& tree = trees_[turn_];
    Tree& other = trees_[1 - turn_];
    turn_ = 1 - turn_;
    if (extend(tree, nearest(tree, position, rotation), position, rotation, nullptr) == Step::kBlocked) continue;
    const Node made = tree.back();
    std::size_t from = nearest(other, made.position, made.rotation);
    Step step = Step::kGone;
    while (step == Step::kGone) {
      step = extend(other, from, made.position, made.rotation, &made.pose);
      from = other.size() - 1;
    }
    if (step == Step::kArrived) return path();
  }
  return std::nullopt;
}

// Both trees end in the same pose.
std::vector<RigidPose> CertifiedTrees::path() const {
  const auto to_root = [](const Tree& tree) {
    std::vector<RigidPose> poses;
    for (std::size_t i = tree.size() - 1;; i = tree[i].parent) {
      poses.push_back(tree[i].pose);
      if (i == 0) return poses;
    }
  };
  std::vector<RigidPose> result = to_root(trees_[0]);
  std::reverse(result.begin(), result.end());
  const std::vector<RigidPose> rest = to_root(trees_[1]);
  result.insert(result.end(), rest.begin() + 1, rest.end());
  return result;
}

}  // namespace nef::planner
