// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._planner. It gives the package nef.planner tuples and dictionaries, which make the public
// classes in Python; so scenes, problems and proofs are bound here with as little as that package needs.
#include <pybind11/stl.h>

#include "apps/planner/clearance/widest_robot.h"
#include "apps/planner/no_path/turning_barrier.h"
#include "apps/planner/path/question.h"
#include "apps/planner/proofs/make/answer_proof.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_search.h"
#include "binding/apps/planner.h"
#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "binding/base/mesh_options.h"

namespace nef::python {
namespace {

namespace plan = nef::planner;

// (axis, low, high, start, goal), angles in degrees.
plan::AxisRotation rotation_of(const py::tuple& values) {
  plan::AxisRotation rotation;
  rotation.axis = to_triple(values[0], "an axis");
  rotation.low = to_rational(values[1]);
  rotation.high = to_rational(values[2]);
  rotation.start = to_rational(values[3]);
  rotation.goal = to_rational(values[4]);
  return rotation;
}

py::object told(const std::optional<plan::AxisRotation>& rotation) {
  if (!rotation) return py::none();
  return py::make_tuple(from_triple(rotation->axis), to_fraction(rotation->low), to_fraction(rotation->high),
                        to_fraction(rotation->start), to_fraction(rotation->goal));
}

plan::Scene scene_of(const Polyhedron& robot, const std::vector<Polyhedron>& obstacles,
                     const std::vector<std::string>& names, const py::object& box, bool contact,
                     const py::object& rotation) {
  plan::Scene scene;
  scene.name = "scene";
  scene.robot = robot;
  scene.obstacles = obstacles;
  scene.obstacle_names = names;
  scene.contact = contact ? plan::ContactRule::kAllow : plan::ContactRule::kForbid;
  if (py::isinstance<py::str>(rotation)) {  // "SO(3)"
    scene.turns_freely = true;
    scene.quaternions = {{{1, 0, 0, 0}, {1, 0, 0, 0}}};
  } else if (!rotation.is_none()) {
    scene.rotation = rotation_of(rotation);
  }
  if (!box.is_none()) scene.box = to_corners(box);
  return scene;
}

py::tuple told(const plan::RigidPose& pose) {
  py::list quaternion;
  for (const Rational& x : pose.quaternion) quaternion.append(to_fraction(x));
  return py::make_tuple(from_triple(pose.position), py::tuple(quaternion));
}

// Of ((x, y, z), (w, x, y, z)).
plan::RigidPose pose_of(py::handle item) {
  const auto pair = item.cast<py::sequence>();
  if (pair.size() != 2) throw InputError("a pose is a position and a quaternion");
  const py::sequence quaternion = pair[1];
  if (quaternion.size() != 4) throw InputError("a quaternion has four numbers: w, x, y, z");
  plan::RigidPose pose{to_triple(pair[0], "a position"), {}};
  for (std::size_t k = 0; k < 4; ++k) pose.quaternion[k] = to_rational(quaternion[k]);
  if (pose.quaternion == plan::Quaternion{}) throw InputError("a rotation's quaternion must not be zero");
  return pose;
}

// Start (0) or goal (1): None, a position, or of a robot that turns freely (position, quaternion).
py::object end_of(const plan::Scene& scene, std::size_t end) {
  const std::optional<Rational3>& position = end == 0 ? scene.start : scene.goal;
  if (!position) return py::none();
  if (!scene.turns_freely) return from_triple(*position);
  return told(plan::RigidPose{*position, (*scene.quaternions)[end]});
}

// What a start or goal that is not free hits; None if both are free. Without any free space.
py::object invalid_end(const plan::Scene& scene, py::handle start, py::handle goal) {
  const Rational3 from = to_triple(start, "a start");
  const Rational3 to = to_triple(goal, "a goal");
  const std::optional<plan::Answer> answer =
      call(kSmallCall, [=](const Monitor& monitor) { return plan::Problem::invalid_end(scene, from, to, monitor); });
  if (!answer) return py::none();
  py::dict result;
  result["status"] = plan::status_name(answer->status);
  result["collision"] = plan::describe(*answer->collision, scene);
  return result;
}

// A proof about a robot that turns, with what it is about.
struct TurningProofOfScene {
  plan::Scene scene;
  plan::TurningQuestion question;
  plan::TurningProof proof;

