// SPDX-License-Identifier: Apache-2.0
//
// Three kinds of sums, each found by exact signs: a facet with the peaks and parallel edges that it touches, two
// parallel facets (their convex pieces are added as polygons), and two convex edges whose arcs of normals cross on the
// sphere (a parallelogram). Signs are found on several threads, facets are added on one, in the order of the features,
// so that the result does not depend on the threads.
#include "apps/minkowski/convolution/facets/convolution_facets.h"

#include <algorithm>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/convolution/facets/polygon_sum.h"
#include "nef/base/threads/parallel.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

// A vertex of A and one of B.
struct Pair {
  std::uint32_t a = 0, b = 0;
};

// If one of the sets has nothing of its boundary, so has the sum; if both have all of it, so has the sum.
BoundaryMarks marks_of_sum(BoundaryMarks a, BoundaryMarks b) {
  if (a == BoundaryMarks::kNone || b == BoundaryMarks::kNone) return BoundaryMarks::kNone;
  return a == b ? a : BoundaryMarks::kMixed;
}

class Convolution {
 public:
  Convolution(const SolidFeatures& a, const SolidFeatures& b, unsigned threads, const Monitor& monitor)
      : a_(a), b_(b), threads_(threads), monitor_(monitor) {
    result_.marks = marks_of_sum(a.marks(), b.marks());
  }

  ConvolutionFacets run() {
    touch_facets(a_, b_, false);
    touch_facets(b_, a_, true);
    for (const SolidFacet& f : a_.facets()) {
      for (const SolidFacet& g : b_.facets()) {
        if (same_direction(f.normal, g.normal, monitor_)) add_parallel_facets(f, g);
      }
    }
    cross_edges();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool mixed() const { return result_.marks == BoundaryMarks::kMixed; }

  // What of the other solid a facet touches.
  struct Touched {
    std::vector<std::uint32_t> peaks, edges;
  };

  static Touched touched_by(const SolidFacet& facet, const SolidFeatures& theirs, const Monitor& own) {
    Touched result;
    for (std::uint32_t v = 0; v < theirs.points().size(); ++v) {
      if (theirs.is_peak(v, facet.normal, own)) result.peaks.push_back(v);
    }
    for (std::uint32_t e = 0; e < theirs.edges().size(); ++e) {
      const ConvexEdge& edge = theirs.edges()[e];
      if (sign_of_dot(edge.line, facet.normal, own) == 0 && edge.touches(facet.normal, own)) result.edges.push_back(e);
    }
    return result;
  }

  // Facets of one solid with edges and vertices of the other one.
  void touch_facets(const SolidFeatures& ours, const SolidFeatures& theirs, bool swapped) {
    std::vector<Touched> touched(ours.facets().size());
    parallel_for(touched.size(), threads_, monitor_,
                 [&](std::size_t f, const Monitor& own) { touched[f] = touched_by(ours.facets()[f], theirs, own); });
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
    for (const FacetPiece& p : f.pieces) {
      for (const FacetPiece& q : g.pieces) add_sum(a_, p, b_, q, false, f.normal);
    }
  }

  // Each arc of normals lies on the great circle of its edge. Arcs cross iff the ends of each lie on both sides of the
  // other's circle, and cross where the circles do on the same side of the sphere. Walking along arc A, which runs
  // counterclockwise about edge a, one comes to the side `to` of b's circle at y with sign(y . (b x a)) = to.
  void cross_edges() {
    struct Crossing {
      std::uint32_t b = 0;
      int side = 0;
    };
    std::vector<std::vector<Crossing>> crossings(a_.edges().size());
    parallel_for(crossings.size(), threads_, monitor_, [&](std::size_t i, const Monitor& own) {
      const ConvexEdge& a = a_.edges()[i];
      for (std::uint32_t j = 0; j < b_.edges().size(); ++j) {
        const ConvexEdge& b = b_.edges()[j];
        const int of_a = sign_of_dot(b.line, a.last, own);
        if (of_a == 0 || sign_of_dot(b.line, a.first, own) != -of_a) continue;
        const int of_b = sign_of_dot(a.line, b.last, own);
        if (of_b == -of_a && sign_of_dot(a.line, b.first, own) == of_a) crossings[i].push_back({j, of_a});
      }
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
    for (const SumCorner& c : polygon_sum(p, q, {Rational(n[0]), Rational(n[1]), Rational(n[2])})) {
      push_corner(pair(piece.ring[c.p], other.ring[c.q], swapped), c.mark, c.side);
    }
    push_facet(normal, p.inside & q.inside);
    // What of the inside belongs to the sum all the same lies in sums of parts, whose borders it may end at.
    if ((p.inside & q.inside) != 0 || p.is_void() || q.is_void()) return;
    result_.marks_are_told = false;
  }

  [[nodiscard]] Rational3 sum(const Pair& p) const {
    const Rational3& a = a_.points()[p.a];
    const Rational3& b = b_.points()[p.b];
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  }

  std::uint32_t corner(const Pair& p) {
    const auto [at, is_new] = number_.emplace(pair_key(p.a, p.b), static_cast<std::uint32_t>(result_.points.size()));
    if (is_new) {
      const Rational3 point = sum(p);
      result_.points.push(point);
      result_.rounded.push_back({nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])});
    }
    return at->second;
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
  unsigned threads_;
  Monitor monitor_;
  ConvolutionFacets result_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_;
};

}  // namespace

ConvolutionFacets reduced_convolution(const SolidFeatures& a, const SolidFeatures& b, unsigned threads,
                                      const Monitor& monitor) {
  return Convolution(a, b, threads, monitor).run();
}

}  // namespace nef::minkowski
