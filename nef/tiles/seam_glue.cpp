// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the whole that lies in a seam is a vertex of a tile there, or the point where edges of tiles on both
// sides of a cut cross: at any other point of a seam all pyramids have a common line, or all are half-spaces. A vertex
// of a tile in a seam need not be one of the tiles beside it, nor of the whole. So all these points are gathered by
// their coordinates, each is looked up in all tiles that hold it, and the overlay on the sphere decides.
#include "nef/tiles/seam_glue.h"

#include <algorithm>
#include <unordered_map>

#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/complex/facet_plane.h"
#include "nef/complex/local_pyramid.h"
#include "nef/geometry/box_tree.h"
#include "nef/location/query_structure.h"
#include "nef/operation/canonical_order.h"
#include "nef/sphere_map/overlay.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

void append_reduced(const PointTable& from, PointId point, PointTable& to) {
  std::array<Integer, 7> h;
  Integer divisor;
  for (std::size_t i = 0; i < 7; ++i) {
    mpz_set(h[i].get_mpz_t(), from.coordinate(point, i));
    mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), h[i].get_mpz_t());
  }
  for (Integer& value : h) mpz_divexact(value.get_mpz_t(), value.get_mpz_t(), divisor.get_mpz_t());
  to.push_homogeneous(h);
}

class SeamGlue {
 public:
  explicit SeamGlue(const TileRef& tree, const Region& region) { root_ = add(tree, region, Walls{}); }

