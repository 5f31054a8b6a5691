// SPDX-License-Identifier: Apache-2.0
//
// Branch and bound. A pair of vertices that alternating nearest-neighbour steps in doubles find gives a first bound.
// Then each edge of A meets the edges of B whose boxes are not farther than the best pair so far, found in a tree of
// boxes, and each vertex of either set meets the facets of the other in the same way. The square of the distance of
// boxes is rounded down, the bound is rounded up, so no pair is left out wrongly; pairs that remain are computed in
// rationals. Two edges: the minimum of a quadratic form over a square. A vertex and a facet: the foot of the
// perpendicular, if it lies in the facet; if not, an edge of the facet is at least as near. O(n log n) for sets that
// are near each other in few places; O(n m) if many pairs are equally near.
#include "nef/distance/nearest_features.h"

#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "nef/base/error.h"
#include "nef/complex/item_boxes.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"
#include "nef/location/facet_search.h"

namespace nef {
namespace {

// At most the square of the distance of any two points of the boxes. Gaps, squares and sums lose less than 2^-50
// relative; what underflows is covered by the absolute part. A box that leaves the range of doubles tells nothing.
double least_square(const Box& a, const Box& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double above = b.low[i] - a.high[i];
    const double below = a.low[i] - b.high[i];
    const double gap = above > below ? above : below;
    if (gap > 0 && gap < std::numeric_limits<double>::infinity()) sum += gap * gap;
  }
  return sum * (1 - 0x1p-48) - 1e-300;
}

// At least the value of a positive rational.
double rounded_up(const Rational& value) { return nearest_double(value) * (1 + 0x1p-48) + 1e-300; }

Rational clamped(const Rational& value) { return value < 0 ? Rational(0) : value > 1 ? Rational(1) : value; }

Rational3 along(const Rational3& start, const Rational& t, const Rational3& direction) {
  return {start[0] + t * direction[0], start[1] + t * direction[1], start[2] + t * direction[2]};
}

// One of the two sets: its facets, and its edges and vertices without edges, as segments.
struct Side {
  explicit Side(const Complex& complex) : c(complex) {
    std::vector<Box> boxes;
    for (const Facet& facet : c.facets) {
      Box& box = boxes.emplace_back();
      for (const SHalfedgeId corner : c.corners_of(facet)) box.add(vertex_box(c, c.shalfedge_vertex(corner)));
    }
    facets = BoxTree(boxes);
    boxes.clear();
    for (const HalfedgeId h : c.halfedge_ids()) {
      if (h > c.twin[h]) continue;
      segments.push_back({c.source(h), c.target(h)});
      boxes.push_back(edge_box(c, h));
    }
    for (const VertexId v : c.vertex_ids()) {
      if (!c.sphere_map(v).svertices.empty()) continue;
      segments.push_back({v, v});
      boxes.push_back(vertex_box(c, v));
    }
    segment_tree = BoxTree(boxes);
    segment_boxes = std::move(boxes);
  }

  [[nodiscard]] Rational3 point(VertexId vertex) const { return c.points.rational(point_of(vertex)); }

  // A tree for a facet with many corners, made at the first call.
  const BoxTree* edges_of(FacetId facet) {
    constexpr std::size_t kMany = 64;
    if (c.corners_of(facet).size() < kMany) return nullptr;
    const auto [at, fresh] = trees.try_emplace(facet);
    if (fresh) at->second = facet_edge_tree(c, c.facets[facet]);
    return &at->second;
  }

  const Complex& c;
  BoxTree facets;
  std::vector<std::array<VertexId, 2>> segments;
  std::vector<Box> segment_boxes;
  BoxTree segment_tree;
  std::unordered_map<FacetId, BoxTree> trees;
};

class Search {
 public:
  Search(const Complex& a, const Complex& b, const Monitor& monitor) : a_(a), b_(b), monitor_(monitor) {}

  NearestPair run() {
    start();
    for (std::uint32_t i = 0; i < a_.segments.size(); ++i) meet_segments(i);
    meet_facets(a_, b_, false);
    meet_facets(b_, a_, true);
    NEF_ASSERT(best_);
    return *best_;
  }

 private:
  void offer(NearestPair&& pair) {
    if (best_ && best_->squared <= pair.squared) return;
    best_ = std::move(pair);
    limit_ = rounded_up(best_->squared);
  }

