// SPDX-License-Identifier: Apache-2.0
//
// Three kinds of sums, each found by exact signs: a facet with the peaks and parallel edges that it touches, two
// parallel facets (by `planar_sum`; where marks differ, their convex pieces are added pair by pair, and their sides and
// corners, if the marks inside of these sums differ, too), and two convex edges whose arcs of normals cross on the
// sphere (a parallelogram). They are found on several threads, in lists by the order of the features, so that the
// result does not depend on the threads (`numbered_facets`).
#include "apps/minkowski/convolution/facets/convolution_facets.h"

#include <algorithm>
#include <utility>

#include "apps/minkowski/convolution/facets/convex_pieces.h"
#include "apps/minkowski/convolution/facets/facet_list.h"
#include "apps/minkowski/convolution/facets/numbered_facets.h"
#include "apps/minkowski/convolution/facets/polygon_sum.h"
#include "apps/minkowski/planar/planar_sum.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/integer_vector.h"

#include "nef/geometry/vectors.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

// How a plane with this normal is looked at from outside.
PlanarFrame frame_across(const Integer3& n) {
  PlanarFrame frame;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(n[i]) > abs(n[frame.axis])) frame.axis = i;
  }
  frame.sign = sgn(n[frame.axis]);
  return frame;
}

// The rings of a facet; only its piece, if there is just one.
bool is_polygon(const SolidFacet& facet) { return facet.pieces.size() == 1 || !facet.rings.empty(); }

template <typename Visit>
void for_each_ring(const SolidFacet& facet, Visit&& visit) {
  if (facet.pieces.size() == 1) return visit(facet.pieces[0].ring);
  for (const std::vector<std::uint32_t>& ring : facet.rings) visit(ring);
}

// Vertices in the order of the corners of polygon_of.
std::vector<std::uint32_t> vertices_around(const SolidFacet& facet) {
  std::vector<std::uint32_t> result;
  for_each_ring(facet,
                [&](const std::vector<std::uint32_t>& ring) { result.insert(result.end(), ring.begin(), ring.end()); });
  return result;
}

PlanarPolygon polygon_of(const SolidFeatures& solid, const SolidFacet& facet) {
  PlanarPolygon result;
  for_each_ring(facet, [&](const std::vector<std::uint32_t>& ring) {
    for (const std::uint32_t v : ring) result.corners.push_back(solid.points()[v]);
    result.ring_end.push_back(static_cast<std::uint32_t>(result.corners.size()));
  });
  return result;
}

// The boxes of the features of a solid; the trees give those whose sum with something comes near the origin.
class FeatureBoxes {
 public:
  FeatureBoxes(const SolidFeatures& solid, const NearOrigin& near) : near_(near) {
    if (near.is_all()) return;
    for (const Rational3& p : solid.points()) {
      vertices_.emplace_back().add_rounded(nearest_doubles(p));
    }
    for (const ConvexEdge& e : solid.edges()) {
      edges_.push_back(vertices_[e.from]);
      edges_.back().add(vertices_[e.to]);
    }
    for (const SolidFacet& f : solid.facets()) {
      Box& box = facets_.emplace_back();
      for (const FacetPiece& piece : f.pieces) {
        for (const std::uint32_t v : piece.ring) box.add(vertices_[v]);
      }
    }
    vertex_tree_ = BoxTree(vertices_);
    edge_tree_ = BoxTree(edges_);
  }

  [[nodiscard]] Box edge(std::size_t e) const { return near_.is_all() ? Box() : edges_[e]; }
  [[nodiscard]] Box facet(std::size_t f) const { return near_.is_all() ? Box() : facets_[f]; }

  /// Calls visit(number) for the vertices, or edges, of `count` whose sum with what is in a box may come near.
  template <typename Visit>
  void for_each_vertex(std::size_t count, const Box& box, Visit&& visit) const {
    for_each(vertex_tree_, count, box, visit);
  }
  template <typename Visit>
  void for_each_edge(std::size_t count, const Box& box, Visit&& visit) const {
    for_each(edge_tree_, count, box, visit);
  }

