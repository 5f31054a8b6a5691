// SPDX-License-Identifier: Apache-2.0
//
// How an assembly comes apart, to look at.
#pragma once

#include <vector>

#include "apps/planner/assembly/disassembly.h"
#include "apps/view/layer.h"

namespace nef::planner {

/// Each part in a layer of its own, which plays all of its motions. A step takes the same time as any other, along its
/// way at constant speed.
std::vector<view::Layer> assembly_layers(const Disassembly& answer, const Assembly& assembly);

}  // namespace nef::planner
