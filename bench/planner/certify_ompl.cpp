// SPDX-License-Identifier: Apache-2.0
//
// Do paths that OMPL's planners report as exact collide? Runs one planner on one OMPL.app problem in SE(3), with
// motions checked in several ways, and certifies every path that it finds. Prints one JSON object for each run;
// bench/planner/certify_ompl.py makes a table of many.
//
//   bench_planner_certify_ompl SCENE.cfg [planner, RRTConnect] [runs, 10] [seconds a run, 20] [seed, 1] [checks]
//
// A check says how motions are examined while planning, with a resolution after a colon where it samples:
// `exact:0.01` exact poses, OMPL's samples between them; `fcl:0.01` FCL's poses; `continuous` FCL's poses and its
// conservative advancement between them; `certified` MotionChecker. Robot and obstacles are the same convex pieces and
// triangles for all of them.
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#ifdef BENCH_WITH_FCL
#include <fcl/narrowphase/continuous_collision.h>

#include "bench/planner/fcl_bodies.h"
#endif

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/position_bounds.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"
#include "apps/planner/rigid_ompl/se3_planning.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using nlohmann::json;
using Checker = std::shared_ptr<const MotionChecker>;

#ifdef BENCH_WITH_FCL
fcl::Transform3d transform_of(const ob::State* state) {
  const auto& pose = *state->as<ob::SE3StateSpace::StateType>();
  const ob::SO3StateSpace::StateType& q = pose.rotation();
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  result.translation() = Vector3d(pose.getX(), pose.getY(), pose.getZ());
  return result;
}

class FclStates : public ob::StateValidityChecker {
 public:
  FclStates(const ob::SpaceInformationPtr& si, const MotionChecker& checker)
      : ob::StateValidityChecker(si),
        robot_(fcl_model_of(checker.robot())),
        obstacles_(fcl_model_of(checker.obstacles())) {}
  using ob::StateValidityChecker::isValid;
  bool isValid(const ob::State* state) const override {
    if (!si_->satisfiesBounds(state)) return false;
    return !fcl_collides(*robot_, transform_of(state), *obstacles_);
  }
  [[nodiscard]] bool moves_freely(const ob::State* from, const ob::State* to) const {
    const fcl::ContinuousCollisionRequestd request(100, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                   fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    fcl::ContinuousCollisionResultd result;
    const fcl::Transform3d still = fcl::Transform3d::Identity();
    fcl::continuousCollide(robot_.get(), transform_of(from), transform_of(to), obstacles_.get(), still, still, request,
                           result);
    return !result.is_collide;
  }

 private:
  std::shared_ptr<FclModel> robot_;
  std::shared_ptr<FclModel> obstacles_;
};

class FclMotions : public ob::MotionValidator {
 public:
  FclMotions(const ob::SpaceInformationPtr& si, std::shared_ptr<FclStates> states)
      : ob::MotionValidator(si), states_(std::move(states)) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const bool valid = states_->isValid(to) && states_->moves_freely(from, to);
    ++(valid ? valid_ : invalid_);
    return valid;
  }
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0;
    if (last.first != nullptr) si_->copyState(last.first, from);
    return false;
  }

 private:
  std::shared_ptr<FclStates> states_;
};
#endif

// True if this build knows the check.
bool set_up_checks(og::SimpleSetup& setup, const Checker& checker, const std::string& kind) {
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  if (kind == "exact" || kind == "certified") {
    setup.setStateValidityChecker(std::make_shared<RigidStateValidityChecker>(si, checker));
    if (kind == "certified") si->setMotionValidator(std::make_shared<RigidMotionValidator>(si, checker));
    return true;
  }
#ifdef BENCH_WITH_FCL
  if (kind == "fcl" || kind == "continuous") {
    const auto states = std::make_shared<FclStates>(si, *checker);
    setup.setStateValidityChecker(states);
    if (kind == "continuous") si->setMotionValidator(std::make_shared<FclMotions>(si, states));
    return true;
  }
#endif
  return false;
}

// The box of a scene as OMPL has it, in doubles: start and goal may lie on it.
void round_box(Scene& scene) {
  if (!scene.box) return;
  for (Rational3& corner : *scene.box) {
    for (Rational& x : corner) x = exact_rational(nearest_double(x));
  }
}

ob::ScopedState<> state_of(const ob::StateSpacePtr& space, const RigidPose& pose) {
  ob::ScopedState<> state(space);
  set_pose(pose, state.get());
  return state;
}

