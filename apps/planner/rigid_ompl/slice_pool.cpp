// SPDX-License-Identifier: Apache-2.0
//
// Slices at the rotations where a path is looked for bring samples to narrow places: Lien, Hybrid motion planning using
// Minkowski sums (RSS 2008); Salzman, Hemmer, Raveh and Halperin, Motion planning via manifold samples (Algorithmica
// 2013).
#include "apps/planner/rigid_ompl/slice_pool.h"

#include <algorithm>
#include <utility>

#include "apps/planner/orientation/rotations.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "nef/base/interruption.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

template <typename T>
const T& any_of(const std::vector<T>& items, ompl::RNG& rng) {
  return items[static_cast<std::size_t>(rng.uniformInt(0, static_cast<int>(items.size()) - 1))];
}

// The middles of the walls between a zone and others of its component.
std::vector<Vector3d> gates_of(const FreeSpace& free, ZoneId zone) {
  std::vector<Vector3d> gates;
  for (const PortalId id : free.roadmap().portals_of(zone)) {
    const Roadmap::Portal& portal = free.roadmap().portals()[id];
    if (free.cells().dimension(portal.cell) < 3) continue;  // in contact
    gates.emplace_back(portal.approximate[0], portal.approximate[1], portal.approximate[2]);
  }
  return gates;
}

// A gate of a zone, or a point between one inside of it and three gates. A zone is convex, so the robot goes straight
// from any of them to any other.
Vector3d point_in(const FreeSpace& free, ZoneId zone, ompl::RNG& rng) {
  const std::vector<Vector3d> gates = gates_of(free, zone);
  if (!gates.empty() && rng.uniformBool()) return any_of(gates, rng);
  double weights = rng.uniform01();
  Vector3d sum = weights * to_vector(free.roadmap().interior_point(zone));
  constexpr int kGates = 3;
  for (int i = 0; i < kGates && !gates.empty(); ++i) {
    const double weight = rng.uniform01();
    sum += weight * any_of(gates, rng);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

SlicePool::SlicePool(Scene scene, std::shared_ptr<const MotionChecker> checker)
    : scene_(std::move(scene)),
      question_(rigid_question_of(scene_)),
      checker_(std::move(checker)),
      isDone_(!is_light(*checker_)) {
  const RigidTurn turn = RigidTurn::of(*checker_);
  if (!isDone_) drawsPerSlice_ = turn.samples / turn.slices;
}

void SlicePool::setMonitor(const Monitor& monitor) {
  const std::scoped_lock lock(mutex_);
  monitor_ = monitor.of_other_thread().on_threads(1);
}

void SlicePool::countDraw() {
  const std::scoped_lock lock(mutex_);
  ++draws_;
  if (isDone_ || draws_ % drawsPerSlice_ != 0) return;
  const std::size_t slices = draws_ / drawsPerSlice_;
  if (search_ == nullptr || search_->slices() < slices) search(slices);
}

void SlicePool::search(std::size_t slices) {
  try {
    if (search_ == nullptr) search_ = std::make_unique<SliceSearch>(scene_, question_, *checker_, monitor_);
    const bool isFound = search_->run(slices, monitor_).has_value();
    isDone_ = isFound || search_->slices() < slices;
  } catch (const Interrupted&) {
    isDone_ = true;
    return;
  }
  for (const auto& [rotation, slice] : search_->made()) {
    if (rotations_.insert(rotation).second) add(rotation, *slice);
  }
}

void SlicePool::add(const Quaternion& rotation, const Slice& slice) {
  for (const SliceComponent& component : slice.components) {
    if (!component.zones.empty()) parts_.push_back({rotation, slice.free, component.zones, nullptr});
  }
  auto tight = std::make_shared<const CellPool>(slice.free);
  if (!tight->empty()) parts_.push_back({rotation, slice.free, {}, std::move(tight)});
}

// Of the rotations that share the slice any one.
RigidPose SlicePool::poseIn(const Part& part, ompl::RNG& rng) const {
  const Quaternion rotation = product(part.rotation, any_of(search_->symmetries(), rng));
  if (part.tight != nullptr) return {part.tight->draw(rng), rotation};
  const Vector3d position = point_in(*part.free, any_of(part.zones, rng), rng);
  return {{exact_rational(position[0]), exact_rational(position[1]), exact_rational(position[2])}, rotation};
}

bool SlicePool::draw(const ob::StateSpace& space, ob::State* state, ompl::RNG& rng) const {
  const std::scoped_lock lock(mutex_);
  // A pose may collide once it is rounded, and be beyond the bounds if the scene has no box.
  constexpr int kTries = 8;
  for (int i = 0; i < kTries && !parts_.empty(); ++i) {
    set_pose(poseIn(any_of(parts_, rng), rng), state);
    if (space.satisfiesBounds(state) &&
        checker_->check(*pose_of(space, state)).status == MotionVerdict::Status::kFree) {
      return true;
    }
  }
  return false;
}

std::size_t SlicePool::sliceCount() const {
  const std::scoped_lock lock(mutex_);
  return rotations_.size();
}

}  // namespace nef::planner