 private:
  template <typename Visit>
  void for_each(const BoxTree& tree, std::size_t count, const Box& box, Visit&& visit) const {
    if (near_.is_all()) {
      for (std::uint32_t i = 0; i < count; ++i) visit(i);
    } else {
      tree.for_each_if([&](const Box& of) { return near_.may_hold(of, box); }, visit);
    }
  }

  NearOrigin near_;
  std::vector<Box> vertices_, edges_, facets_;  // none if all is near
  BoxTree vertex_tree_, edge_tree_;
};

// Finds the facets of a convolution, in lists of its own for each range of features, so that their order does not
// depend on the threads.
class Convolution {
 public:
  Convolution(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor, const NearOrigin& near)
      : a_(a), b_(b), monitor_(monitor), near_(near), boxes_a_(a, near), boxes_b_(b, near) {
    marks_ = marks_of_sum(a.marks(), b.marks());
  }

  ConvolutionFacets run() {
    touch_facets(false);
    touch_facets(true);
    add_parallel_facets();
    cross_edges();
    return numbered_facets(a_, b_, marks_, std::move(lists_), monitor_);
  }

 private:
  [[nodiscard]] bool mixed() const { return marks_ == BoundaryMarks::kMixed; }

  // add(i, list, own) for i = 0 .. count - 1, in ranges with a list each.
  template <typename Add>
  void add_in_ranges(std::size_t count, const Add& add) {
    constexpr std::size_t kMostRanges = 256;
    const std::size_t range = (count + kMostRanges - 1) / kMostRanges;
    const std::size_t before = lists_.size();
    lists_.resize(before + (count == 0 ? 0 : (count + range - 1) / range), FacetList(mixed()));
    parallel_for_ranges(count, std::max<std::size_t>(range, 1), monitor_,
                        [&](std::size_t from, std::size_t to, const Monitor& own) {
                          FacetList& list = lists_[before + from / range];
                          for (std::size_t i = from; i < to; ++i) {
                            own.check_interruption();
                            add(i, list, own);
                          }
                        });
  }

  // Facets of one solid (B if swapped) with edges and vertices of the other one.
  void touch_facets(bool swapped) {
    const SolidFeatures& ours = swapped ? b_ : a_;
    const SolidFeatures& theirs = swapped ? a_ : b_;
    const FeatureBoxes& our_boxes = swapped ? boxes_b_ : boxes_a_;
    const FeatureBoxes& their_boxes = swapped ? boxes_a_ : boxes_b_;
    add_in_ranges(ours.facets().size(), [&](std::size_t f, FacetList& list, const Monitor& own) {
      const SolidFacet& facet = ours.facets()[f];
      const PlaneNormal normal = ours.normal(facet.plane);
      const Box box = our_boxes.facet(f);
      their_boxes.for_each_vertex(theirs.points().size(), box, [&](std::uint32_t v) {
        if (!theirs.is_peak(v, normal, own)) return;
        for (const FacetPiece& piece : facet.pieces) add_moved(list, ours, piece, theirs, v, swapped, facet.plane);
      });
      their_boxes.for_each_edge(theirs.edges().size(), box, [&](std::uint32_t e) {
        const ConvexEdge& edge = theirs.edges()[e];
        if (theirs.lines().sign_of_dot(edge.line, normal, own) != 0 || !theirs.touches(edge, normal, own)) return;
        const FacetPiece segment{{edge.from, edge.to}, {edge.mark, edge.mark}, edge.mark};
        for (const FacetPiece& piece : facet.pieces) {
          add_sum(list, ours, piece, theirs, segment, swapped, facet.plane);
        }
      });
    });
  }

