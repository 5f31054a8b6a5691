// SPDX-License-Identifier: Apache-2.0
//
// From each end grows a tree of nodes, both at the same time. The motion that a tree tries next leads to the rotation
// nearest to the other end. After each step of both, each gets to know what the other one has found; so a step does not
// depend on which of them is faster.
#include "apps/planner/rigid_search/slice_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>

#include "apps/planner/orientation/aligned_rotations.h"
#include "apps/planner/orientation/rotations.h"
#include "apps/planner/path/path.h"
#include "apps/planner/rigid_search/slice_tree.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/threads/parallel.h"

namespace nef::planner {
namespace {

// How fine a round is: the grid's level, and how often arcs between its rotations are halved.
struct Fineness {
  unsigned level;
  unsigned depth;
};
constexpr std::array<Fineness, 10> kRounds{Fineness{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4},
                                           {1, 1},         {1, 2}, {1, 3}, {2, 2}, {2, 3}};

// The rotations at which faces of both are parallel, beside those of the first grid; none if there are too many faces.
std::set<Quaternion> aligned_beside_grid(const Scene& scene, const Monitor& monitor) {
  constexpr std::size_t kMostPairs = 400;  // of directions
  const std::set<Integer3> of_robot = face_directions({&scene.robot, 1});
  const std::set<Integer3> of_obstacles = face_directions(scene.obstacles);
  if (of_robot.size() * of_obstacles.size() > kMostPairs) return {};
  std::set<Quaternion> result = aligned_rotations(of_robot, of_obstacles, monitor);
  std::erase_if(result, [](const Quaternion& q) { return is_in_grid(q, kRounds.front().level); });
  return result;
}

}  // namespace

class SliceSearch::State {
 public:
  State(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker, const Monitor& monitor)
      : fit_(checker),
        slices_(scene, monitor, is_light(checker)),
        metric_(checker.robot().nodes().front().reach),
        goal_(question.goal),
        is_light_(is_light(checker)),
        aligned_(aligned_beside_grid(scene, monitor)),
        trees_{SliceTree(checker, fit_, metric_, slices_, aligned_, question.start, question.goal),
               SliceTree(checker, fit_, metric_, slices_, aligned_, question.goal, question.start)} {}

