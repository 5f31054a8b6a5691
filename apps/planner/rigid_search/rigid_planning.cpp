// SPDX-License-Identifier: Apache-2.0
//
// Phases of the three searches, each of twice the size of the one before. Slices cost a Minkowski sum each, so of
// scenes with many pieces fewer are made in a phase, and more random poses are drawn before the first. A proof that
// takes few boxes is cheaper than the first slices, so it is looked for before them; a turn of the search for a proof
// is longer while it looks as if there was one. The sizes do not depend on times, so neither does the answer.
#include "apps/planner/rigid_search/rigid_planning.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "apps/planner/free_space/collision.h"
#include "apps/planner/rigid_search/certified_trees.h"
#include "apps/planner/rigid_search/shorten_poses.h"
#include "apps/planner/rigid_search/slice_search.h"
#include "apps/planner/rigid_search/slices.h"
#include "nef/base/interruption.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

constexpr std::size_t kFirstSamples = 500;    // of a scene of few pieces
constexpr std::size_t kPairsForSamples = 50;  // as many again for each so many pairs of pieces,
constexpr std::size_t kMostTimes = 64;        // at most so often
constexpr std::size_t kFirstSlices = 40;
constexpr std::size_t kFewBoxes = 2500;  // before the first slices
constexpr std::size_t kFirstBoxes = 20000;
constexpr std::size_t kFewLeft = 160;    // as it is estimated where there is a proof: see NoPathAnswer::cells_left
constexpr std::size_t kLongestTurn = 3;  // times as long as planned

class RigidPlanning {
 public:
  RigidPlanning(const Scene& scene, const MotionChecker& checker, const RigidLimits& limits, const Monitor& monitor)
      : scene_(scene),
        question_(rigid_question_of(scene)),
        checker_(checker),
        limits_(limits),
        monitor_(monitor),
        unstopped_(Monitor().on_threads(monitor.threads())) {}

  RigidAnswer run() {
    try {
      if (auto invalid = invalid_rigid_end(scene_, checker_, monitor_)) return *std::move(invalid);
      if (!is_answer({question_.start, question_.goal}, monitor_)) search();
    } catch (const Interrupted&) {
      count();
    }
    return std::move(answer_);
  }

 private:
  void search() {
    trees_.emplace(question_, checker_);
    std::size_t samples = 0;
    std::size_t slices = 0;
    for (std::size_t size = 1; trees_->samples() < limits_.max_samples || !slices_are_done_ || !proofs_are_done_;
         size *= 2) {
      const RigidTurn turn = RigidTurn::of(checker_, size);
      samples = std::min(samples + turn.samples, limits_.max_samples);
      if (const auto path = trees_->run(samples, monitor_)) {
        if (is_answer(*path, unstopped_)) return;
      }
      count();
      if (size == 1 && is_light(checker_) && search_proof(std::min(kFewBoxes, limits_.max_boxes))) return;
      slices = std::min(slices + turn.slices, limits_.max_slices);
      if (search_slices(slices)) return;
      count();
      if (search_proof(std::min(kFirstBoxes * size, limits_.max_boxes))) return;
    }
  }

  // True if there is no path.
  bool search_proof(std::size_t boxes) {
    if (proofs_are_done_) return false;
    NoPathAnswer found;
    if (boxes > 0) {
      if (proofs_ == nullptr) {
        proofs_ = std::make_unique<NoPathSearch>(checker_, question_.start, question_.goal);
      }
      found = proofs_->run(boxes, monitor_);
      // It goes on beyond its turn if it looks as if there was a proof. At once: where a search stops, some boxes are
      // lost.
      const std::size_t most = std::min(kLongestTurn * boxes, limits_.max_boxes);
      if (!found.proof && found.cells >= boxes && boxes < most && found.cells_left && *found.cells_left <= kFewLeft) {
        boxes = most;
        found = proofs_->run(boxes, monitor_);
      }
    }
    answer_.boxes = found.cells;
    answer_.in_question = std::move(found.in_question);
    proofs_are_done_ = found.proof || found.cells < boxes || boxes == limits_.max_boxes;
    if (!found.proof) return false;
    answer_.status = RigidAnswer::Status::kInfeasible;
    answer_.proof = std::move(found.proof);
    return true;
  }

