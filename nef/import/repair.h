// SPDX-License-Identifier: Apache-2.0
//
// Meshes that nearly bound a solid.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/import/repair/face_fates.h"
#include "nef/import/resolve_mesh.h"
#include "nef/polyhedron.h"

namespace nef {

struct RepairOptions {
  bool fill_holes = false;   ///< close planar holes with a face
  double close_percent = 0;  ///< close all holes, with triangles of least area where they are not planar, if lids have
                             ///< no more than this share in the area of the mesh with its lids; open pieces in one
                             ///< plane are left out, if there are others, but for
                             ///< kOutside and kGuess
  Crossings crossings = Crossings::kRefuse;  ///< what to do with faces that cross when all else is done
  bool strict = false;                       ///< refuse faces that are not exactly planar, like MeshOptions::strict
  bool record = false;                       ///< fill RepairedMesh::record
};

struct RepairedMesh {
  Mesh mesh;
  std::vector<std::string> done;  ///< a line for each kind of change; empty if nothing was changed
  std::string problem;            ///< why the mesh bounds no solid still; empty if it does
  std::size_t holes = 0;          ///< loops of the border when all but lids was done
  std::size_t flat_holes = 0;     ///< of them, with the border of a polygon; with RepairOptions::close_percent
  double lid_share = 0;           ///< of lids for all of them in the area of the mesh with its lids; likewise
  bool has_lids = false;          ///< the holes were closed; a guess
  bool is_one_sided = false;      ///< it bounds no solid, as it cannot be oriented and the rule asks for that
  bool is_flat = false;           ///< it bounds no solid, and all its faces lie in one plane
  FaceRecord record;              ///< if RepairOptions::record; of a mesh that bounds no solid still, of the steps
                                  ///< before the rule for crossings
  MeasuredVolume signed_volume;   ///< of the mesh (signed_volume), if it needed the rule
  std::optional<ResolvedMesh> resolved;  ///< the solid, with volumes in doubles, where the mesh needed the rule
  Polyhedron set;                        ///< the solid, if there is one
  Messages notes;                        ///< what its import from `mesh` noted
};

/// Makes the solid of a mesh that means one, without moving a vertex: a mesh that from_mesh takes is left alone.
/// Otherwise vertices at equal points become one, copies of faces go (models with two sides to each face) but for walls
/// between solids (without_copies), faces without area go and the vertices in the sides of their neighbours become
/// corners of these, faces are turned to fit their neighbours, and components that cross no other are turned outward
/// or, inside an odd number of others, inward. Holes whose border lies in a plane are filled if the options say so,
/// and any others by triangles of least area (least_area_triangles), without open pieces that lie in one plane
/// (drop_flat_pieces), unless the rule is kOutside or kGuess.
/// A surface that cannot be oriented is refused, unless the rule is kOdd, kOutside or kGuess.
/// What crosses itself then, or encloses something several times, is resolved by the rule; with a rule, components stay
/// outward inside of others unless some of their faces were turned, as the rule has an answer to them. O(n log n), and
/// a point location for each pair of a component and another in whose box it lies.
RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options = {}, const Monitor& monitor = {});

/// Which option has an answer to what a repair has left open, as the end of a message; "" if none has.
std::string advice_about(const RepairedMesh& repaired, double close_percent);

/// What from_mesh makes of a mesh with MeshOptions::close_percent: the solid that it bounds, else the one that it
/// bounds when it is repaired. Notes what was done. Throws InputError with what is still wrong, and what to do about
/// holes.
Polyhedron repaired_solid(const Mesh& mesh, const MeshOptions& options, Messages* messages);

}  // namespace nef
