// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions is looked for with the middle of the robot's box as the reference point first, so that turning
// moves the robot as little as can be, then with the middles of its pieces.
#include "apps/planner/no_path/no_rigid_path.h"

#include <algorithm>
#include <utility>

#include "apps/planner/no_path/position_barrier.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/rigid_question.h"
#include "nef/base/interruption.h"

namespace nef::planner {
namespace {

// The middle of the box around some points.
Rational3 middle_of(const std::vector<Rational3>& points) {
  Rational3 low = points.front();
  Rational3 high = low;
  for (const Rational3& v : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], v[k]);
      high[k] = std::max(high[k], v[k]);
    }
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

// The points to try, each once.
std::vector<Rational3> references_of(const PathProof::Claim& claim) {
  constexpr std::size_t kMost = 4;
  std::vector<Rational3> all;
  std::vector<Rational3> result;
  const auto add = [&](const Rational3& point) {
    if (result.size() < kMost && std::find(result.begin(), result.end(), point) == result.end()) {
      result.push_back(point);
    }
  };
  for (const std::vector<Rational3>& piece : claim.robot) all.insert(all.end(), piece.begin(), piece.end());
  add(middle_of(all));
  for (const std::vector<Rational3>& piece : claim.robot) add(middle_of(piece));
  return result;
}

}  // namespace

PathProof::Claim no_path_claim(const MotionChecker& checker, const RotationClaim& meant) {
  PathProof::Claim claim;
  claim.status = PathProof::Claim::Status::kInfeasible;
  claim.contact = checker.contact();
  claim.box = checker.box();
  for (const RigidBody::Piece& piece : checker.robot().pieces()) claim.robot.push_back(piece.mesh.vertices);
  for (const RigidBody::Piece& piece : checker.obstacles().pieces()) claim.obstacles.push_back(piece.mesh.vertices);
  claim.path = {meant.start, meant.goal};
  claim.rotations = meant.chain;
  claim.places = meant.places;
  return claim;
}

class NoPathSearch::State {
 public:
  State(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal)
      : claim_(no_path_claim(checker, {start, goal, {}, {}, {}})),
        references_(references_of(claim_)),
        barriers_(references_.size()),
        is_done_(references_.size(), false) {}

  NoPathAnswer run(std::size_t max_cells, const Monitor& monitor) {
    NoPathAnswer answer;
    try {
      for (std::size_t i = 0; i < references_.size() && cells_ < max_cells && !answer.proof; ++i) {
        if (is_done_[i]) continue;
        const bool is_last =
            std::find(is_done_.begin() + static_cast<std::ptrdiff_t>(i) + 1, is_done_.end(), false) == is_done_.end();
        look_for(i, (max_cells - cells_ + 1) / (is_last ? 1 : 2), answer, monitor);
      }
    } catch (const Interrupted&) {
      // What is in question is known.
    }
    answer.cells = cells_;
    if (!answer.proof) {
      answer.in_question = in_question();
      if (barriers_[last_] != nullptr && !is_done_[last_]) answer.cells_left = barriers_[last_]->boxes_left();
    }
    return answer;
  }

 private:
  // A barrier of positions of one reference point, with so many boxes.
  void look_for(std::size_t i, std::size_t given, NoPathAnswer& answer, const Monitor& monitor) {
    last_ = i;
    if (barriers_[i] == nullptr) {
      barriers_[i] = std::make_unique<PositionBarrier>(claim_, orientations_, references_[i], monitor);
    }
    std::size_t budget = given;
    const bool found = barriers_[i]->find(budget, monitor);
    cells_ += given - budget;
    is_done_[i] = found || budget > 0;
    if (!found) return;
    PathProof proof;
    proof.claim = claim_;
    proof.cells = barriers_[i]->take_written();
    if (!complaint_about(proof, monitor)) answer.proof = std::move(proof);
  }

  [[nodiscard]] BarrierInQuestion in_question() const {
    BarrierInQuestion result;
    if (references_.empty() || barriers_[last_] == nullptr) return result;
    result.reference = references_[last_];
    for (const PositionBox& box : barriers_[last_]->in_question()) {
      result.boxes.push_back({to_array(box.low), to_array(box.high)});
    }
    return result;
  }

  PathProof::Claim claim_;
  Orientations orientations_ = Orientations::all();
  std::vector<Rational3> references_;
  std::vector<std::unique_ptr<PositionBarrier>> barriers_;  // of each reference point, when it is looked at
  std::vector<bool> is_done_;                               // nothing is left to be cut
  std::size_t last_ = 0;
  std::size_t cells_ = 0;
};

NoPathSearch::NoPathSearch(const MotionChecker& checker, const RigidPose& start, const RigidPose& goal)
    : state_(std::make_unique<State>(checker, start, goal)) {}

NoPathSearch::~NoPathSearch() = default;

NoPathAnswer NoPathSearch::run(std::size_t max_cells, const Monitor& monitor) {
  return state_->run(max_cells, monitor);
}

NoPathAnswer prove_no_rigid_path(const Scene& scene, const NoPathLimits& limits, const Monitor& monitor) {
  const RigidQuestion question = rigid_question_of(scene);
  const MotionChecker checker = MotionChecker::of_scene(with_robot_as_in_its_file(scene, monitor), monitor);
  return NoPathSearch(checker, question.start, question.goal).run(limits.max_cells, monitor);
}

}  // namespace nef::planner
