// SPDX-License-Identifier: Apache-2.0
//
// Polyhedra from geometry.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/crossings.h"
#include "nef/forward.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// The closed box [low, high]. A box that is flat in some directions is a facet, segment or
/// point. Throws InputError if low > high in one of them.
Polyhedron make_box(const Rational3& low, const Rational3& high, const Monitor& monitor = {});

/// a x + b y + c z + d <= 0 (or < 0, if not closed). The normal must not be zero.
Polyhedron make_halfspace(const Rational& a, const Rational& b, const Rational& c, const Rational& d,
                          bool closed = true, const Monitor& monitor = {});

/// The closed convex hull of any number of points, of whatever dimension it is.
Polyhedron convex_hull(std::span<const Rational3> points, const Monitor& monitor = {});

/// The closed convex hull as a mesh with planar faces (no two coplanar), for points that span
/// space; throws InputError if they do not.
Mesh convex_hull_mesh(std::span<const Rational3> points, const Monitor& monitor = {});

Polyhedron make_point(const Rational3& point, const Monitor& monitor = {});
Polyhedron make_segment(const Rational3& a, const Rational3& b, const Monitor& monitor = {});

/// A closed planar polygon as a two-dimensional set; `rings` are simple cycles in one plane
/// without common interior, combined by parity (outer cycles and holes in any order).
/// Throws InputError if the points are not coplanar or a ring touches or crosses itself.
Polyhedron make_polygon(std::span<const std::vector<Rational3>> rings, const Monitor& monitor = {});

/// How a mesh becomes a solid.
struct MeshOptions {
  bool strict = false;      ///< refuse faces that are not exactly planar instead of triangulating them
  bool as_surface = false;  ///< the union of the faces as a two-dimensional set; any mesh will do
  bool check = true;        ///< look for faces that meet otherwise than in common vertices and edges. Precondition of
                            ///< false: there are none. All else is checked; where such faces keep vertices from
                            ///< fitting together they are looked for nevertheless (InputError), others go unseen
  Crossings crossings = Crossings::kRefuse;  ///< what to do where faces cross or enclose something several times
  double close_percent = 0;  ///< above 0: a mesh that bounds no solid is repaired like by repair_mesh, and its holes
                             ///< are closed by lids of at most this share in the area of the mesh with them, a guess
                             ///< that is noted like all that was done
  Monitor monitor = {};      ///< cancellation, progress, counters; its referents must outlive the call
};

/// Notes about what was done to the input (faces that were triangulated).
using Messages = std::vector<std::string>;

/// The closed solid bounded by a closed orientable mesh: any number of components and planar
/// polygons of any shape, nested cavities by orientation. Vertices at equal coordinates are one.
/// A mesh that touches itself is legal. A mesh without vertices and faces bounds the empty set, which is noted.
/// Throws InputError for a mesh that is open, inconsistently oriented or crosses itself, or has vertices but no faces,
/// naming the first guilty elements. With a rule for crossings, meshes that cross themselves become the closure of the
/// interior of what the rule takes (which is noted); they still must be closed, and oriented consistently where the
/// rule needs that, unless close_percent asks for a repair. Only faces that meet others are arranged: O(n log n) for n
/// faces with few contacts.
Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options = {}, Messages* messages = nullptr);

}  // namespace nef
