// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_ompl/sliced_space.h"

#include <utility>

namespace nef::planner {

namespace ob = ompl::base;

SliceSampler::SliceSampler(const ob::StateSpace* space, ob::StateSamplerPtr uniform, std::shared_ptr<SlicePool> pool,
                           double share)
    : ob::StateSampler(space), uniform_(std::move(uniform)), pool_(std::move(pool)), share_(share) {}

void SliceSampler::sampleUniform(ob::State* state) {
  pool_->countDraw();
  if (rng_.uniform01() < share_ && pool_->draw(*space_, state, rng_)) return;
  uniform_->sampleUniform(state);
}

void SliceSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  uniform_->sampleUniformNear(state, near, distance);
}

void SliceSampler::sampleGaussian(ob::State* state, const ob::State* mean, double stdDev) {
  uniform_->sampleGaussian(state, mean, stdDev);
}

ob::StateSamplerPtr SlicedSpace::allocDefaultStateSampler() const {
  ob::StateSamplerPtr uniform = ob::SE3StateSpace::allocDefaultStateSampler();
  if (sliceShare_ == 0) return uniform;
  return std::make_shared<SliceSampler>(this, std::move(uniform), pool_, sliceShare_);
}

}  // namespace nef::planner