  // True if there is an answer.
  bool search_slices(std::size_t slices) {
    if (slices_are_done_) return false;
    if (slices > 0) {
      if (slices_ == nullptr) slices_ = std::make_unique<SliceSearch>(scene_, question_, checker_, monitor_);
      const auto path = slices_->run(slices, monitor_);
      if (path && is_answer(*path, unstopped_)) return true;
      // A path that is not certified touches a surface, which slices allow at its border.
      if (path || slices_->slices() < slices) slices_are_done_ = true;
    }
    if (slices >= limits_.max_slices) slices_are_done_ = true;
    return false;
  }

  // Takes a path for the answer if all its motions are certified; it is shortened first.
  bool is_answer(std::vector<RigidPose> path, const Monitor& monitor) {
    if (path.size() > 2) path = shorten(checker_, std::move(path), monitor_);
    path.front() = question_.start;
    path.back() = question_.goal;
    CertifiedPath certified = certify(checker_, path, MotionTiming::kSlerp, {}, monitor);
    if (certified.status != MotionVerdict::Status::kFree) return false;
    answer_.status = RigidAnswer::Status::kPath;
    answer_.in_question = {};
    answer_.path = std::move(path);
    answer_.certified = std::move(certified);
    count();
    return true;
  }

  void count() {
    if (trees_) answer_.samples = trees_->samples();
    if (slices_ != nullptr) answer_.slices = slices_->slices();
  }

  const Scene& scene_;
  RigidQuestion question_;
  const MotionChecker& checker_;
  RigidLimits limits_;
  const Monitor& monitor_;
  Monitor unstopped_;  // a path that was found in time is certified to the end
  std::optional<CertifiedTrees> trees_;
  std::unique_ptr<SliceSearch> slices_;
  std::unique_ptr<NoPathSearch> proofs_;
  bool slices_are_done_ = false;
  bool proofs_are_done_ = false;
  RigidAnswer answer_;
};

}  // namespace

RigidTurn RigidTurn::of(const MotionChecker& checker, std::size_t size) {
  const std::size_t pairs = pairs_of(checker);
  return {kFirstSamples * std::clamp<std::size_t>(pairs / kPairsForSamples, 1, kMostTimes) * size,
          kFirstSlices * size * kLightPairs / std::max(pairs, kLightPairs)};
}

RigidLimits RigidLimits::of(std::optional<std::size_t> max_slices, bool time_is_limited) {
  RigidLimits limits;
  if (max_slices) {
    limits.max_samples = limits.max_samples / limits.max_slices * *max_slices;
    limits.max_boxes = limits.max_boxes / limits.max_slices * *max_slices;
    limits.max_slices = *max_slices;
  } else if (time_is_limited) {
    limits.max_samples = limits.max_slices = limits.max_boxes = std::numeric_limits<std::uint32_t>::max();
  }
  return limits;
}

std::optional<RigidAnswer> invalid_rigid_end(const Scene& scene, const MotionChecker& checker, const Monitor& monitor) {
  const RigidQuestion question = rigid_question_of(scene);
  for (const auto& [pose, status] : {std::pair(&question.start, RigidAnswer::Status::kInvalidStart),
                                     std::pair(&question.goal, RigidAnswer::Status::kInvalidGoal)}) {
    if (checker.check(*pose, {}, monitor).status == MotionVerdict::Status::kFree) continue;
    RigidAnswer answer;
    answer.collision = find_collision(scene, *pose, monitor);
    answer.status = status;
    return answer;
  }
  return std::nullopt;
}

RigidAnswer find_rigid_path(const Scene& scene, const MotionChecker& checker, const RigidLimits& limits,
                            const Monitor& monitor) {
  return RigidPlanning(scene, checker, limits, monitor).run();
}

}  // namespace nef::planner
