// SPDX-License-Identifier: Apache-2.0
//
// A vertex lies in a wall if one of its planes is the wall's, since what is beyond a wall is marked kOutside. What the
// seam needs of such a vertex depends on its pattern and on which of its planes are walls, so it is found once for each
// pattern and kept while the mask stays the same. O(n), with a few comparisons for each vertex.
#include "nef/tiles/seams/leaf_seam.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "nef/tiles/seams/cut_items.h"
#include "nef/tiles/tile_tree.h"

namespace nef {

// What patterns of a leaf say, found when it is first asked for.
class SeamReader::Patterns {
 public:
  // The patterns of another leaf.
  void set(const PatternTable& patterns) {
    patterns_ = &patterns;
    of_.assign(patterns.size(), OfPattern());
    std::size_t svertices = 0;
    for (std::uint32_t i = 0; i < patterns.size(); ++i) {
      of_[i].svertices = svertices;
      svertices += patterns.svertices(PatternId{i}).size();
    }
    edge_.assign(svertices, kUnknown);
  }

  // has_boundary of a map without sloops.
  bool has_boundary(PatternId pattern) {
    std::uint8_t& known = of_[pattern.index()].boundary;
    if (known == kUnknown) known = nef::has_boundary(patterns_->view(pattern)) ? 1 : 0;
    return known != 0;
  }

  // facets_of_cut_edge and cut_facet, for a mask that is the same for nearly all vertices of a pattern.
  std::uint64_t facets_of_cut_edge(PatternId pattern, std::uint64_t in_wall) { return cut(pattern, in_wall).edge; }
  const std::optional<CutFacet>& cut_facet(PatternId pattern, std::uint64_t in_wall) {
    return cut(pattern, in_wall).facet;
  }

  // True if not all marks around the edge of an svertex are the same, kOutside left out.
  bool edge_has_boundary(PatternId pattern, std::uint32_t svertex) {
    std::uint8_t& known = edge_[of_[pattern.index()].svertices + svertex];
    if (known == kUnknown) known = find_boundary(patterns_->view(pattern), svertex) ? 1 : 0;
    return known != 0;
  }

 private:
  static constexpr std::uint8_t kUnknown = 2;
  struct OfPattern {
    std::size_t svertices = 0;  // of the patterns before
    std::uint64_t in_wall = 0;  // asked about last; none is never asked about
    std::uint64_t edge = 0;
    std::optional<CutFacet> facet;
    std::uint8_t boundary = kUnknown;
  };

  const OfPattern& cut(PatternId pattern, std::uint64_t in_wall) {
    OfPattern& known = of_[pattern.index()];
    if (known.in_wall != in_wall) {
      known.in_wall = in_wall;
      known.edge = nef::facets_of_cut_edge(patterns_->view(pattern), in_wall);
      known.facet = nef::cut_facet(patterns_->view(pattern), in_wall);
    }
    return known;
  }

  static bool find_boundary(const SphereMapView& map, std::uint32_t svertex) {
    const SVertex edge = map.svertices[svertex];
    if (edge.out == kNone) return true;
    std::uint32_t e = edge.out;
    do {
      const LabelId side = map.sfaces[map.shalfedges[e].sface].mark;
      if (map.shalfedges[e].mark != edge.mark || (side != edge.mark && side != kOutside)) return true;
      e = map.next_around(e);
    } while (e != edge.out);
    return false;
  }

  const PatternTable* patterns_ = nullptr;
  std::vector<OfPattern> of_;
  std::vector<std::uint8_t> edge_;  // of the svertices of all patterns
};

class SeamReader::State {
 public:
  void read(const Complex& c, std::span<const std::uint32_t> rows, const std::array<std::uint32_t, 6>& walls,
            LeafSeam& leaf) {
    rows_ = rows;
    find_walls_of_planes(walls);
    find_seam(c, leaf);
    patterns_.set(c.patterns);
    leaf.cut_edges.reserve(leaf.seam.size());
    for (std::uint32_t index = 0; index < leaf.seam.size(); ++index) read_vertex(c, leaf, index);
    leaf.edges.reserve(leaf.seam.size());
    for (const SeamVertex& s : leaf.seam) {
      if (s.point != kNone) read_edges(c, leaf, s);
    }
  }

 private:
  // The walls that lie in each plane, a bit for each.
  void find_walls_of_planes(const std::array<std::uint32_t, 6>& walls) {
    walls_of_plane_.assign(rows_.size(), 0);
    for (unsigned wall = 0; wall < 6; ++wall) {
      if (walls[wall] == kNone) continue;
      const auto at = std::find(rows_.begin(), rows_.end(), walls[wall]);
      if (at != rows_.end()) walls_of_plane_[static_cast<std::size_t>(at - rows_.begin())] |= 1U << wall;
    }
  }

