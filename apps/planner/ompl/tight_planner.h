// SPDX-License-Identifier: Apache-2.0
//
// The exact planner as an OMPL planner.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <atomic>
#include <functional>
#include <memory>

#include "apps/planner/ompl/disconnection_proof.h"
#include "apps/planner/ompl/exact_translation_space.h"
#include "apps/planner/ompl/own_planners.h"
#include "apps/planner/path/path.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/** \brief Complete planning for a translating robot, through passages of width zero too.

    The free space is a Nef polyhedron; its cells and how they touch are the roadmap (see roadmap.h). A query
    locates start and goal and walks through the cells between them, or proves that there is no way: then the
    status is INFEASIBLE (ABORT before OMPL 1.6, which has no such status) and the problem definition holds a
    DisconnectionProof. There is no time-out while there is an answer; the termination condition is respected
    before and between pairs of start and goal states and, by builders that ask, while the free space is built. A
    proof needs all goal states: while a goal region may give more of them, the search goes on.

    If validity depends on more than the free space (a checker of the user's, see NefStateValidityChecker), the exact
    path is checked against that; if it is rejected, RRTConnect looks for another one in the remaining time, and there
    is no proof for want of a path. A DisconnectionProof holds all the same: further checks only forbid more.

    The free space is built once (by the first solve) and serves all queries. clear() keeps it unless `keep_roadmap` is
    set to 0, which gives single-query times in benchmarks.

    \par External documentation
    P. Hachenberger, Boolean Operations on 3D Selective Nef Complexes, PhD thesis, 2006, sections 1.1 and 10.2;
    D. Halperin, Robust geometric computing in motion, IJRR 2002. */
class TightPlanner : public ompl::base::Planner {
 public:
  /** \brief Computes a free space, at most once per setup. It may throw Interrupted if the monitor stops it. */
  using FreeSpaceBuilder = std::function<std::shared_ptr<const FreeSpace>(const Monitor& monitor)>;

  /** \brief The free space is that of the space information's NefStateValidityChecker, or of its
      ExactTranslationSpace. */
  explicit TightPlanner(const ompl::base::SpaceInformationPtr& si);
  /** \brief The builder is called by solve(), within the time that is given there. */
  TightPlanner(const ompl::base::SpaceInformationPtr& si, FreeSpaceBuilder builder);
  ~TightPlanner() override;

  void setup() override;
  void clear() override;
  void clearQuery() override;
  /** \brief Whether the next free space will be a part of the present one, as when an obstacle comes: then the last way
      answers the first question there if that is the same and the way is free still. */
  void keepWay(bool keep) { keepWay_ = keep; }
  /** \brief Another problem for the same free space; forgets start and goal states, as PRM does. */
  void setProblemDefinition(const ompl::base::ProblemDefinitionPtr& pdef) override;
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  using ompl::base::Planner::solve;
  /** \brief The roadmap: portals and the middles of the zones they join, and the start and goal states of the last
      query. The states belong to the planner and are freed by clear(). */
  void getPlannerData(ompl::base::PlannerData& data) const override;

  /** \brief Only ways where free space is locally at least this thick (0: any; at most 3).
      Throws std::invalid_argument for more than 3 (so params().setParam returns false). */
  void setMinDimension(unsigned int dimension);
  unsigned int getMinDimension() const { return static_cast<unsigned int>(options_.min_dimension); }
  /** \brief Prefer the thickest passages to the shortest path. */
  void setRoomy(bool roomy) { set(options_.roomy, roomy); }
  bool getRoomy() const { return options_.roomy; }
  /** \brief Way-points inside volumes rather than in contact. */
  void setClearance(bool clearance) { set(options_.clearance, clearance); }
  bool getClearance() const { return options_.clearance; }
  /** \brief Look for the shortest of several ways round, as far as affordable, and pull until nothing is gained any
      more; the default, as in the command. Off: the first way found, pulled a few times, mostly in a millisecond or two
      (the command's --quick). */
  void setThorough(bool thorough) { set(options_.thorough, thorough); }
  bool getThorough() const { return options_.thorough; }
  /** \brief Round way-points to so many decimals where the motions stay free; -1: as many as they have.
      Throws std::invalid_argument for other negative numbers or more than 300. `unrounded` of getExactPath() tells
     which way-points have more all the same. */
  void setDigits(int digits) { set(options_.digits, digits_of_parameter(digits)); }
  int getDigits() const { return parameter_of_digits(options_.digits); }
  /** \brief Keep the free space when clear() is called. */
  void setKeepRoadmap(bool keep) { keepRoadmap_ = keep; }
  bool getKeepRoadmap() const { return keepRoadmap_; }

  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }
  /** \brief The last solution with rational way-points. */
  const std::optional<ExactPath>& getExactPath() const { return exactPath_; }
  /** \brief Seconds that the last construction of the free space and its roadmap took. */
  double getPreprocessingTime() const { return preprocessing_; }

 private:
  struct EndPoint {
    Rational3 position;
    CellId cell = kNoCell;
  };
  // Sets an option; the last way answered another question then.
  template <typename Value>
  void set(Value& option, const Value& value) {
    option = value;
    lastWay_.clear();
    knownWay_.clear();
  }
  void declare();
  // Builds the free space, or takes that of the space information, which may have been replaced.
  void updateFreeSpace(const Monitor& monitor);
  void takeStarts();
  // Takes some goals that are not there yet. True if there are no more, and will be none.
  bool takeGoals(const ompl::base::GoalSampleableRegion& region, const ompl::base::PlannerTerminationCondition& ptc);
  // The shortest path from a start to one of the goals from an index on, or of those that could be tried in time.
  std::optional<ExactPath> bestPath(std::size_t firstGoal, const ompl::base::PlannerTerminationCondition& ptc,
                                    bool& interrupted);
  // True if the checks beyond the free space have nothing against the path.
  bool isAccepted(const ExactPath& path) const;
  ompl::base::PlannerStatus searchAnotherWay(const ompl::base::PlannerTerminationCondition& ptc);
  void proveInfeasible();
  EndPoint endPointOf(const ompl::base::State* state) const;
  ompl::base::PlannerDataVertex dataVertex(const Rational3& position) const;
  void freeDataStates();

  FreeSpaceBuilder builder_;
  std::shared_ptr<const FreeSpace> freeSpace_;
  PathOptions options_;
  bool keepRoadmap_ = true;
  bool keepWay_ = false;
  std::vector<Rational3> lastWay_;   // the last answer
  std::vector<Rational3> knownWay_;  // the last one in a free space that held the present one
  // OMPL's benchmark asks for these from a thread of its own while solve() runs.
  std::atomic<double> preprocessing_ = 0;
  std::atomic<std::size_t> freeCells_ = 0;
  std::vector<EndPoint> starts_;
  std::vector<EndPoint> goals_;
  std::optional<ExactPath> exactPath_;
  mutable std::vector<ompl::base::State*> dataStates_;
};

/** \brief A builder for a scene, which must outlive it. Throws InputError if the robot turns: TurningPlanning is for
    these. */
TightPlanner::FreeSpaceBuilder free_space_builder(const Scene& scene);

/** \brief The exact path as an OMPL path whose states keep their rationals. */
std::shared_ptr<ompl::geometric::PathGeometric> toPathGeometric(const ompl::base::SpaceInformationPtr& si,
                                                                const ExactPath& path);

}  // namespace nef::planner
