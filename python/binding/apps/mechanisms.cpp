// SPDX-License-Identifier: Apache-2.0
//
// The part of the extension module nef._planner that nef.mechanisms is made of: verdicts on parts, ranges of motion,
// linkages. It gives tuples, which Python makes into the public classes.
#include <pybind11/stl.h>

#include "apps/planner/linkage/linkage_path.h"
#include "apps/planner/linkage_urdf/urdf_robot.h"
#include "apps/planner/mechanism/range_of_motion.h"
#include "apps/planner/verdict/verdict.h"
#include "binding/apps/planner.h"
#include "binding/base/bindings.h"
#include "binding/base/mesh_options.h"

namespace nef::python {
namespace {

namespace plan = nef::planner;

// (a, b, contact, squared, distance, on_a, on_b, items, overlap); the overlap is (region, box, volume, error, exact).
py::tuple told(const plan::PairVerdict& pair) {
  py::object items = py::none();
  if (pair.touching) items = py::make_tuple((*pair.touching)[0], (*pair.touching)[1]);
  py::object overlap = py::none();
  if (pair.interference) {
    const plan::Interference& found = *pair.interference;
    overlap = py::make_tuple(found.region, py::make_tuple(from_triple(found.box[0]), from_triple(found.box[1])),
                             found.volume.value, found.volume.error,
                             found.exact_volume ? to_fraction(*found.exact_volume) : py::none());
  }
  return py::make_tuple(pair.a, pair.b, std::string(contact_name(pair.distance.contact)),
                        to_fraction(pair.distance.squared), pair.distance.value(), from_triple(pair.distance.on_a),
                        from_triple(pair.distance.on_b), items, overlap);
}

// (status, direction, dimension, rays, stops); a stop is (part, normals).
py::tuple told(const plan::PartVerdict& part) {
  py::list rays;
  for (const Integer3& ray : part.first.rays) rays.append(from_triple(ray));
  return py::make_tuple(plan::status_name(part.status),
                        part.direction ? py::object(from_triple(*part.direction)) : py::none(), part.first.dimension,
                        rays, stops_of(part.first.stops));
}

// (pairs, parts)
py::tuple verdict(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts, bool exact) {
  const plan::Assembly assembly = assembly_of(names, parts);
  const plan::PartsVerdict found = call(items(parts), [assembly, exact](const Monitor& monitor) {
    return plan::verdict(closed(assembly, monitor), {exact, monitor});
  });
  py::list pairs;
  for (const plan::PairVerdict& pair : found.pairs) pairs.append(told(pair));
  py::list judged;
  for (const plan::PartVerdict& part : found.parts) judged.append(told(part));
  return py::make_tuple(pairs, judged);
}

// (names, parts, messages) of a file.
py::tuple read_parts(const std::string& path) {
  const plan::Assembly assembly = call(kSmallCall, [path](const Monitor&) { return plan::read_assembly(path); });
  const py::object axis = assembly.turning_axis ? py::object(from_triple(*assembly.turning_axis)) : py::none();
  return py::make_tuple(assembly.names, assembly.parts, assembly.messages, assembly.turns_freely, axis);
}

// (measure, lower, upper, stops); the bounds are equal if the value is rational. A stop is (item, part, item of it).
py::tuple told(const plan::RangeEnd& end, const plan::Mechanism& m) {
  constexpr unsigned kBits = 60;
  const std::array<Rational, 2> around = end.between ? *end.between : plan::enclosure(end.value, kBits);
  py::list stops;
  for (const plan::ContactPair& stop : end.stops) stops.append(py::make_tuple(stop.moving, stop.fixed, stop.of_fixed));
  return py::make_tuple(m.joint.measure_of(around[0]), to_fraction(around[0]), to_fraction(around[1]), stops);
}

// A list of (status, start, end).
py::list range_of(const plan::Mechanism& mechanism) {
  const plan::RangeOfMotion range =
      call(kSmallCall, [mechanism](const Monitor& monitor) { return plan::range_of_motion(mechanism, monitor); });
  py::list result;
  for (const plan::RangePart& part : range.parts) {
    result.append(py::make_tuple(plan::status_name(part.status), told(part.from, mechanism), told(part.to, mechanism)));
  }
  return result;
}

// The joint is ("hinge", axis, point), ("slider", direction), ("screw", axis, point, pitch) or ("four-bar", axis, pivot
// of the crank, pivot of the rocker, pin of the crank, pin of the rocker, whether the rocker moves the part).
py::list range_of_motion(const Polyhedron& moving, const std::vector<Polyhedron>& fixed, const py::tuple& joint,
                         py::handle low, py::handle high) {
  plan::Mechanism m;
  m.moving = moving;
  m.fixed = fixed;
  m.fixed_names.resize(fixed.size());
  const auto kind = joint[0].cast<std::string>();
  const Rational3 direction = to_triple(joint[1], "an axis or direction");
  if (kind == "slider") {
    m.joint = plan::Joint::slider(direction);
  } else if (kind == "hinge") {
    m.joint = plan::Joint::hinge(direction, to_triple(joint[2], "a point"));
  } else if (kind == "four-bar") {
    const auto point = [&](std::size_t i) { return to_triple(joint[i], "a point"); };
    using Link = plan::FourBar::Link;
    m.joint = plan::Joint::four_bar(direction, {point(2), point(3)}, {point(4), point(5)},
                                    joint[6].cast<bool>() ? Link::kRocker : Link::kCoupler);
  } else {
    m.joint = plan::Joint::screw(direction, to_triple(joint[2], "a point"), to_rational(joint[3]));
  }
  m.low = m.joint.value_of(to_rational(low));
  m.high = m.joint.value_of(to_rational(high));
  if (m.low > m.high) throw InputError("a range goes from low to high");
  for (const Polyhedron& part : m.fixed) {
    if (part.is_empty() || !part.is_bounded() || !part.is_regular())
      throw InputError("fixed parts must be bounded solids");
  }
  if (moving.is_empty() || !moving.is_bounded() || !moving.is_regular()) {
    throw InputError("the moving part must be a bounded solid");
  }
  return range_of(m);
}

// (range, names of the fixed parts, messages) of a file.
py::tuple range_of_file(const std::string& path) {
  const plan::Mechanism m = call(kSmallCall, [path](const Monitor&) { return plan::read_mechanism(path); });
  return py::make_tuple(range_of(m), m.fixed_names, m.messages);
}

using Triple = std::array<double, 3>;

// Links are (name, body or None, kind, parent, shift, turn, axis).
std::shared_ptr<plan::LinkageChecker> linkage_checker(const py::list& links,
                                                      const std::vector<std::array<std::size_t, 2>>& allowed,
                                                      const std::vector<Polyhedron>& obstacles) {
  plan::Linkage linkage;
  linkage.allowed = allowed;
  std::vector<std::optional<Polyhedron>> bodies;
  for (const py::handle item : links) {
    const auto values = item.cast<py::tuple>();
    plan::Link& link = linkage.links.emplace_back();
    link.name = values[0].cast<std::string>();
    bodies.push_back(values[1].cast<std::optional<Polyhedron>>());
    const auto kind = values[2].cast<std::string>();
    link.joint.kind = kind == "revolute"    ? plan::LinkageJoint::Kind::kRevolute
                      : kind == "prismatic" ? plan::LinkageJoint::Kind::kPrismatic
                                            : plan::LinkageJoint::Kind::kFixed;
    link.joint.parent = values[3].cast<std::size_t>();
    link.joint.shift = plan::to_vector(values[4].cast<Triple>());
    link.joint.turn = values[5].cast<std::array<double, 4>>();
    link.joint.axis = plan::to_vector(values[6].cast<Triple>());
  }
  return call(kSmallCall, [=](const Monitor& monitor) mutable {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i]) linkage.links[i].body = plan::RigidBody::of_set(*bodies[i], monitor);
    }
    std::vector<plan::RigidBody> around;
    for (const Polyhedron& obstacle : obstacles) around.push_back(plan::RigidBody::of_set(obstacle, monitor));
    return std::make_shared<plan::LinkageChecker>(linkage, plan::RigidBody::together(around));
  });
}