  // The walls that vertices lie in. Beyond a wall is kOutside, so that it is a plane of the sphere maps of all
  // vertices in it.
  void find_seam(const Complex& c, LeafSeam& leaf) {
    at_.resize(c.vertex_count());
    leaf.seam.reserve(c.vertex_count());
    for (const VertexId v : c.vertex_ids()) {
      std::uint8_t walls = 0;
      for (const PlaneId plane : c.planes_of_pairs(v)) walls |= walls_of_plane_[plane.row()];
      const VertexRecord& begin = c.vertices[v];
      const VertexRecord& end = c.vertices[v.next()];
      for (std::uint32_t l = begin.sloops; l < end.sloops; ++l) walls |= walls_of_plane_[c.sloops[l].plane.row()];
      at_[v] = {static_cast<std::uint32_t>(leaf.seam.size()), walls};
      if (walls != 0) leaf.seam.push_back({v, kNone, walls});
    }
  }

  void read_vertex(const Complex& c, LeafSeam& leaf, std::uint32_t index) {
    SeamVertex& s = leaf.seam[index];
    const bool has_sloops = c.vertices[s.vertex].sloops != c.vertices[s.vertex.next()].sloops;
    const PatternId pattern = c.vertices.pattern(s.vertex);
    if (!(has_sloops ? has_boundary(c.sphere_map(s.vertex)) : patterns_.has_boundary(pattern))) return;
    s.point = 0;  // it will get one
    const std::uint64_t in_wall = has_sloops ? 0 : pairs_in_walls(c, s.vertex);
    if (in_wall == 0) return;
    if (std::has_single_bit(s.walls)) {
      if (const auto planes = two_planes(c, s.vertex, patterns_.facets_of_cut_edge(pattern, in_wall))) {
        leaf.cut_edges.push_back({index, *planes});
      }
    } else if (const std::optional<CutFacet>& facet = patterns_.cut_facet(pattern, in_wall)) {
      s.facet = static_cast<std::uint32_t>(leaf.facets.size());
      leaf.facets.push_back(inside(c, s.vertex, *facet));
    }
  }

  // The pairs of shalfedges of a vertex that lie in walls, a bit for each; none if there are many.
  [[nodiscard]] std::uint64_t pairs_in_walls(const Complex& c, VertexId v) const {
    const std::span<const PlaneId> planes = c.planes_of_pairs(v);
    if (planes.size() > 64) return 0;
    std::uint64_t in_wall = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (walls_of_plane_[planes[i].row()] != 0) in_wall |= std::uint64_t{1} << i;
    }
    return in_wall;
  }

  // The two smallest planes of some pairs of a vertex, if there are two.
  [[nodiscard]] std::optional<std::array<std::uint32_t, 2>> two_planes(const Complex& c, VertexId v,
                                                                       std::uint64_t pairs) const {
    const std::span<const PlaneId> planes = c.planes_of_pairs(v);
    std::array<std::uint32_t, 2> smallest{kNone, kNone};
    for (; pairs != 0; pairs &= pairs - 1) {
      const std::uint32_t row = rows_[planes[static_cast<std::size_t>(std::countr_zero(pairs))].row()];
      if (row < smallest[0]) {
        smallest = {row, smallest[0]};
      } else if (row != smallest[0]) {
        smallest[1] = std::min(smallest[1], row);
      }
    }
    if (smallest[1] == kNone) return std::nullopt;
    return smallest;
  }

  [[nodiscard]] FacetInside inside(const Complex& c, VertexId v, const CutFacet& facet) const {
    const PlaneId plane = c.planes_of_pairs(v)[facet.shalfedge / 2];
    const std::uint32_t row = rows_[plane.row()];
    if (plane.flipped() != (facet.shalfedge % 2 != 0)) return {row, facet.mark, facet.right, facet.left};
    return {row, facet.mark, facet.left, facet.right};
  }

  // Each edge in walls is met at both ends, and is its smaller halfedge's.
  void read_edges(const Complex& c, LeafSeam& leaf, const SeamVertex& s) {
    const IdRange<HalfedgeId> halfedges = c.halfedges(s.vertex);
    for (const HalfedgeId h : halfedges) {
      if (c.twin[h] < h) continue;
      const Place& target = at_[c.target(h)];
      const unsigned common = s.walls & target.walls;
      if (common == 0) continue;
      if (!patterns_.edge_has_boundary(c.vertices.pattern(s.vertex), halfedges.position(h))) continue;
      for (std::uint32_t wall = 0; wall < 6; ++wall) {
        if ((common >> wall & 1U) != 0) leaf.edges.push_back({wall, {at_[s.vertex].seam, target.seam}, h});
      }
    }
  }

  struct Place {
    std::uint32_t seam = 0;  // its number among seam vertices, or the next one's
    std::uint8_t walls = 0;
  };

  Patterns patterns_;
  std::vector<std::uint8_t> walls_of_plane_;
  IndexedVector<VertexId, Place> at_;  // of the leaf at hand, as are the lines around
  std::span<const std::uint32_t> rows_;
};

SeamReader::SeamReader() : state_(std::make_unique<State>()) {}

SeamReader::~SeamReader() = default;

void SeamReader::read(const Complex& leaf, std::span<const std::uint32_t> rows,
                      const std::array<std::uint32_t, 6>& walls, LeafSeam& seam) {
  state_->read(leaf, rows, walls, seam);
}

}  // namespace nef
