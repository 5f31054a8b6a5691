// SPDX-License-Identifier: Apache-2.0
//
// Everything needed to plan for a translating robot, in one object.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/planner/question.h"
#include "apps/planner/tight_planner.h"

namespace nef::planner {

/** \brief A SimpleSetup for a robot that translates among obstacles, with the verbs of OMPL.app's
    RigidBodyGeometry and with TightPlanner as its default planner.

    The free space is computed in setup(). From then on the state validity checker and the motion validator
    are exact, and the state sampler of every planner also draws from tight passages. */
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
  void changed();

  Scene scene_;
  std::vector<std::string> folders_;
  std::shared_ptr<const FreeSpace> freeSpace_;
};

}  // namespace nef::planner
