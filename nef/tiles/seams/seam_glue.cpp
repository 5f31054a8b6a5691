// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the whole that lies in a seam is a vertex of a tile there, or the point where edges of tiles on both
// sides of a cut cross: at any other point of a seam all pyramids have a common line, or all are half-spaces. A vertex
// of a tile in a seam need not be one of the tiles beside it, nor of the whole. So all these points are gathered by
// their coordinates, each is looked up in all tiles that hold it, and the overlay on the sphere decides; but for most
// of them, where an edge or a facet was cut, which the maps tell without it. Where tiles have no boundary but their
// walls, neither vertices nor edges of theirs matter: next to what has some, they change along no line that it does
// not change along.
#include "nef/tiles/seams/seam_glue.h"

#include <algorithm>
#include <bit>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/facet_plane.h"
#include "nef/complex/local_pyramid.h"
#include "nef/location/query_structure.h"
#include "nef/operation/canonical_order.h"
#include "nef/sphere_map/overlay.h"
#include "nef/synthesis/complex_builder.h"
#include "nef/tiles/seams/half_rings.h"
#include "nef/tiles/seams/leaf_seam.h"
#include "nef/tiles/seams/point_numbers.h"
#include "nef/tiles/seams/wall_crossings.h"

namespace nef {
namespace {

class SeamGlue {
 public:
  SeamGlue(const TileRef& tree, const Region& region, const Monitor& monitor) : monitor_(monitor) {
    root_ = add(tree, region, Walls{});
  }

  // Fills what the functions below return.
  void run() {
    monitor_.check_interruption();
    parallel_for(leaves_.size(), monitor_, [this](std::size_t i, const Monitor& own) {
      leaves_[i].set = leaf_set(leaves_[i].tree, leaves_[i].region, own);
    });
    name_planes();
    parallel_for_ranges(leaves_.size(), kTogether, monitor_,
                        [this](std::size_t first, std::size_t last, const Monitor&) {
                          SeamReader reader;
                          for (std::size_t i = first; i < last; ++i) {
                            Leaf& leaf = leaves_[i];
                            reader.read(leaf.set.complex(), leaf.rows, rows_of_walls(leaf), leaf);
                          }
                        });
    number_straight_edges();
    number_points();
    find_crossings();
    join_points();
  }

  PlaneTable& planes() { return planes_; }

  // The vertices of the whole that lie in seams, by planes().
  [[nodiscard]] const Complex& of_seams() const { return of_seams_; }

  // Calls body(complex, first, count, rows) for runs of vertices that lie in no seam.
  template <typename Body>
  void for_each_run(std::uint32_t leaf, Body&& body) const {
    const Leaf& l = leaves_[leaf];
    VertexId first{0};
    for (std::size_t k = 0; k <= l.seam.size(); ++k) {
      const VertexId end = k < l.seam.size() ? l.seam[k].vertex : VertexId{count(l)};
      if (first < end) body(l.set.complex(), first, end - first, l.rows);
      first = end.next();
    }
  }

  // The whole as input of canonical_complex.
  [[nodiscard]] std::vector<CanonicalPart> parts() const {
    std::vector<CanonicalPart> result;
    for (const Leaf& leaf : leaves_) result.push_back({&leaf.set.complex(), leaf.rows});
    result.push_back({&of_seams_, {}});
    return result;
  }
  [[nodiscard]] std::vector<CanonicalVertex> vertices() const {
    std::size_t all = of_seams_.vertex_count();
    for (const Leaf& leaf : leaves_) all += count(leaf) - leaf.seam.size();
    std::vector<CanonicalVertex> result;
    result.reserve(all);
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
      for_each_run(i, [&](const Complex&, VertexId first, std::uint32_t number, const auto&) {
        for (const VertexId v : IdRange(first, number)) result.push_back({i, v});
      });
    }
    const auto seams = static_cast<std::uint32_t>(leaves_.size());
    for (const VertexId v : of_seams_.vertex_ids()) result.push_back({seams, v});
    return result;
  }
  [[nodiscard]] std::uint32_t leaf_count() const { return static_cast<std::uint32_t>(leaves_.size()); }

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
  struct Leaf : LeafSeam {
    TileRef tree;
    Region region;
    Walls walls;
    Polyhedron set;
    std::vector<std::uint32_t> rows;  // of its planes in the common table
  };
  struct LeafVertex {
    std::uint32_t leaf = 0;
    VertexId vertex{0};
  };
  // A seam vertex of a leaf.
  struct Member {
    std::uint32_t leaf = 0;
    std::uint32_t seam = 0;
  };

