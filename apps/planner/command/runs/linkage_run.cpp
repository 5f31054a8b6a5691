// SPDX-License-Identifier: Apache-2.0
//
// One run: read the robot, the obstacles and the path, certify the path, write the report, pages and glTF files. To be
// shown, a motion is cut into steps of a few degrees, since pages and glTF files move each link straight between the
// times that they are given; links are drawn at the start with rotations rounded to some digits, which no check sees.
#include "apps/planner/command/runs/runs.h"

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "apps/planner/command/findings.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/linkage/linkage_path.h"
#include "apps/planner/linkage_urdf/urdf_robot.h"
#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {
namespace {

using nlohmann::json;
using JointPath = std::vector<std::vector<double>>;

struct LinkageTask {
  UrdfRobot robot;
  Linkage linkage;
  std::vector<Polyhedron> obstacles;
  JointPath path;
};

LinkageTask read_task(const Arguments& a) {
  LinkageTask task;
  a.session.show_phase("reading " + a.linkage);
  task.robot = read_urdf(a.linkage, a.srdf, a.session.mesh);
  Messages messages = task.robot.messages;
  for (const std::string& text : a.obstacles) {
    task.obstacles.push_back(closure(shape_of_text(text, "", a.session.mesh, &messages), a.session.monitor));
  }
  a.session.note_all(messages);
  task.path = read_joint_path(a.given_path, task.robot.joint_names());
  for (std::size_t i = 0; i < task.path.size(); ++i) {
    if (const std::optional<std::string> complaint = task.robot.complaint_about(task.path[i])) {
      throw InputError(a.given_path + ": way-point " + std::to_string(i) + ": " + *complaint);
    }
  }
  task.linkage = task.robot.linkage(a.session.monitor);
  return task;
}

json link_name(const LinkageTask& task, const std::optional<std::size_t>& link) {
  return link ? json(task.robot.links[*link].name) : json();
}

json motion_json(const LinkageTask& task, const LinkageVerdict& verdict, std::size_t i) {
  json result{{"status", status_name(verdict.status)}, {"parts", verdict.cells}};
  if (verdict.status == MotionVerdict::Status::kCollides) {
    const std::vector<double>& to = task.path[std::min(i + 1, task.path.size() - 1)];
    result["collision"] = {{"values", values_at(task.path[i], to, verdict.parameter)},
                           {"parameter", verdict.parameter},
                           {"links", {link_name(task, verdict.link), link_name(task, verdict.other)}}};
  }
  if (verdict.status == MotionVerdict::Status::kUndecided) result["undecided"] = parts_json(verdict.undecided);
  return result;
}

json linkage_json(const LinkageTask& task, const CertifiedLinkagePath& path) {
  json result{{"linkage", task.robot.name}, {"status", status_name(path.status)},
              {"motions", "joints"},        {"joints", task.robot.joint_names()},
              {"path", task.path},          {"verdicts", json::array()}};
  for (std::size_t i = 0; i < path.motions.size(); ++i) {
    result["verdicts"].push_back(motion_json(task, path.motions[i], i));
  }
  if (path.blocked) result["blocked_segment"] = *path.blocked;
  return result;
}

void print(const LinkageTask& task, const CertifiedLinkagePath& path) {
  std::vector<MotionVerdict::Status> motions;
  for (const LinkageVerdict& verdict : path.motions) motions.push_back(verdict.status);
  std::cout << certified_text(path.status, motions);
  if (path.blocked) {
    const json found = motion_json(task, path.motions[*path.blocked], *path.blocked)["collision"];
    std::cout << ": motion " << *path.blocked << ", link " << found["links"][0].get<std::string>() << " collides with "
              << (found["links"][1].is_null() ? "an obstacle" : "link " + found["links"][1].get<std::string>())
              << " at";
    for (const json& value : found["values"]) std::cout << ' ' << value.get<double>();
  }
  std::cout << '\n';
}

// Where a link is: its points are turned, then shifted.
struct LinkPlace {
  Eigen::Quaterniond turn;
  Vector3d shift;
};

LinkPlace place_of(const LinkChain& chain, const std::vector<double>& values) {
  const MotionCell cell = chain.pose({values, values}, 0, 0);
  return {Eigen::Quaterniond(cell.turns[0]).normalized(), cell.positions[0]};
}

AffineMap shown_map(const LinkPlace& place) {
  const auto rounded = [](double x) { return exact_rational(std::ldexp(std::round(std::ldexp(x, 24)), -24)); };
  const Quaternion q{rounded(place.turn.w()), rounded(place.turn.x()), rounded(place.turn.y()),
                     rounded(place.turn.z())};
  return {rotation_between(q, q),
          {exact_rational(place.shift[0]), exact_rational(place.shift[1]), exact_rational(place.shift[2])}};
}

// The path cut into steps in which no joint turns by more than a few degrees; a blocked one ends where it collides.
JointPath shown_steps(const LinkageTask& task, const CertifiedLinkagePath& known) {
  constexpr double kStep = 4 * M_PI / 180;
  constexpr double kMostSteps = 500;  // of one motion
  JointPath path = task.path;
  if (known.blocked && path.size() > 1) {
    const std::size_t i = *known.blocked;
    path[i + 1] = values_at(path[i], path[i + 1], known.motions[i].parameter);
    path.resize(i + 2);
  }
  JointPath steps{path.front()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    double farthest = 0;
    std::size_t value = 0;
    for (std::size_t k = 1; k < task.linkage.links.size(); ++k) {
      const LinkageJoint::Kind kind = task.linkage.links[k].joint.kind;
      if (kind == LinkageJoint::Kind::kRevolute)
        farthest = std::max(farthest, std::fabs(path[i + 1][value] - path[i][value]));
      if (kind != LinkageJoint::Kind::kFixed) ++value;
    }
    const double count = std::clamp(std::ceil(farthest / kStep), 1.0, kMostSteps);
    for (double step = 1; step <= count; ++step) steps.push_back(values_at(path[i], path[i + 1], step / count));
  }
  return steps;
}

// How far the farthest point of a link goes from one step to the next, about.
double way_between(const LinkPlace& a, const LinkPlace& b, double reach) {
  return (b.shift - a.shift).norm() + reach * a.turn.angularDistance(b.turn);
}

std::vector<view::Layer> linkage_layers(const LinkageTask& task, const CertifiedLinkagePath& known) {
  const JointPath steps = shown_steps(task, known);
  std::vector<ShownSet> sets;
  std::vector<std::vector<LinkPlace>> places;  // of each link that is shown, at each step; none if it stays
  std::vector<double> times(steps.size());
  for (std::size_t k = 0; k < task.linkage.links.size(); ++k) {
    const std::optional<Polyhedron>& shape = task.robot.links[k].shape;
    if (!shape || shape->is_empty()) continue;
    const LinkChain chain(task.linkage, 0, k);
    const double reach = task.linkage.links[k].body->nodes().front().reach;
    std::vector<LinkPlace>& at = places.emplace_back();
    for (std::size_t i = 0; i < (chain.is_rigid() ? 1 : steps.size()); ++i) {
      at.push_back(place_of(chain, steps[i]));
      if (i > 0 && at[i].turn.dot(at[i - 1].turn) < 0) at[i].turn.coeffs() *= -1;  // the shorter arc
      if (i > 0) times[i] = std::max(times[i], way_between(at[i - 1], at[i], reach));
    }
    sets.push_back({task.robot.links[k].name, transform(*shape, shown_map(at.front())), kRobotColor});
    if (chain.is_rigid()) at.clear();
  }
  if (Polyhedron obstacles = unite_all(task.obstacles); !obstacles.is_empty()) {
    sets.push_back({"obstacles", std::move(obstacles), kObstaclesColor, kObstaclesOpacity});
  }
  for (std::size_t i = 1; i < times.size(); ++i) times[i] += times[i - 1];
  std::vector<view::Layer> layers = layers_of(sets);
  if (times.back() == 0) return layers;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::vector<LinkPlace>& at = places[k];
    if (at.empty()) continue;
    view::Motion& motion = layers[k].motion;
    motion.pivot = {at[0].shift[0], at[0].shift[1], at[0].shift[2]};
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i > 0 && times[i] == times[i - 1]) continue;  // times must increase
      const Vector3d offset = at[i].shift - at[0].shift;
      const Eigen::Quaterniond turn = at[i].turn * at[0].turn.conjugate();
      motion.times.push_back(kPlaySeconds * times[i] / times.back());
      motion.offsets.push_back({offset[0], offset[1], offset[2]});
      motion.turns.push_back({turn.w(), turn.x(), turn.y(), turn.z()});
    }
  }
  return layers;
}

}  // namespace

int run_linkage(const Arguments& a, const TimeLimit& limit) {
  const Stopwatch watch;
  const LinkageTask task = read_task(a);
  std::vector<RigidBody> obstacles;
  for (const Polyhedron& obstacle : task.obstacles) {
    if (!obstacle.is_empty()) obstacles.push_back(RigidBody::of_set(obstacle, limit.monitor()));
  }
  const LinkageChecker checker(task.linkage, RigidBody::together(obstacles));
  const double setup_s = watch.seconds();
  CertifiedLinkagePath path;
  try {
    path = certify(checker, task.path, {}, limit.monitor());
  } catch (const Interrupted&) {
    path.status = MotionVerdict::Status::kUndecided;
  }
  tell(a, {"linkage",
           task.robot.name,
           [&] { return linkage_json(task, path); },
           {{"setup", setup_s, {}}, {"op", watch.seconds() - setup_s, {}}},
           [&] { print(task, path); },
           nullptr,
           [&] { return linkage_layers(task, path); }});
  return certified_exit_code(path.status);
}

}  // namespace nef::planner
