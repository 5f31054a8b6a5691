// SPDX-License-Identifier: Apache-2.0
//
// A scene and its answer to look at: pages and glTF files in which the robot moves.
#pragma once

#include <string>
#include <vector>

#include "apps/planner/command/report.h"
#include "nef/view/layer.h"

namespace nef::planner {

inline constexpr view::Color kRobot{230, 120, 20};
inline constexpr view::Color kObstacles{130, 140, 155};
inline constexpr view::Color kPath{20, 90, 200};

inline view::Point to_double(const Rational3& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

/// A set with its place in the page.
struct ViewPart {
  std::string name;
  Polyhedron set;
  view::Color color;
  double opacity = 1;
  bool visible = true;
};
/// A layer for each part. Unbounded ones are cut by one box in which the visible ones are large.
std::vector<view::Layer> layers_of(const std::vector<ViewPart>& parts);

/// Layers: the robot (with a motion along the path if there is one, kPlaySeconds long at constant speed; else at the
/// start), the robot at the goal, the obstacles (see-through), the tight passages, the free space (not shown at
/// first), start, goal and the path of the reference point. Parts that are empty are left out.
std::vector<view::Layer> view_layers(const Answer& answer, const Scene& scene, const FreeSpace& free);

inline constexpr double kPlaySeconds = 10;

/// Writes layers by the file's extension: .html a page, .glb a glTF file. Throws InputError for another one, or where
/// the file cannot be written.
void write_view(const std::vector<view::Layer>& layers, const std::string& title, const std::string& file);

/// True for a file that write_view writes.
bool is_view_file(const std::string& file);

}  // namespace nef::planner
