// SPDX-License-Identifier: Apache-2.0
//
// Two moves, always the one of least deviation first.
//   remove(k):   a, k, b becomes a, b.
//   collapse(p): a, p, q, b becomes a, x, b with x where the edges a-p and q-b meet if prolonged,
//                moved outwards to a grid. Only with `outer`: it can pass a convex corner.
// With `outer`, remove(k) is for straight and reflex vertices only, so that both moves only add to
// the region.
//
// Topology: a move sweeps a region bounded by old and new edges. It is allowed iff no other vertex
// lies in the closed region and no new edge meets an old one (but for common ends). An edge that
// enters the region must end there, cross an old edge (impossible) or a new one (excluded). So rings
// stay simple, and none jumps to another side of another.
//
// Deviation: each vertex is matched to a point of the original ring within the tolerance (itself, unless it
// is an x), and the original vertices between the matches of two neighbours lie within the tolerance of the
// edge between them. The other direction follows: the original chain is connected, so it projects onto the
// whole edge, up to its ends, which are near their matches.
//
// Without `outer`, the polygon of fewest vertices is known for each ring by itself. Nearly always these polygons are a
// silhouette with the rings and the nesting of the original, which is checked, and all that is left is to try the
// vertices that they begin with. Otherwise the vertices that they leave out go one by one, with the topology as the
// only condition, and the deviation is checked when they are gone. A ring where that fails (others are in its way)
// starts anew with the greedy choice alone.
#include "apps/visual_hull/silhouette/simplify.h"

#include <cmath>
#include <optional>
#include <queue>

#include "apps/visual_hull/polygon/edge_grid.h"
#include "apps/visual_hull/silhouette/fewest_vertices.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

using Vec = std::array<double, 2>;

struct Node {
  Point2 point;
  std::uint32_t prev = 0;
  std::uint32_t next = 0;
  std::uint32_t ring = 0;
  std::uint32_t match = 0;  ///< place on the original ring: 2i is vertex i, 2i + 1 on the edge that follows it
  std::uint32_t version = 0;
  bool pinned = false;  ///< another ring touches here
  bool alive = true;
};

enum class Kind : std::uint8_t { kNothing, kRemove, kCollapse };

struct Move {
  double cost = INFINITY;
  std::uint32_t node = 0;
  std::uint32_t version = 0;
  Kind kind = Kind::kNothing;
  Vec target{};             ///< x of a collapse
  std::uint32_t match = 0;  ///< and its place on the original ring

  bool operator<(const Move& other) const {  // for a queue with the cheapest on top
    if (cost != other.cost) return cost > other.cost;
    return node > other.node;
  }
};

// Distances are computed with relative errors of a few 2^-53: stay below the bound.
double within(double tolerance) { return tolerance * (1 - 1e-9); }

// Vertices in which rings touch.
std::vector<std::vector<bool>> shared_vertices(const Silhouette& silhouette) {
  struct Place {
    Vec point{};  // equal points have equal doubles
    std::uint32_t ring = 0;
    std::uint32_t vertex = 0;
  };
  std::vector<Place> places;
  std::vector<std::vector<bool>> shared;
  for (std::uint32_t r = 0; r < silhouette.rings.size(); ++r) {
    const Ring& ring = silhouette.rings[r];
    shared.emplace_back(ring.size(), false);
    for (std::uint32_t i = 0; i < ring.size(); ++i) places.push_back({ring[i].approximate, r, i});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.point < b.point; });
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k - 1].point != places[k].point) continue;
    for (const Place& place : {places[k - 1], places[k]}) shared[place.ring][place.vertex] = true;
  }
  return shared;
}

// The vertices of the polygons of fewest vertices, each ring for itself; nothing if one is none, or if the rings get
// into each other's way.
std::optional<std::vector<std::vector<bool>>> fewest_together(const Silhouette& silhouette, double tolerance,
                                                              const nef::Monitor& monitor) {
  const std::vector<std::vector<bool>> pinned = shared_vertices(silhouette);
  std::vector<std::vector<bool>> keep;
  std::vector<Ring> simple;
  for (std::size_t r = 0; r < silhouette.rings.size(); ++r) {
    const Ring& ring = silhouette.rings[r];
    keep.push_back(fewest_vertices(ring, pinned[r], tolerance));
    Ring kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (keep[r][i]) kept.push_back(ring[i]);
    }
    if (kept.size() < 3) return std::nullopt;
    simple.push_back(std::move(kept));
  }
  const Silhouette nested = nest(std::move(simple), monitor);
  if (nested.parent != silhouette.parent || nested.depth != silhouette.depth || !check(nested, monitor).empty()) {
    return std::nullopt;
  }
  return keep;
}

