// SPDX-License-Identifier: Apache-2.0
//
// A robot that turns, to look at.
#pragma once

#include <vector>

#include "apps/planner/turning/turning_search.h"
#include "apps/view/layer.h"

namespace nef::planner {

/// How long each part of a path is, an angle being the way of the robot's farthest corner.
std::vector<double> lengths_of(const std::vector<Pose>& path, const Polyhedron& robot, const TurningAxis& axis);

/// Layers: the robot (with a motion along the path if there is one, kPlaySeconds long, in which its farthest point is
/// about as fast in turns as in translations; else at the start), the robot at the goal, the obstacles (see-through),
/// start, goal and the path of the reference point.
std::vector<view::Layer> turning_layers(const TurningAnswer& answer, const Scene& scene,
                                        const TurningQuestion& question);

}  // namespace nef::planner
