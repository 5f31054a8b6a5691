// SPDX-License-Identifier: Apache-2.0
//
// urdfdom parses the file and checks that links form a tree, which is walked from the root. It follows nested elements
// by recursion, so the document is looked at first. An SRDF file is XML of which only one element counts. Without
// urdfdom only the refusal is compiled.
#include "apps/planner/linkage_urdf/urdf_robot.h"

#include "nef/base/error.h"
#include "nef/io/number_text.h"

#ifdef PLANNER_WITH_URDF
#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/shapes.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/formats/xml_events.h"
#endif

namespace nef::planner {

Linkage UrdfRobot::linkage(const Monitor& monitor) const {
  Linkage result;
  result.allowed = allowed;
  for (const UrdfLink& link : links) {
    std::optional<RigidBody> body;
    if (link.shape) body = RigidBody::of_set(*link.shape, monitor);
    result.links.push_back({link.name, std::move(body), link.joint});
  }
  return result;
}

std::vector<std::string> UrdfRobot::joint_names() const {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < links.size(); ++i) {
    if (links[i].joint.kind != LinkageJoint::Kind::kFixed) names.push_back(links[i].joint_name);
  }
  return names;
}

std::optional<std::string> UrdfRobot::complaint_about(std::span<const double> values) const {
  std::size_t number = 0;
  for (std::size_t i = 1; i < links.size(); ++i) {
    const UrdfLink& link = links[i];
    if (link.joint.kind == LinkageJoint::Kind::kFixed) continue;
    const double value = values[number++];
    if (link.continuous || (link.lower <= value && value <= link.upper)) continue;
    std::string text = "the value ";
    append_number(text, value);
    text += " of joint '" + link.joint_name + "' is not within its limits, ";
    append_number(text, link.lower);
    text += " to ";
    append_number(text, link.upper);
    return text;
  }
  return std::nullopt;
}

#ifndef PLANNER_WITH_URDF

bool reads_urdf() { return false; }

UrdfRobot read_urdf(const std::string& file, const std::string& srdf, const MeshOptions& meshes) {
  static_cast<void>(srdf);
  static_cast<void>(meshes);
  throw InputError(file +
                   ": this build does not read URDF files: install urdfdom (Debian: liburdfdom-dev) and build again");
}

#else

namespace {

// The last complaint of urdfdom, which else goes to the console. There is one console for the whole process, so one
// file is parsed at a time.
class UrdfComplaints : public console_bridge::OutputHandler {
 public:
  UrdfComplaints() : alone_(mutex()) { console_bridge::useOutputHandler(this); }
  ~UrdfComplaints() override { console_bridge::restorePreviousOutputHandler(); }
  UrdfComplaints(const UrdfComplaints&) = delete;
  UrdfComplaints& operator=(const UrdfComplaints&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) last = text.substr(0, text.find('\n'));
  }

  std::string last = "it contains no robot";

 private:
  static std::mutex& mutex() {
    static std::mutex result;
    return result;
  }

  std::lock_guard<std::mutex> alone_;
};

// Throws FileError or InputError unless the text is well-formed XML without a document type, of few levels and not too
// many links: urdfdom and the walk over the links would take a stack of any depth.
void check_document(const std::string& file, const std::string& text) {
  constexpr std::size_t kMostLevels = 64;
  constexpr std::size_t kMostLinks = 10'000;
  std::size_t level = 0;
  std::size_t links = 0;
  std::optional<XmlEvents> events;
  events.emplace(
      file,
      [&](const XmlElement& element) {
        if (++level > kMostLevels) {
          throw InputError(events->place() + ": elements are nested more than " + std::to_string(kMostLevels) +
                           " deep");
        }
        if (element.name == "link" && ++links > kMostLinks) {
          throw InputError(events->place() + ": there are more than " + std::to_string(kMostLinks) + " links");
        }
      },
      [&](const std::string&) { --level; });
  events->parse(text, true);
}

class UrdfReader {
 public:
  UrdfReader(std::string file, MeshOptions meshes) : file_(std::move(file)), meshes_(meshes) {}

