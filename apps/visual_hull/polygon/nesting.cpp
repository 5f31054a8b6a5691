// SPDX-License-Identifier: Apache-2.0
//
// From loose rings to a silhouette: cleaning, checks, nesting by parity. Repeated and straight vertices are dropped;
// edges are split where a vertex touches them, so that afterwards rings have at most vertices in common; the first pair
// of edges that meet otherwise, found in a tree of boxes, is an error. Then the rings around a ring are those that
// contain the middle of one of its edges, and their number is its depth.
#include <algorithm>
#include <numeric>

#include "apps/visual_hull/polygon/polygon.h"
#include "nef/base/error.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/number/brief_text.h"

namespace nef::visual_hull {
namespace {

struct Edge {
  std::size_t ring = 0;
  std::size_t index = 0;
};

nef::Box edge_box(const Point2& a, const Point2& b) {
  nef::Box box;
  box.add_rounded({a.approximate[0], a.approximate[1], 0});
  box.add_rounded({b.approximate[0], b.approximate[1], 0});
  return box;
}

struct EdgeSoup {
  std::vector<Edge> edges;
  std::vector<nef::Box> boxes;
  nef::BoxTree tree;

  explicit EdgeSoup(const std::vector<Ring>& rings) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t i = 0; i < rings[r].size(); ++i) {
        edges.push_back({r, i});
        boxes.push_back(edge_box(rings[r][i], rings[r][(i + 1) % rings[r].size()]));
      }
    }
    tree = nef::BoxTree(boxes);
  }
};

std::string describe(const Point2& p) { return "(" + nef::brief_text(p.x()) + ", " + nef::brief_text(p.y()) + ")"; }

// Drops repeated and straight vertices until none is left (dropping one may reveal another).
void clean(Ring& ring, const nef::Monitor& monitor) {
  bool changed = true;
  while (changed && ring.size() >= 3) {
    changed = false;
    Ring kept;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point2& before = kept.empty() ? ring[n - 1] : kept.back();
      if (ring[i] == before || orientation(before, ring[i], ring[(i + 1) % n], monitor) == 0) {
        changed = true;
      } else {
        kept.push_back(ring[i]);
      }
    }
    ring = std::move(kept);
  }
}

// Splits edges at vertices (of any ring) that lie inside them.
void split_at_touches(std::vector<Ring>& rings, const nef::Monitor& monitor) {
  const EdgeSoup soup(rings);
  std::vector<std::vector<std::vector<Point2>>> inserted(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) inserted[r].resize(rings[r].size());
  bool any = false;
  for (const Ring& ring : rings) {
    for (const Point2& p : ring) {
      soup.tree.for_each_overlap(edge_box(p, p), [&](std::uint32_t e) {
        const Ring& other = rings[soup.edges[e].ring];
        const Point2& a = other[soup.edges[e].index];
        const Point2& b = other[(soup.edges[e].index + 1) % other.size()];
        if (p == a || p == b || !on_segment(a, b, p, monitor)) return;
        auto& list = inserted[soup.edges[e].ring][soup.edges[e].index];
        if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
        any = true;
      });
    }
  }
  if (!any) return;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    Ring split;
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Point2& a = rings[r][i];
      const Point2& b = rings[r][(i + 1) % rings[r].size()];
      auto& list = inserted[r][i];
      std::sort(list.begin(), list.end(), [&](const Point2& p, const Point2& q) {
        const std::size_t axis = compare_coordinate(a, b, 0) != 0 ? 0 : 1;
        return compare_coordinate(p, q, axis) * compare_coordinate(a, b, axis) > 0;
      });
      split.push_back(a);
      split.insert(split.end(), list.begin(), list.end());
    }
    rings[r] = std::move(split);
  }
}

}  // namespace

std::string first_crossing(const std::vector<Ring>& rings, const nef::Monitor& monitor) {
  const EdgeSoup soup(rings);
  std::string problem;
  for (std::uint32_t e = 0; e < soup.edges.size() && problem.empty(); ++e) {
    const Ring& ring = rings[soup.edges[e].ring];
    const Point2& a = ring[soup.edges[e].index];
    const Point2& b = ring[(soup.edges[e].index + 1) % ring.size()];
    soup.tree.for_each_overlap(soup.boxes[e], [&](std::uint32_t f) {
      if (f <= e || !problem.empty()) return;
      const Ring& other = rings[soup.edges[f].ring];
      const Point2& c = other[soup.edges[f].index];
      const Point2& d = other[(soup.edges[f].index + 1) % other.size()];
      if (!segments_meet(a, b, c, d, monitor)) return;
      const bool same_ring = soup.edges[e].ring == soup.edges[f].ring;
      const auto crossing = [&](const char* what) {
        problem = (same_ring ? "polygon " + std::to_string(soup.edges[e].ring + 1) + what + "itself"
                             : "polygon " + std::to_string(soup.edges[e].ring + 1) + what + "polygon " +
                                   std::to_string(soup.edges[f].ring + 1)) +
                  " near " + describe(c);
      };
      const bool follows = same_ring && (b == c || d == a) &&
                           ((soup.edges[e].index + 1) % ring.size() == soup.edges[f].index ||
                            (soup.edges[f].index + 1) % ring.size() == soup.edges[e].index);
      const int shared = (a == c || a == d ? 1 : 0) + (b == c || b == d ? 1 : 0);
      if (shared == 0) return crossing(" crosses ");
      const Point2& pivot = (a == c || a == d) ? a : b;
      const Point2& end1 = pivot == a ? b : a;
      const Point2& end2 = pivot == c ? d : c;
      if (shared == 2 || on_segment(c, d, end1, monitor) || on_segment(a, b, end2, monitor))
        return crossing(" runs along ");
      if (same_ring && !follows) crossing(" touches ");
    });
  }
  return problem;
}

