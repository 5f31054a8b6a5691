// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a mesh, by name and with the guilty elements.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// A property that a mesh should not have if it is to bound a solid.
enum class MeshProblemKind : std::uint8_t {
  kBadIndex,                 ///< a face names a vertex that is not there
  kDegenerateFace,           ///< fewer than three corners, a vertex named twice, or no area; the latter are legal
  kDuplicateFace,            ///< two faces with the same corners; legal if they are back to back
  kOpenBorder,               ///< an edge of one face only
  kNonManifoldEdge,          ///< an edge of more than two faces; legal if they separate inside from outside
  kInconsistentOrientation,  ///< faces that run through a common edge in the same direction
  kSelfIntersection,         ///< faces that cross, or overlap and are turned alike, or a face that crosses itself
  kTouching,                 ///< faces that meet otherwise without sharing all of what they meet in; legal
  kNonPlanarFace,            ///< corners that lie in no common plane; legal, it will be triangulated
  kIsolatedVertex,           ///< a vertex of no face; legal, it is ignored
  kInsideOut,                ///< the mesh encloses a negative volume; legal, but hardly meant
};

/// The name as a program prints it: "open border", "self-intersection", ...
const char* name(MeshProblemKind kind);

struct MeshSurface;  // nef/mesh/surface/mesh_surface.h
struct FaceContact;  // nef/mesh/surface/surface_contacts.h

/// How the faces of an edge run through it.
enum class EdgeBalance : std::uint8_t {
  kBalanced,  ///< equally often in both directions, as in all closed surfaces
  kEven,      ///< an even number of times
  kOdd,       ///< an odd number of times: the surface is open there
};

struct MeshProblem {
  MeshProblemKind kind = MeshProblemKind::kBadIndex;
  bool legal = false;                               ///< true if a solid can be made in spite of it
  std::vector<std::uint32_t> vertices;              ///< as numbered in the mesh, from 0
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< each as its two vertices
  std::vector<std::uint32_t> faces;                 ///< as numbered in the mesh, from 0
  EdgeBalance balance = EdgeBalance::kBalanced;     ///< of the edge, where the problem is one
  std::string text;                                 ///< one line for people
};

/// True unless the problem keeps a mesh from being strictly legal. A mesh is strictly legal if it is closed and
/// outward, no face is degenerate, and any two of the triangles into which its faces are cut have nothing in common but
/// a vertex or an edge that both name. So every reader finds the same solid in it, whatever it does with contacts.
/// Solids may touch in whole edges (of four or more faces) and in vertices; vertices that no face names do not count.
bool is_strictly_legal(const MeshProblem& problem);

struct MeshCheckOptions {
  /// Report no more than these of each kind, legal and illegal ones and edges of each balance counted apart.
  std::size_t max_per_kind = std::numeric_limits<std::size_t>::max();
  bool self_intersections = true;  ///< the expensive part
  bool only_verdict = false;       ///< leave that part out, too, where something before it is illegal already
};

/// Everything that is wrong with a mesh, in the order of MeshProblemKind and of the elements; empty for a clean mesh.
/// Vertices with equal coordinates count as one (the smallest number stands for all). Two solids that share an edge
/// or a vertex are legal: the edge has four faces that pair up, which is reported as legal. Whether components that
/// touch or lie in each other contradict each other is known only when the solid is made (from_mesh). All decisions are
/// exact. O(n log n) for meshes whose faces meet few others; 20000 triangles take about 50 ms.
std::vector<MeshProblem> check_mesh(const Mesh& mesh, const MeshCheckOptions& options = {},
                                    const Monitor& monitor = {});
/// The same for a mesh whose surface is there already. `contacts`, if given, are all contacts of its faces
/// (face_contacts) if it holds something, and receives them if it does not and they were looked for. `open`: see
/// SurfaceContacts::for_each.
std::vector<MeshProblem> check_mesh(const Mesh& mesh, const MeshSurface& surface, const MeshCheckOptions& options,
                                    const Monitor& monitor, std::optional<std::vector<FaceContact>>* contacts = nullptr,
                                    std::vector<std::array<std::uint32_t, 2>>* open = nullptr);

/// How far the corners of a face are from the plane through their centroid whose normal is the area vector of the
/// face: the largest distance. Zero iff the face is planar and not degenerate, or has no area vector.
double face_deviation(const Mesh& mesh, std::size_t face);

/// The same with three digits, however small, as messages tell it.
std::string face_deviation_text(const Mesh& mesh, std::size_t face);

/// "face F is not planar (off by D)", as messages say it.
std::string not_planar_text(const Mesh& mesh, std::size_t face);

}  // namespace nef
