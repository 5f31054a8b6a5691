// SPDX-License-Identifier: Apache-2.0
//
// Why there is no path.
#pragma once

#include <ompl/base/SolutionNonExistenceProof.h>

#include <iosfwd>
#include <memory>
#include <vector>

#include "apps/planner/free_space/free_space.h"

namespace nef::planner {

/** \brief Start and goal lie in different components of the exact free space.

    The components are connected sets of cells of a Nef complex whose incidences are known exactly, so this
    is a proof and not a failed search. If planning was restricted (min_dimension), the components are those
    of the restricted space. */
class DisconnectionProof : public ompl::base::SolutionNonExistenceProof {
 public:
  DisconnectionProof(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace,
                     std::vector<std::uint32_t> startComponents, std::vector<std::uint32_t> goalComponents,
                     int minDimension);

  /** \brief Components that hold start states (goal states); none is in both unless isRestricted(). */
  const std::vector<std::uint32_t>& startComponents() const { return startComponents_; }
  const std::vector<std::uint32_t>& goalComponents() const { return goalComponents_; }
  std::size_t componentCount() const { return freeSpace_->components().size(); }
  /** \brief True if thinner passages, which were not wanted, would join them. */
  bool isRestricted() const;

  /** \brief The facets between the first start component and the configuration space obstacle; between the
      first goal component and it, if the start component has none (it is a mere edge, say). */
  std::vector<std::uint32_t> separatingFacets() const;

  /** \brief Checks the proof anew from the cells: no free cell of a start component touches one of another. */
  bool verify() const;

  void print(std::ostream& out) const;

 private:
  std::vector<std::uint32_t> boundaryFacets(std::uint32_t component) const;

  std::shared_ptr<const FreeSpace> freeSpace_;
  std::vector<std::uint32_t> startComponents_;
  std::vector<std::uint32_t> goalComponents_;
  int minDimension_;
};

}  // namespace nef::planner
