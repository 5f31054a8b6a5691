// SPDX-License-Identifier: Apache-2.0
//
// Meshes whose coordinates have been rounded: are they legal still, and what can be done if not?
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_formats.h"

namespace nef {

/// How coordinates come out of a file.
struct Rounding {
  /// The number of the format that is nearest to one, as a double.
  std::function<double(const Rational&)> nearest;
  /// The number of the format next to one of them, up or down.
  std::function<double(double, bool up)> next;
  /// What readers make of such a number, this library first; there may be several opinions (0.1 is a tenth, or a double
  /// near it), each within half a unit in the last place of the double, and greater ones of greater doubles.
  std::vector<std::function<Rational(double)>> readings;
};

/// That of a format's numbers (not kNone).
Rounding rounding_to(FileNumbers numbers);

/// A mesh that was rounded.
struct MendedMesh {
  Mesh mesh;                ///< its coordinates are numbers of the format
  bool legal = true;        ///< it is strictly legal in every reading, and bounds a solid
  std::string problem;      ///< the first problem if it is not legal
  std::size_t moved = 0;    ///< vertices that are not at the nearest numbers, so that it is legal
  std::size_t dropped = 0;  ///< slivers that are gone
  /// How far a vertex is from its exact place at most, along an axis, and how far the sides of slivers that were
  /// flipped are from those before. 0 if nothing was mended.
  double largest_move = 0;
  /// Of each face: the face of the exact mesh that it comes from; empty if the faces are that mesh's.
  std::vector<std::uint32_t> face_of;
};

/// What was moved and dropped, as a note; empty if nothing was.
std::string repair_text(const MendedMesh& rounded);

/// Why a mesh is not strictly legal (is_strictly_legal), or bounds no solid though it is; empty if it does. The cost is
/// that of check_mesh.
std::string strict_problem(const Mesh& mesh, const Monitor& monitor = {});

/// The same for the mesh with rounded coordinates, in the first reading that has a problem.
std::string rounded_problem(const Mesh& exact, const Rounding& rounding, const Monitor& monitor = {});

/// Whose readings count.
enum class Readers : std::uint8_t {
  kAll,   ///< every one
  kOurs,  ///< that of this library, which takes decimals for what they spell
};

/// True if nothing happens to a point in a file: it is the same after rounding, in the readings that count.
bool is_kept(const Rational3& point, const Rounding& rounding, Readers readers = Readers::kAll);

/// The same of all vertices of a mesh. O(n).
bool are_kept(const Mesh& mesh, const Rounding& rounding);

/// Rounds the vertices of a legal closed mesh of convex faces. Where the result is not strictly legal, vertices go to
/// other numbers nearby and slivers are flipped or contracted, as long as that takes few rounds; then all faces are
/// triangles. What it returns as legal was checked exactly. The cost is that of check_mesh for each reading and round;
/// the readings are checked side by side on the threads of `monitor`.
MendedMesh round_mesh(const Mesh& exact, const Rounding& rounding, const Monitor& monitor = {});

}  // namespace nef
