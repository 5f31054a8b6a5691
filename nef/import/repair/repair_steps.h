// SPDX-License-Identifier: Apache-2.0
//
// The steps that repair a mesh, each of which keeps what the ones before have done.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/geometry/ids.h"
#include "nef/import/repair/face_fates.h"
#include "nef/import/repair/lids.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// A mesh whose faces change, and what became of each face that came in. No vertex moves, and none is made.
struct MeshInRepair {
  /// Vertices at equal points become one, and corners that repeat the one before go. Throws InputError for a face that
  /// names a vertex that does not exist. Expected O(n).
  explicit MeshInRepair(const Mesh& mesh);

  /// The faces as they are now, over the vertices that they use.
  [[nodiscard]] Mesh mesh() const;
  /// Some of them.
  [[nodiscard]] Mesh mesh(std::span<const std::uint32_t> faces) const;
  /// True if the faces are those of this mesh still.
  [[nodiscard]] bool is(const Mesh& mesh) const;

  void turn_over(std::uint32_t face);

  /// Adds "COUNT one WHAT" or "COUNT many WHAT" to `done`, unless the count is 0.
  void note(std::size_t count, const char* one, const char* many, const char* what);

  std::vector<Rational3> vertices;
  std::vector<std::vector<std::uint32_t>> rings;  ///< the corners of each face
  std::vector<std::uint32_t> sources;             ///< of each ring: the face of the mesh that came in, kNone for lids
  std::vector<bool> turned_over;                  ///< of each ring: against that face
  std::vector<bool> turned;                       ///< of each ring: to fit its neighbours
  std::uint32_t one_sided = kNone;                ///< a face that came in whose component cannot be oriented
  std::vector<FaceFate> fates;                    ///< of each face that came in
  std::vector<std::string> done;                  ///< a line for each step that changed something
};

/// True if each side is run through as often one way as the other: then winding numbers say what the faces enclose,
/// and nothing has to be guessed from how they stand. O(n log n).
bool is_balanced(const MeshInRepair& mesh);

/// Copies of faces go, but for walls between solids (without_copies). Of a balanced mesh, those go that are turned
/// against each other and that no other faces touch (skins with two sides to each face), and faces that are there again
/// turned alike if these are closed by themselves.
void drop_copies(MeshInRepair& mesh);

/// Faces without area, or with fewer than three corners, go.
void drop_faces_without_area(MeshInRepair& mesh, const Monitor& monitor);

/// Which sides of faces are open.
enum class OpenSides : std::uint8_t {
  kOdd,         ///< those that an odd number of faces has, however these are turned
  kUnbalanced,  ///< those that are run through more often one way than the other
};

/// Vertices of the border that lie in an open side become corners there, so that T-junctions close. O(n log n).
void split_sides(MeshInRepair& mesh, OpenSides which, const Monitor& monitor);

/// Faces are turned to fit their neighbours, breadth first over sides of two faces; the larger part of what hangs
/// together keeps its direction. A wall between two solids has both directions, and the faces beside it are each
/// other's neighbours. Of a component that cannot be oriented, some stay unlike their neighbours (one_sided). O(n).
void turn_to_neighbours(MeshInRepair& mesh);

/// True if all corners lie in one plane, or there are none. O(n).
bool is_flat(const MeshInRepair& mesh, const Monitor& monitor);

/// Open pieces that lie in one plane go, as no lid makes them enclose anything, unless nothing else is left; true if
/// there are some. Faces belong to one piece if they share sides with each other or with the same of these lids, which
/// are for all holes. Expected O(n).
bool drop_flat_pieces(MeshInRepair& mesh, const Lids& lids, const Monitor& monitor);

/// Adds faces that close holes.
void put_on(MeshInRepair& mesh, const Lids& lids);

}  // namespace nef
