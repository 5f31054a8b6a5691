// SPDX-License-Identifier: Apache-2.0
//
// Meshes that bound no solid by the rules, but mean one.
#pragma once

#include <cstddef>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// What a mesh was taken for.
struct MeshMeaning {
  Polyhedron set;                   ///< closed: solids and, where the mesh encloses nothing, surfaces
  std::size_t duplicate_faces = 0;  ///< dropped: faces with the corners of another one, or with no area
  std::size_t solid_parts = 0;      ///< connected parts that enclose something
  std::size_t surface_parts = 0;    ///< connected parts of which (also) faces remain that bound nothing
};

/// The set that a triangle soup stands for, wherever that is unambiguous. Orientation is ignored (models are
/// double-sided, or turned at random), and nothing is moved: gaps stay gaps.
///  - Faces that occur twice count once.
///  - Of each connected part of the mesh, what is an odd number of faces away from the outside is solid; faces with
///    the same region on both sides (fins, open borders, flaps) do not count, and stay as surfaces. A part whose
///    regions cannot be counted that way (a box with an inner partition, which may be two solids or two rooms) stays
///    a surface; so do parts that enclose nothing. Open parts are tried once more together.
///  - A part in another one's inside is a cavity of it if it is nested an odd number of times: a doubled wall has a
///    room in it. Of parts that touch each other there, the largest (by its box) is the room, and the others stand in
///    it; what reaches in from outside is there, too. All other parts are united.
/// O(n log n + k) for n faces with k contacts; O(m^2) boxes are compared for m parts.
MeshMeaning meaning_of(const Mesh& mesh, const Monitor& monitor = {});

}  // namespace nef::planner
