// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/cell_sampler.h"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>

#include "apps/planner/free_space/segments.h"

namespace nef::planner {

namespace ob = ompl::base;

CellPool::CellPool(std::shared_ptr<const FreeSpace> freeSpace) : freeSpace_(std::move(freeSpace)) {
  std::vector<CellId> cells;
  for (const TightPassage& passage : freeSpace_->passages()) {
    cells.insert(cells.end(), passage.cells.begin(), passage.cells.end());
    cells.insert(cells.end(), passage.mouths.begin(), passage.mouths.end());
  }
  // Rooms may also meet in a mere edge or vertex, without any passage between them.
  const CellNumbering& numbering = freeSpace_->cells();
  for (CellId cell = 0; cell < numbering.facet(FacetId{0}); ++cell) {
    if (!freeSpace_->is_free(cell)) continue;
    std::size_t volumes = 0;
    for (const CellId other : freeSpace_->neighbours(cell)) volumes += numbering.dimension(other) == 3 ? 1 : 0;
    if (volumes > 1) cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const CellId cell : cells) {
    switch (numbering.dimension(cell)) {
      case 0:
        points_.push_back(freeSpace_->vertices(cell)[0]);
        break;
      case 3:
        break;
      default:
        cells_.push_back(cell);
    }
  }
}

Rational3 CellPool::draw(ompl::RNG& rng) const {
  const bool a_point = cells_.empty() || (!points_.empty() && rng.uniform01() < 0.5);
  if (a_point) return points_[static_cast<std::size_t>(rng.uniformInt(0, static_cast<int>(points_.size()) - 1))];
  return drawFrom(cells_[static_cast<std::size_t>(rng.uniformInt(0, static_cast<int>(cells_.size()) - 1))], rng);
}

// A convex combination of vertices with dyadic weights; in a facet that is not convex it may miss the facet, and then
// some place at one of its corners is taken.
Rational3 CellPool::drawFrom(CellId cell, ompl::RNG& rng) const {
  const std::vector<Rational3> vertices = freeSpace_->vertices(cell);
  std::vector<Rational> weights;
  Rational sum;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    weights.emplace_back(1 + rng.uniformInt(0, 1 << 16));
    sum += weights.back();
  }
  Rational3 point;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Rational share = weights[i] / sum;
    for (std::size_t k = 0; k < 3; ++k) point[k] += share * vertices[i][k];
  }
  if (freeSpace_->locate(ExactPoint(point)) == cell) return point;
  return atCorner(cell, vertices, static_cast<std::size_t>(rng.uniformInt(0, static_cast<int>(vertices.size()) - 1)));
}

// From a corner towards its neighbours together, or away from both if it is reflex, one comes into the facet. The
// lowest corner is convex, so this ends.
Rational3 CellPool::atCorner(CellId cell, const std::vector<Rational3>& cycle, std::size_t first) const {
  for (Rational step(1, 2);; step /= 4) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const Rational3& corner = cycle[(first + i) % cycle.size()];
      const Rational3& before = cycle[(first + i + cycle.size() - 1) % cycle.size()];
      const Rational3& after = cycle[(first + i + 1) % cycle.size()];
      for (const int sign : {1, -1}) {
        Rational3 point = corner;
        for (std::size_t k = 0; k < 3; ++k) point[k] += sign * step * (before[k] + after[k] - 2 * corner[k]);
        if (freeSpace_->locate(ExactPoint(point)) == cell) return point;
      }
    }
  }
}

CellSampler::CellSampler(const ob::StateSpace* space, std::shared_ptr<const FreeSpace> freeSpace, double share)
    : ob::RealVectorStateSampler(space), pool_(std::move(freeSpace)), share_(share) {}

bool CellSampler::drawCell(ob::State* state) {
  if (pool_.empty()) return false;
  auto* exact = static_cast<ExactTranslationSpace::StateType*>(state);
  if (firstPass_ < pool_.pointCount()) {
    exact->setExact(pool_.point(firstPass_++));
  } else if (rng_.uniform01() < share_) {
    exact->setExact(pool_.draw(rng_));
  } else {
    return false;
  }
  return space_->satisfiesBounds(state);
}

bool CellSampler::drawCellNear(ob::State* state, const ob::State* near, double distance) {
  if (pool_.empty() || rng_.uniform01() >= share_) return false;
  auto* exact = static_cast<ExactTranslationSpace::StateType*>(state);
  const Rational3 centre = static_cast<const ExactTranslationSpace::StateType*>(near)->exact();
  constexpr int kTries = 8;
  for (int i = 0; i < kTries; ++i) {
    const Rational3 point = pool_.draw(rng_);
    if (nef::planner::distance(point, centre) > distance) continue;
    exact->setExact(point);
    return space_->satisfiesBounds(state);
  }
  return false;
}

void CellSampler::sampleUniform(ob::State* state) {
  if (!drawCell(state)) ob::RealVectorStateSampler::sampleUniform(state);
}

void CellSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  if (!drawCellNear(state, near, distance)) ob::RealVectorStateSampler::sampleUniformNear(state, near, distance);
}

void CellSampler::sampleGaussian(ob::State* state, const ob::State* mean, double stdDev) {
  if (!drawCellNear(state, mean, 3 * stdDev)) ob::RealVectorStateSampler::sampleGaussian(state, mean, stdDev);
}

CellValidStateSampler::CellValidStateSampler(const ob::SpaceInformation* si, std::shared_ptr<const FreeSpace> freeSpace,
                                             double share)
    : ob::ValidStateSampler(si), sampler_(si->getStateSpace().get(), std::move(freeSpace), share) {
  name_ = "cells";
}

bool CellValidStateSampler::sample(ob::State* state) {
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    sampler_.sampleUniform(state);
    if (si_->isValid(state)) return true;
  }
  return false;
}

bool CellValidStateSampler::sampleNear(ob::State* state, const ob::State* near, double distance) {
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    sampler_.sampleUniformNear(state, near, distance);
    if (si_->isValid(state)) return true;
  }
  return false;
}

}  // namespace nef::planner
