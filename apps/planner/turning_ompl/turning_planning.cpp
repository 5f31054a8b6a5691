// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_planning.h"

#include <algorithm>

#include "apps/planner/ompl/position_bounds.h"
#include "apps/planner/turning/turning_robot.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

// Samples in the box of the scene, exactly: it may be flat, and at coordinates that no double has.
class BoxSampler : public ob::RealVectorStateSampler {
 public:
  BoxSampler(const ob::StateSpace* space, const std::array<Rational3, 2>& box)
      : ob::RealVectorStateSampler(space), box_(box) {}
  void sampleUniform(ob::State* state) override {
    ob::RealVectorStateSampler::sampleUniform(state);
    clamp(state);
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    ob::RealVectorStateSampler::sampleUniformNear(state, near, distance);
    clamp(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    ob::RealVectorStateSampler::sampleGaussian(state, mean, deviation);
    clamp(state);
  }

 private:
  void clamp(ob::State* state) const {
    auto* exact = static_cast<ExactTranslationSpace::StateType*>(state);
    exact->dropExact();
    Rational3 point = exact->exact();
    for (std::size_t k = 0; k < 3; ++k) point[k] = std::clamp(point[k], box_[0][k], box_[1][k]);
    exact->setExact(point);
  }
  std::array<Rational3, 2> box_;
};

std::shared_ptr<TurningSpace> space_for(const Scene& scene) {
  const TurningQuestion question = question_of(scene);
  if (question.high - question.low > 4) {
    throw InputError(scene.name + ": OMPL's angles are those of one full circle; the range is wider");
  }
  auto space = std::make_shared<TurningSpace>(question.axis, reach_of(scene.robot));
  space->setBounds(position_bounds(scene));
  if (scene.box) {
    space->as<ExactTranslationSpace>(0)->setStateSamplerAllocator(
        [box = *scene.box](const ob::StateSpace* part) { return std::make_shared<BoxSampler>(part, box); });
  }
  return space;
}

}  // namespace

TurningPlanning::TurningPlanning(const Scene& scene)
    : ompl::geometric::SimpleSetup(space_for(scene)), scene_(scene), question_(question_of(scene)) {
  const auto collision = std::make_shared<const TurningCollision>(scene_, question_.axis);
  setStateValidityChecker(std::make_shared<TurningValidityChecker>(si_, collision, question_));
  si_->setMotionValidator(std::make_shared<TurningMotionValidator>(si_, collision, question_));
  ob::ScopedState<> start(si_);
  ob::ScopedState<> goal(si_);
  space().setPose(start.get(), question_.start);
  space().setPose(goal.get(), question_.goal);
  setStartAndGoalStates(start, goal);
  setPlannerAllocator(
      [this](const ob::SpaceInformationPtr& si) { return std::make_shared<TurningPlanner>(si, scene_, question_); });
}

}  // namespace nef::planner
