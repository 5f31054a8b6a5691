// SPDX-License-Identifier: Apache-2.0
//
// OMPL's SE(3) whose samplers also draw from slices.
#pragma once

#include <ompl/base/spaces/SE3StateSpace.h>

#include <memory>

#include "apps/planner/rigid_ompl/slice_pool.h"

namespace nef::planner {

/** \brief Uniform sampling of SE(3), mixed with free poses in slices.

    A narrow place is rarely met by uniform sampling: position and rotation have to be right at once. The near variants
    are those of uniform sampling. */
class SliceSampler : public ompl::base::StateSampler {
 public:
  /** \brief \e share of the draws come from slices, once there are some, the others from \e uniform. */
  SliceSampler(const ompl::base::StateSpace* space, ompl::base::StateSamplerPtr uniform,
               std::shared_ptr<SlicePool> pool, double share);

  void sampleUniform(ompl::base::State* state) override;
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean, double stdDev) override;

 private:
  ompl::base::StateSamplerPtr uniform_;
  std::shared_ptr<SlicePool> pool_;
  double share_;
};

/** \brief An SE3StateSpace like any other, but for its samplers. */
class SlicedSpace : public ompl::base::SE3StateSpace {
 public:
  explicit SlicedSpace(std::shared_ptr<SlicePool> pool) : pool_(std::move(pool)) {}

  /** \brief The share of samples that are drawn from slices (0.3); 0: none, and no slices are made. For samplers that
      are allocated from now on. */
  void setSliceShare(double share) { sliceShare_ = share; }
  double getSliceShare() const { return sliceShare_; }
  /** \brief What samplers draw from. */
  const std::shared_ptr<SlicePool>& getSlices() const { return pool_; }

  /** \brief A SliceSampler. Informed samplers ask for this one directly. */
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;

 private:
  std::shared_ptr<SlicePool> pool_;
  double sliceShare_ = 0.3;
};

}  // namespace nef::planner