  // Into the builder, whose planes are `planes`.
  void run(ComplexBuilder& builder) {
    std::size_t vertices = 0;
    std::size_t planes = planes_.size();
    VertexRecord items;
    for (const Leaf& leaf : leaves_) {
      planes += leaf.set.complex().planes.size();
      const VertexRecord& own = leaf.set.complex().vertices.back();
      vertices += leaf.set.complex().vertex_count();
      items.svertices += own.svertices;
      items.shalfedges += own.shalfedges;
      items.sloops += own.sloops;
      items.sfaces += own.sfaces;
      items.entries += own.entries;
    }
    builder.reserve(vertices, items);
    planes_.reserve(planes);
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) take_leaf(i, builder);
    find_crossings();
    std::sort(members_.begin(), members_.end());
    std::size_t first = 0;
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
      std::size_t last = first;
      while (last < members_.size() && members_[last].point == point) ++last;
      join(PointId{point}, std::span(members_).subspan(first, last - first), builder);
      first = last;
    }
  }

  PlaneTable& planes() { return planes_; }

 private:
  // A cut or a leaf of the tree.
  struct Spot {
    PlaneId plane;  // invalid for a leaf
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t leaf = 0;
  };
  // The cuts that bound a region, as spots; kNone where none of the tree does.
  struct Walls {
    std::array<std::uint32_t, 6> spot{kNone, kNone, kNone, kNone, kNone, kNone};  // 2 * axis + (1 for the upper one)
  };
  struct Leaf {
    Polyhedron set;
    Walls walls;
    std::vector<std::uint32_t> rows;  // of its planes in the common table
  };
  // A vertex of a leaf at a point of a seam.
  struct Member {
    std::uint32_t point;
    std::uint32_t leaf;
    std::uint32_t vertex;
    auto operator<=>(const Member&) const = default;
  };
  // An edge of a leaf in a wall.
  struct WallEdge {
    std::array<std::uint32_t, 2> points;  // ascending
    bool above = false;                   // its leaf lies above the wall
    std::uint32_t leaf = 0;
    std::uint32_t halfedge = 0;
    [[nodiscard]] auto key() const { return std::pair(points, above); }
  };

  std::uint32_t add(const TileRef& tree, const Region& region, const Walls& walls) {
    const auto index = static_cast<std::uint32_t>(spots_.size());
    spots_.emplace_back();
    edges_.emplace_back();
    if (tree.node->kind != TileNode::Kind::kCut) {
      spots_[index].leaf = static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back({leaf_set(tree, region), walls, {}});
      return index;
    }
    const AxisPlane& plane = tree.node->plane;
    spots_[index].plane = plane.intern(planes_);
    const std::array<TileRef, 2> parts = children(tree);
    Walls below = walls;
    below.spot[2 * plane.axis + 1] = index;
    Walls above = walls;
    above.spot[2 * plane.axis] = index;
    const std::uint32_t low = add(parts[0], region.below(plane), below);
    const std::uint32_t high = add(parts[1], region.above(plane), above);
    spots_[index].low = low;
    spots_[index].high = high;
    return index;
  }

  // Copies what lies in no seam and notes the rest.
  void take_leaf(std::uint32_t index, ComplexBuilder& builder) {
    check_interruption();
    Leaf& leaf = leaves_[index];
    const Complex& c = leaf.set.complex();
    for (std::uint32_t row = 0; row < c.planes.size(); ++row) {
      leaf.rows.push_back(planes_.intern_from(c.planes, PlaneId{row << 1U}).row());
    }
    const auto count = static_cast<std::uint32_t>(c.vertex_count());
    std::vector<std::uint8_t> on(count, 0);  // a bit for each wall
    for (unsigned wall = 0; wall < 6; ++wall) {
      if (leaf.walls.spot[wall] == kNone) continue;
      const PlaneId plane = spots_[leaf.walls.spot[wall]].plane;
      for (std::uint32_t v = 0; v < count; ++v) {
        if (side_of_plane(planes_, plane, c.points, PointId{v}) == 0) on[v] |= static_cast<std::uint8_t>(1U << wall);
      }
    }
    std::vector<std::uint32_t> point(count, kNone);
    for (std::uint32_t v = 0; v < count;) {
      std::uint32_t end = v + 1;
      if (on[v] != 0) {
        point[v] = point_at(c.points, PointId{v});
        members_.push_back({point[v], index, v});
      } else {
        while (end < count && on[end] == 0) ++end;
        builder.copy(c, v, end - v, leaf.rows);
      }
      v = end;
    }
    for (std::uint32_t h = 0; h < c.svertices.size(); ++h) {
      const std::uint32_t source = c.svertex_owner[h];
      const std::uint32_t target = c.target(h);
      const unsigned common = on[source] & on[target];
      if (common == 0 || c.twin[h] < h) continue;
      for (unsigned wall = 0; wall < 6; ++wall) {
        if ((common >> wall & 1U) == 0) continue;
        edges_[leaf.walls.spot[wall]].push_back(
            {{std::min(point[source], point[target]), std::max(point[source], point[target])},
             wall % 2 == 0,
             index,
             h});
      }
    }
  }

  // The number of a point among those of seams.
  std::uint32_t point_at(const PointTable& from, PointId point) {
    append_reduced(from, point, points_);
    const PointId last{points_.size() - 1};
    const auto [begin, end] = known_points_.equal_range(points_.hash(last));
    for (auto at = begin; at != end; ++at) {
      if (!points_.identical(PointId{at->second}, last)) continue;
      points_.pop();
      return at->second;
    }
    known_points_.emplace(points_.hash(last), last.index());
    return last.index();
  }

  void find_crossings() {
    for (std::uint32_t spot = 0; spot < spots_.size(); ++spot) {
      if (spots_[spot].plane.valid()) cross_edges(spots_[spot].plane, edges_[spot]);
    }
  }

  // An edge that both sides have is crossed by none of either side.
  void cross_edges(PlaneId plane, std::vector<WallEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const WallEdge& a, const WallEdge& b) { return a.key() < b.key(); });
    std::array<std::vector<WallEdge>, 2> alone;
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i;
      bool matched = false;
      while (end < edges.size() && edges[end].points == edges[i].points) {
        matched = matched || edges[end].above != edges[i].above;
        ++end;
      }
      if (!matched) alone[edges[i].above ? 1 : 0].push_back(edges[i]);
      i = end;
    }
    if (alone[0].empty() || alone[1].empty()) return;
    std::vector<Box> boxes;
    for (const WallEdge& edge : alone[1]) boxes.push_back(box_of(edge));
    const BoxTree tree(boxes);
    for (const WallEdge& edge : alone[0]) {
      tree.for_each_overlap(box_of(edge), [&](std::uint32_t i) { cross(plane, edge, alone[1][i]); });
    }
  }

  [[nodiscard]] Box box_of(const WallEdge& edge) const {
    Box box;
    for (const std::uint32_t point : edge.points) box.add_rounded(points_.approximate(PointId{point}));
    return box;
  }

  // The plane other than that of the wall that holds the edge.
  [[nodiscard]] PlaneId other_plane(PlaneId wall, const WallEdge& edge) const {
    const Leaf& leaf = leaves_[edge.leaf];
    SVertex svertex = leaf.set.complex().svertices[edge.halfedge];
    svertex.p = renamed(leaf, svertex.p);
    svertex.q = renamed(leaf, svertex.q);
    return edge_side(planes_, wall, svertex).other;
  }

  void cross(PlaneId wall, const WallEdge& a, const WallEdge& b) {
    const auto apart = [this](PlaneId plane, const WallEdge& edge) {
      return side_of_plane(planes_, plane, points_, PointId{edge.points[0]}) *
                 side_of_plane(planes_, plane, points_, PointId{edge.points[1]}) <
             0;
    };
    const PlaneId of_a = other_plane(wall, a);
    if (!apart(of_a, b)) return;
    const PlaneId of_b = other_plane(wall, b);
    if (!apart(of_b, a)) return;
    PointTable crossing;
    const auto point = crossing.push_intersection(planes_, wall, of_a, of_b);
    NEF_ASSERT(point.has_value());
    point_at(crossing, *point);
  }

  static PlaneId renamed(const Leaf& leaf, PlaneId plane) {
    return PlaneId{leaf.rows[plane.row()] << 1U | (plane.value & 1U)};
  }

  // The leaves that hold a point.
  void find_leaves(PointId point, std::uint32_t spot) {
    const Spot& at = spots_[spot];
    if (!at.plane.valid()) {
      holding_.push_back(at.leaf);
      return;
    }
    const int side = side_of_plane(planes_, at.plane, points_, point);
    if (side <= 0) find_leaves(point, at.low);
    if (side >= 0) find_leaves(point, at.high);
  }

  void join(PointId point, std::span<const Member> members, ComplexBuilder& builder) {
    holding_.clear();
    find_leaves(point, root_);
    NEF_ASSERT(holding_.size() > 1);
    bool first = true;
    for (const std::uint32_t leaf : holding_) {
      const auto member =
          std::find_if(members.begin(), members.end(), [leaf](const Member& m) { return m.leaf == leaf; });
      load(leaf, point, member == members.end() ? kNone : member->vertex, first ? joined_ : next_);
      if (!first) {
        overlay_.overlay(planes_, joined_.view(), next_.view(), whichever_, result_);
        std::swap(joined_, result_);
      }
      first = false;
    }
    builder.add(points_, point, joined_.view());
  }

  // The local pyramid in a leaf, by common planes.
  void load(std::uint32_t index, PointId point, std::uint32_t vertex, SphereMapBuffer& out) const {
    const Leaf& leaf = leaves_[index];
    const Complex& c = leaf.set.complex();
    if (vertex == kNone) {
      const auto hit = leaf.set.queries().item_at(c, {&points_, point});
      NEF_ASSERT(hit.has_value());  // a wall if nothing else
      NEF_ASSERT(hit->kind != ComplexHit::Kind::kVertex);
      if (hit->kind == ComplexHit::Kind::kEdge) {
        const std::uint32_t owner = c.svertex_owner[hit->index];
        edge_pyramid(c.sphere_map(owner), hit->index - c.vertices[owner].svertices, out);
      } else {
        const Facet& facet = c.facets[facet_of(hit->halffacet())];
        out.assign_circle(facet.plane, facet.mark, c.volumes[facet.volume_above].mark,
                          c.volumes[facet.volume_below].mark);
      }
    } else {
      out.assign(c.sphere_map(vertex));
    }
    for_each_plane(out, [&leaf](PlaneId& plane) { plane = renamed(leaf, plane); });
  }

  std::vector<Spot> spots_;
  std::vector<std::vector<WallEdge>> edges_;  // by spot
  std::vector<Leaf> leaves_;
  std::uint32_t root_ = 0;
  PlaneTable planes_;
  PointTable points_;  // of seams
  std::unordered_multimap<std::uint64_t, std::uint32_t> known_points_;
  std::vector<Member> members_;
  // Scratch of join.
  std::vector<std::uint32_t> holding_;
  SphereOverlay overlay_;
  LabelFunction whichever_{LabelFunction::WhicheverIsInside{}};
  SphereMapBuffer joined_, next_, result_;
};

}  // namespace

Polyhedron glue_tiles(const TileRef& tree, const Region& region) {
  if (tree.node->kind != TileNode::Kind::kCut) return leaf_set(tree, region);
  SeamGlue glue(tree, region);
  ComplexBuilder builder(glue.planes());
  glue.run(builder);
  return Polyhedron(builder.finish(kOutside));
}

Polyhedron glue_all_tiles(const TileRef& tree) {
  if (tree.node->kind != TileNode::Kind::kCut) return in_canonical_order(leaf_set(tree, Region{}));
  SeamGlue glue(tree, Region{});
  ComplexBuilder builder(glue.planes());
  glue.run(builder);
  const Complex vertices = builder.take_so_far();
  return Polyhedron(canonical_complex(std::move(glue.planes()), vertices, kOutside));
}

}  // namespace nef
