// SPDX-License-Identifier: Apache-2.0
//
// Everything needed to plan for a translating robot, in one object.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/planner/ompl/tight_planner.h"
#include "apps/planner/path/question.h"

namespace nef::planner {

/** \brief A SimpleSetup for a robot that translates among obstacles, with the verbs of OMPL.app's
    RigidBodyGeometry and with TightPlanner as its default planner.

    The free space is computed in setup(), or in solve() within the given time. From then on the state validity checker
    and the motion validator are exact, and the state sampler of every planner also draws from tight passages.

    What the user sets counts, at any time: bounds of the state space bound the free space, as those of
    setEnvironmentBounds() do; a state validity checker or motion validator is asked as well (see
    NefStateValidityChecker and TightPlanner for what is exact then). */
class TranslationPlanning : public ompl::geometric::SimpleSetup {
 public:
  TranslationPlanning();
  /** \brief For a problem whose free space is computed already; start and goal are set from its scene. */
  explicit TranslationPlanning(const Problem& problem);

  /** \brief Folders in which mesh files are looked for (the current one first). Returns false if one is missing. */
  bool setMeshPath(const std::vector<std::string>& folders);
  /** \brief The robot's mesh; replaces earlier ones. Returns false, with an error in OMPL's log, if it cannot
      be read. The reference point is the mesh's origin. */
  bool setRobotMesh(const std::string& file);
  /** \brief A further part of the robot. */
  bool addRobotMesh(const std::string& file);
  /** \brief The obstacles' mesh; replaces earlier ones. */
  bool setEnvironmentMesh(const std::string& file);
  bool addEnvironmentMesh(const std::string& file);
  /** \brief Sets instead of meshes. */
  void setRobot(const Polyhedron& robot);
  void addObstacle(const Polyhedron& obstacle);
  /** \brief Takes an obstacle away, by its index in getScene().obstacles; later ones move up. Throws std::out_of_range.
      After a solution, obstacles that come or go change the free space by one operation each, if the robot is solid or
      contact is forbidden; otherwise, and after many changes at once, it is built anew. */
  void removeObstacle(std::size_t index);
  /** \brief Moves an obstacle; it keeps its index. As removeObstacle and addObstacle, in one operation. Throws
      std::out_of_range. */
  void moveObstacle(std::size_t index, const Rational3& by);
  /** \brief As moveObstacle, by any invertible map: a turn, say. Throws InputError for other maps. */
  void moveObstacle(std::size_t index, const AffineMap& map);
  /** \brief May the robot touch obstacles (the default)? */
  void setContact(ContactRule contact);
  /** \brief Bounds of the reference point. Without them it may be anywhere (see inferEnvironmentBounds). */
  void setEnvironmentBounds(const Rational3& low, const Rational3& high);
  /** \brief Bounds for the state space alone, which must have some: they hold all of the configuration space
      obstacle, start and goal with room to spare, so that nothing is lost. Called by setup(). */
  void inferEnvironmentBounds();

  /** \brief Start and goal with exact coordinates. */
  void setExactStartAndGoal(const Rational3& start, const Rational3& goal);

  /** \brief Computes the free space if robot, obstacles or bounds have changed, then as SimpleSetup. */
  void setup() override;
  /** \brief As SimpleSetup. The time counts from the call: if it is up while the free space is built, the status is
      TIMEOUT, and the next call begins that anew. */
  ompl::base::PlannerStatus solve(double time = 1.0) override;
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;

  /** \brief The free space; null before setup(). */
  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }
  /** \brief The default planner, if it is in use. */
  TightPlanner* getTightPlanner() const { return dynamic_cast<TightPlanner*>(planner_.get()); }
  const Scene& getScene() const { return scene_; }
  /** \brief What was done to the meshes. */
  const Messages& getMessages() const { return scene_.messages; }

 private:
  ExactTranslationSpace& space() const;
  std::vector<const ompl::base::State*> endStates() const;
  std::string find(const std::string& file) const;
  bool readMesh(const std::string& file, Polyhedron& into, bool add);
  void useFreeSpace(std::shared_ptr<const FreeSpace> freeSpace);
  void setStateBounds(const ompl::base::RealVectorBounds& bounds);
  void setBox(const Rational3& low, const Rational3& high);
  // True unless something has set bounds on the state space since last time.
  bool boundsAreKnown() const;
  // True if the bounds of the state space are the user's, adopted or not yet.
  bool hasBoundsOfUser() const { return boundsOfUser_ || !boundsAreKnown(); }
  // What the user has set on the state space and the space information since last time.
  void adoptBounds();
  bool noteCheckers();
  // Ours, which ask the user's as well.
  void installCheckers();
  // Builds the free space if there is none, and its roadmap if the planner is to find it there.
  void prepare(const Monitor& monitor);
  // Prepares and then solves; TIMEOUT if the monitor stops the former.
  template <typename Solve>
  ompl::base::PlannerStatus prepareAndSolve(const Monitor& monitor, const Solve& solve);
  void changed();
  // Throws std::out_of_range.
  void requireObstacle(std::size_t index) const;
  // The free positions of the present scene, from those before the changes if these are few.
  Polyhedron presentFreePositions(const Monitor& monitor) const;
  void obstacleChanged(ObstacleChange change);
  struct Before {
    Scene scene;
    Polyhedron free;
  };
  Scene scene_;
  std::optional<Before> before_;         ///< what the free space was built for last
  std::vector<ObstacleChange> changes_;  ///< since then
  std::vector<std::string> folders_;
  std::shared_ptr<const FreeSpace> freeSpace_;
  std::optional<ompl::base::RealVectorBounds> bounds_;  ///< of the state space, when last looked at
  bool boundsOfUser_ = false;
  ompl::base::StateValidityCheckerPtr userChecker_;
  ompl::base::MotionValidatorPtr userValidator_;
};

}  // namespace nef::planner