  UrdfRobot read() {
    const std::string text = read_file(file_);
    check_document(file_, text);
    urdf::ModelInterfaceSharedPtr model;
    {
      UrdfComplaints complaints;
      try {
        model = urdf::parseURDF(text);
      } catch (const std::exception& error) {
        complaints.last = error.what();
      }
      if (!model || !model->getRoot()) throw InputError(file_ + ": not a URDF file: " + complaints.last);
    }
    robot_.name = model->getName();
    add(*model->getRoot(), 0);
    return std::move(robot_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_ + ": " + what); }

  void add(const urdf::Link& link, std::size_t parent) {
    const std::size_t number = robot_.links.size();
    UrdfLink& made = robot_.links.emplace_back();
    made.name = link.name;
    if (link.parent_joint) take_joint(*link.parent_joint, parent, made);
    made.shape = shape_of(link);
    for (const urdf::LinkSharedPtr& child : link.child_links) add(*child, number);
  }

  void take_joint(const urdf::Joint& joint, std::size_t parent, UrdfLink& made) const {
    const std::string where = "joint " + in_quotes(joint.name);
    if (joint.mimic) fail(where + " mimics another one, which is not supported: give it a value of its own");
    made.joint_name = joint.name;
    made.joint.parent = parent;
    const urdf::Pose& origin = joint.parent_to_joint_origin_transform;
    made.joint.shift = vector_of(origin.position, where);
    made.joint.turn = turn_of(origin.rotation, where);
    switch (joint.type) {
      case urdf::Joint::FIXED:
        return;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::PRISMATIC:
        if (!joint.limits) fail(where + " has no limits");
        made.lower = joint.limits->lower;
        made.upper = joint.limits->upper;
        break;
      case urdf::Joint::CONTINUOUS:
        made.lower = -M_PI;
        made.upper = M_PI;
        made.continuous = true;
        break;
      default:
        fail(where + " is neither fixed, revolute, continuous nor prismatic");
    }
    if (!(made.lower <= made.upper && std::isfinite(made.lower) && std::isfinite(made.upper))) {
      fail(where + ": limits must be finite, and lower not above upper");
    }
    made.joint.axis = vector_of(joint.axis, where);
    if (made.joint.axis.isZero(0)) fail(where + ": its axis is the zero vector");
    made.joint.kind =
        joint.type == urdf::Joint::PRISMATIC ? LinkageJoint::Kind::kPrismatic : LinkageJoint::Kind::kRevolute;
  }

  [[nodiscard]] Vector3d vector_of(const urdf::Vector3& v, const std::string& where) const {
    Vector3d result(v.x, v.y, v.z);
    if (!result.allFinite()) fail(where + ": a coordinate is not finite");
    return result;
  }

  [[nodiscard]] std::array<double, 4> turn_of(const urdf::Rotation& r, const std::string& where) const {
    const std::array<double, 4> result{r.w, r.x, r.y, r.z};
    for (const double x : result) {
      if (!std::isfinite(x)) fail(where + ": an angle is not finite");
    }
    if (result == std::array<double, 4>{}) fail(where + ": its rotation is zero");
    return result;
  }