  [[nodiscard]] py::object complaint() const {
    const std::optional<std::string> found = call(kSmallCall, [self = *this](const Monitor& monitor) {
      return plan::complaint_about(self.proof, self.scene, self.question, monitor);
    });
    return found ? py::object(py::str(*found)) : py::none();
  }
  // The text of the same proof as a file; None if there is none.
  [[nodiscard]] py::object text() const {
    const std::optional<plan::PathProof> found = call(kSmallCall, [self = *this](const Monitor& monitor) {
      return plan::make_turning_proof(self.scene, self.proof, monitor);
    });
    return found ? py::object(py::str(plan::proof_text(*found))) : py::none();
  }
  [[nodiscard]] std::size_t cells() const { return proof.cells.size(); }
};

// A question about a robot that turns; the scene says where it starts and how it is turned there.
py::dict solve_turning(const plan::Scene& scene, std::size_t max_cells, const std::optional<double>& seconds,
                       const std::optional<unsigned>& digits) {
  plan::TurningLimits limits;
  limits.max_cells = max_cells;
  if (digits) limits.digits = *digits;
  const plan::TurningQuestion question = plan::question_of(scene);
  plan::TurningAnswer answer = call(kSmallCall, [=](const Monitor& monitor) {
    const TimeLimit limit(seconds, monitor);
    return plan::find_turning_path(scene, question, limits, limit.monitor());
  });
  py::dict result;
  result["status"] = plan::status_name(answer.status);
  py::list points;
  py::list turns;
  py::list degrees;
  for (const plan::Pose& pose : answer.path) {
    points.append(from_triple(pose.position));
    py::list quaternion;
    for (const Rational& x : question.axis.quaternion(pose.turn)) quaternion.append(to_fraction(x));
    turns.append(py::tuple(quaternion));
    degrees.append(question.axis.degrees_of(pose.turn));
  }
  if (!answer.path.empty()) {
    result["points"] = points;
    result["turns"] = turns;
    result["degrees"] = degrees;
    result["unrounded"] = answer.unrounded;
  }
  py::list open;
  for (const plan::TurnRange& range : answer.open_ranges) {
    open.append(py::make_tuple(question.axis.degrees_of(range.low), question.axis.degrees_of(range.high)));
  }
  result["open_ranges"] = open;
  if (answer.collision) result["collision"] = plan::describe(*answer.collision, scene);
  if (answer.proof) result["proof"] = TurningProofOfScene{scene, question, std::move(*answer.proof)};
  return result;
}

// A question about a robot that turns freely, from the start of the scene to its goal.
py::dict solve_rigid(const plan::Scene& scene, const std::optional<std::size_t>& max_cells,
                     const std::optional<double>& seconds) {
  const auto limits = plan::RigidLimits::of(max_cells, seconds.has_value());
  const plan::RigidAnswer answer = call(kSmallCall, [=](const Monitor& monitor) {
    const TimeLimit limit(seconds, monitor);
    const auto checker = plan::MotionChecker::of_scene(scene, monitor);
    plan::RigidAnswer found = plan::find_rigid_path(scene, checker, limits, limit.monitor());
    monitor.check_interruption();
    return found;
  });
  py::dict result;
  result["status"] = plan::status_name(answer.status);
  py::list points;
  py::list turns;
  for (const plan::RigidPose& pose : answer.path) {
    const py::tuple both = told(pose);
    points.append(both[0]);
    turns.append(both[1]);
  }
  if (!answer.path.empty()) {
    result["points"] = points;
    result["turns"] = turns;
  }
  result["samples"] = answer.samples;
  result["slices"] = answer.slices;
  result["boxes"] = answer.boxes;
  result["reference_in_question"] = from_triple(answer.in_question.reference);
  result["boxes_in_question"] = answer.in_question.boxes;
  if (answer.proof) result["proof_text"] = plan::proof_text(*answer.proof);
  if (answer.collision) result["collision"] = plan::describe(*answer.collision, scene);
  return result;
}

// The scene with another start and goal: three numbers, or four if the robot turns about an axis, or (position,
// quaternion) if it turns freely.
plan::Scene with_ends(const plan::Scene& scene, const py::object& start, const py::object& goal) {
  plan::Scene result = scene;
  if (scene.turns_freely) {
    const auto take_pose = [&](const py::object& end, std::size_t which, std::optional<Rational3>& position) {
      if (end.is_none()) return;
      const plan::RigidPose pose = pose_of(end);
      position = pose.position;
      (*result.quaternions)[which] = pose.quaternion;
    };
    take_pose(start, 0, result.start);
    take_pose(goal, 1, result.goal);
    return result;
  }
  const auto take = [&](const py::object& end, const char* what, std::optional<Rational3>& position,
                        Rational* degrees) {
    if (end.is_none()) return;
    const py::list numbers(end);
    if (degrees != nullptr && numbers.size() == 4) *degrees = to_rational(numbers[3]);
    position = to_triple(degrees != nullptr && numbers.size() == 4
                             ? py::object(py::make_tuple(numbers[0], numbers[1], numbers[2]))
                             : end,
                         what);
  };
  Rational* const no_angle = nullptr;
  take(start, "a start", result.start, result.rotation ? &result.rotation->start : no_angle);
  take(goal, "a goal", result.goal, result.rotation ? &result.rotation->goal : no_angle);
  return result;
}

// The scene of a larger robot (planner --keep-clear).
plan::Scene kept_clear(const plan::Scene& scene, py::handle distance) {
  const Rational d = to_rational(distance);
  return call(kSmallCall, [scene = scene, d](const Monitor& monitor) mutable {
    plan::keep_clear(scene, d, monitor);
    return scene;
  });
}

// (low, high, undecided, the robot of the size low) for a scene with its ends.
py::tuple widest(const plan::Scene& scene, bool box, py::handle precision, std::size_t max_cells,
                 const std::optional<double>& seconds) {
  const plan::WidestLimits limits{to_rational(precision), max_cells, seconds};
  const auto growth = box ? plan::Growth::kBox : plan::Growth::kScale;
  const auto found = call(kSmallCall, [scene = scene, growth, limits](const Monitor& monitor) mutable {
    plan::Widest interval = plan::widest_robot(scene, growth, limits, monitor);
    return std::pair(std::move(interval), scene.robot);
  });
  const auto bound = [](const std::optional<Rational>& size) { return size ? to_fraction(*size) : py::none(); };
  return py::make_tuple(bound(found.first.low), bound(found.first.high), found.first.undecided, found.second);
}

// The number of a motion, and the parameter and the pose at which it collides.
py::object collision_of(const plan::CertifiedPath& path) {
  if (!path.blocked) return py::none();
  const plan::MotionVerdict& verdict = path.motions[*path.blocked];
  return py::make_tuple(*path.blocked, verdict.parameter, told(*verdict.pose));
}

// The poses in a file (planner --path); None if no pose is turned, unless any will do.
py::object read_poses(const std::string& path, bool any) {
  const std::vector<plan::RigidPose> poses = call(kSmallCall, [path](const Monitor&) { return plan::read_path(path); });
  if (!any && std::none_of(poses.begin(), poses.end(), plan::is_turned)) return py::none();
  py::list result;
  for (const plan::RigidPose& pose : poses) result.append(told(pose));
  return result;
}

// Poses of a list of ((x, y, z), (w, x, y, z)).
std::vector<plan::RigidPose> poses_of(const py::sequence& path) {
  std::vector<plan::RigidPose> poses;
  for (const py::handle item : path) {
    poses.push_back(pose_of(item));
  }
  if (poses.empty()) throw InputError("a path needs a pose");
  return poses;
}

// (status, collision, undecided motions, touching motions) of such a path.
py::tuple certify(const plan::Scene& scene, const py::sequence& path, const std::optional<double>& seconds,
                  const py::object& progress) {
  const std::vector<plan::RigidPose> poses = poses_of(path);
  const ProgressFunction told(progress);
  const plan::CertifiedPath found = call(kSmallCall, [=](const Monitor& monitor) {
    const auto checker = plan::MotionChecker::of_scene(plan::with_robot_as_in_its_file(scene, monitor), monitor);
    return certified_in_time<plan::CertifiedPath>(seconds, told, monitor, [&](const Monitor& limited) {
      return plan::certify(checker, poses, plan::MotionTiming::kSlerp, {}, limited);
    });
  });
  using Status = plan::MotionVerdict::Status;
  py::list undecided;
  py::list touching;
  for (std::size_t i = 0; i < found.motions.size(); ++i) {
    if (found.motions[i].status == Status::kUndecided) undecided.append(i);
    if (found.motions[i].status == Status::kFree && found.motions[i].touches) touching.append(i);
  }
  return py::make_tuple(plan::status_name(found.status), collision_of(found), undecided, touching);
}

// The text of the proof of what is known of such a path; None if that is undecided.
py::object prove_path(const plan::Scene& scene, const py::sequence& path) {
  const std::vector<plan::RigidPose> poses = poses_of(path);
  const std::optional<plan::PathProof> proof = call(kSmallCall, [scene, poses](const Monitor& monitor) {
    const auto checker = plan::MotionChecker::of_scene(plan::with_robot_as_in_its_file(scene, monitor), monitor);
    return plan::make_path_proof(checker, poses, monitor);
  });
  return proof ? py::object(py::str(plan::proof_text(*proof))) : py::none();
}

// What is wrong with the text of a proof, by itself and as one about a scene; None if it holds.
py::object complaint_about(const plan::Scene& scene, const std::string& text) {
  const plan::PathProof proof = plan::parse_proof(text, "the proof");
  const std::optional<std::string> found = call(kSmallCall, [scene, proof](const Monitor& monitor) {
    const std::optional<std::string> complaint = plan::complaint_about(proof, monitor);
    return complaint ? complaint : plan::complaint_about(proof.claim, scene, monitor);
  });
  return found ? py::object(py::str(*found)) : py::none();
}

// A problem whose free space is computed.
class Space {
 public:
  // Not built if it takes longer than so many seconds.
  Space(plan::Scene scene, unsigned threads, const py::object& progress, const std::optional<double>& seconds) {
    const ProgressFunction told(progress);
    problem_ = call(kSmallCall, [scene = std::move(scene), threads, told, seconds](const Monitor& monitor) {
      const TimeLimit limit(seconds, monitor.on_threads(threads));
      const nef::ProgressFunction tell = told_by(told, monitor);
      try {
        return std::make_shared<const plan::Problem>(scene, limit.monitor().telling(tell));
      } catch (const Interrupted&) {
        monitor.check_interruption();
        return std::shared_ptr<const plan::Problem>();
      }
    });
  }

