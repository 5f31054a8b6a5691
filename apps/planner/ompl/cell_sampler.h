// SPDX-License-Identifier: Apache-2.0
//
// Samplers that also draw from the vertices, edges and facets of free space.
#pragma once

#include <ompl/base/ValidStateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>

#include "apps/planner/ompl/exact_translation_space.h"

namespace nef::planner {

/** \brief The cells that samplers draw from: those of tight passages and their mouths. Without tight
    passages there are none, and sampling is uniform. All points drawn are exact. */
class CellPool {
 public:
  explicit CellPool(std::shared_ptr<const FreeSpace> freeSpace);

  bool empty() const { return points_.empty() && cells_.empty(); }
  /** \brief Number of 0-dimensional cells: the mouths and tight vertices. */
  std::size_t pointCount() const { return points_.size(); }
  const Rational3& point(std::size_t i) const { return points_[i]; }
  /** \brief An exact point of a random edge or facet, or of a random vertex. */
  Rational3 draw(ompl::RNG& rng) const;

 private:
  Rational3 drawFrom(CellId cell, ompl::RNG& rng) const;
  Rational3 atCorner(CellId cell, const std::vector<Rational3>& cycle, std::size_t first) const;

  std::shared_ptr<const FreeSpace> freeSpace_;
  std::vector<Rational3> points_;
  std::vector<CellId> cells_;
};

/** \brief Uniform sampling of R<sup>3</sup>, mixed with exact points of tight passages and of the cells at
    their mouths.

    A set of measure zero is never met by uniform sampling, whatever the time. This sampler first draws
    every mouth once, since a point of a volume can be joined to a corridor only through the corridor's end;
    then a constant share of all draws is from cells of dimension 0, 1 and 2. The near variants draw a
    cell's point too if one lies within the distance. */
class CellSampler : public ompl::base::RealVectorStateSampler {
 public:
  /** \brief \e share of the draws come from cells (after the first pass). */
  CellSampler(const ompl::base::StateSpace* space, std::shared_ptr<const FreeSpace> freeSpace, double share);

  void sampleUniform(ompl::base::State* state) override;
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean, double stdDev) override;

 private:
  bool drawCell(ompl::base::State* state);
  bool drawCellNear(ompl::base::State* state, const ompl::base::State* near, double distance);

  CellPool pool_;
  double share_;
  std::size_t firstPass_ = 0;
};

/** \brief The same for planners that ask for valid states (PRM, EST, SBL, ...). */
class CellValidStateSampler : public ompl::base::ValidStateSampler {
 public:
  /** \brief The state space of \e si must be an ExactTranslationSpace. */
  CellValidStateSampler(const ompl::base::SpaceInformation* si, std::shared_ptr<const FreeSpace> freeSpace,
                        double share = 0.3);

  bool sample(ompl::base::State* state) override;
  bool sampleNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;

 private:
  CellSampler sampler_;
};

}  // namespace nef::planner