// (status, parameter, link, other link or None, undecided parts)
py::tuple told(const plan::LinkageVerdict& found) {
  return py::make_tuple(plan::status_name(found.status), found.parameter, found.link, found.other, found.undecided);
}

// The verdict on one motion, as above.
py::tuple check_linkage(const std::shared_ptr<plan::LinkageChecker>& checker, const std::vector<double>& from,
                        const std::vector<double>& to) {
  const std::size_t dimension = checker->linkage().dimension();
  if (from.size() != dimension || to.size() != dimension) {
    throw InputError("the linkage has " + std::to_string(dimension) + " joints with a value, not " +
                     std::to_string(std::max(from.size(), to.size())));
  }
  return told(call(kSmallCall, [=](const Monitor& monitor) {
    return from == to ? checker->check(from) : checker->check(from, to, {}, monitor);
  }));
}

// (status, verdicts on motions, the first motion that collides or None).
py::tuple certify_linkage(const std::shared_ptr<plan::LinkageChecker>& checker,
                          const std::vector<std::vector<double>>& path, const std::optional<double>& seconds,
                          const py::object& progress) {
  const ProgressFunction listener(progress);
  const plan::CertifiedLinkagePath found = call(kSmallCall, [=](const Monitor& monitor) {
    return certified_in_time<plan::CertifiedLinkagePath>(
        seconds, listener, monitor, [&](const Monitor& limited) { return plan::certify(*checker, path, {}, limited); });
  });
  py::list motions;
  for (const plan::LinkageVerdict& verdict : found.motions) motions.append(told(verdict));
  return py::make_tuple(plan::status_name(found.status), motions, found.blocked);
}

