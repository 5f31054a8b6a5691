// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/disconnection_proof.h"

#include <algorithm>
#include <ostream>

namespace nef::planner {
namespace {

bool holds(const std::vector<std::uint32_t>& list, std::uint32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

DisconnectionProof::DisconnectionProof(const ompl::base::SpaceInformationPtr& si,
                                       std::shared_ptr<const FreeSpace> freeSpace,
                                       std::vector<std::uint32_t> startComponents,
                                       std::vector<std::uint32_t> goalComponents, int minDimension)
    : ompl::base::SolutionNonExistenceProof(si),
      freeSpace_(std::move(freeSpace)),
      startComponents_(std::move(startComponents)),
      goalComponents_(std::move(goalComponents)),
      minDimension_(minDimension) {}

bool DisconnectionProof::isRestricted() const {
  return std::any_of(startComponents_.begin(), startComponents_.end(),
                     [&](std::uint32_t component) { return holds(goalComponents_, component); });
}

std::vector<std::uint32_t> DisconnectionProof::separatingFacets() const {
  std::vector<std::uint32_t> facets = boundaryFacets(startComponents_.front());
  return facets.empty() ? boundaryFacets(goalComponents_.front()) : facets;
}

std::vector<std::uint32_t> DisconnectionProof::boundaryFacets(std::uint32_t component) const {
  const Complex& c = freeSpace_->complex();
  const CellNumbering& cells = freeSpace_->cells();
  std::vector<std::uint32_t> result;
  for (const FacetId f : c.facets.ids()) {
    const std::array<CellId, 3> around{cells.facet(f), cells.volume(c.facets[f].volume_above),
                                       cells.volume(c.facets[f].volume_below)};
    bool mine = false;
    bool obstacle = false;
    for (const CellId cell : around) {
      if (!freeSpace_->is_free(cell)) {
        obstacle = true;
      } else {
        mine = mine || freeSpace_->component(cell) == component;
      }
    }
    if (mine && obstacle) result.push_back(f.index());
  }
  return result;
}

bool DisconnectionProof::verify() const {
  for (CellId cell = 0; cell < freeSpace_->cells().size(); ++cell) {
    if (!freeSpace_->is_free(cell) || freeSpace_->local_dimension(cell) < minDimension_) continue;
    for (const CellId other : freeSpace_->neighbours(cell)) {
      if (freeSpace_->component(other) != freeSpace_->component(cell)) return false;
    }
  }
  return minDimension_ > 0 || !isRestricted();
}

void DisconnectionProof::print(std::ostream& out) const {
  out << "No path: the free space has " << componentCount() << " components; start in";
  for (const std::uint32_t component : startComponents_) out << ' ' << component;
  out << ", goal in";
  for (const std::uint32_t component : goalComponents_) out << ' ' << component;
  if (isRestricted()) out << ", joined only where it is thinner than dimension " << minDimension_;
  out << ".\n";
}

}  // namespace nef::planner