  // Pairs are found on several threads; the few that there are, as a rule, are added by this one, as one planar sum may
  // be large.
  void add_parallel_facets() {
    std::vector<PlaneNormal> of_b;
    of_b.reserve(b_.facets().size());
    for (const SolidFacet& facet : b_.facets()) of_b.push_back(b_.normal(facet.plane));
    std::vector<std::vector<std::uint32_t>> parallel(a_.facets().size());
    constexpr std::size_t kAtOnce = 256;
    parallel_for_ranges(parallel.size(), kAtOnce, monitor_, [&](std::size_t from, std::size_t to, const Monitor& own) {
      for (std::size_t i = from; i < to; ++i) {
        const Box box = boxes_a_.facet(i);
        const PlaneNormal normal = a_.normal(a_.facets()[i].plane);
        for (std::uint32_t j = 0; j < of_b.size(); ++j) {
          if (!near_.is_all() && !near_.may_hold(box, boxes_b_.facet(j))) continue;
          if (same_direction(normal, of_b[j], own)) parallel[i].push_back(j);
        }
      }
    });
    FacetList list(mixed());
    for (std::size_t i = 0; i < parallel.size(); ++i) {
      for (const std::uint32_t j : parallel[i]) add_sum_of_facets(list, a_.facets()[i], b_.facets()[j]);
    }
    lists_.push_back(std::move(list));
  }

  void add_sum_of_facets(FacetList& list, const SolidFacet& f, const SolidFacet& g) {
    if (!mixed() && f.pieces.size() * g.pieces.size() > 1 && is_polygon(f) && is_polygon(g)) {
      add_planar_sum(list, f, g);
      return;
    }
    for (const FacetPiece& p : f.pieces) {
      for (const FacetPiece& q : g.pieces) add_sum(list, a_, p, b_, q, false, f.plane);
    }
  }

  // The sum of two facets, as a whole, cut into convex pieces: by far fewer than the sums of their pieces, which
  // overlap.
  void add_planar_sum(FacetList& list, const SolidFacet& f, const SolidFacet& g) {
    const std::vector<std::uint32_t> of_f = vertices_around(f);
    const std::vector<std::uint32_t> of_g = vertices_around(g);
    const PlanarFrame frame = frame_across(a_.normal(f.plane).integers());
    const PlanarSum sum = planar_sum(polygon_of(a_, f), polygon_of(b_, g), frame, monitor_);
    std::vector<std::uint64_t> corners;
    for (std::size_t i = 0; i < sum.points.size(); ++i) {
      const auto& [p, q] = sum.sources[i];
      corners.push_back(p != kNone ? FacetList::sum_of(of_f[p], of_g[q]) : list.add_point(sum.points[i]));
    }
    const MeshPoints points(sum.points);
    for (const std::vector<std::uint32_t>& piece : ConvexPieces(points, monitor_).cut(sum.rings, frame)) {
      for (const std::uint32_t i : piece) list.add_corner(corners[i], 1, 1);
      list.end_facet({FacetList::Normal::Kind::kFacetOfA, f.plane}, 1);
    }
  }

  // The ends of an arc of normals.
  struct ArcEnds {
    PlaneNormal first, last;
  };

  // Each arc of normals lies on the great circle of its edge. Arcs cross iff the ends of each lie on both sides of the
  // other's circle, and cross where the circles do on the same side of the sphere. Walking along arc A, which runs
  // counterclockwise about edge a, one comes to the side `to` of b's circle at y with sign(y . (b x a)) = to. A circle
  // is crossed wherever the arc crosses it. The sign, or 0 for arcs that do not cross.
  [[nodiscard]] int side_of_crossing(const ConvexEdge& a, const ArcEnds& of_a, const ConvexEdge& b,
                                     const Monitor& own) const {
    const auto side_of_a = [&](PlaneId end) { return a_.lines().sign_of_dot(a.line, b_.normal(end), own); };
    const auto side_of_b = [&](const PlaneNormal& end) { return b_.lines().sign_of_dot(b.line, end, own); };
    if (a.is_bare) {
      const int last = side_of_a(b.last);
      return last != 0 && side_of_a(b.first) == -last ? -last : 0;
    }
    const int last = side_of_b(of_a.last);
    if (last == 0 || side_of_b(of_a.first) != -last) return 0;
    if (b.is_bare) return last;
    return side_of_a(b.last) == -last && side_of_a(b.first) == last ? last : 0;
  }