  [[nodiscard]] bool built() const { return problem_ != nullptr; }

  py::dict solve(py::handle start, py::handle goal, const plan::PathOptions& options,
                 const std::optional<double>& seconds) const {
    const Rational3 from = to_triple(start, "a start");
    const Rational3 to = to_triple(goal, "a goal");
    const auto problem = problem_;
    return told(call(kSmallCall, [=](const Monitor& monitor) {
      const TimeLimit limit(seconds, monitor);
      try {
        return problem->solve(from, to, options, limit.monitor());
      } catch (const Interrupted&) {
        monitor.check_interruption();
        plan::Answer answer;
        answer.status = plan::Answer::Status::kUndecided;
        return answer;
      }
    }));
  }

  // The text of the proof that there is a path, or none, or that start or goal collides.
  std::string prove(py::handle start, py::handle goal) const {
    const Rational3 from = to_triple(start, "a start");
    const Rational3 to = to_triple(goal, "a goal");
    return plan::proof_text(call(kSmallCall, [=, problem = problem_](const Monitor& monitor) {
      plan::Scene scene = problem->scene();
      scene.start = from;
      scene.goal = to;
      return plan::proof_of_answer(scene, &problem->free_space(), problem->solve(from, to, {}, monitor), {}, monitor);
    }));
  }