  // The vertex of a side that seems nearest to a point.
  static VertexId nearest_vertex(const Side& side, const std::array<double, 3>& x) {
    VertexId nearest{0};
    double least = std::numeric_limits<double>::infinity();
    for (const VertexId v : side.c.vertex_ids()) {
      const std::array<double, 3>& y = side.c.points.approximate(point_of(v));
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
      if (sum < least) {
        least = sum;
        nearest = v;
      }
    }
    return nearest;
  }

  // A pair that is rather near, so that most of what follows is left out.
  void start() {
    constexpr int kRounds = 4;
    VertexId v{0};
    VertexId w{0};
    for (int i = 0; i < kRounds; ++i) {
      w = nearest_vertex(b_, a_.c.points.approximate(point_of(v)));
      v = nearest_vertex(a_, b_.c.points.approximate(point_of(w)));
    }
    const Rational3 p = a_.point(v);
    const Rational3 q = b_.point(w);
    offer(nearest_of_segments({p, p}, {q, q}));
  }

  void meet_segments(std::uint32_t i) {
    const Box& box = a_.segment_boxes[i];
    std::optional<std::array<Rational3, 2>> segment;
    b_.segment_tree.for_each_if([&](const Box& other) { return least_square(box, other) <= limit_; },
                                [&](std::uint32_t j) {
                                  const auto [u, v] = a_.segments[i];
                                  if (!segment) segment = {a_.point(u), a_.point(v)};
                                  const auto [w, x] = b_.segments[j];
                                  offer(nearest_of_segments(*segment, {b_.point(w), b_.point(x)}));
                                });
  }

  void meet_facets(const Side& vertices, Side& facets, bool swapped) {
    for (const VertexId v : vertices.c.vertex_ids()) {
      const Box box = vertex_box(vertices.c, v);
      facets.facets.for_each_if([&](const Box& other) { return least_square(box, other) <= limit_; },
                                [&](std::uint32_t f) { meet_facet(vertices.point(v), facets, FacetId{f}, swapped); });
    }
  }

  // The foot of the perpendicular, where it lies in the facet; otherwise an edge is as near.
  void meet_facet(const Rational3& p, Side& side, FacetId f, bool swapped) {
    const Facet& facet = side.c.facets[f];
    Rational3 normal;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = Integer(side.c.planes.coefficient(facet.plane, i));
    const Rational form = dot(normal, p) + Integer(side.c.planes.coefficient(facet.plane, 3));
    const Rational length = dot(normal, normal);
    const Rational t = form / length;
    Rational squared = t * form;
    if (squared >= best_->squared) return;
    const Rational3 foot = along(p, -t, normal);
    PointTable table;
    const PointRef at{&table, table.push(foot)};
    if (!locate_in_facet(side.c, f, at, side.edges_of(f), monitor_).valid()) return;
    offer(swapped ? NearestPair{std::move(squared), foot, p} : NearestPair{std::move(squared), p, foot});
  }

  Side a_;
  Side b_;
  Monitor monitor_;
  std::optional<NearestPair> best_;
  double limit_ = std::numeric_limits<double>::infinity();
};

}  // namespace

NearestPair nearest_of_segments(const std::array<Rational3, 2>& a, const std::array<Rational3, 2>& b) {
  const Rational3 d = minus(a[1], a[0]);
  const Rational3 e = minus(b[1], b[0]);
  const Rational3 r = minus(a[0], b[0]);
  const Rational dd = dot(d, d);
  const Rational ee = dot(e, e);
  const Rational de = dot(d, e);
  const Rational dr = dot(d, r);
  const Rational er = dot(e, r);
  Rational s = 0;
  Rational t = 0;
  if (ee == 0) {
    if (dd != 0) s = clamped(-dr / dd);
  } else if (dd == 0) {
    t = clamped(er / ee);
  } else {
    // The nearest point of the first segment to the line of the second; of parallel lines any will do.
    const Rational determinant = dd * ee - de * de;
    if (determinant != 0) s = clamped((de * er - dr * ee) / determinant);
    t = (de * s + er) / ee;
    if (t < 0) {
      t = 0;
      s = clamped(-dr / dd);
    } else if (t > 1) {
      t = 1;
      s = clamped((de - dr) / dd);
    }
  }
  NearestPair result;
  result.on_a = along(a[0], s, d);
  result.on_b = along(b[0], t, e);
  const Rational3 gap = minus(result.on_b, result.on_a);
  result.squared = dot(gap, gap);
  return result;
}

NearestPair nearest_features(const Complex& a, const Complex& b, const Monitor& monitor) {
  return Search(a, b, monitor).run();
}

}  // namespace nef