  void cross_edges() {
    add_in_ranges(a_.edges().size(), [&](std::size_t i, FacetList& list, const Monitor& own) {
      const ConvexEdge& a = a_.edges()[i];
      const ArcEnds ends = a.is_bare ? ArcEnds() : ArcEnds{a_.normal(a.first), a_.normal(a.last)};
      boxes_b_.for_each_edge(b_.edges().size(), boxes_a_.edge(i), [&](std::uint32_t j) {
        const ConvexEdge& b = b_.edges()[j];
        // About b x a the edges a, b turn clockwise.
        if (const int side = side_of_crossing(a, ends, b, own); side != 0) add_parallelogram(list, a, b, side > 0);
      });
    });
  }

  // The sum of a vertex of one solid and one of the other.
  static std::uint64_t corner(std::uint32_t own, std::uint32_t other, bool swapped) {
    return swapped ? FacetList::sum_of(other, own) : FacetList::sum_of(own, other);
  }

  static FacetList::Normal normal_of_facet(PlaneId plane, bool of_b) {
    return {of_b ? FacetList::Normal::Kind::kFacetOfB : FacetList::Normal::Kind::kFacetOfA, plane};
  }

  // A piece of a facet and a vertex.
  void add_moved(FacetList& list, const SolidFeatures& ours, const FacetPiece& piece, const SolidFeatures& theirs,
                 std::uint32_t v, bool swapped, PlaneId plane) {
    const std::uint8_t mark = theirs.mark(v);
    for (std::size_t i = 0; i < piece.ring.size(); ++i) {
      list.add_corner(corner(piece.ring[i], v, swapped), ours.mark(piece.ring[i]) & mark, piece.sides[i] & mark);
    }
    list.end_facet(normal_of_facet(plane, swapped), piece.mark & mark);
  }

  void add_parallelogram(FacetList& list, const ConvexEdge& a, const ConvexEdge& b, bool reversed) {
    const auto add = [&](std::uint32_t v, std::uint32_t w, std::uint8_t side) {
      list.add_corner(FacetList::sum_of(v, w), a_.mark(v) & b_.mark(w), side);
    };
    const auto with_a = [&](std::uint32_t w) { return static_cast<std::uint8_t>(a.mark & b_.mark(w)); };
    const auto with_b = [&](std::uint32_t v) { return static_cast<std::uint8_t>(b.mark & a_.mark(v)); };
    if (reversed) {
      add(a.from, b.to, with_a(b.to));
      add(a.to, b.to, with_b(a.to));
      add(a.to, b.from, with_a(b.from));
      add(a.from, b.from, with_b(a.from));
    } else {
      add(a.from, b.from, with_a(b.from));
      add(a.to, b.from, with_b(a.to));
      add(a.to, b.to, with_a(b.to));
      add(a.from, b.to, with_b(a.from));
    }
    using Kind = FacetList::Normal::Kind;
    list.end_facet({reversed ? Kind::kLinesTurned : Kind::kLines, PlaneId(), a.line, b.line}, a.mark & b.mark);
  }

  [[nodiscard]] MarkedPolygon polygon(const SolidFeatures& of, const FacetPiece& piece) const {
    MarkedPolygon result;
    result.inside = piece.mark;
    result.sides = piece.sides;
    for (const std::uint32_t v : piece.ring) {
      result.corners.push_back(of.points()[v]);
      result.corner_marks.push_back(mixed() ? of.mark(v) : 1);
    }
    if (!mixed()) {
      result.inside = 1;
      result.sides.assign(piece.ring.size(), 1);
    }
    return result;
  }

  // A piece of a facet, and a piece or an edge parallel to it.
  void add_sum(FacetList& list, const SolidFeatures& ours, const FacetPiece& piece, const SolidFeatures& theirs,
               const FacetPiece& other, bool swapped, PlaneId plane) {
    const MarkedPolygon p = polygon(ours, piece);
    const MarkedPolygon q = polygon(theirs, other);
    add_polygon_sum(list, {piece.ring, p}, {other.ring, q}, swapped, plane);
    if ((p.inside & q.inside) == 0 && !p.is_void() && !q.is_void())
      add_sums_of_parts(list, {piece.ring, p}, {other.ring, q}, swapped, plane);
  }