  // The text of the proof that the tight passages are tight.
  std::string prove_tight() const {
    return plan::proof_text(call(kSmallCall, [problem = problem_](const Monitor& monitor) {
      return plan::proof_of_tight_passages(problem->scene(), problem->free_space(), monitor);
    }));
  }

  py::dict check(py::handle points) const {
    const std::vector<Rational3> path = to_points(points, "way-points");
    if (path.empty()) throw InputError("a path needs a point");
    const auto problem = problem_;
    return told(call(kSmallCall, [=](const Monitor& monitor) { return problem->check(path, monitor); }));
  }

  [[nodiscard]] Polyhedron free() const { return problem_->free_space().set(); }
  // For each tight passage (dimension, component, cells, mouths), a cell being (name, dimension, vertices).
  [[nodiscard]] py::list passages() const {
    const plan::FreeSpace& free = problem_->free_space();
    py::list result;
    for (const plan::TightPassage& passage : free.passages()) {
      result.append(py::make_tuple(passage.dimension, passage.component, told(passage.cells), told(passage.mouths)));
    }
    return result;
  }

  // For each component of free space (dimension, bounded, cells).
  [[nodiscard]] py::list components() const {
    py::list result;
    for (const plan::Component& component : problem_->free_space().components()) {
      result.append(py::make_tuple(component.dimension, component.bounded, component.cells));
    }
    return result;
  }

 private:
  [[nodiscard]] py::list told(const std::vector<plan::CellId>& cells) const {
    const plan::FreeSpace& free = problem_->free_space();
    py::list result;
    for (const plan::CellId cell : cells) {
      py::list vertices;
      for (const Rational3& vertex : free.vertices(cell)) vertices.append(from_triple(vertex));
      result.append(py::make_tuple(free.name(cell), free.cells().dimension(cell), vertices));
    }
    return result;
  }

