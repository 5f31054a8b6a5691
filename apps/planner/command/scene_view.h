// SPDX-License-Identifier: Apache-2.0
//
// A scene and its answer to look at: pages and glTF files in which the robot moves.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/path/answer.h"
#include "apps/view/layer.h"
#include "nef/construct/construct.h"

namespace nef::planner {

/// Colours of layers.
inline constexpr view::Color kRobotColor{230, 120, 20};
inline constexpr view::Color kObstaclesColor{130, 140, 155};
/// How see-through obstacles are.
inline constexpr double kObstaclesOpacity = 0.35;

/// How long a motion plays.
inline constexpr double kPlaySeconds = 10;

/// A set with its place in the page.
struct ShownSet {
  std::string name;
  Polyhedron set;
  view::Color color;
  double opacity = 1;
  bool visible = true;
};
/// A layer for each part. Unbounded ones are cut by one box in which the visible ones are large.
std::vector<view::Layer> layers_of(const std::vector<ShownSet>& parts);

/// Layers: the robot as `start` places it (as it is without), the robot at the goal, the obstacles (see-through), the
/// tight passages and the free space (not shown at first) if `free` is not null, and last the reference points of both
/// ends, by the name of a path if there is one. Parts that are empty are left out.
std::vector<view::Layer> scene_layers(const Scene& scene, const std::optional<AffineMap>& start,
                                      const std::optional<AffineMap>& goal, bool has_path, const FreeSpace* free);

/// The turn at a way-point, from the first one on: a unit quaternion w x y z.
using TurnAt = std::function<std::array<double, 4>(std::size_t)>;
/// Lets the first layer move along a path of several points, kPlaySeconds long, and draws the path in the last one. The
/// time between two points is proportional to its entry in `lengths`.
void move_along(const std::vector<Rational3>& points, const std::vector<double>& lengths, const TurnAt& turn,
                std::vector<view::Layer>& layers);

/// The layers of an answer about translations, in which the robot moves at constant speed.
std::vector<view::Layer> view_layers(const Answer& answer, const Scene& scene, const FreeSpace* free);

}  // namespace nef::planner