  // A piece, a side or a corner, as vertices and as a polygon.
  struct Part {
    std::vector<std::uint32_t> ring;
    MarkedPolygon polygon;
  };

  void add_polygon_sum(FacetList& list, const Part& p, const Part& q, bool swapped, PlaneId plane) {
    for (const SumCorner& c :
         polygon_sum(p.polygon, q.polygon, to_rational((swapped ? b_ : a_).normal(plane).integers()))) {
      list.add_corner(corner(p.ring[c.p], q.ring[c.q], swapped), c.mark, c.side);
    }
    list.end_facet(normal_of_facet(plane, swapped), p.polygon.inside & q.polygon.inside);
  }

  // What of the inside of a sum belongs to it although the insides of both pieces do not: sums of sides and corners
  // with each other and with an inside. They are facets of their own, in the same plane, or sides or corners of such.
  void add_sums_of_parts(FacetList& list, const Part& p, const Part& q, bool swapped, PlaneId plane) {
    const auto add = [&](const Part& of_p, const Part& of_q) {
      if (of_p.polygon.is_void() || of_q.polygon.is_void() || !have_area(of_p, of_q)) return;
      add_polygon_sum(list, of_p, of_q, swapped, plane);
    };
    const std::vector<Part> sides_of_p = p.ring.size() > 2 ? sides(p) : std::vector<Part>();
    const std::vector<Part> sides_of_q = q.ring.size() > 2 ? sides(q) : std::vector<Part>();
    for (const Part& side : sides_of_q) add(p, side);
    for (const Part& side : sides_of_p) {
      add(side, q);
      for (const Part& other : sides_of_q) add(side, other);
    }
    for (const Part& corner : corners(q)) add(p, corner);
    for (const Part& corner : corners(p)) add(corner, q);
  }

  // False for a sum that is a segment or a point.
  static bool have_area(const Part& p, const Part& q) {
    if (p.ring.size() > 2 || q.ring.size() > 2) return true;
    if (p.ring.size() < 2 || q.ring.size() < 2) return false;
    const Rational3 along_p = minus(p.polygon.corners[1], p.polygon.corners[0]);
    return !is_zero(cross(along_p, minus(q.polygon.corners[1], q.polygon.corners[0])));
  }

  static std::vector<Part> sides(const Part& of) {
    std::vector<Part> result;
    for (std::size_t i = 0; i < of.ring.size(); ++i) {
      const std::size_t k = i + 1 < of.ring.size() ? i + 1 : 0;
      const MarkedPolygon& all = of.polygon;
      const std::uint8_t mark = all.sides[i];
      result.push_back(
          {{of.ring[i], of.ring[k]},
           {{all.corners[i], all.corners[k]}, {all.corner_marks[i], all.corner_marks[k]}, {mark, mark}, mark}});
    }
    return result;
  }

  static std::vector<Part> corners(const Part& of) {
    std::vector<Part> result;
    for (std::size_t i = 0; i < of.ring.size(); ++i) {
      const std::uint8_t mark = of.polygon.corner_marks[i];
      result.push_back({{of.ring[i]}, {{of.polygon.corners[i]}, {mark}, {mark}, mark}});
    }
    return result;
  }

  const SolidFeatures& a_;
  const SolidFeatures& b_;
  Monitor monitor_;
  NearOrigin near_;
  FeatureBoxes boxes_a_, boxes_b_;
  BoundaryMarks marks_ = BoundaryMarks::kAll;
  std::vector<FacetList> lists_;
};

}  // namespace

BoundaryMarks marks_of_sum(BoundaryMarks a, BoundaryMarks b) {
  if (a == BoundaryMarks::kNone || b == BoundaryMarks::kNone) return BoundaryMarks::kNone;
  return a == b ? a : BoundaryMarks::kMixed;
}

ConvolutionFacets reduced_convolution(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor,
                                      const NearOrigin& near) {
  return Convolution(a, b, monitor, near).run();
}

}  // namespace nef::minkowski
