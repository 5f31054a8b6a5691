// SPDX-License-Identifier: Apache-2.0
//
// A polyhedron as things to draw: triangles, segments, dots, each with its mark and its index. The only place where
// exact geometry becomes doubles for the eye; what a viewer tells about an item still comes from the exact complex.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::view {

using Point = std::array<double, 3>;

/// Marks an item that is no item of the polyhedron: made by the visible box or by a section.
inline constexpr std::uint32_t kArtificial = 0xffffffffU;

/// How an item came into the scene.
enum class Origin : std::uint8_t {
  kOwn,      ///< an item of the polyhedron (or a part of it)
  kBox,      ///< lies on the visible box, where an unbounded part is cut off, or in the wall of a tile
  kSection,  ///< lies on the section plane
};

/// A vertex to draw.
struct SceneVertex {
  Point position{};
  std::uint32_t index = kArtificial;  ///< vertex of the polyhedron's complex
  LabelId mark = 0;
  Origin origin = Origin::kOwn;
  bool isolated = false;  ///< neither an edge nor a facet ends here
};

/// An edge to draw.
struct SceneEdge {
  std::uint32_t from = 0;  ///< in Scene::vertices
  std::uint32_t to = 0;
  std::uint32_t index = kArtificial;  ///< halfedge of the polyhedron's complex; the smaller of the two
  LabelId mark = 0;
  Origin origin = Origin::kOwn;
  bool isolated = false;  ///< bounds no facet
};

/// A facet to draw, as consecutive triangles.
struct SceneFacet {
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  std::uint32_t index = kArtificial;  ///< facet of the polyhedron's complex
  LabelId mark = 0;
  Origin origin = Origin::kOwn;
  std::uint32_t above = 0;  ///< in Scene::volumes, on the side from which the triangles turn counterclockwise
  std::uint32_t below = 0;
};

/// A volume that facets of the scene bound.
struct SceneVolume {
  std::uint32_t index = kArtificial;  ///< volume of the polyhedron's complex; kArtificial if it was not looked for
  LabelId mark = 0;                   ///< never kOutside
  bool bounded = true;                ///< false if it is the outer one or was cut off by the visible box
};

/// What of a set is drawn.
struct SceneOptions {
  /// Keep only the side a x + b y + c z + d <= 0; cut exactly.
  std::optional<std::array<Rational, 4>> section;
  /// The visible box; derived from the polyhedron if not given.
  std::optional<std::array<Rational3, 2>> box;
  /// Look up the items of the polyhedron that cut items are parts of. Needed to tell about them, not to draw them;
  /// costs a point location for each.
  bool indices = true;
};

/// Flat arrays; triangles index vertices. Owns everything.
struct Scene {
  Polyhedron source;  ///< that the indices refer to
  std::vector<SceneVertex> vertices;
  std::vector<SceneEdge> edges;
  std::vector<SceneFacet> facets;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< facet after facet
  std::vector<SceneVolume> volumes;
  /// The vertices of facet f (corners and isolated ones) are facet_vertices[facet_vertex_begin[f]] and following.
  std::vector<std::uint32_t> facet_vertex_begin{0};
  std::vector<std::uint32_t> facet_vertices;
  std::optional<std::array<Point, 2>> box;  ///< the visible box, if something was cut off by it

  /// Smallest and largest coordinates of what is to be seen, the box included; nothing for an empty scene.
  [[nodiscard]] std::optional<std::array<Point, 2>> bounds() const;
  /// True if the item's mark counts as being in the set.
  static bool selected(LabelId mark) { return mark != 0 && mark != kOutside; }
};

/// Everything there is to see of a polyhedron. Facets are triangulated exactly, without new vertices. Unbounded parts
/// are cut off at a visible box (and sections are made) by Boolean operations, so what is drawn is the exact
/// intersection. O(n) plus the triangulation for bounded sets without a section.
Scene build_scene(const Polyhedron& polyhedron, const SceneOptions& options = {}, const Monitor& monitor = {});

/// What there is to see of the part of a bounded set in a closed region, beyond which its marks are kOutside: a tile of
/// a TiledPolyhedron. The scenes of all tiles together show the set, but edges that lie in walls between them: facets
/// that walls cut are drawn in parts, walls themselves are not. Vertices in walls are of Origin::kBox. O(n).
Scene build_tile_scene(const Polyhedron& tile, const Monitor& monitor = {});

/// A box around all finite vertices of all sets, and around the places where their unbounded planes and lines are, with
/// a margin of about a third; [-1,1]^3 for sets without any. Sets that are shown together should be cut at one box.
std::array<Rational3, 2> visible_box(std::span<const Polyhedron> sets);

}  // namespace nef::view
