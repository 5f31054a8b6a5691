// SPDX-License-Identifier: Apache-2.0
//
// An unbounded set is intersected with a visible box, and a section is an intersection with a half-space, so what is
// drawn is exact. Then vertices, edges and triangulated facets become flat arrays. Which items the cuts have made is
// found by planes: a bit for each cutting plane that a vertex lies on exactly; an edge or facet lies on the planes that
// all its vertices have in common.
#include "apps/view/scene.h"

#include <algorithm>

#include "apps/view/scene/item_finder.h"
#include "nef/base/error.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::view {
namespace {

constexpr std::uint32_t kUnused = 0xffffffffU;

// Adds the items of one complex, without those of an infimaximal box and without those that only border on kOutside, to
// an empty scene.
class SceneBuilder {
 public:
  SceneBuilder(const Complex& complex, Scene& scene, const Monitor& monitor)
      : complex_(complex), scene_(scene), monitor_(monitor) {}

  void run() {
    find_walls();
    add_volumes();
    add_vertices();
    add_edges();
    add_facets();
  }

 private:
  [[nodiscard]] bool is_beyond(VolumeId volume) const { return complex_.volumes[volume].mark == kOutside; }

  // Where kOutside borders on the rest, which is nowhere else than at infinity unless the set is one in a region: its
  // edges, and the facets that are only its end, since their marks are those behind them.
  void find_walls() {
    in_wall_.assign(complex_.svertex_count(), false);
    for (const FacetId f : complex_.facets.ids()) {
      const Facet& facet = complex_.facets[f];
      if (!is_beyond(facet.volume_above) && !is_beyond(facet.volume_below)) continue;
      for (const SHalfedgeId corner : complex_.corners_of(facet)) in_wall_[complex_.corner_halfedge(corner)] = true;
    }
  }

  [[nodiscard]] bool is_end(const Facet& facet) const {
    if (is_beyond(facet.volume_above)) return complex_.volumes[facet.volume_below].mark == facet.mark;
    return is_beyond(facet.volume_below) && complex_.volumes[facet.volume_above].mark == facet.mark;
  }

  // The scene's volume on a side of a facet. Of what lies beyond a wall that is drawn no more is known here than that
  // the wall ends the set, so it has the mark of the wall; the tile there tells the rest.
  std::uint32_t side_of(VolumeId volume, const Facet& facet) {
    if (!is_beyond(volume)) return volume.index();
    for (auto v = static_cast<std::uint32_t>(complex_.volume_count()); v < scene_.volumes.size(); ++v) {
      if (scene_.volumes[v].mark == facet.mark) return v;
    }
    scene_.volumes.push_back({kArtificial, facet.mark, false});
    return static_cast<std::uint32_t>(scene_.volumes.size() - 1);
  }

  void add_volumes() {
    for (const VolumeId v : complex_.volumes.ids()) {
      const LabelId mark = complex_.volumes[v].mark;
      scene_.volumes.push_back({v.index(), mark == kOutside ? LabelId{0} : mark, v != kOuterVolume});
    }
  }

  void add_vertices() {
    number_.assign(complex_.vertex_count(), kUnused);
    for (const VertexId v : complex_.vertex_ids()) {
      if (is_box_vertex(complex_, v)) continue;
      number_[v] = static_cast<std::uint32_t>(scene_.vertices.size());
      const SphereMapView map = complex_.sphere_map(v);
      places_.push_back(point_of(v));
      positions_.push_back(nearest_doubles(complex_.points, point_of(v)));
      const bool wall =
          std::any_of(map.sfaces.begin(), map.sfaces.end(), [](const SFace& sface) { return sface.mark == kOutside; });
      scene_.vertices.push_back({positions_.back(), v.index(), map.mark, wall ? Origin::kBox : Origin::kOwn,
                                 map.svertices.empty() && map.shalfedges.empty() && map.sloops.empty()});
    }
  }

  void add_edges() {
    for (const HalfedgeId h : complex_.halfedge_ids()) {
      if (h > complex_.twin[h] || in_wall_[h] || in_wall_[complex_.twin[h]]) continue;
      const std::uint32_t from = number_[complex_.source(h)];
      const std::uint32_t to = number_[complex_.target(h)];
      if (from == kUnused || to == kUnused) continue;
      const SVertex& svertex = complex_.svertex(h);
      scene_.edges.push_back({from, to, h.index(), svertex.mark, Origin::kOwn, svertex.out == kNone});
    }
  }

  // The corners of a facet as rings of scene vertices; empty if one is infimaximal.
  std::vector<std::vector<std::uint32_t>> rings_of(const Facet& facet) const {
    std::vector<std::vector<std::uint32_t>> rings;
    for (const CycleId i : facet.cycles()) {
      std::vector<std::uint32_t>& ring = rings.emplace_back();
      for (const SHalfedgeId corner : complex_.corners_of(i)) {
        ring.push_back(number_[complex_.shalfedge_vertex(corner)]);
        if (ring.back() == kUnused) return {};
      }
    }
    return rings;
  }

