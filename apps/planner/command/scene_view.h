// SPDX-License-Identifier: Apache-2.0
//
// A scene and its answer to look at: pages and glTF files in which the robot moves.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/command/report.h"
#include "apps/view/layer.h"

namespace nef::planner {

inline constexpr view::Color kRobot{230, 120, 20};
inline constexpr view::Color kObstacles{130, 140, 155};
inline constexpr view::Color kPath{20, 90, 200};

inline view::Point to_double(const Rational3& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

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

/// The turn at a way-point, from the first one on: a unit quaternion w x y z.
using TurnAt = std::function<std::array<double, 4>(std::size_t)>;
/// Lets the first layer move along a path of several points, kPlaySeconds long, and draws the path in the last one. The
/// time between two points is proportional to its entry in `lengths`.
void move_along(const std::vector<Rational3>& points, const std::vector<double>& lengths, const TurnAt& turn,
                std::vector<view::Layer>& layers);

/// Layers: the robot (with a motion along the path if there is one, kPlaySeconds long at constant speed; else at the
/// start), the robot at the goal, the obstacles (see-through), the tight passages, the free space (not shown at
/// first), start, goal and the path of the reference point. Parts that are empty are left out.
std::vector<view::Layer> view_layers(const Answer& answer, const Scene& scene, const FreeSpace& free);

inline constexpr double kPlaySeconds = 10;

/// True for a file to look at: a page (.html) or a glTF file (.glb).
bool is_view_file(const std::string& file);

/// Writes the files that were asked for: those to look at from layers, which are made once if there is any, others from
/// text(file), unless that is nothing. Throws InputError where a file cannot be written.
void write_outputs(const Arguments& a, const std::string& title,
                   const std::function<std::optional<std::string>(const std::string& file)>& text,
                   const std::function<std::vector<view::Layer>()>& layers);

}  // namespace nef::planner