  std::optional<std::vector<RigidPose>> run(std::size_t max_slices, const Monitor& monitor) {
    const bool at_once = is_light_ && monitor.threads() != 1;
    if (at_once && !trees_[0].is_planted()) {
      parallel_for(2, monitor, [&](std::size_t i, const Monitor& own) { trees_[i].prepare(own); });
    }
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
      if (!meeting_ && has_steps()) {
        if (at_once) {
          AtOnce(*this, max_slices).run(monitor);
        } else {
          grow_in_turn(max_slices, monitor);
        }
      }
      if (meeting_) return path(monitor);
      if (is_full_) return std::nullopt;
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
  [[nodiscard]] bool has_steps() const { return trees_[0].has_steps() || trees_[1].has_steps(); }
  [[nodiscard]] unsigned depth() const { return kRounds[round_].depth; }

  // A step of each tree.
  struct Steps {
    std::array<std::size_t, 2> allowed{};  // slices
    std::array<SliceTree::Growth, 2> grown;
  };

  [[nodiscard]] Steps next_steps(std::size_t max_slices) const {
    const std::size_t left = max_slices - std::min(max_slices, made_.size());
    const bool are_two = trees_[0].has_steps() && trees_[1].has_steps();
    return {{are_two ? left - left / 2 : left, are_two ? left / 2 : left}, {}};
  }

  void grow(std::size_t i, Steps& steps, const Monitor& monitor, const std::function<bool()>& meanwhile = {}) {
    steps.grown[i] = trees_[i].grow(trees_[1 - i], depth(), made_, steps.allowed[i], monitor, meanwhile);
  }

  // False if there are to be no others: the trees have met, have no steps, or there are not enough slices.
  bool end_steps(Steps& steps, std::size_t max_slices) {
    for (std::size_t i = 0; i < 2 && !meeting_; ++i) {
      made_.merge(steps.grown[i].slices);
      if (steps.grown[i].meeting) {
        meeting_ = std::move(steps.grown[i].meeting);
        meeting_of_ = i;
      }
    }
    if (!meeting_) settle();
    is_full_ = (steps.grown[0].is_full || steps.grown[1].is_full) && made_.size() >= max_slices;
    return !meeting_ && !is_full_ && has_steps();
  }

  void grow_in_turn(std::size_t max_slices, const Monitor& monitor) {
    Steps steps;
    do {
      steps = next_steps(max_slices);
      for (std::size_t i = 0; i < 2 && !steps.grown[0].meeting; ++i) {
        if (trees_[i].has_steps()) grow(i, steps, monitor);
      }
    } while (end_steps(steps, max_slices));
  }

  // Two threads take the steps of both trees. One that has none to take does what later steps will ask for, so that it
  // is known when they do.
  class AtOnce {
   public:
    AtOnce(State& state, std::size_t max_slices) : state_(state), max_slices_(max_slices) { begin(); }

    void run(const Monitor& monitor) {
      const auto work = [this](const Monitor& own) { take_work(own); };
      parallel_calls(monitor, {work, work});
      for (const std::exception_ptr& failure : failures_) {
        if (failure) std::rethrow_exception(failure);
      }
    }

   private:
    enum class Stage : std::uint8_t { kWaiting, kTaken, kDone };

    void begin() {
      steps_ = state_.next_steps(max_slices_);
      for (std::size_t i = 0; i < 2; ++i) stages_[i] = state_.trees_[i].has_steps() ? Stage::kWaiting : Stage::kDone;
      is_decided_ = false;
      if (idle_ > 0 && ahead_.empty()) {
        for (std::size_t i = 0; i < 2; ++i) foresee(i);
      }
    }

    // The tree does not grow now.
    void foresee(std::size_t i) {
      constexpr std::size_t kMost = 8;
      for (const SliceTree::Work& work : state_.trees_[i].foreseen(state_.depth(), kMost)) ahead_.emplace_back(i, work);
    }

    void take_work(const Monitor& monitor) {
      std::unique_lock lock(mutex_);
      while (!is_over_) {
        const auto waiting = std::find(stages_.begin(), stages_.end(), Stage::kWaiting);
        if (waiting != stages_.end()) {
          make_step(static_cast<std::size_t>(waiting - stages_.begin()), lock, monitor);
        } else if (!work_ahead(lock, monitor)) {
          ++idle_;
          changed_.wait(lock);
          --idle_;
        }
      }
    }

    void make_step(std::size_t i, std::unique_lock<std::mutex>& lock, const Monitor& monitor) {
      stages_[i] = Stage::kTaken;
      lock.unlock();
      std::exception_ptr failure;
      try {
        // Once the first tree has met the second one, that one's step does not matter.
        const StopQuestion stop([&] { return is_over_ || (i == 1 && is_decided_); }, monitor);
        state_.grow(i, steps_, stop.monitor(), [&] {
          std::unique_lock again(mutex_);
          return work_ahead(again, stop.monitor());
        });
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      stages_[i] = Stage::kDone;
      if (i == 1 && is_decided_) failure = nullptr;
      if (failure) {
        failures_[i] = failure;
        is_over_ = true;
      }
      if (i == 0 && steps_.grown[0].meeting) is_decided_ = true;
      if (!is_over_ && stages_[1 - i] == Stage::kWaiting && is_decided_) stages_[1 - i] = Stage::kDone;
      if (!is_over_ && stages_[1 - i] == Stage::kDone) {
        is_over_ = !state_.end_steps(steps_, max_slices_);
        if (!is_over_) begin();
      }
      changed_.notify_all();
    }

    // False if there is nothing to do.
    bool work_ahead(std::unique_lock<std::mutex>& lock, const Monitor& monitor) {
      for (std::size_t i = 0; i < 2 && ahead_.empty(); ++i) {
        if (stages_[i] != Stage::kTaken) foresee(i);
      }
      if (ahead_.empty()) return false;
      const auto [tree, work] = ahead_.front();
      ahead_.pop_front();
      lock.unlock();
      try {
        const StopQuestion stop([&] { return is_over_.load(); }, monitor);
        state_.trees_[tree].do_ahead(work, stop.monitor());
      } catch (...) {  // whoever needs it will see
      }
      lock.lock();
      return true;
    }

    State& state_;
    std::size_t max_slices_;
    std::mutex mutex_;  // of all but the trees' steps and the work ahead
    std::condition_variable changed_;
    Steps steps_;
    std::array<Stage, 2> stages_{};
    std::array<std::exception_ptr, 2> failures_;
    std::atomic<bool> is_decided_ = false;  // the first tree has met the second one in this step
    std::atomic<bool> is_over_ = false;
    std::deque<std::pair<std::size_t, SliceTree::Work>> ahead_;  // and for which tree
    unsigned idle_ = 0;                                          // threads that have nothing to do
  };

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
  std::set<Quaternion> aligned_;    // rotations
  std::array<SliceTree, 2> trees_;  // from the start, and from the goal
  std::set<Quaternion> made_;       // the slices that both have asked for, as Slices::shared names them
  std::size_t round_ = 0;
  bool is_begun_ = false;
  bool is_full_ = false;  // there were not enough slices for the next steps
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
