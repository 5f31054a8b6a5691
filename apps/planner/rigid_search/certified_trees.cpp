// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_search/certified_trees.h"

#include <algorithm>
#include <limits>

#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/first_true.h"

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
    const Vector3d& from = trees_[0].places.front().position;
    const Vector3d& to = trees_[1].places.front().position;
    low_ = from.cwiseMin(to);
    high_ = from.cwiseMax(to);
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
  tree.poses.push_back(pose);
  tree.places.push_back({to_vector(pose.position), PoseMetric::rounded(pose.quaternion)});
  tree.parents.push_back(parent);
}

std::size_t CertifiedTrees::nearest(const Tree& tree, const Vector3d& position,
                                    const Eigen::Quaterniond& rotation) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tree.places.size(); ++i) {
    const Place& place = tree.places[i];
    if ((place.position - position).squaredNorm() > least * least) continue;  // not to take a root for each
    const double away = metric_.distance(place.position, place.rotation, position, rotation);
    if (away >= least) continue;
    least = away;
    best = i;
  }
  return best;
}

// One step towards a pose; if that is near, to `arrival` itself, if it is given.
CertifiedTrees::Step CertifiedTrees::extend(const RigidPose& from, const Sample& to, const RigidPose* arrival,
                                            std::vector<RigidPose>& poses, const Monitor& monitor) const {
  const double away =
      metric_.distance(to_vector(from.position), PoseMetric::rounded(from.quaternion), to.position, to.rotation);
  const bool arrives = away <= range_;
  const RigidPose next = arrives && arrival != nullptr
                             ? *arrival
                             : metric_.between(from, to.position, to.rotation, arrives ? 1 : range_ / away);
  if (!moves_freely(checker_, from, next, monitor)) return Step::kBlocked;
  poses.push_back(next);
  return arrives ? Step::kArrived : Step::kGone;
}

CertifiedTrees::Trial CertifiedTrees::tried(const Sample& sample, const Monitor& monitor) const {
  Trial trial;
  const Tree& tree = trees_[sample.tree];
  const Tree& other = trees_[1 - sample.tree];
  trial.from = nearest(tree, sample.position, sample.rotation);
  if (extend(tree.poses[trial.from], sample, nullptr, trial.poses, monitor) == Step::kBlocked) return trial;
  const RigidPose& made = trial.poses.back();
  const Sample goal{to_vector(made.position), PoseMetric::rounded(made.quaternion), 0};
  trial.other_from = nearest(other, goal.position, goal.rotation);
  Step step = Step::kGone;
  while (step == Step::kGone) {
    const RigidPose from = trial.other_poses.empty() ? other.poses[trial.other_from] : trial.other_poses.back();
    step = extend(from, goal, &made, trial.other_poses, monitor);
  }
  trial.arrives = step == Step::kArrived;
  return trial;
}

void CertifiedTrees::add(const std::vector<RigidPose>& poses, std::size_t from, Tree& tree) {
  for (const RigidPose& pose : poses) {
    add(pose, from, tree);
    from = tree.poses.size() - 1;
  }
}

// How many samples are tried at once does not depend on the number of threads. Few in small trees: samples that are
// tried at once do not find each other.
std::size_t CertifiedTrees::samples_at_once() const {
  constexpr std::size_t kMost = 16;
  constexpr std::size_t kNodesForOne = 8;
  return std::clamp<std::size_t>((trees_[0].poses.size() + trees_[1].poses.size()) / kNodesForOne, 1, kMost);
}

std::optional<std::vector<RigidPose>> CertifiedTrees::run(std::size_t max_samples, const Monitor& monitor) {
  while (samples_ < max_samples) {
    monitor.check_interruption();
    std::vector<Sample> samples(std::min(samples_at_once(), max_samples - samples_));
    for (Sample& sample : samples) {
      for (Eigen::Index k = 0; k < 3; ++k) sample.position[k] = low_[k] + random_.uniform() * (high_[k] - low_[k]);
      sample.rotation = random_.rotation();
      sample.tree = turn_;
      turn_ = 1 - turn_;
    }
    std::vector<Trial> trials(samples.size());
    first_true(samples.size(), monitor, [&](std::size_t i, const Monitor& own) {
      trials[i] = tried(samples[i], own);
      return trials[i].arrives;
    });
    for (std::size_t i = 0; i < samples.size(); ++i, ++samples_) {
      add(trials[i].poses, trials[i].from, trees_[samples[i].tree]);
      add(trials[i].other_poses, trials[i].other_from, trees_[1 - samples[i].tree]);
      if (trials[i].arrives) return path();
    }
  }
  return std::nullopt;
}

// Both trees end in the same pose.
std::vector<RigidPose> CertifiedTrees::path() const {
  const auto to_root = [](const Tree& tree) {
    std::vector<RigidPose> poses;
    for (std::size_t i = tree.poses.size() - 1;; i = tree.parents[i]) {
      poses.push_back(tree.poses[i]);
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
