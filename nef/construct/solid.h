// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "nef/base/defect.h"
#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef {

/// The faces of a closed orientable surface over points of a table: face f has the corners
/// corners[begin[f]] .. corners[begin[f+1]-1], counterclockwise about the normal of plane[f], which
/// points away from the solid. Every vertex is there once.
struct SolidFaces {
  PlaneTable planes;
  PointTable points;
  std::vector<std::uint32_t> names;  ///< of the points, as messages tell them; empty: as they are numbered
  std::vector<PlaneId> plane;
  std::vector<std::uint32_t> begin{0};
  std::vector<std::uint32_t> corners;
};

/// Adds the sides -x, +x, -y, +y, -z, +z of a box between eight points, point i being at the upper end of axis k if i
/// has bit k. plane(s) is the plane of side s.
template <typename Plane>
void add_box_sides(SolidFaces& f, Plane&& plane) {
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t s = 0; s < kSides.size(); ++s) {
    f.plane.push_back(plane(s));
    f.corners.insert(f.corners.end(), kSides[s].begin(), kSides[s].end());
    f.begin.push_back(static_cast<std::uint32_t>(f.corners.size()));
  }
}

struct SolidMarks {
  LabelId boundary = 1;  ///< of faces whose plane is not flipped, and where faces of both kinds meet
  LabelId inside = 1;
  LabelId outside = 0;
  LabelId flipped_boundary = boundary;  ///< of faces whose plane is flipped
};

/// The complex of the solid. Coplanar neighbouring faces become one facet. The faces must not
/// cross; throws InputError naming an edge (by vertex numbers) around which inside and outside do not alternate.
/// O(n log n).
Complex make_solid(SolidFaces&& faces, const SolidMarks& marks, const Monitor& monitor);

/// How a solid's sphere maps are made of its faces; the complex is the same, item for item.
enum class SphereMaps : std::uint8_t {
  kRead,   ///< those of ordinary vertices are read off their faces (PlainRing), which takes a fifth off an import
  kDrawn,  ///< all are drawn: the way of vertices where doubles cannot tell, and what the other way is compared with
};

/// The same for faces that may cross, or whose components may have the inside on different sides: then it may return
/// what does not fit together.
std::variant<Complex, Defect> try_make_solid(SolidFaces&& faces, const SolidMarks& marks, const Monitor& monitor,
                                             SphereMaps maps = SphereMaps::kRead);

/// The union of the faces as a two-dimensional set of the given mark, 0 around it. The faces may have borders and may
/// meet in any number around an edge, but nowhere else than in common vertices and edges. O(n log n).
Complex make_surface(SolidFaces&& faces, LabelId mark, const Monitor& monitor);

/// The same, marked 1 where faces are seen from the positive side of their plane and 2 where from the other one; 1
/// where such faces meet.
Complex make_oriented_surface(SolidFaces&& faces, const Monitor& monitor);

/// The solid [-R, R]^3 in coordinates with parts in the infimaximal number R (thesis 3.3): an
/// ordinary solid, whose outside is marked 0.
Complex make_infimaximal_box(const Monitor& monitor);

/// The complex with everything outside of that box replaced by kOutside: how an unbounded set is
/// represented. On the walls of the box the marks of `solid` are taken as they are.
Complex clip_to_infimaximal_box(const Complex& solid, const Monitor& monitor);

/// z <= 0, clipped to the box.
Complex make_lower_halfspace(const Monitor& monitor);

}  // namespace nef
