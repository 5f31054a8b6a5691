// SPDX-License-Identifier: Apache-2.0
//
// Three kinds of sums, each found by exact signs: a facet with the peaks and parallel edges that it touches, two
// parallel facets (by `planar_sum`; where marks differ, their convex pieces are added pair by pair), and two convex
// edges whose arcs of normals cross on the sphere (a parallelogram). Signs are found on several threads, facets are
// added on one, in the order of the features, so that the result does not depend on the threads.
#include "apps/minkowski/convolution/facets/convolution_facets.h"

#include <algorithm>
#include <cmath>

#include "apps/minkowski/convolution/facets/convex_pieces.h"
#include "apps/minkowski/convolution/facets/polygon_sum.h"
#include "apps/minkowski/planar/planar_sum.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/plane_finder.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

// A vertex of A and one of B.
struct Pair {
  std::uint32_t a = 0, b = 0;
};

// How a plane with this normal is looked at from outside.
PlanarFrame frame_across(const Direction& normal) {
  const Integer3& n = normal.integers();
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

class Convolution {
 public:
  Convolution(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor, const NearOrigin& near)
      : a_(a), b_(b), monitor_(monitor), near_(near), boxes_a_(a, near), boxes_b_(b, near) {
    result_.marks = marks_of_sum(a.marks(), b.marks());
  }

  ConvolutionFacets run() {
    touch_facets(false);
    touch_facets(true);
    for (std::size_t i = 0; i < a_.facets().size(); ++i) {
      const SolidFacet& f = a_.facets()[i];
      const Box box = boxes_a_.facet(i);
      for (std::size_t j = 0; j < b_.facets().size(); ++j) {
        const SolidFacet& g = b_.facets()[j];
        if (!near_.is_all() && !near_.may_hold(box, boxes_b_.facet(j))) continue;
        if (same_direction(f.normal, g.normal, monitor_)) add_parallel_facets(f, g);
      }
    }
    cross_edges();
    drop_covered();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool mixed() const { return result_.marks == BoundaryMarks::kMixed; }

  // What of the other solid a facet touches.
  struct Touched {
    std::vector<std::uint32_t> peaks, edges;
  };

  static Touched touched_by(const SolidFacet& facet, const Box& box, const SolidFeatures& theirs,
                            const FeatureBoxes& boxes, const Monitor& own) {
    Touched result;
    boxes.for_each_vertex(theirs.points().size(), box, [&](std::uint32_t v) {
      if (theirs.is_peak(v, facet.normal, own)) result.peaks.push_back(v);
    });
    boxes.for_each_edge(theirs.edges().size(), box, [&](std::uint32_t e) {
      const ConvexEdge& edge = theirs.edges()[e];
      if (sign_of_dot(edge.line, facet.normal, own) == 0 && edge.touches(facet.normal, own)) result.edges.push_back(e);
    });
    return result;
  }

  // Facets of one solid (B if swapped) with edges and vertices of the other one.
  void touch_facets(bool swapped) {
    const SolidFeatures& ours = swapped ? b_ : a_;
    const SolidFeatures& theirs = swapped ? a_ : b_;
    const FeatureBoxes& our_boxes = swapped ? boxes_b_ : boxes_a_;
    const FeatureBoxes& their_boxes = swapped ? boxes_a_ : boxes_b_;
    std::vector<Touched> touched(ours.facets().size());
    parallel_for(touched.size(), monitor_, [&](std::size_t f, const Monitor& own) {
      touched[f] = touched_by(ours.facets()[f], our_boxes.facet(f), theirs, their_boxes, own);
    });
    for (std::size_t f = 0; f < touched.size(); ++f) {
      monitor_.check_interruption();
      const SolidFacet& facet = ours.facets()[f];
      for (const std::uint32_t v : touched[f].peaks) {
        for (const FacetPiece& piece : facet.pieces) add_moved(ours, piece, theirs, v, swapped, facet.normal);
      }
      for (const std::uint32_t e : touched[f].edges) {
        const ConvexEdge& edge = theirs.edges()[e];
        const FacetPiece segment{{edge.from, edge.to}, {edge.mark, edge.mark}, edge.mark};
        for (const FacetPiece& piece : facet.pieces) add_sum(ours, piece, theirs, segment, swapped, facet.normal);
      }
    }
  }

  void add_parallel_facets(const SolidFacet& f, const SolidFacet& g) {
    if (!mixed() && f.pieces.size() * g.pieces.size() > 1 && is_polygon(f) && is_polygon(g)) {
      add_planar_sum(f, g);
      return;
    }
    for (const FacetPiece& p : f.pieces) {
      for (const FacetPiece& q : g.pieces) add_sum(a_, p, b_, q, false, f.normal);
    }
  }

  // Facets that lie inside of the sum as far as a grid tells; few facets are not worth one.
  void drop_covered() {
    constexpr std::size_t kFew = 500;
    if (result_.size() < kFew) return;
    const auto cells = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(result_.size())));
    result_.covered = CoveredVoxels(a_, b_, std::min(cells, 128U));
    std::vector<Double3> polygon;
    std::uint32_t kept = 0;
    std::uint32_t end = 0;  // of the corners that are kept
    for (std::uint32_t f = 0; f < result_.size(); ++f) {
      monitor_.check_interruption();
      const std::uint32_t first = result_.begin[f];
      const std::uint32_t last = result_.begin[f + 1];
      polygon.clear();
      for (const std::uint32_t c : result_.ring(f)) polygon.push_back(result_.rounded[c]);
      result_.begin[kept] = end;
      if (result_.covered.cover(polygon)) continue;
      result_.plane[kept] = result_.plane[f];
      if (mixed()) result_.inside_marks[kept] = result_.inside_marks[f];
      for (std::uint32_t c = first; c < last; ++c, ++end) {
        result_.corners[end] = result_.corners[c];
        if (!mixed()) continue;
        result_.corner_marks[end] = result_.corner_marks[c];
        result_.side_marks[end] = result_.side_marks[c];
      }
      ++kept;
    }
    result_.begin[kept] = end;
    result_.begin.resize(kept + 1);
    result_.plane.resize(kept);
    result_.corners.resize(end);
    if (!mixed()) return;
    result_.inside_marks.resize(kept);
    result_.corner_marks.resize(end);
    result_.side_marks.resize(end);
  }

  // The sum of two facets, as a whole, cut into convex pieces: by far fewer than the sums of their pieces, which
  // overlap.
  void add_planar_sum(const SolidFacet& f, const SolidFacet& g) {
    const std::vector<std::uint32_t> of_f = vertices_around(f);
    const std::vector<std::uint32_t> of_g = vertices_around(g);
    const PlanarFrame frame = frame_across(f.normal);
    const PlanarSum sum = planar_sum(polygon_of(a_, f), polygon_of(b_, g), frame, monitor_);
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < sum.points.size(); ++i) {
      const auto& [p, q] = sum.sources[i];
      corners.push_back(p != kNone ? corner({of_f[p], of_g[q]}) : new_corner(sum.points[i]));
    }
    const MeshPoints points(sum.points);
    for (const std::vector<std::uint32_t>& piece : ConvexPieces(points, monitor_).cut(sum.rings, frame)) {
      for (const std::uint32_t i : piece) result_.corners.push_back(corners[i]);
      push_facet(f.normal, 1);
    }
  }

  // Each arc of normals lies on the great circle of its edge. Arcs cross iff the ends of each lie on both sides of the
  // other's circle, and cross where the circles do on the same side of the sphere. Walking along arc A, which runs
  // counterclockwise about edge a, one comes to the side `to` of b's circle at y with sign(y . (b x a)) = to. A circle
  // is crossed wherever the arc crosses it. The sign, or 0 for arcs that do not cross.
  static int side_of_crossing(const ConvexEdge& a, const ConvexEdge& b, const Monitor& own) {
    if (a.is_bare) {
      const int of_b = sign_of_dot(a.line, b.last, own);
      return of_b != 0 && sign_of_dot(a.line, b.first, own) == -of_b ? -of_b : 0;
    }
    const int of_a = sign_of_dot(b.line, a.last, own);
    if (of_a == 0 || sign_of_dot(b.line, a.first, own) != -of_a) return 0;
    if (b.is_bare) return of_a;
    return sign_of_dot(a.line, b.last, own) == -of_a && sign_of_dot(a.line, b.first, own) == of_a ? of_a : 0;
  }

  void cross_edges() {
    struct Crossing {
      std::uint32_t b = 0;
      int side = 0;
    };
    std::vector<std::vector<Crossing>> crossings(a_.edges().size());
    parallel_for(crossings.size(), monitor_, [&](std::size_t i, const Monitor& own) {
      const ConvexEdge& a = a_.edges()[i];
      boxes_b_.for_each_edge(b_.edges().size(), boxes_a_.edge(i), [&](std::uint32_t j) {
        const ConvexEdge& b = b_.edges()[j];
        const int side = side_of_crossing(a, b, own);
        if (side != 0) crossings[i].push_back({j, side});
      });
    });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      monitor_.check_interruption();
      const ConvexEdge& a = a_.edges()[i];
      for (const Crossing& crossing : crossings[i]) {
        const ConvexEdge& b = b_.edges()[crossing.b];
        Direction normal = Direction::cross(b.line, a.line);
        if (crossing.side < 0) normal = normal.negated();
        // About b x a the edges a, b turn clockwise.
        add_parallelogram(a, b, crossing.side > 0, normal);
      }
    }
  }

  [[nodiscard]] static Pair pair(std::uint32_t own, std::uint32_t other, bool swapped) {
    return swapped ? Pair{other, own} : Pair{own, other};
  }

  // A piece of a facet and a vertex.
  void add_moved(const SolidFeatures& ours, const FacetPiece& piece, const SolidFeatures& theirs, std::uint32_t v,
                 bool swapped, const Direction& normal) {
    const std::uint8_t mark = theirs.mark(v);
    for (std::size_t i = 0; i < piece.ring.size(); ++i) {
      push_corner(pair(piece.ring[i], v, swapped), ours.mark(piece.ring[i]) & mark, piece.sides[i] & mark);
    }
    push_facet(normal, piece.mark & mark);
  }

  void add_parallelogram(const ConvexEdge& a, const ConvexEdge& b, bool reversed, const Direction& normal) {
    const auto add = [&](std::uint32_t v, std::uint32_t w, std::uint8_t side) {
      push_corner({v, w}, a_.mark(v) & b_.mark(w), side);
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
    push_facet(normal, a.mark & b.mark);
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
  void add_sum(const SolidFeatures& ours, const FacetPiece& piece, const SolidFeatures& theirs, const FacetPiece& other,
               bool swapped, const Direction& normal) {
    const MarkedPolygon p = polygon(ours, piece);
    const MarkedPolygon q = polygon(theirs, other);
    const Integer3& n = normal.integers();
    for (const SumCorner& c : polygon_sum(p, q, to_rational(n))) {
      push_corner(pair(piece.ring[c.p], other.ring[c.q], swapped), c.mark, c.side);
    }
    push_facet(normal, p.inside & q.inside);
    // What of the inside belongs to the sum all the same lies in sums of parts, whose borders it may end at.
    if ((p.inside & q.inside) != 0 || p.is_void() || q.is_void()) return;
    result_.marks_are_told = false;
  }

  std::uint32_t corner(const Pair& p) {
    const auto [at, is_new] = number_.emplace(pair_key(p.a, p.b), static_cast<std::uint32_t>(result_.points.size()));
    if (is_new) new_corner(plus(a_.points()[p.a], b_.points()[p.b]));
    return at->second;
  }

  std::uint32_t new_corner(const Rational3& point) {
    result_.points.push(point);
    result_.rounded.push_back(nearest_doubles(point));
    return static_cast<std::uint32_t>(result_.rounded.size() - 1);
  }

  // A corner of the facet that is being made, and the side that begins there.
  void push_corner(const Pair& p, int mark, int side) {
    result_.corners.push_back(corner(p));
    if (!mixed()) return;
    result_.corner_marks.push_back(static_cast<std::uint8_t>(mark));
    result_.side_marks.push_back(static_cast<std::uint8_t>(side));
  }

  void push_facet(const Direction& normal, int inside) {
    const PointId first{result_.corners[result_.begin.back()]};
    result_.plane.push_back(plane_through(result_.planes, result_.points, normal.integers(), first));
    result_.begin.push_back(static_cast<std::uint32_t>(result_.corners.size()));
    if (mixed()) result_.inside_marks.push_back(static_cast<std::uint8_t>(inside));
  }

  const SolidFeatures& a_;
  const SolidFeatures& b_;
  Monitor monitor_;
  NearOrigin near_;
  FeatureBoxes boxes_a_, boxes_b_;
  ConvolutionFacets result_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_;
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