std::vector<std::vector<double>> read_joint_path(const std::string& file, const std::vector<std::string>& joints) {
  return call(kSmallCall, [=](const Monitor&) { return plan::read_joint_path(file, joints); });
}

// (links, allowed, messages); a link is (name, body, kind, parent, shift, turn, axis, joint, lower, upper,
// continuous).
py::tuple read_urdf(const std::string& file, const std::string& srdf, const std::string& crossings, py::handle close) {
  MeshOptions meshes = mesh_options(crossings, close);
  const plan::UrdfRobot robot = call(kSmallCall, [=](const Monitor& monitor) mutable {
    meshes.monitor = monitor;
    return plan::read_urdf(file, srdf, meshes);
  });
  const auto floats = [](const plan::Vector3d& v) { return py::make_tuple(v[0], v[1], v[2]); };
  py::list links;
  for (const plan::UrdfLink& link : robot.links) {
    using Kind = plan::LinkageJoint::Kind;
    const plan::LinkageJoint& joint = link.joint;
    const char* kind = joint.kind == Kind::kRevolute    ? "revolute"
                       : joint.kind == Kind::kPrismatic ? "prismatic"
                                                        : "fixed";
    const std::array<double, 4>& q = joint.turn;
    links.append(py::make_tuple(link.name, link.shape, kind, joint.parent, floats(joint.shift),
                                py::make_tuple(q[0], q[1], q[2], q[3]), floats(joint.axis), link.joint_name, link.lower,
                                link.upper, link.continuous));
  }
  return py::make_tuple(links, robot.allowed, robot.messages);
}

}  // namespace

void bind_mechanisms(py::module_& m) {
  m.def("verdict", &verdict);
  m.def("read_parts", &read_parts);
  m.def("range_of_motion", &range_of_motion);
  m.def("range_of_file", &range_of_file);
  m.def("read_urdf", &read_urdf);
  m.def("read_joint_path", &read_joint_path);
  m.def("reads_urdf", &plan::reads_urdf);
  py::class_<plan::LinkageChecker, std::shared_ptr<plan::LinkageChecker>>(m, "LinkageChecker")
      .def(py::init(&linkage_checker))
      .def("check", &check_linkage)
      .def("certify", &certify_linkage)
      .def_property_readonly("dimension", [](const plan::LinkageChecker& c) { return c.linkage().dimension(); });
}

}  // namespace nef::python
