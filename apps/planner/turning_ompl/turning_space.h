// SPDX-License-Identifier: Apache-2.0
//
// R^3 x SO(2) whose states may carry exact positions and turns beside the doubles.
#pragma once

#include <ompl/base/spaces/SO2StateSpace.h>

#include <memory>
#include <optional>

#include "apps/planner/ompl/exact_translation_space.h"
#include "apps/planner/turning/turning_question.h"

namespace nef::planner {

/** \brief The angles about an axis, SO(2), with exact turns.

    A state holds an angle in radians, as every ompl::base::SO2StateSpace, and optionally a Turn, which counts as long
   as the angle still rounds to it. A state without one stands for the simplest turn within 1e-12 of its angle. */
class TurnSpace : public ompl::base::SO2StateSpace {
 public:
  class StateType : public ompl::base::SO2StateSpace::StateType {
   public:
    /** \brief Sets the turn and its angle. */
    void setExact(const Turn& turn, const TurningAxis& axis);
    /** \brief The turn, in [-2, 2): the exact one if it counts, else that of the angle. */
    Turn exact(const TurningAxis& axis) const;
    bool hasExact(const TurningAxis& axis) const;
    /** \brief Takes over the turn of another state, if it has one, but not its angle. */
    void copyTurn(const StateType& other) { exact_ = other.exact_; }
    /** \brief Forgets the turn. */
    void dropExact() { exact_.reset(); }

   private:
    std::optional<Turn> exact_;
  };

  ompl::base::State* allocState() const override;
  void freeState(ompl::base::State* state) const override;
  void copyState(ompl::base::State* destination, const ompl::base::State* source) const override;
  /** \brief Both ends with their turns; in between the angle alone. */
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
};

/** \brief The poses of a robot that translates and turns about one axis, R<sup>3</sup> x SO(2).

    The parts are an ExactTranslationSpace and a TurnSpace, so code for compound spaces (ScopedState, samplers, storage
   of doubles) works as ever; pose() and setPose() are exact. Distances: an angle counts with a weight, the robot's
   reach if not set otherwise, so that a turn is about as long as the way of the robot's farthest point. */
class TurningSpace : public ompl::base::CompoundStateSpace {
 public:
  /** \brief Bounds must be set before use. */
  explicit TurningSpace(const TurningAxis& axis, double weightOfAngles = 1);

  const TurningAxis& axis() const { return axis_; }
  void setBounds(const ompl::base::RealVectorBounds& bounds);
  const ompl::base::RealVectorBounds& getBounds() const;

  /** \brief The position's projection by default, for planners that want one. */
  void registerProjections() override;

  /** \brief The pose, exactly; the turn is in [-2, 2). */
  Pose pose(const ompl::base::State* state) const;
  void setPose(ompl::base::State* state, const Pose& pose) const;

 private:
  TurningAxis axis_;
};

}  // namespace nef::planner
