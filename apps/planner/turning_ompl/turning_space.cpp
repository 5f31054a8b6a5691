// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_space.h"

#include <ompl/base/ProjectionEvaluator.h>

#include <cmath>

#include "nef/number/floor.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

// Where OMPL has its angles: [-2, 2).
Turn reduced(const Turn& turn) { return moved_above(turn, -2); }

double radians_of(const Turn& turn, const TurningAxis& axis) { return axis.degrees_of(turn) * M_PI / 180; }

}  // namespace

void TurnSpace::StateType::setExact(const Turn& turn, const TurningAxis& axis) {
  exact_ = reduced(turn);
  value = radians_of(*exact_, axis);
}

bool TurnSpace::StateType::hasExact(const TurningAxis& axis) const {
  return exact_ && radians_of(*exact_, axis) == value;
}

Turn TurnSpace::StateType::exact(const TurningAxis& axis) const {
  if (hasExact(axis)) return *exact_;
  return reduced(axis.turn_of_degrees(exact_rational(value * 180 / M_PI)));
}

ob::State* TurnSpace::allocState() const { return new StateType(); }

void TurnSpace::freeState(ob::State* state) const { delete static_cast<StateType*>(state); }

void TurnSpace::copyState(ob::State* destination, const ob::State* source) const {
  if (destination == source) return;
  auto* to = static_cast<StateType*>(destination);
  const auto* from = static_cast<const StateType*>(source);
  to->value = from->value;
  to->copyTurn(*from);
}

void TurnSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const {
  if (t == 0 || t == 1) return copyState(state, t == 0 ? from : to);
  const auto* a = static_cast<const StateType*>(from);
  const auto* b = static_cast<const StateType*>(to);
  auto* result = static_cast<StateType*>(state);
  if (a->value == b->value) {
    result->copyTurn(*a);  // a translation
  } else {
    result->dropExact();
  }
  ob::SO2StateSpace::interpolate(from, to, t, state);
}

TurningSpace::TurningSpace(const TurningAxis& axis, double weightOfAngles) : axis_(axis) {
  setName("Turning" + getName());
  // A part in R^n and one of rotations: what OMPL's informed samplers, which ask for this type, know how to sample.
  type_ = ob::STATE_SPACE_SE3;
  addSubspace(std::make_shared<ExactTranslationSpace>(), 1.0);
  addSubspace(std::make_shared<TurnSpace>(), weightOfAngles);
  lock();
}

void TurningSpace::setBounds(const ob::RealVectorBounds& bounds) { as<ExactTranslationSpace>(0)->setBounds(bounds); }

const ob::RealVectorBounds& TurningSpace::getBounds() const { return as<ExactTranslationSpace>(0)->getBounds(); }

void TurningSpace::registerProjections() {
  registerDefaultProjection(std::make_shared<ob::SubspaceProjectionEvaluator>(this, 0));
}

Pose TurningSpace::pose(const ob::State* state) const {
  const auto* compound = static_cast<const StateType*>(state);
  return {compound->as<ExactTranslationSpace::StateType>(0)->exact(),
          compound->as<TurnSpace::StateType>(1)->exact(axis_)};
}

void TurningSpace::setPose(ob::State* state, const Pose& pose) const {
  auto* compound = static_cast<StateType*>(state);
  compound->as<ExactTranslationSpace::StateType>(0)->setExact(pose.position);
  compound->as<TurnSpace::StateType>(1)->setExact(pose.turn, axis_);
}

}  // namespace nef::planner
