// SPDX-License-Identifier: Apache-2.0
//
// Why a hull is empty.
#pragma once

#include <vector>

#include "apps/visual_hull/verify/consistency.h"

namespace nef::visual_hull {

/// Sets of views whose cones have no point in common in `box`, confirmed exactly. Smallest ones, at most `most`, where
/// up to four views are enough; else one from which no view can be left out. Empty if all cones have a common point
/// there. The views of a set are in ascending order.
std::vector<std::vector<std::size_t>> views_without_common_point(const std::vector<ComparedView>& views,
                                                                 const WorldBox& box, std::size_t most,
                                                                 const nef::Monitor& monitor);

}  // namespace nef::visual_hull