  static std::size_t count(const Leaf& leaf) { return leaf.set.complex().vertex_count(); }

  std::uint32_t add(const TileRef& tree, const Region& region, const Walls& walls) {
    const auto index = static_cast<std::uint32_t>(spots_.size());
    spots_.emplace_back();
    if (tree.node->kind != TileNode::Kind::kCut) {
      spots_[index].leaf = static_cast<std::uint32_t>(leaves_.size());
      Leaf leaf;
      leaf.tree = tree;
      leaf.region = region;
      leaf.walls = walls;
      leaves_.push_back(std::move(leaf));
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

  [[nodiscard]] std::array<std::uint32_t, 6> rows_of_walls(const Leaf& leaf) const {
    std::array<std::uint32_t, 6> rows;
    for (std::size_t wall = 0; wall < 6; ++wall) {
      const std::uint32_t spot = leaf.walls.spot[wall];
      rows[wall] = spot == kNone ? kNone : spots_[spot].plane.row();
    }
    return rows;
  }

  void name_planes() {
    std::size_t planes = planes_.size();
    for (const Leaf& leaf : leaves_) planes += leaf.set.complex().planes.size();
    planes_.reserve(planes);
    for (Leaf& leaf : leaves_) leaf.rows = planes_.intern_all(leaf.set.complex().planes);
  }

  // The spot of the one wall of these.
  static std::uint32_t wall_of(const Leaf& leaf, std::uint8_t walls) {
    return leaf.walls.spot[static_cast<std::size_t>(std::countr_zero(walls))];
  }

  // Where the leaves on both sides of a cut have a cut edge with the same planes, that is one point, around which there
  // are no other leaves: the edge goes on, and the whole has no vertex there. The point gets a number, as an end of
  // edges in the wall, without a look at its coordinates: kStraight and its place in straight_.
  void number_straight_edges() {
    monitor_.check_interruption();
    struct End {
      std::uint64_t planes;  // both
      std::uint32_t leaf;
      std::uint32_t seam;
    };
    std::vector<std::uint32_t> begin(spots_.size() + 1U, 0);  // of the ends in each cut
    const auto for_each_end = [this](const auto& body) {
      for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
        for (const CutEdge& edge : leaves_[i].cut_edges) {
          body(wall_of(leaves_[i], leaves_[i].seam[edge.seam].walls),
               End{std::uint64_t{edge.planes[0]} << 32U | edge.planes[1], i, edge.seam});
        }
      }
    };
    for_each_end([&begin](std::uint32_t spot, const End&) { ++begin[spot + 1U]; });
    for (std::size_t spot = 0; spot < spots_.size(); ++spot) begin[spot + 1U] += begin[spot];
    std::vector<End> ends(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each_end([&](std::uint32_t spot, const End& end) { ends[next[spot]++] = end; });
    for (Leaf& leaf : leaves_) leaf.cut_edges = {};
    parallel_for(spots_.size(), monitor_, [&](std::size_t spot, const Monitor&) {
      std::sort(ends.begin() + begin[spot], ends.begin() + begin[spot + 1U],
                [](const End& a, const End& b) { return a.planes < b.planes; });
    });
    for (std::size_t spot = 0; spot < spots_.size(); ++spot) {
      for (std::uint32_t k = begin[spot]; k < begin[spot + 1U]; ++k) {
        Leaf& leaf = leaves_[ends[k].leaf];
        SeamVertex& one = leaf.seam[ends[k].seam];
        if (k + 1U < begin[spot + 1U] && ends[k + 1U].planes == ends[k].planes) {
          SeamVertex& other = leaves_[ends[k + 1U].leaf].seam[ends[k + 1U].seam];
          one.straight = other.straight = true;
          one.point = other.point = kStraight | static_cast<std::uint32_t>(straight_.size());
          straight_.push_back({ends[k].leaf, one.vertex});
          ++k;
        }
      }
    }
  }

  // Where the coordinates of a point of a seam are.
  [[nodiscard]] PointRef point(std::uint32_t number) const {
    if ((number & kStraight) == 0) return {&points_.table(), PointId{number}};
    const LeafVertex& at = straight_[number & ~kStraight];
    return {&leaves_[at.leaf].set.complex().points, point_of(at.vertex)};
  }

  void number_points() {
    monitor_.check_interruption();
    PointTable one;
    Integer divisor;
    for (Leaf& leaf : leaves_) {
      const PointTable& own = leaf.set.complex().points;
      for (SeamVertex& s : leaf.seam) {
        if (!s.joins()) continue;
        const PointId point = point_of(s.vertex);
        if (own.is_reduced(point, divisor)) {
          s.point = points_.number(own, point);
        } else {
          s.point = points_.number(one, one.push_reduced(own, point));
          one.pop();
        }
      }
    }
  }

  void find_crossings() {
    std::vector<std::uint32_t> begin(spots_.size() + 1U, 0);  // of the edges in each cut
    for (const Leaf& leaf : leaves_) {
      for (const LeafEdge& edge : leaf.edges) ++begin[leaf.walls.spot[edge.wall] + 1U];
    }
    for (std::size_t spot = 0; spot < spots_.size(); ++spot) begin[spot + 1U] += begin[spot];
    std::vector<WallEdge> edges(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
      Leaf& leaf = leaves_[i];
      for (const LeafEdge& edge : leaf.edges) {
        const std::uint32_t a = leaf.seam[edge.seam[0]].point;
        const std::uint32_t b = leaf.seam[edge.seam[1]].point;
        edges[next[leaf.walls.spot[edge.wall]]++] = {
            {std::min(a, b), std::max(a, b)}, edge.wall % 2 == 0, i, edge.halfedge};
      }
      leaf.edges = {};
    }
    std::vector<std::vector<PlaneTriple>> crossings(spots_.size());
    parallel_for(spots_.size(), monitor_, [&](std::size_t spot, const Monitor& own) {
      const PlaneId cut = spots_[spot].plane;
      if (!cut.valid()) return;
      crossings[spot] = wall_crossings(
          planes_, cut, std::span(edges).subspan(begin[spot], begin[spot + 1U] - begin[spot]), own,
          [this](std::uint32_t number) { return point(number); },
          [&](const WallEdge& edge) { return other_plane(cut, edge, own); });
    });
    crossing_.assign(points_.table().size(), false);
    for (const std::vector<PlaneTriple>& some : crossings) {
      for (const PlaneTriple& planes : some) {
        PointTable crossing;
        const auto point = crossing.push_intersection(planes_, planes[0], planes[1], planes[2]);
        NEF_ASSERT(point.has_value());
        PointTable reduced;
        reduced.push_reduced(crossing, *point);
        const std::uint32_t number = points_.number(reduced, PointId{0});
        crossing_.resize(points_.table().size(), false);
        crossing_[number] = true;
      }
    }
  }

  // The plane other than that of the wall that holds the edge.
  [[nodiscard]] PlaneId other_plane(PlaneId wall, const WallEdge& edge, const Monitor& own) const {
    const Leaf& leaf = leaves_[edge.leaf];
    SVertex svertex = leaf.set.complex().svertex(edge.halfedge);
    svertex.p = renamed(leaf, svertex.p);
    svertex.q = renamed(leaf, svertex.q);
    return edge_side(planes_, wall, svertex, own).other;
  }

  static PlaneId renamed(const Leaf& leaf, PlaneId plane) { return plane.in_row(leaf.rows[plane.row()]); }

  // Puts the pyramids together at every point of a seam.
  void join_points() {
    const auto count = static_cast<std::uint32_t>(points_.table().size());
    std::vector<std::uint32_t> begin(count + 1U, 0);  // of the members of each point
    for (const Leaf& leaf : leaves_) {
      for (const SeamVertex& s : leaf.seam) {
        if (s.joins()) ++begin[s.point + 1U];
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) begin[i + 1U] += begin[i];
    std::vector<Member> members(begin.back());
    std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
      for (std::uint32_t k = 0; k < leaves_[i].seam.size(); ++k) {
        if (const SeamVertex& s = leaves_[i].seam[k]; s.joins()) members[end[s.point]++] = {i, k};
      }
    }
    constexpr std::uint32_t kChunk = 1024;
    std::vector<Complex> joined((count + kChunk - 1) / kChunk);
    monitor_.check_interruption();
    parallel_for(joined.size(), monitor_, [&](std::size_t chunk, const Monitor& own) {
      Joiner joiner(*this, own);
      const auto first = static_cast<std::uint32_t>(chunk * kChunk);
      for (std::uint32_t point = first; point < std::min(count, first + kChunk); ++point) {
        const std::uint32_t size = begin[point + 1U] - begin[point];
        if (size > 0 || crossing_[point]) joiner.join(PointId{point}, std::span(members).subspan(begin[point], size));
      }
      joined[chunk] = joiner.take();
    });
    ComplexBuilder builder(planes_, monitor_);
    for (const Complex& some : joined) builder.copy(some);
    of_seams_ = builder.take_so_far();
  }

  // Writes the vertices of the whole at points of seams. One for each thread.
  class Joiner {
   public:
    Joiner(SeamGlue& glue, const Monitor& monitor) : glue_(glue), monitor_(monitor), builder_(glue.planes_, monitor) {}

    void join(PointId point, std::span<const Member> members) {
      if (!glue_.crossing_[point.index()] && inside_facet(members)) return;
      if (join_halves(point, members)) return;
      holding_.clear();
      find_leaves(point, glue_.root_);
      NEF_ASSERT(holding_.size() > 1);
      bool first = true;
      for (const std::uint32_t leaf : holding_) {
        const auto member =
            std::find_if(members.begin(), members.end(), [leaf](const Member& m) { return m.leaf == leaf; });
        load(leaf, point, member == members.end() ? VertexId() : glue_.leaves_[leaf].seam[member->seam].vertex,
             first ? joined_ : next_);
        if (!first) {
          overlay_.overlay(glue_.planes_, joined_.view(), next_.view(), whichever_, result_, monitor_);
          std::swap(joined_, result_);
        }
        first = false;
      }
      builder_.add(glue_.points_.table(), point, joined_.view());
    }

    Complex take() { return builder_.take_so_far(); }

   private:
    // A ring that one wall cuts: no other leaves are around the point.
    bool join_halves(PointId point, std::span<const Member> members) {
      if (members.size() != 2) return false;
      std::array<std::uint32_t, 2> spot{};
      for (std::size_t k = 0; k < 2; ++k) {
        const Leaf& leaf = glue_.leaves_[members[k].leaf];
        const std::uint8_t walls = leaf.seam[members[k].seam].walls;
        if (!std::has_single_bit(walls)) return false;
        spot[k] = wall_of(leaf, walls);
      }
      if (spot[0] != spot[1]) return false;
      for (std::size_t k = 0; k < 2; ++k) {
        const VertexId vertex = glue_.leaves_[members[k].leaf].seam[members[k].seam].vertex;
        load(members[k].leaf, point, vertex, k == 0 ? joined_ : next_);
      }
      const std::uint32_t wall = glue_.spots_[spot[0]].plane.row();
      if (!half_rings_.join(glue_.planes_, wall, joined_.view(), next_.view(), result_, monitor_)) return false;
      builder_.add(glue_.points_.table(), point, result_.view());
      return true;
    }

    // A facet that was cut along several walls.
    [[nodiscard]] bool inside_facet(std::span<const Member> members) const {
      if (members.empty()) return false;
      const FacetInside* facet = facet_at(members[0]);
      return facet != nullptr && std::all_of(members.begin() + 1, members.end(), [&](const Member& member) {
               const FacetInside* other = facet_at(member);
               return other != nullptr && *other == *facet;
             });
    }

    // Null if it is something else.
    [[nodiscard]] const FacetInside* facet_at(const Member& member) const {
      const Leaf& leaf = glue_.leaves_[member.leaf];
      const std::uint32_t facet = leaf.seam[member.seam].facet;
      return facet == kNone ? nullptr : &leaf.facets[facet];
    }

    // The leaves that hold a point.
    void find_leaves(PointId point, std::uint32_t spot) {
      const Spot& at = glue_.spots_[spot];
      if (!at.plane.valid()) {
        holding_.push_back(at.leaf);
        return;
      }
      const int side = side_of_plane(glue_.planes_, at.plane, glue_.points_.table(), point, monitor_);
      if (side <= 0) find_leaves(point, at.low);
      if (side >= 0) find_leaves(point, at.high);
    }

    // The local pyramid in a leaf, by common planes.
    void load(std::uint32_t index, PointId point, VertexId vertex, SphereMapBuffer& out) const {
      const Leaf& leaf = glue_.leaves_[index];
      const Complex& c = leaf.set.complex();
      if (!vertex.valid()) {
        const ItemRef item = leaf.set.queries().item_at(c, {&glue_.points_.table(), point}, monitor_);
        NEF_ASSERT(item.valid());  // a wall if nothing else
        pyramid_of(c, item, out);
      } else {
        out.assign(c.sphere_map(vertex));
      }
      for_each_plane(out, [&leaf](PlaneId& plane) { plane = renamed(leaf, plane); });
    }

    const SeamGlue& glue_;
    Monitor monitor_;
    ComplexBuilder builder_;
    std::vector<std::uint32_t> holding_;
    HalfRings half_rings_;
    SphereOverlay overlay_;
    LabelFunction whichever_{LabelFunction::WhicheverIsInside{}};
    SphereMapBuffer joined_, next_, result_;
  };

  static constexpr std::size_t kTogether = 32;             // leaves of a task
  static constexpr std::uint32_t kStraight = 0x80000000U;  // in the number of a point where an edge goes on

  Monitor monitor_;
  std::vector<Spot> spots_;
  std::vector<Leaf> leaves_;
  std::uint32_t root_ = 0;
  PlaneTable planes_;
  PointNumbers points_;               // of seams, where a vertex of the whole may be
  std::vector<LeafVertex> straight_;  // one of each two where an edge goes on
  std::vector<bool> crossing_;        // of these: edges of tiles on both sides of a cut cross there
  Complex of_seams_;
};

}  // namespace

Polyhedron glue_tiles(const TileRef& tree, const Region& region, const Monitor& monitor) {
  if (tree.node->kind != TileNode::Kind::kCut) return leaf_set(tree, region, monitor);
  SeamGlue glue(tree, region, monitor);
  glue.run();
  ComplexBuilder builder(glue.planes(), monitor);
  for (std::uint32_t i = 0; i < glue.leaf_count(); ++i) {
    glue.for_each_run(i, [&](const Complex& c, VertexId first, std::uint32_t count, const auto& rows) {
      builder.copy(c, first, count, rows);
    });
  }
  builder.copy(glue.of_seams());
  return Polyhedron(builder.finish(kOutside));
}

Polyhedron glue_all_tiles(const TileRef& tree, const Monitor& monitor) {
  if (tree.node->kind != TileNode::Kind::kCut) return in_canonical_order(leaf_set(tree, Region{}, monitor), monitor);
  SeamGlue glue(tree, Region{}, monitor);
  glue.run();
  return Polyhedron(canonical_complex(std::move(glue.planes()), glue.parts(), glue.vertices(), kOutside, monitor));
}

}  // namespace nef
