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

// The turn from the first pose on as a unit quaternion w x y z. Angles are those of people, whose sum is not taken
// modulo a full turn, so that neighbours are near each other.
std::array<double, 4> quaternion_of(double degrees, const TurningAxis& axis) {
  const Vector3d direction = to_vector(axis.direction()).normalized();
  const double half = degrees * M_PI / 360;
  return {std::cos(half), std::sin(half) * direction[0], std::sin(half) * direction[1], std::sin(half) * direction[2]};
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
  std::vector<ShownSet> parts{{"robot", at(scene.robot, question.start, question.axis), kRobot},
                              {"robot at the goal", at(scene.robot, question.goal, question.axis), kRobot, 0.3}};
  if (!scene.obstacles.empty()) parts.push_back({"obstacles", unite_all(scene.obstacles), kObstacles, 0.35});
  parts.push_back({answer.path.empty() ? "start and goal" : "path", ends, kPath});
  std::vector<view::Layer> layers = layers_of(parts);
  std::vector<Rational3> points;
  for (const Pose& pose : answer.path) points.push_back(pose.position);
  const auto turn = [&](std::size_t i) {
    const double first = question.axis.degrees_of(answer.path.front().turn);
    return quaternion_of(question.axis.degrees_of(answer.path[i].turn) - first, question.axis);
  };
  move_along(points, lengths_of(answer.path, scene.robot, question.axis), turn, layers);
  return layers;
}

}  // namespace nef::planner
