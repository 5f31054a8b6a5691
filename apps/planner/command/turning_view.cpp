// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/turning_view.h"

#include <cmath>

#include "apps/planner/command/scene_view.h"
#include "apps/planner/free_space/vectors.h"
#include "apps/planner/path/path.h"

namespace nef::planner {
namespace {

Polyhedron at(const Polyhedron& robot, const Pose& pose, const TurningAxis& axis) {
  AffineMap map = axis.rotation(pose.turn);
  map.translation = pose.position;
  return transform(robot, map);
}

// The distance of the robot's farthest corner from the reference point.
double reach_of(const Polyhedron& robot) {
  double reach = 0;
  const std::array<Rational3, 2> box = *bounding_box(robot);
  for (const Rational3& corner : box) reach = std::max(reach, distance(corner, {}));
  return reach;
}

// The turn from the first pose on as a unit quaternion w x y z. Angles are those of people, whose sum is not taken
// modulo a full turn, so that neighbours are near each other.
std::array<double, 4> quaternion_of(double degrees, const TurningAxis& axis) {
  const Vector3d direction = to_vector(axis.direction()).normalized();
  const double half = degrees * M_PI / 360;
  return {std::cos(half), std::sin(half) * direction[0], std::sin(half) * direction[1], std::sin(half) * direction[2]};
}

view::Motion motion_along(const std::vector<Pose>& path, const Polyhedron& robot, const TurningAxis& axis) {
  std::vector<double> way{0};
  for (const double length : lengths_of(path, robot, axis)) way.push_back(way.back() + length);
  view::Motion motion;
  motion.pivot = to_double(path.front().position);
  const double first = axis.degrees_of(path.front().turn);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && way[i] == way[i - 1]) continue;  // times must increase
    const view::Point here = to_double(path[i].position);
    motion.times.push_back(way.back() > 0 ? kPlaySeconds * way[i] / way.back() : 0);
    motion.offsets.push_back({here[0] - motion.pivot[0], here[1] - motion.pivot[1], here[2] - motion.pivot[2]});
    motion.turns.push_back(quaternion_of(axis.degrees_of(path[i].turn) - first, axis));
  }
  return motion;
}

}  // namespace

std::vector<double> lengths_of(const std::vector<Pose>& path, const Polyhedron& robot, const TurningAxis& axis) {
  const double reach = reach_of(robot);
  std::vector<double> lengths;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double turned = axis.degrees_of(path[i].turn) - axis.degrees_of(path[i - 1].turn);
    lengths.push_back(distance(path[i - 1].position, path[i].position) + std::abs(turned) * M_PI / 180 * reach);
  }
  return lengths;
}

std::vector<view::Layer> turning_layers(const TurningAnswer& answer, const Scene& scene,
                                        const TurningQuestion& question) {
  const Polyhedron ends = unite(make_point(question.start.position), make_point(question.goal.position));
  std::vector<ViewPart> parts{{"robot", at(scene.robot, question.start, question.axis), kRobot},
                              {"robot at the goal", at(scene.robot, question.goal, question.axis), kRobot, 0.3}};
  if (!scene.obstacles.empty()) parts.push_back({"obstacles", unite_all(scene.obstacles), kObstacles, 0.35});
  parts.push_back({answer.path.empty() ? "start and goal" : "path", ends, kPath});
  std::vector<view::Layer> layers = layers_of(parts);
  if (answer.path.size() > 1) {
    layers.front().motion = motion_along(answer.path, scene.robot, question.axis);
    view::Polyline line{"path", {}, kPath};
    for (const Pose& pose : answer.path) line.points.push_back(to_double(pose.position));
    layers.back().lines.push_back(std::move(line));
  }
  return layers;
}

}  // namespace nef::planner