  std::optional<Polyhedron> shape_of(const urdf::Link& link) {
    std::optional<Polyhedron> result;
    for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
      const std::string where = "the collision geometry of link " + in_quotes(link.name);
      if (!collision->geometry) fail(where + " is empty");
      Polyhedron part =
          transform(geometry_of(*collision->geometry, where), map_of(collision->origin, where), meshes_.monitor);
      result = result ? unite(*result, part, meshes_.monitor) : std::move(part);
    }
    return result;
  }

  [[nodiscard]] AffineMap map_of(const urdf::Pose& origin, const std::string& where) const {
    const std::array<double, 4> turn = turn_of(origin.rotation, where);
    const Quaternion q{exact_rational(turn[0]), exact_rational(turn[1]), exact_rational(turn[2]),
                       exact_rational(turn[3])};
    const Vector3d shift = vector_of(origin.position, where);
    return {rotation_between(q, q), {exact_rational(shift[0]), exact_rational(shift[1]), exact_rational(shift[2])}};
  }

  Polyhedron geometry_of(const urdf::Geometry& geometry, const std::string& where) {
    if (geometry.type == urdf::Geometry::BOX) {
      const Vector3d size = vector_of(dynamic_cast<const urdf::Box&>(geometry).dim, where);
      if (!(size.minCoeff() > 0)) fail(where + ": the sizes of a box must be positive");
      const Rational3 half{exact_rational(size[0]) / 2, exact_rational(size[1]) / 2, exact_rational(size[2]) / 2};
      return make_box({-half[0], -half[1], -half[2]}, half);
    }
    if (geometry.type != urdf::Geometry::MESH) {
      fail(where + " is a sphere or a cylinder: give it a box, or a mesh that encloses it");
    }
    const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
    const Vector3d scale = vector_of(mesh.scale, where);
    if ((scale.array() == 0).any()) fail(where + ": a scale is zero");
    const AffineMap map =
        AffineMap::scale({exact_rational(scale[0]), exact_rational(scale[1]), exact_rational(scale[2])});
    const Polyhedron set = read_shape_file(place_of(mesh.filename, where), meshes_, &robot_.messages);
    if (set.is_empty() || !set.is_bounded()) fail(where + " is empty or unbounded");
    return transform(closure(set, meshes_.monitor), map, meshes_.monitor);
  }

  [[nodiscard]] std::string place_of(const std::string& name, const std::string& where) const {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(file_).lexically_normal().parent_path();
    const auto after = [&](const std::string& prefix) -> std::optional<std::string> {
      if (name.rfind(prefix, 0) != 0) return std::nullopt;
      return name.substr(prefix.size());
    };
    if (const auto path = after("file://")) return *path;
    const auto in_package = after("package://");
    if (!in_package) return (folder / name).string();
    const std::size_t slash = in_package->find('/');
    if (slash == std::string::npos) fail(where + ": " + in_quotes(name) + " names no file");
    const std::string package = in_package->substr(0, slash);
    const std::string path = in_package->substr(slash + 1);
    for (fs::path at = folder;; at = at.parent_path()) {
      if (at.filename() == package && fs::exists(at / path)) return (at / path).string();
      if (fs::exists(at / package / path)) return (at / package / path).string();
      if (at == at.parent_path()) break;
    }
    fail(where + ": " + in_quotes(name) + " is in no folder " + in_quotes(package) + " beside the file or above it");
  }

  std::string file_;
  MeshOptions meshes_;
  UrdfRobot robot_;
};

std::vector<std::array<std::size_t, 2> > read_allowed(const std::string& file, const UrdfRobot& robot) {
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < robot.links.size(); ++i) numbers[robot.links[i].name] = i;
  std::vector<std::array<std::size_t, 2> > result;
  std::optional<XmlEvents> events;
  const auto number_of = [&](const XmlElement& element, const char* attribute) {
    const std::string* name = element.find(attribute);
    if (name == nullptr) throw InputError(events->place() + ": disable_collisions has no " + attribute);
    const auto found = numbers.find(*name);
    if (found == numbers.end()) throw InputError(events->place() + ": the robot has no link " + in_quotes(*name));
    return found->second;
  };
  events.emplace(
      file,
      [&](const XmlElement& element) {
        if (element.name != "disable_collisions") return;
        result.push_back({number_of(element, "link1"), number_of(element, "link2")});
      },
      [](const std::string&) {});
  events->parse(read_file(file), true);
  return result;
}

}  // namespace

bool reads_urdf() { return true; }

UrdfRobot read_urdf(const std::string& file, const std::string& srdf, const MeshOptions& meshes) {
  UrdfRobot robot = UrdfReader(file, meshes).read();
  if (!srdf.empty()) robot.allowed = read_allowed(srdf, robot);
  return robot;
}

#endif

}  // namespace nef::planner