  [[nodiscard]] py::dict told(const plan::Answer& answer) const {
    py::dict result;
    if (answer.path) {
      py::list points;
      for (const Rational3& p : answer.path->points) points.append(from_triple(p));
      result["points"] = points;
      result["segment_dimensions"] = answer.path->segment_dimensions;
      result["passages"] = answer.path->passages;
      result["unrounded"] = answer.path->unrounded;
      result["length"] = answer.path->length;
    }
    if (answer.thinness) result["thinness"] = py::make_tuple(answer.thinness->piece, answer.thinness->junction);
    if (answer.collision) result["collision"] = plan::describe(*answer.collision, problem_->scene());
    if (answer.blocked_segment) result["blocked_segment"] = *answer.blocked_segment;
    if (answer.status == plan::Answer::Status::kInfeasible) {
      result["components"] = py::make_tuple(answer.start_component, answer.goal_component);
    }
    result["status"] = plan::status_name(answer.status);
    return result;
  }

  std::shared_ptr<const plan::Problem> problem_;
};

plan::PathOptions path_options(bool raw, bool clearance, bool roomy, int min_dimension, bool quick,
                               const std::optional<unsigned>& digits) {
  plan::PathOptions options;
  options.raw = raw;
  options.clearance = clearance;
  options.roomy = roomy;
  options.min_dimension = min_dimension;
  options.thorough = !quick;
  if (digits) options.digits = *digits;
  return options;
}

void define_module(py::module_& m) {
  m.doc() = "The core of the package nef.planner; see there.";
  py::module_::import("nef._nef");
  py::class_<plan::PathOptions>(m, "PathOptions").def(py::init(&path_options));
  py::class_<plan::Scene>(m, "Scene")
      .def(py::init(&scene_of))
      .def_readonly("robot", &plan::Scene::robot)
      .def_readonly("obstacles", &plan::Scene::obstacles)
      .def_readonly("names", &plan::Scene::obstacle_names)
      .def_readonly("messages", &plan::Scene::messages)
      .def_property_readonly("contact", [](const plan::Scene& s) { return s.contact == plan::ContactRule::kAllow; })
      .def_property_readonly("box",
                             [](const plan::Scene& s) -> py::object {
                               if (!s.box) return py::none();
                               return py::make_tuple(from_triple((*s.box)[0]), from_triple((*s.box)[1]));
                             })
      .def_property_readonly("rotation", [](const plan::Scene& s) { return told(s.rotation); })
      .def("with_ends", &with_ends)
      .def("kept_clear", &kept_clear)
      .def("widest", &widest)
      .def("invalid_end", &invalid_end)
      .def("certify", &certify)
      .def("prove_path", &prove_path)
      .def("complaint", &complaint_about)
      .def_property_readonly("turns_freely", [](const plan::Scene& s) { return s.turns_freely; })
      .def_property_readonly("start", [](const plan::Scene& s) { return end_of(s, 0); })
      .def_property_readonly("goal", [](const plan::Scene& s) { return end_of(s, 1); });
  m.def("read", [](const std::string& path, const std::string& crossings, py::handle close, bool turn_freely) {
    MeshOptions meshes = mesh_options(crossings, close);
    return call(kSmallCall, [=](const Monitor& monitor) mutable {
      meshes.monitor = monitor;
      return turn_freely ? plan::freely_turning_scene(path, meshes) : plan::read_scene(path, meshes);
    });
  });
  py::class_<TurningProofOfScene>(m, "TurningProof")
      .def("complaint", &TurningProofOfScene::complaint)
      .def("text", &TurningProofOfScene::text)
      .def_property_readonly("cells", &TurningProofOfScene::cells);
  m.def("read_poses", &read_poses);
  m.def("solve_turning", &solve_turning);
  m.def("solve_rigid", &solve_rigid);
  py::class_<Space>(m, "Space")
      .def(py::init<plan::Scene, unsigned, const py::object&, const std::optional<double>&>())
      .def_property_readonly("built", &Space::built)
      .def("solve", &Space::solve)
      .def("check", &Space::check)
      .def("prove", &Space::prove)
      .def("prove_tight", &Space::prove_tight)
      .def("free", &Space::free)
      .def("passages", &Space::passages)
      .def("components", &Space::components);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_planner, m) {
  nef::python::define_module(m);
  nef::python::bind_mechanisms(m);
  nef::python::bind_assemblies(m);
  nef::python::explain_arguments(m);
}
