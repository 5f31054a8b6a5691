// SPDX-License-Identifier: Apache-2.0
//
// What became of each face of a mesh that was repaired.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/surface_contacts.h"
#include "nef/polyhedron.h"

namespace nef {

enum class FaceFate : std::uint8_t {
  kKept,    ///< it is in the boundary of the solid, as it was
  kTurned,  ///< it is, turned over
  kCut,     ///< it crosses or overlaps others, and the rule for crossings decides about its pieces
  kInside,  ///< the rule has the same on both sides of it, so nothing of it is left
  kCopy,    ///< another face has its corners
  kNoArea,  ///< it has no area
  kAdded,   ///< a lid
};

/// All fates, in the order above.
inline constexpr std::array kAllFates{FaceFate::kKept, FaceFate::kTurned, FaceFate::kCut,  FaceFate::kInside,
                                      FaceFate::kCopy, FaceFate::kNoArea, FaceFate::kAdded};

/// "kept", "turned", "cut", "inside", "copy", "no_area", "added".
const char* name(FaceFate fate);

/// Faces that were cut, all of them together, as two-dimensional sets.
struct CutPieces {
  Polyhedron kept;     ///< in the boundary of the solid
  Polyhedron dropped;  ///< not
};

struct FaceRecord {
  std::vector<FaceFate> fates;                    ///< of each face of the mesh, then of those that were added
  std::vector<std::vector<std::uint32_t>> added;  ///< corners of faces that were added, vertices of the mesh
  CutPieces pieces;
};

/// kKept, kCut or kInside for each face of a mesh that a rule for crossings made `solid` of, given all contacts of its
/// faces. A face that crosses no other has the same on each of its sides everywhere, so one of its points decides.
/// Faces without area are kInside. O(n + contacts), and a point location for each face.
std::vector<FaceFate> fates_by_rule(const Mesh& mesh, std::span<const FaceContact> contacts, const Polyhedron& solid,
                                    const Monitor& monitor);

/// Of the faces with the fate kCut, what is in the boundary of the solid, and what is not. The cost is that of an
/// intersection and a difference of the cut faces and the solid.
CutPieces pieces_of_cut_faces(const Mesh& mesh, const std::vector<FaceFate>& fates, const Polyhedron& solid,
                              const Monitor& monitor);

}  // namespace nef
