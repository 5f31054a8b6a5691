// SPDX-License-Identifier: Apache-2.0
//
// Where two convex pieces touch, and cones of directions: what proofs about first motions are made of.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "apps/planner/assembly/contact_cones.h"
#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Two convex pieces with a point in common, and the directions in which the first one overlaps the second one as soon
/// as it moves: those inside of the cone that the vectors from the point to the second one's vertices and from the
/// first one's vertices to the point span.
struct BlockingContact {
  CommonPoint common;  ///< robot: of the first piece, obstacle: of the second one
  OpenCone blocked;    ///< not empty
};

/// How two pieces touch; nothing if they have no common point, overlap, or block no direction. A linear program if
/// their boxes touch (common_point.h), and O(n^3) for n vertices.
std::optional<BlockingContact> contact_of_pieces(std::span<const Rational3> first, std::span<const Rational3> second);

/// Three vectors, and all sums of multiples of them that are not negative.
using ConeCorners = std::array<Rational3, 3>;

/// When a search through cones gives up: after so many halvings of one, or with so many cones.
inline constexpr unsigned kMostHalvings = 30;
inline constexpr std::size_t kMostCones = 50000;

/// The edge (from corner k to the next one) whose ends turn away from each other most.
std::size_t widest_edge(const ConeCorners& corners);

/// The cone with the sum of the ends of an edge in place of one of these.
ConeCorners half_cone(const ConeCorners& corners, std::size_t edge, std::size_t replaced);

}  // namespace nef::planner