class Simplifier {
 public:
  /// Begins with the vertices to be kept only, if they are told (ring by ring): they are known to be a silhouette.
  Simplifier(const Silhouette& silhouette, const SimplifyOptions& options, const std::vector<std::vector<bool>>* keep,
             const nef::Monitor& monitor)
      : original_(silhouette),
        outer_(options.outer),
        tolerance_(within(options.tolerance)),
        monitor_(monitor),
        grid_(bounds_of(silhouette), keep != nullptr ? count(*keep) : silhouette.vertex_count()) {
    step_ = tolerance_ > 0 ? std::exp2(std::floor(std::log2(tolerance_ / 8))) : 0;
    build(keep);
  }

  /// Rings for which the fewest vertices could not be had. They are to be tried with `greedy`.
  std::vector<bool> remove_guided(const std::vector<bool>& greedy) {
    std::vector<std::uint32_t> unwanted;
    for (std::uint32_t r = 0, first = 0; r < original_.rings.size(); first += size_of_ring(r), ++r) {
      if (greedy[r]) continue;
      std::vector<bool> pinned;
      for (std::uint32_t i = 0; i < size_of_ring(r); ++i) pinned.push_back(nodes_[first + i].pinned);
      const std::vector<bool> keep = fewest_vertices(original_.rings[r], pinned, tolerance_);
      if (std::count(keep.begin(), keep.end(), true) < 3) continue;
      for (std::uint32_t i = 0; i < size_of_ring(r); ++i) {
        if (!keep[i]) unwanted.push_back(first + i);
      }
    }
    for (std::size_t before = unwanted.size() + 1; before != unwanted.size();) {
      before = unwanted.size();
      std::erase_if(unwanted, [this](std::uint32_t k) { return remove_if_free(k); });
    }
    std::vector<bool> failed(greedy.size(), false);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (!node.alive || failed[node.ring]) continue;
      const Node& next = nodes_[node.next];
      failed[node.ring] =
          deviation(node.ring, node.match, next.match, node.point.approximate, next.point.approximate) > tolerance_;
    }
    return failed;
  }

  Silhouette run() {
    // Corners that a removal can take are not to be built over, so all removals come first.
    for (const bool collapse : {false, true}) {
      collapse_ = collapse && outer_;
      for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].alive) push(i);
      }
      work();
    }
    return collect();
  }

 private:
  void work() {
    while (!queue_.empty()) {
      const Move move = queue_.top();
      queue_.pop();
      const Node& node = nodes_[move.node];
      if (!node.alive || node.version != move.version) continue;
      move.kind == Kind::kRemove ? try_remove(move) : try_collapse(move);
    }
  }

  static Rectangle bounds_of(const Silhouette& silhouette) {
    Rectangle box;
    for (const Ring& ring : silhouette.rings) {
      for (const Point2& p : ring) box.add(p.approximate);
    }
    return box;
  }

  static std::size_t count(const std::vector<std::vector<bool>>& flags) {
    std::size_t sum = 0;
    for (const auto& ring : flags) sum += static_cast<std::size_t>(std::count(ring.begin(), ring.end(), true));
    return sum;
  }

  void build(const std::vector<std::vector<bool>>* keep) {
    const std::vector<std::vector<bool>> pinned = shared_vertices(original_);
    for (std::uint32_t r = 0; r < original_.rings.size(); ++r) {
      const Ring& ring = original_.rings[r];
      const auto first = static_cast<std::uint32_t>(nodes_.size());
      for (std::uint32_t i = 0; i < ring.size(); ++i) {
        if (keep != nullptr && !(*keep)[r][i]) continue;
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({ring[i], node - 1, node + 1, r, 2 * i, 0, pinned[r][i], true});
      }
      const auto last = static_cast<std::uint32_t>(nodes_.size() - 1);
      nodes_[first].prev = last;
      nodes_[last].next = first;
      size_.push_back(last + 1 - first);
    }
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) grid_.insert(i, edge_box(i));
  }

  Rectangle edge_box(std::uint32_t node) const {
    Rectangle box;
    box.add(nodes_[node].point.approximate);
    box.add(nodes_[nodes_[node].next].point.approximate);
    return box;
  }

  const Vec& original(std::uint32_t ring, std::uint32_t index) const {
    return original_.rings[ring][index].approximate;
  }

  // The largest distance of the original vertices strictly between two matches from the segment a-b;
  // infinite as soon as it passes the tolerance.
  double deviation(std::uint32_t ring, std::uint32_t from, std::uint32_t to, const Vec& a, const Vec& b) const {
    const auto n = static_cast<std::uint32_t>(original_.rings[ring].size());
    const std::uint32_t end = (to + 1) / 2 % n;
    double worst = 0;
    for (std::uint32_t i = (from / 2 + 1) % n; i != end; i = (i + 1) % n) {
      worst = std::max(worst, distance_to_segment(original(ring, i), a, b));
      if (worst > tolerance_) return INFINITY;
    }
    return worst;
  }

  int turn(std::uint32_t k) const {
    return orientation(nodes_[nodes_[k].prev].point, nodes_[k].point, nodes_[nodes_[k].next].point, monitor_);
  }

  void push(std::uint32_t k) {
    Move best = removal(k);
    if (collapse_) {
      const Move other = collapse(k);
      if (other.cost < best.cost) best = other;
    }
    if (best.kind != Kind::kNothing) queue_.push(best);
  }

  Move removal(std::uint32_t k) const {
    Move move;
    const Node& node = nodes_[k];
    if (node.pinned || size_[node.ring] <= 3 || (outer_ && turn(k) > 0)) return move;
    const Node& a = nodes_[node.prev];
    const Node& b = nodes_[node.next];
    move.cost = deviation(node.ring, a.match, b.match, a.point.approximate, b.point.approximate);
    if (move.cost > tolerance_) return move;
    move.kind = Kind::kRemove;
    move.node = k;
    move.version = node.version;
    return move;
  }

  // The point of the grid nearest to where the lines a-p and q-b meet, to the right of both.
  bool find_target(const Node& a, const Node& p, const Node& q, const Node& b, Vec& target) const {
    const Vec& pa = p.point.approximate;
    const Vec& qa = q.point.approximate;
    const Vec d1{pa[0] - a.point.approximate[0], pa[1] - a.point.approximate[1]};
    const Vec d2{b.point.approximate[0] - qa[0], b.point.approximate[1] - qa[1]};
    const double cross = d1[0] * d2[1] - d1[1] * d2[0];
    if (!(cross > 0)) return false;
    const double t = ((qa[0] - pa[0]) * d2[1] - (qa[1] - pa[1]) * d2[0]) / cross;
    const Vec x{pa[0] + t * d1[0], pa[1] + t * d1[1]};
    if (!(std::hypot(x[0] - pa[0], x[1] - pa[1]) <= 4 * tolerance_)) return false;
    double nearest = INFINITY;
    for (int i = -1; i <= 2; ++i) {
      for (int j = -1; j <= 2; ++j) {
        const Vec c{(std::floor(x[0] / step_) + i) * step_, (std::floor(x[1] / step_) + j) * step_};
        const double distance = std::hypot(c[0] - x[0], c[1] - x[1]);
        if (distance >= nearest) continue;
        const Point2 point = Point2::from_doubles(c[0], c[1]);
        if (orientation(a.point, p.point, point, monitor_) > 0 || orientation(q.point, b.point, point, monitor_) > 0 ||
            orientation(p.point, q.point, point, monitor_) >= 0) {
          continue;
        }
        nearest = distance;
        target = c;
      }
    }
    return nearest < INFINITY;
  }

  Move collapse(std::uint32_t k) const {
    Move move;
    const Node& p = nodes_[k];
    const Node& q = nodes_[p.next];
    if (p.pinned || q.pinned || size_[p.ring] <= 3 || turn(k) <= 0 || turn(p.next) <= 0) return move;
    const Node& a = nodes_[p.prev];
    const Node& b = nodes_[q.next];
    if (!find_target(a, p, q, b, move.target)) return move;
    const auto n = static_cast<std::uint32_t>(original_.rings[p.ring].size());
    const std::uint32_t last = (q.match + 2 * n - 1) / 2 % n;  // the last edge that begins before q's match
    double nearest = INFINITY;
    for (std::uint32_t i = p.match / 2;; i = (i + 1) % n) {
      const double distance = distance_to_segment(move.target, original(p.ring, i), original(p.ring, (i + 1) % n));
      if (distance < nearest) {
        nearest = distance;
        move.match = 2 * i + 1;
      }
      if (i == last) break;
    }
    if (nearest > tolerance_) return move;
    const double cost = std::max({nearest, deviation(p.ring, a.match, move.match, a.point.approximate, move.target),
                                  deviation(p.ring, move.match, b.match, move.target, b.point.approximate)});
    if (cost > tolerance_) return move;
    move.cost = cost;
    move.kind = Kind::kCollapse;
    move.node = k;
    move.version = p.version;
    return move;
  }

  struct Triangle {
    std::array<const Point2*, 3> corner;
    // Exact; degenerate triangles are segments.
    bool contains(const Point2& p, const nef::Monitor& monitor) const {
      const int s0 = orientation(*corner[0], *corner[1], p, monitor);
      const int s1 = orientation(*corner[1], *corner[2], p, monitor);
      const int s2 = orientation(*corner[2], *corner[0], p, monitor);
      if ((s0 > 0 || s1 > 0 || s2 > 0) && (s0 < 0 || s1 < 0 || s2 < 0)) return false;
      if (s0 != 0 || s1 != 0 || s2 != 0) return s0 * s1 >= 0 && s1 * s2 >= 0 && s0 * s2 >= 0;
      return on_segment(*corner[0], *corner[1], p, monitor) || on_segment(*corner[1], *corner[2], p, monitor) ||
             on_segment(*corner[2], *corner[0], p, monitor);
    }
  };

  // True if edge c-d meets the new segment a-b in more than a common end.
  [[nodiscard]] bool conflicts(const Point2& a, const Point2& b, const Point2& c, const Point2& d) const {
    if (!segments_meet(a, b, c, d, monitor_)) return false;
    const bool at_a = a == c || a == d;
    const bool at_b = b == c || b == d;
    if (at_a && at_b) return true;
    if (!at_a && !at_b) return true;
    const Point2& pivot = at_a ? a : b;
    return on_segment(c, d, at_a ? b : a, monitor_) || on_segment(a, b, pivot == c ? d : c, monitor_);
  }

  bool blocked(const std::vector<const Point2*>& path, const std::vector<Triangle>& swept, std::uint32_t first_old,
               std::uint32_t last_old) {
    Rectangle box;
    for (const Triangle& t : swept) {
      for (const Point2* p : t.corner) box.add(p->approximate);
    }
    bool bad = false;
    grid_.visit_near(box, [&](std::uint32_t e) {
      const Node& node = nodes_[e];
      const Point2& c = node.point;
      const Point2& d = nodes_[node.next].point;
      bool old_edge = false;
      for (std::uint32_t k = first_old; k != last_old; k = nodes_[k].next) old_edge = old_edge || k == e;
      if (!old_edge) {
        for (std::size_t i = 0; i + 1 < path.size() && !bad; ++i) bad = conflicts(*path[i], *path[i + 1], c, d);
      }
      // A vertex at a place of the path's ends is one that touches there; it may stay.
      bool on_old = e == last_old;
      for (std::uint32_t k = first_old; k != last_old; k = nodes_[k].next) on_old = on_old || k == e;
      if (!bad && !on_old && !(c == *path.front()) && !(c == *path.back())) {
        for (const Triangle& t : swept) bad = bad || t.contains(c, monitor_);
      }
      return !bad;
    });
    return bad;
  }

  void touch(std::uint32_t k) {
    ++nodes_[k].version;
    push(k);
  }

  std::uint32_t size_of_ring(std::uint32_t ring) const {
    return static_cast<std::uint32_t>(original_.rings[ring].size());
  }

  // Removes a vertex if the topology allows it.
  bool remove_if_free(std::uint32_t node) {
    const Node k = nodes_[node];
    if (size_[k.ring] <= 3) return false;
    const std::vector<const Point2*> path{&nodes_[k.prev].point, &nodes_[k.next].point};
    if (blocked(path, {{{path[0], &nodes_[node].point, path[1]}}}, k.prev, k.next)) return false;
    grid_.remove(k.prev, edge_box(k.prev));
    grid_.remove(node, edge_box(node));
    nodes_[node].alive = false;
    nodes_[k.prev].next = k.next;
    nodes_[k.next].prev = k.prev;
    --size_[k.ring];
    grid_.insert(k.prev, edge_box(k.prev));
    return true;
  }

  void try_remove(const Move& move) {
    const std::uint32_t prev = nodes_[move.node].prev;
    const std::uint32_t next = nodes_[move.node].next;
    if (remove_if_free(move.node)) retouch_around(prev, next);
  }

  void try_collapse(const Move& move) {
    const std::uint32_t p = move.node;
    const std::uint32_t q = nodes_[p].next;
    const std::uint32_t a = nodes_[p].prev;
    const std::uint32_t b = nodes_[q].next;
    if (size_[nodes_[p].ring] <= 3 || a == b) return;
    const Point2 x = Point2::from_doubles(move.target[0], move.target[1]);
    const Point2* pa = &nodes_[a].point;
    const Point2* pp = &nodes_[p].point;
    const Point2* pq = &nodes_[q].point;
    const Point2* pb = &nodes_[b].point;
    if (blocked({pa, &x, pb}, {{{pa, pp, &x}}, {{pp, pq, &x}}, {{pq, pb, &x}}}, a, b)) return;
    for (const std::uint32_t e : {a, p, q}) grid_.remove(e, edge_box(e));
    nodes_[p].alive = nodes_[q].alive = false;
    const auto fresh = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({x, a, b, nodes_[a].ring, move.match, 0, false, true});
    nodes_[a].next = fresh;
    nodes_[b].prev = fresh;
    --size_[nodes_[a].ring];
    grid_.insert(a, edge_box(a));
    grid_.insert(fresh, edge_box(fresh));
    touch(fresh);
    retouch_around(a, b);
  }

  // The moves that start at these and at the vertices before them have changed.
  void retouch_around(std::uint32_t a, std::uint32_t b) {
    touch(a);
    if (b != a) touch(b);
    if (!outer_) return;
    const std::uint32_t before = nodes_[a].prev;
    touch(before);
    if (nodes_[before].prev != b) touch(nodes_[before].prev);
  }

  Silhouette collect() const {
    Silhouette result = original_;
    for (Ring& ring : result.rings) ring.clear();
    std::vector<bool> done(original_.rings.size(), false);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const std::uint32_t ring = nodes_[i].ring;
      if (!nodes_[i].alive || done[ring]) continue;
      done[ring] = true;
      std::uint32_t k = i;
      do {
        result.rings[ring].push_back(nodes_[k].point);
        k = nodes_[k].next;
      } while (k != i);
    }
    return result;
  }

  const Silhouette& original_;
  bool outer_;
  bool collapse_ = false;
  double tolerance_;
  nef::Monitor monitor_;
  double step_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> size_;  // of each ring
  EdgeGrid grid_;
  std::priority_queue<Move> queue_;
};

}  // namespace

Silhouette simplify(const Silhouette& silhouette, const SimplifyOptions& options, const nef::Monitor& monitor) {
  if (!(options.tolerance >= 0) || std::isinf(options.tolerance)) {
    throw nef::InputError("--simplify: the tolerance must be a number that is not negative");
  }
  if (silhouette.empty() || options.tolerance == 0) return silhouette;
  if (options.outer) return Simplifier(silhouette, options, nullptr, monitor).run();
  if (const auto keep = fewest_together(silhouette, within(options.tolerance), monitor)) {
    return Simplifier(silhouette, options, &*keep, monitor).run();
  }
  for (std::vector<bool> greedy(silhouette.rings.size(), false);;) {
    Simplifier simplifier(silhouette, options, nullptr, monitor);
    const std::vector<bool> failed = simplifier.remove_guided(greedy);
    bool any = false;
    for (std::size_t r = 0; r < failed.size(); ++r) {
      any = any || failed[r];
      if (failed[r]) greedy[r] = true;
    }
    if (!any) return simplifier.run();
  }
}

}  // namespace nef::visual_hull
