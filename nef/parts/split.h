// SPDX-License-Identifier: Apache-2.0
//
// One set taken apart into its pieces.
#pragma once

#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

/// The connected components of a set, as a point set: what touches in a single point of the set is one component, what
/// only comes near (two open cubes on both sides of a facet that is not in the set) is two. Their union is the set, and
/// none meets the closure of another. Labels are kept; every label but 0 counts as in the set. In the order of the
/// first volume, facet, edge or vertex of each in a.complex(); none for the empty set.
/// O(n log n) for n items in all, beside the planes, which are copied for each component that has few of them.
std::vector<Polyhedron> split(const Polyhedron& a, const Monitor& monitor = {});

/// The connected component of a set that holds a point, empty if the set does not hold it; without a point, the
/// component of what lies beyond all finite points (empty for bounded sets; for sets that leave the finite by several
/// ways, all of these). Connected means: by paths within the set, passages of dimension 1 and 0 included. O(n log n).
Polyhedron component_of(const Polyhedron& a, const std::optional<Rational3>& point, const Monitor& monitor = {});

/// For each volume (connected open region) of the set, in the order of a.complex().volumes: the volume and what the
/// set has of its boundary. Two cubes that touch in an edge are one component, but two of these; parts of the set that
/// bound no volume of it (walls and wires) are in none of them. A vertex, edge or facet between two volumes of the set
/// is in both pieces. Cost as for split.
std::vector<Polyhedron> split_volumes(const Polyhedron& a, const Monitor& monitor = {});

}  // namespace nef
