// SPDX-License-Identifier: Apache-2.0
//
// Charts of orientations that need no search, since the robot looks there as it does in another chart.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// How the boxes of one chart of all rotations become those of another one. Let u be a half turn about a coordinate
/// axis through the reference point that takes the robot's pieces onto each other. Then the robot is the same at the
/// orientations q and q u, but for the numbers of its pieces, and q u goes through one chart when q goes through
/// another one.
struct ChartImage {
  std::uint32_t of = 0;                    ///< the chart of q; it is no image itself
  std::array<std::uint32_t, 3> becomes{};  ///< for each parameter of q the one of q u that it is,
  std::array<int, 3> signs{1, 1, 1};       ///< multiplied by this
  std::vector<std::uint32_t> pieces;       ///< for each piece of the robot at q the one that is there at q u
};

/// For each chart of `orientations`, which must be all rotations, what it is an image of; nothing if it is none. Half
/// turns count if they take the set of pieces of the claim's robot onto itself, and, if the claim has a box, the
/// robot's origin, too. O(pieces^2 vertices log(vertices)).
std::vector<std::optional<ChartImage>> images_of_charts(const PathProof::Claim& claim, const Orientations& orientations,
                                                        const Rational3& reference, const Monitor& monitor = {});

/// The box of poses in a chart that a box in the chart of `image.of` becomes, with all that is below it.
PathProof::PoseCell image_of(const PathProof::PoseCell& cell, const ChartImage& image, const Monitor& monitor = {});

}  // namespace nef::planner
