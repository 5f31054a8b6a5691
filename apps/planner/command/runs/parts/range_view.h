// SPDX-License-Identifier: Apache-2.0
//
// A mechanism in its range of motion, to look at.
#pragma once

#include <vector>

#include "apps/planner/mechanism/range_of_motion.h"
#include "apps/view/layer.h"

namespace nef::planner {

/// The moving part, and each of the others (see-through). The moving part plays the longest stretch of its range in
/// which nothing collides, at constant speed of the joint; without one it stays where its file has it.
std::vector<view::Layer> range_layers(const RangeOfMotion& range, const Mechanism& mechanism);

}  // namespace nef::planner