json certified(const MotionChecker& checker, og::PathGeometric& path) {
  std::vector<RigidPose> poses;
  for (const ob::State* state : path.getStates()) {
    const std::optional<RigidPose> pose = pose_of(*path.getSpaceInformation()->getStateSpace(), state);
    if (!pose) return {{"status", "not finite"}};
    poses.push_back(*pose);
  }
  const ProcessStopwatch watch;
  const CertifiedPath result = certify(checker, poses);
  json told{{"seconds", watch.seconds()}, {"motions", result.motions.size()}};
  switch (result.status) {
    case MotionVerdict::Status::kFree:
      told["status"] = "free";
      break;
    case MotionVerdict::Status::kUndecided:
      told["status"] = "undecided";
      break;
    case MotionVerdict::Status::kCollides:
      told["status"] = "collides";
      const MotionVerdict& verdict = result.motions[*result.blocked];
      told["motion"] = *result.blocked;
      told["parameter"] = verdict.parameter;
      for (const Rational& x : verdict.pose->position) told["position"].push_back(nearest_double(x));
      for (const Rational& x : verdict.pose->quaternion) told["quaternion"].push_back(nearest_double(x));
      break;
  }
  return told;
}

struct Request {
  std::string planner = "RRTConnect";
  unsigned runs = 10;
  double seconds = 20;
};

void plan(const Scene& scene, const Checker& checker, const Request& request, const std::string& check) {
  const std::string kind = check.substr(0, check.find(':'));
  for (unsigned run = 0; run < request.runs; ++run) {
    const auto space = std::make_shared<ob::SE3StateSpace>();
    space->setBounds(position_bounds(scene));
    og::SimpleSetup setup(space);
    if (!set_up_checks(setup, checker, kind)) return;
    if (kind.size() < check.size()) {
      setup.getSpaceInformation()->setStateValidityCheckingResolution(std::atof(check.c_str() + kind.size() + 1));
    }
    setup.setStartAndGoalStates(state_of(space, {*scene.start, (*scene.quaternions)[0]}),
                                state_of(space, {*scene.goal, (*scene.quaternions)[1]}));
    setup.setPlanner(make_ompl_planner(request.planner, setup.getSpaceInformation()));
    setup.setup();
    json told{{"scene", scene.name}, {"planner", request.planner}, {"check", check}, {"run", run}};
    ProcessStopwatch watch;
    const ob::PlannerStatus status = setup.solve(request.seconds);
    told["seconds"] = watch.lap();
    told["status"] = status.asString();
    told["motions"] = setup.getSpaceInformation()->getCheckedMotionCount();
    told["solved"] = setup.haveExactSolutionPath();
    if (setup.haveExactSolutionPath()) {
      told["raw"] = certified(*checker, setup.getSolutionPath());
      watch.lap();
      setup.simplifySolution();
      told["simplify_seconds"] = watch.lap();
      told["simplified"] = certified(*checker, setup.getSolutionPath());
    }
    std::cout << told.dump() << std::endl;
  }
}

int run(int argc, char** argv) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  if (argc < 2) throw InputError("which .cfg file?");
  Request request;
  if (argc > 2) request.planner = argv[2];
  if (argc > 3) request.runs = static_cast<unsigned>(std::atoi(argv[3]));
  if (argc > 4) request.seconds = std::atof(argv[4]);
  ompl::RNG::setSeed(argc > 5 ? static_cast<unsigned>(std::atoi(argv[5])) : 1);
  Scene scene = with_robot_as_in_its_file(read_scene(argv[1]));
  round_box(scene);
  if (!scene.quaternions || !scene.start || !scene.goal) throw InputError("not a .cfg file of OMPL.app");
  const auto checker = std::make_shared<const MotionChecker>(MotionChecker::of_scene(scene));
  std::istringstream checks(argc > 6 ? argv[6] : "exact:0.01,fcl:0.01,fcl:0.001,continuous,certified");
  for (std::string check; std::getline(checks, check, ',');) plan(scene, checker, request, check);
  return 0;
}

}  // namespace
}  // namespace nef::planner

int main(int argc, char** argv) {
  try {
    return nef::planner::run(argc, argv);
  } catch (const nef::Error& error) {
    std::cerr << "bench_planner_certify_ompl: " << error.what() << '\n';
    return 2;
  }
}
