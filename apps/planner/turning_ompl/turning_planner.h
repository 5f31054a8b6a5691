// SPDX-License-Identifier: Apache-2.0
//
// The search over cells of angles as an OMPL planner.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/SolutionNonExistenceProof.h>

#include <atomic>
#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>

#include "apps/planner/ompl/own_planners.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/planner/turning_ompl/turning_space.h"

namespace nef::planner {

/** \brief No path at any angle of the range: start and goal are apart in the graph of inner robots. */
class TurningImpossibility : public ompl::base::SolutionNonExistenceProof {
 public:
  TurningImpossibility(const ompl::base::SpaceInformationPtr& si, Scene scene, TurningQuestion question,
                       TurningProof proof);
  const TurningProof& proof() const { return proof_; }
  /** \brief Checks the proof by other means than it was found (see complaint_about). Takes about as long. */
  bool verify() const;
  void print(std::ostream& out) const;

 private:
  Scene scene_;
  TurningQuestion question_;
  TurningProof proof_;
};

/** \brief Paths of a robot that translates and turns about one axis, or proofs that there are none.

    One start and one goal state of the problem definition are taken. EXACT_SOLUTION: a path of translations at fixed
    turns and turns in place, all proved free. INFEASIBLE (ABORT before OMPL 1.6): the problem definition holds a
    TurningImpossibility. TIMEOUT: the termination condition or `max_cells` was reached; contact that must be kept while
    turning is never decided. */
class TurningPlanner : public ompl::base::Planner {
 public:
  /** \brief The space of `si` must be a TurningSpace about the question's axis; of the question only the range counts.
   */
  TurningPlanner(const ompl::base::SpaceInformationPtr& si, Scene scene, TurningQuestion question);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  using ompl::base::Planner::solve;
  void clear() override;

  /** \brief Cells that the range is cut into at most. */
  void setMaxCells(unsigned int cells) { maxCells_ = cells; }
  unsigned int getMaxCells() const { return maxCells_; }
  /** \brief Round way-points to so many decimals where the motions stay free; -1: as many as they have. As
      TightPlanner::setDigits. */
  void setDigits(int digits) { digits_ = digits_of_parameter(digits); }
  int getDigits() const { return parameter_of_digits(digits_); }
  /** \brief What the last search found. */
  const std::optional<TurningAnswer>& getAnswer() const { return answer_; }

 private:
  Scene scene_;
  TurningQuestion question_;
  unsigned int maxCells_ = 2000;
  std::optional<unsigned> digits_;
  std::optional<TurningAnswer> answer_;
  std::atomic<std::size_t> cells_ = 0;  // of the answer; OMPL's benchmark asks from a thread of its own during solve()
};

}  // namespace nef::planner
