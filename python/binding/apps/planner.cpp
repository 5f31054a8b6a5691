// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._planner.
#include <pybind11/stl.h>

#include "apps/planner/path/question.h"
#include "apps/planner/scene/scene.h"
#include "binding/base/bindings.h"

namespace nef::python {
namespace {

namespace plan = nef::planner;

plan::Scene scene_of(const Polyhedron& robot, const std::vector<Polyhedron>& obstacles,
                     const std::vector<std::string>& names, const py::object& box, bool contact) {
  plan::Scene scene;
  scene.name = "scene";
  scene.robot = robot;
  scene.obstacles = obstacles;
  scene.obstacle_names = names;
  scene.contact = contact ? plan::ContactRule::kAllow : plan::ContactRule::kForbid;
  if (!box.is_none()) {
    const py::sequence corners = box;
    if (corners.size() != 2) throw py::value_error("a box needs two corners");
    scene.box = {to_triple(corners[0], "a corner"), to_triple(corners[1], "a corner")};
  }
  return scene;
}

py::object optional_triple(const std::optional<Rational3>& point) {
  return point ? py::object(from_triple(*point)) : py::none();
}

// A problem whose free space is computed.
class Space {
 public:
  Space(plan::Scene scene, unsigned threads, const py::object& progress) {
    const ProgressFunction told(progress);
    problem_ = call(kSmallCall, [scene = std::move(scene), threads, told](const Monitor& monitor) {
      plan::BuildOptions options;
      options.threads = threads;
      options.progress = [&](const std::string& phase, std::size_t done, std::size_t total) {
        told(monitor, phase, done, total);
      };
      options.monitor = monitor;
      return std::make_shared<const plan::Problem>(scene, options);
    });
  }

  py::dict solve(py::handle start, py::handle goal, const plan::PathOptions& options) const {
    const Rational3 from = to_triple(start, "a start");
    const Rational3 to = to_triple(goal, "a goal");
    const auto problem = problem_;
    return told(call(kSmallCall, [=](const Monitor& monitor) { return problem->solve(from, to, options, monitor); }));
  }

  py::dict check(py::handle points) const {
    const std::vector<Rational3> path = to_points(points, "way-points");
    if (path.empty()) throw py::value_error("a path needs a point");
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
      result["length"] = answer.path->length;
    }
    if (answer.thinness) result["thinness"] = py::make_tuple(answer.thinness->piece, answer.thinness->junction);
    if (answer.collision) result["collision"] = plan::describe(*answer.collision, problem_->scene());
    if (answer.blocked_segment) result["blocked_segment"] = *answer.blocked_segment;
    if (answer.status == plan::Answer::Status::kInfeasible) {
      result["components"] = py::make_tuple(answer.start_component, answer.goal_component);
    }
    result["status"] = status_text(answer.status);
    return result;
  }

  static const char* status_text(plan::Answer::Status status) {
    switch (status) {
      case plan::Answer::Status::kPath:
        return "path";
      case plan::Answer::Status::kInfeasible:
        return "infeasible";
      case plan::Answer::Status::kInvalidStart:
        return "invalid_start";
      case plan::Answer::Status::kInvalidGoal:
        return "invalid_goal";
      case plan::Answer::Status::kBlocked:
        return "blocked";
      case plan::Answer::Status::kNoQuestion:
        break;
    }
    return "free_space";
  }

  std::shared_ptr<const plan::Problem> problem_;
};

plan::PathOptions path_options(bool raw, bool clearance, bool roomy, int min_dimension) {
  plan::PathOptions options;
  options.raw = raw;
  options.clearance = clearance;
  options.roomy = roomy;
  options.min_dimension = min_dimension;
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
      .def_property_readonly("start", [](const plan::Scene& s) { return optional_triple(s.start); })
      .def_property_readonly("goal", [](const plan::Scene& s) { return optional_triple(s.goal); });
  m.def("read", [](const std::string& path) {
    return call(kSmallCall, [path](const Monitor& monitor) { return plan::read_scene(path, monitor); });
  });
  py::class_<Space>(m, "Space")
      .def(py::init<plan::Scene, unsigned, const py::object&>())
      .def("solve", &Space::solve)
      .def("check", &Space::check)
      .def("free", &Space::free)
      .def("passages", &Space::passages)
      .def("components", &Space::components);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_planner, m) { nef::python::define_module(m); }
