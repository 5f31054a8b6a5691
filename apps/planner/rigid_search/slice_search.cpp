// SPDX-License-Identifier: Apache-2.0
//
// From each end grows a tree of nodes, both at the same time. The motion that a tree tries next leads to the rotation
// nearest to the other end. After each step of both, each gets to know what the other one has found; so a step does not
// depend on which of them is faster.
#include "apps/planner/rigid_search/slice_search.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "apps/planner/path/path.h"
#include "apps/planner/rigid_search/slice_tree.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/threads/parallel.h"

namespace nef::planner {
namespace {

// How fine a round is: the grid's level, and how often arcs between its rotations are halved.
struct Round {
  unsigned level;
  unsigned depth;
};
constexpr std::array<Round, 10> kRounds{Round{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4},
                                        {1, 1},      {1, 2}, {1, 3}, {2, 2}, {2, 3}};

}  // namespace

class SliceSearch::State {
 public:
  State(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker, const Monitor& monitor)
      : fit_(checker),
        slices_(scene, monitor),
        metric_(checker.robot().nodes().front().reach),
        goal_(question.goal),
        is_light_(is_light(checker)),
        trees_{SliceTree(checker, fit_, metric_, slices_, question.start, question.goal),
               SliceTree(checker, fit_, metric_, slices_, question.goal, question.start)} {}

  std::optional<std::vector<RigidPose>> run(std::size_t max_slices, const Monitor& monitor) {
    for (SliceTree& tree : trees_) {
      if (tree.is_planted()) continue;
      if (!tree.plant(monitor)) return std::nullopt;
      made_.insert(slices_.shared(tree[0].rotation));
      settle();
    }
    for (; round_ < kRounds.size(); ++round_, is_begun_ = false) {
      if (!is_begun_) {
        for (SliceTree& tree : trees_) tree.add_steps(kRounds[round_].level);
      }
      is_begun_ = true;
      while (!meeting_ && (trees_[0].has_steps() || trees_[1].has_steps())) {
        const bool is_full = grow(max_slices, monitor);
        if (is_full && made_.size() >= max_slices) return std::nullopt;
      }
      if (meeting_) return path(monitor);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t slices() const { return made_.size(); }

  [[nodiscard]] std::map<Quaternion, const Slice*> made() {
    std::map<Quaternion, const Slice*> result;
    for (const Quaternion& rotation : made_) result.emplace(rotation, &slices_.at(rotation, {}));
    return result;
  }

  [[nodiscard]] const std::vector<Quaternion>& symmetries() const { return slices_.symmetries(); }

 private:
  // A step of each tree. True if there are not enough slices left for one.
  bool grow(std::size_t max_slices, const Monitor& monitor) {
    std::array<SliceTree::Growth, 2> grown;
    const std::size_t left = max_slices - std::min(max_slices, made_.size());
    const bool are_two = trees_[0].has_steps() && trees_[1].has_steps();
    const std::array<std::size_t, 2> allowed{are_two ? left - left / 2 : left, are_two ? left / 2 : left};
    std::atomic<bool> is_over = false;  // the first tree has met the second one, whose step does not matter
    const auto grow_tree = [&](std::size_t i, const Monitor& own) {
      if (is_over || !trees_[i].has_steps()) return;
      grown[i] = trees_[i].grow(trees_[1 - i], kRounds[round_].depth, made_, allowed[i], own);
      if (grown[i].meeting && i == 0) is_over = true;
    };
    const auto grow_second = [&](const Monitor& own) {
      const StopQuestion stop([&] { return is_over.load(); }, own);
      try {
        grow_tree(1, stop.monitor());
      } catch (const Interrupted&) {
        if (!is_over) throw;
      }
    };
    if (are_two && is_light_) {
      parallel_calls(monitor, {[&](const Monitor& own) { grow_tree(0, own); }, grow_second});
    } else {
      grow_tree(0, monitor);
      grow_tree(1, monitor);
    }
    for (std::size_t i = 0; i < 2 && !meeting_; ++i) {
      made_.merge(grown[i].slices);
      if (grown[i].meeting) {
        meeting_ = std::move(grown[i].meeting);
        meeting_of_ = i;
      }
    }
    if (!meeting_) settle();
    return grown[0].is_full || grown[1].is_full;
  }

  // Both trees get to know each other.
  void settle() {
    for (std::size_t i = 0; i < 2; ++i) {
      auto meeting = trees_[i].settle(trees_[1 - i]);
      if (!meeting || meeting_) continue;
      meeting_ = std::move(meeting);
      meeting_of_ = i;
    }
  }

  [[nodiscard]] std::vector<RigidPose> path(const Monitor& monitor) const {
    const bool from_start = meeting_of_ == 0;
    std::vector<RigidPose> result{trees_[0][0].joint.front()};
    const auto go = [&](std::vector<RigidPose> joint, const SliceTree::Node& first, bool back) {
      if (back) std::reverse(joint.begin(), joint.end());
      translate(first, joint.front().position, result, monitor);
      result.insert(result.end(), joint.begin() + 1, joint.end());
    };
    const auto begin = trees_[0].ancestry(from_start ? meeting_->from : meeting_->to);
    for (std::size_t i = 1; i < begin.size(); ++i) go(trees_[0][begin[i]].joint, trees_[0][begin[i - 1]], false);
    if (!meeting_->joint.empty()) go(meeting_->joint, trees_[0][begin.back()], !from_start);
    const auto end = trees_[1].ancestry(from_start ? meeting_->to : meeting_->from);
    for (std::size_t i = end.size(); i-- > 1;) go(trees_[1][end[i]].joint, trees_[1][end[i]], true);
    translate(trees_[1][0], goal_.position, result, monitor);
    return result;
  }

  // Goes on to another position within a node.
  static void translate(const SliceTree::Node& node, const Rational3& to, std::vector<RigidPose>& path,
                        const Monitor& monitor) {
    const Rational3 from = path.back().position;
    if (from == to) return;
    PathOptions options;
    options.thorough = false;
    options.clearance = true;
    const std::optional<ExactPath> way = find_path(*node.slice->free, from, to, options, monitor);
    NEF_ASSERT(way.has_value());
    for (std::size_t i = 1; i < way->points.size(); ++i) path.push_back({way->points[i], node.rotation});
  }

  MotionFit fit_;
  Slices slices_;
  PoseMetric metric_;
  RigidPose goal_;
  bool is_light_;                   // else slices take long, so trees grow in turn, each on all threads
  std::array<SliceTree, 2> trees_;  // from the start, and from the goal
  std::set<Quaternion> made_;       // the slices that both have asked for, as Slices::shared names them
  std::size_t round_ = 0;
  bool is_begun_ = false;
  std::optional<SliceTree::Meeting> meeting_;
  std::size_t meeting_of_ = 0;  // the tree whose meeting it is
};

SliceSearch::SliceSearch(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker,
                         const Monitor& monitor)
    : state_(std::make_unique<State>(scene, question, checker, monitor)) {}
SliceSearch::~SliceSearch() = default;

std::optional<std::vector<RigidPose>> SliceSearch::run(std::size_t max_slices, const Monitor& monitor) {
  return state_->run(max_slices, monitor);
}
std::size_t SliceSearch::slices() const { return state_->slices(); }
std::map<Quaternion, const Slice*> SliceSearch::made() const { return state_->made(); }
const std::vector<Quaternion>& SliceSearch::symmetries() const { return state_->symmetries(); }

}  // namespace nef::planner
