// SPDX-License-Identifier: Apache-2.0
//
// R^3 whose states may carry exact rational coordinates beside the doubles.
#pragma once

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>
#include <optional>

#include "apps/planner/free_space/free_space.h"

namespace nef::planner {

/** \brief The space of translations of a robot, R<sup>3</sup>, with exact states.

    A passage as narrow as the robot may lie on coordinates that no double has (a plane at 1/3). So a
    state holds three doubles, as every ompl::base::RealVectorStateSpace, and optionally three
    rationals. The rationals count only as long as each still rounds to the double beside it: code that
    knows nothing of them (ScopedState, the path simplifier) writes doubles, and from
    then on these, which are rationals themselves, are the state. */
class ExactTranslationSpace : public ompl::base::RealVectorStateSpace {
 public:
  /** \brief A state: values[0..2] and, if it is not the doubles themselves, the exact position. */
  class StateType : public ompl::base::RealVectorStateSpace::StateType {
   public:
    /** \brief Sets the exact position and its doubles. */
    void setExact(const Rational3& position);
    /** \brief The position. Exact: the rationals if they still round to the doubles, else the doubles. */
    Rational3 exact() const;
    /** \brief The position for exact questions; builds no rationals if it need not. */
    ExactPoint point() const;
    /** \brief True if no coordinate is infinite or no number. */
    bool isFinite() const;
    /** \brief True if rationals are there and count. */
    bool hasExact() const;
    /** \brief Forgets the rationals. */
    void dropExact() { exact_.reset(); }
    /** \brief Becomes the other one, with the rationals that it has. */
    void copyFrom(const StateType& other);

   private:
    std::unique_ptr<Rational3> exact_;
  };

  /** \brief Constructor. Bounds must be set before use (see setBounds). With a free space, samples are
      drawn by CellSampler, which also draws from the cells of dimension 0, 1 and 2. */
  explicit ExactTranslationSpace(std::shared_ptr<const FreeSpace> freeSpace = nullptr);

  /** \brief The free space that default samplers draw from; may be null. */
  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }
  /** \brief Replaces the free space for samplers allocated from now on. */
  void setFreeSpace(std::shared_ptr<const FreeSpace> freeSpace) { freeSpace_ = std::move(freeSpace); }

  /** \brief The share of samples that CellSampler draws from cells of dimension 0 to 2 (0.3). */
  void setCellShare(double share) { cellShare_ = share; }
  double getCellShare() const { return cellShare_; }

  void registerProjections() override;
  ompl::base::State* allocState() const override;
  void freeState(ompl::base::State* state) const override;
  void copyState(ompl::base::State* destination, const ompl::base::State* source) const override;
  /** \brief Exact equality (the base class takes states closer than 2 epsilon for equal). */
  bool equalStates(const ompl::base::State* state1, const ompl::base::State* state2) const override;
  /** \brief Three doubles, and nothing else: the state is at these afterwards, whatever it was before.
      copyToReals gives the nearest doubles. To keep exact positions, copy states, or use StateType::exact() and
      setExact(). */
  void copyFromReals(ompl::base::State* destination, const std::vector<double>& reals) const override;
  /** \brief The exact point at parameter t (a double is a rational) if an end is exact, else as the base class. */
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  /** \brief Doubles and rationals. OMPL wants one length for all states, so a rational is kept only if its numerators
      and denominators have at most 31 bytes (coordinates of ordinary scenes have a few); else the doubles remain. */
  unsigned int getSerializationLength() const override;
  void serialize(void* serialization, const ompl::base::State* state) const override;
  void deserialize(ompl::base::State* state, const void* serialization) const override;
  /** \brief The rationals if they count, else the doubles. */
  void printState(const ompl::base::State* state, std::ostream& out) const override;
  /** \brief A CellSampler if there is a free space. Informed samplers ask for this one directly. */
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;

 private:
  std::shared_ptr<const FreeSpace> freeSpace_;
  double cellShare_ = 0.3;
};

}  // namespace nef::planner
