// SPDX-License-Identifier: Apache-2.0
//
// Solids from the arrangement of a mesh's faces, by winding numbers.
#pragma once

#include <map>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/import/face_arrangement.h"
#include "nef/import/winding_volume.h"
#include "nef/polyhedron.h"

namespace nef {

/// Why a mesh is refused whose faces cancel each other.
inline constexpr const char* kEnclosesNothing = "the faces of the mesh enclose nothing";

/// The winding numbers of the volumes between faces, given their arrangement (arrange_faces), breadth first from the
/// outer volume, whose number is 0; with kParity and kAny they are 0 and 1. Facets with the same volume on both sides
/// do not count. Nothing if two ways to a volume disagree, as the faces then are not closed. O(items).
std::optional<IndexedVector<VolumeId, int>> winding_numbers(const Complex& faces, Covering covering);

struct FillOptions {
  Crossings rule = Crossings::kRefuse;
  Covering covering = Covering::kSigned;  ///< what the marks of the arrangement count
  bool inside_out = false;                ///< the faces count as if they were turned over
  Measure measure = Measure::kNot;        ///< of the volumes of FilledMesh
  Monitor monitor = {};
};

struct FilledMesh {
  Polyhedron set;
  int lowest = 0;  ///< winding number
  int highest = 0;
  std::map<int, WindingVolume> volumes;  ///< by winding number, that of the outer volume left out; if asked for
};

/// The solid that a mesh encloses by a rule, given the arrangement of its faces (arrange_faces): the closure of its
/// interior. With kParity and kAny, winding numbers are 0 and 1; for Crossings::kGuess, by generalized winding numbers
/// of some points in each volume. Throws InputError if nothing is enclosed, if the faces are not closed, and for
/// Crossings::kRefuse naming a face where the winding numbers are not 0 and 1. O(n log n) for n facets, and O(idle
/// items) for what lies between volumes with equal marks.
FilledMesh fill_by_winding(Polyhedron faces, const Mesh& mesh, const FillOptions& options);

}  // namespace nef