  void add_facets() {
    const MeshPoints points(complex_.points, places_, positions_, {});
    Triangulator triangulator(points, monitor_);
    for (const FacetId f : complex_.facets.ids()) {
      const Facet& facet = complex_.facets[f];
      const std::vector<std::vector<std::uint32_t>> rings = rings_of(facet);
      if (rings.empty() || is_end(facet)) continue;
      const auto first = static_cast<std::uint32_t>(scene_.triangles.size());
      if (rings.size() == 1 && rings[0].size() == 3) {
        scene_.triangles.push_back({rings[0][0], rings[0][1], rings[0][2]});
      } else {
        const auto [axis, sign] = projection_axis(complex_.planes, facet.plane);
        const bool done = triangulator.triangulate(rings, axis, sign, scene_.triangles);
        NEF_ASSERT(done);
      }
      const auto count = static_cast<std::uint32_t>(scene_.triangles.size()) - first;
      scene_.facets.push_back({first, count, f.index(), facet.mark, Origin::kOwn, side_of(facet.volume_above, facet),
                               side_of(facet.volume_below, facet)});
      for (const auto& ring : rings) {
        scene_.facet_vertices.insert(scene_.facet_vertices.end(), ring.begin(), ring.end());
      }
      for (const VertexId v : complex_.isolated_vertices_of(facet)) {
        scene_.facet_vertices.push_back(number_[v]);
      }
      scene_.facet_vertex_begin.push_back(static_cast<std::uint32_t>(scene_.facet_vertices.size()));
    }
  }

  const Complex& complex_;
  Scene& scene_;
  Monitor monitor_;
  IndexedVector<HalfedgeId, bool> in_wall_;        // one of the two of an edge
  IndexedVector<VertexId, std::uint32_t> number_;  // scene vertex of each vertex
  std::vector<PointId> places_;                    // point of each scene vertex
  std::vector<Point> positions_;                   // the same, rounded
};

Point rounded(const Rational3& point) { return nearest_doubles(point); }

// The planes by which the polyhedron is cut, in the order of bits in a mask: six of the box, then the section.
std::vector<std::array<Rational, 4>> cutting_planes(const std::optional<std::array<Rational3, 2>>& box,
                                                    const SceneOptions& options) {
  std::vector<std::array<Rational, 4>> planes;
  if (box) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (const Rational3& corner : *box) {
        std::array<Rational, 4> plane{0, 0, 0, -corner[i]};
        plane[i] = 1;
        planes.push_back(plane);
      }
    }
  }
  if (options.section) planes.push_back(*options.section);
  return planes;
}

Origin origin_of(std::uint32_t mask, bool box) {
  if (mask == 0) return Origin::kOwn;
  return box && (mask & 63U) != 0 ? Origin::kBox : Origin::kSection;
}

// Finds out which items lie on the planes of a cut. A mask has a bit for each plane that holds a vertex; an edge or
// facet lies on the planes that hold all its vertices.
void find_origins(const Complex& drawn, const std::vector<std::array<Rational, 4>>& planes, bool box, Scene& scene,
                  const Monitor& monitor) {
  PlaneTable table;
  std::vector<PlaneId> ids;
  for (const auto& p : planes) ids.push_back(table.intern({p[0], p[1], p[2]}, p[3]));
  std::vector<std::uint32_t> masks;
  for (SceneVertex& vertex : scene.vertices) {
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (side_of_plane(table, ids[i], drawn.points, PointId{vertex.index}, monitor) == 0) mask |= 1U << i;
    }
    masks.push_back(mask);
    vertex.origin = origin_of(mask, box);
  }
  for (SceneEdge& edge : scene.edges) edge.origin = origin_of(masks[edge.from] & masks[edge.to], box);
  for (std::size_t f = 0; f < scene.facets.size(); ++f) {
    std::uint32_t mask = ~0U;
    for (std::uint32_t i = scene.facet_vertex_begin[f]; i < scene.facet_vertex_begin[f + 1]; ++i) {
      mask &= masks[scene.facet_vertices[i]];
    }
    scene.facets[f].origin = origin_of(mask, box);
  }
}

}  // namespace

Scene build_scene(const Polyhedron& polyhedron, const SceneOptions& options, const Monitor& monitor) {
  Scene scene;
  scene.source = polyhedron;
  Polyhedron drawn = polyhedron;
  std::optional<std::array<Rational3, 2>> box;
  const Complex& complex = polyhedron.complex();
  if (complex.has_box() || Scene::selected(complex.volumes[kOuterVolume].mark)) {
    box = options.box ? *options.box : visible_box({&polyhedron, 1});
    drawn = intersect(drawn, make_box((*box)[0], (*box)[1], monitor), monitor);
    scene.box = {rounded((*box)[0]), rounded((*box)[1])};
  }
  if (options.section) {
    const auto& [a, b, c, d] = *options.section;
    if (a == 0 && b == 0 && c == 0) {
      throw InputError("section 0,0,0,d is not a plane: give a,b,c,d with a normal (a,b,c) other than zero");
    }
    drawn = intersect(drawn, make_halfspace(a, b, c, d, true, monitor), monitor);
  }
  SceneBuilder(drawn.complex(), scene, monitor).run();
  if (box || options.section) {
    find_origins(drawn.complex(), cutting_planes(box, options), box.has_value(), scene, monitor);
    if (options.indices) {
      find_items(drawn.complex(), scene, monitor);
    } else {
      forget_items(scene);
    }
  }
  return scene;
}

Scene build_tile_scene(const Polyhedron& tile, const Monitor& monitor) {
  Scene scene;
  scene.source = tile;
  SceneBuilder(tile.complex(), scene, monitor).run();
  return scene;
}

std::optional<std::array<Point, 2>> Scene::bounds() const {
  std::optional<std::array<Point, 2>> result = box;
  for (const SceneVertex& vertex : vertices) {
    if (!result) result = {vertex.position, vertex.position};
    for (std::size_t i = 0; i < 3; ++i) {
      (*result)[0][i] = std::min((*result)[0][i], vertex.position[i]);
      (*result)[1][i] = std::max((*result)[1][i], vertex.position[i]);
    }
  }
  return result;
}

}  // namespace nef::view