namespace {

bool contains_strictly(const Ring& outer, const Ring& inner, const nef::Monitor& monitor) {
  // Rings meet in vertices only and no edge is common, so the middle of an edge of one is not on the other, whereas
  // each vertex may be.
  return locate(outer, midpoint(inner[0], inner[1]), monitor) == Side::kInside;
}

nef::Box ring_box(const Ring& ring) {
  nef::Box box;
  for (const Point2& p : ring) box.add_rounded({p.approximate[0], p.approximate[1], 0});
  return box;
}

bool box_within(const nef::Box& inner, const nef::Box& outer) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (inner.low[i] < outer.low[i] || inner.high[i] > outer.high[i]) return false;
  }
  return true;
}

}  // namespace

std::size_t Silhouette::vertex_count() const {
  return std::accumulate(rings.begin(), rings.end(), std::size_t{0},
                         [](std::size_t sum, const Ring& ring) { return sum + ring.size(); });
}

std::size_t Silhouette::hole_count() const {
  return static_cast<std::size_t>(std::count_if(depth.begin(), depth.end(), [](int d) { return d % 2 == 1; }));
}

Silhouette nest(std::vector<Ring> rings, const nef::Monitor& monitor) {
  Silhouette result;
  const std::size_t n = rings.size();
  std::vector<nef::Box> boxes;
  boxes.reserve(n);
  for (const Ring& ring : rings) boxes.push_back(ring_box(ring));
  std::vector<std::vector<std::size_t>> around(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != j && box_within(boxes[i], boxes[j]) && contains_strictly(rings[j], rings[i], monitor))
        around[i].push_back(j);
    }
  }
  result.parent.assign(n, -1);
  result.depth.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    result.depth[i] = static_cast<int>(around[i].size());
    for (const std::size_t j : around[i]) {
      if (around[j].size() + 1 == around[i].size()) result.parent[i] = static_cast<int>(j);
    }
    const int wanted = result.depth[i] % 2 == 0 ? 1 : -1;
    if (ring_orientation(rings[i], monitor) != wanted) std::reverse(rings[i].begin(), rings[i].end());
  }
  result.rings = std::move(rings);
  return result;
}

Silhouette make_silhouette(std::vector<Ring> rings, const std::string& where, const nef::Monitor& monitor) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    clean(rings[r], monitor);
    if (rings[r].size() < 3) {
      throw nef::InputError(where + ": polygon " + std::to_string(r + 1) + " has no area");
    }
  }
  split_at_touches(rings, monitor);
  const std::string crossing = first_crossing(rings, monitor);
  if (!crossing.empty()) throw nef::InputError(where + ": " + crossing);
  Silhouette result = nest(std::move(rings), monitor);
  const std::string problem = check(result, monitor);
  if (!problem.empty()) throw nef::InputError(where + ": " + problem);
  return result;
}

std::string check(const Silhouette& silhouette, const nef::Monitor& monitor) {
  for (std::size_t r = 0; r < silhouette.rings.size(); ++r) {
    const Ring& ring = silhouette.rings[r];
    if (ring.size() < 3) return "polygon " + std::to_string(r + 1) + " has fewer than three vertices";
  }
  std::string problem = first_crossing(silhouette.rings, monitor);
  if (!problem.empty()) return problem;
  const auto same_side = [&](std::size_t inner, std::size_t outer) {
    // All of a ring lies on one side of another, or they cross in a common vertex.
    const Ring& ring = silhouette.rings[inner];
    const bool first = contains_strictly(silhouette.rings[outer], ring, monitor);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point2& a = ring[k];
      const Point2& b = ring[(k + 1) % ring.size()];
      if ((locate(silhouette.rings[outer], midpoint(a, b), monitor) == Side::kInside) != first) return false;
    }
    return true;
  };
  std::vector<nef::Box> boxes;
  for (const Ring& ring : silhouette.rings) boxes.push_back(ring_box(ring));
  const nef::BoxTree tree(boxes);
  for (std::size_t i = 0; i < boxes.size() && problem.empty(); ++i) {
    int depth = 0;
    tree.for_each_overlap(boxes[i], [&](std::uint32_t j) {
      if (i == j || !problem.empty()) return;
      if (!same_side(i, j)) {
        problem = "polygon " + std::to_string(i + 1) + " crosses polygon " + std::to_string(j + 1) + " in a vertex";
      }
      if (contains_strictly(silhouette.rings[j], silhouette.rings[i], monitor)) ++depth;
    });
    if (!problem.empty()) break;
    if (depth != silhouette.depth[i]) return "polygon " + std::to_string(i + 1) + " is not nested as its depth says";
    if (ring_orientation(silhouette.rings[i], monitor) != (depth % 2 == 0 ? 1 : -1)) {
      return "polygon " + std::to_string(i + 1) + " is oriented against its depth";
    }
  }
  return problem;
}

}  // namespace nef::visual_hull
