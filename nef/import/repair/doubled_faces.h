// SPDX-License-Identifier: Apache-2.0
//
// Faces that stand twice in a mesh: walls between solids, and copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nef {

/// Decides for the faces of a mesh that stand in the same place (the same corners in the same cyclic order, turned
/// either way) how many of them a solid needs. Two solids that are glued together have a wall of two faces back to
/// back, and the sides of the wall belong to an even number of other faces. A face that was doubled has sides with an
/// odd number of other faces. Doubled faces that share sides are decided together; those which no other face touches
/// (a skin with two sides to each face) are copies.
///
/// Of copies the first stays. Of a wall two stay, and the second is turned against the first if it is not. If
/// `only_opposite`, only faces in places with as many turned one way as the other are decided about: two solids may
/// share a face on the same side.
/// Returns the rings that stay, in order; `kept`, if not null, receives their numbers. `rings` holds corners as indices
/// without repetitions in a row. O(n log n), and for walls inside of blocks O(n) for each layer of solids around them.
std::vector<std::vector<std::uint32_t>> without_copies(std::vector<std::vector<std::uint32_t>> rings,
                                                       std::vector<std::uint32_t>* kept = nullptr,
                                                       bool only_opposite = false);

/// The faces that stand in the place of an earlier one, turned like the first one there; in order. O(n log n).
std::vector<std::uint32_t> repeated(std::vector<std::vector<std::uint32_t>> rings);

/// For each face whether another one stands in the same place. O(n log n).
std::vector<bool> doubled(std::vector<std::vector<std::uint32_t>> rings);

/// How many faces belong to components, connected by sides, in which as many faces stand in each place turned one way
/// as the other: they enclose nothing, as a solid that stands twice in a mesh, once inside out. O(n log n).
std::size_t count_cancelled(std::vector<std::vector<std::uint32_t>> rings);

}  // namespace nef
