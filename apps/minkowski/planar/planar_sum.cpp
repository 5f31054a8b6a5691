// SPDX-License-Identifier: Apache-2.0
//
// The reduced convolution covers the boundary of the sum and has the inside on its left (`planar_convolution`). A
// coarse grid tells squares that are surely inside (`CoveredCells`); segments there are dropped. The rest is arranged,
// and its faces are inside, or asked by the definition: x is in P + Q iff P meets x - Q, that is, two sides meet, or
// one holds a corner of the other.
#include "apps/minkowski/planar/planar_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "apps/minkowski/planar/covered_cells.h"
#include "apps/minkowski/planar/planar_arrangement.h"
#include "apps/minkowski/planar/planar_convolution.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

using Seen = std::array<double, 2>;

// The nearest doubles to what is seen of points.
std::vector<Seen> seen_corners(const std::vector<Rational3>& corners, const PlanarFrame& frame) {
  std::vector<Seen> result;
  for (const Rational3& c : corners)
    result.push_back({nearest_double(c[first_axis(frame)]), nearest_double(c[second_axis(frame)])});
  return result;
}

// Asks the definition. Points are in the plane of the sum.
class PlanarMembership {
 public:
  PlanarMembership(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame, const Monitor& monitor)
      : p_(p), q_(q), frame_(frame), monitor_(monitor), seen_p_(seen_corners(p.corners, frame)) {
    std::vector<Box> boxes;
    for_each_side(p, [&](std::uint32_t from, std::uint32_t to) {
      sides_.push_back({from, to});
      boxes.push_back(box_around(seen_p_[from], seen_p_[to]));
    });
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] bool operator()(const Rational3& x) const {
    std::vector<Rational3> moved;  // corners of x - Q
    for (const Rational3& c : q_.corners) moved.push_back({x[0] - c[0], x[1] - c[1], x[2] - c[2]});
    const std::vector<Seen> seen = seen_corners(moved, frame_);
    bool meet = false;
    for_each_side(q_, [&](std::uint32_t from, std::uint32_t to) {
      if (meet) return;
      monitor_.check_interruption();
      const Box box = box_around(seen[from], seen[to]);
      tree_.for_each_if([&](const Box& of) { return !meet && of.overlaps(box); },
                        [&](std::uint32_t s) {
                          const auto& [a, b] = sides_[s];
                          meet = meet || sides_meet(p_.corners[a], p_.corners[b], moved[from], moved[to]);
                        });
    });
    return meet || holds(q_, moved, p_.corners[0]) || holds(p_, p_.corners, moved[0]);
  }

 private:
  static Box box_around(const Seen& a, const Seen& b) {
    Box box;
    for (const Seen& p : {a, b}) box.add_rounded({p[0], p[1], 0});
    return box;
  }

  template <typename Visit>
  static void for_each_side(const PlanarPolygon& polygon, Visit&& visit) {
    for (std::size_t ring = 0, c = 0; ring < polygon.ring_end.size(); ++ring) {
      for (; c < polygon.ring_end[ring]; ++c)
        visit(static_cast<std::uint32_t>(c), polygon.next(ring, static_cast<std::uint32_t>(c)));
    }
  }

  [[nodiscard]] int turn(const Rational3& a, const Rational3& b, const Rational3& c) const {
    const std::size_t x = first_axis(frame_);
    const std::size_t y = second_axis(frame_);
    return sgn(Rational((b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x])));
  }

  // Closed segments whose boxes meet.
  [[nodiscard]] bool sides_meet(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) const {
    const int of_c = turn(a, b, c);
    const int of_d = turn(a, b, d);
    if (of_c * of_d > 0) return false;
    const int of_a = turn(c, d, a);
    const int of_b = turn(c, d, b);
    if (of_a * of_b > 0) return false;
    if (of_c != 0 || of_d != 0) return true;
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));  // on one line
  }

  // Whether a point that is on no side is inside of a polygon: parity of the sides that a ray crosses.
  [[nodiscard]] bool holds(const PlanarPolygon& polygon, const std::vector<Rational3>& corners,
                           const Rational3& point) const {
    const std::size_t y = second_axis(frame_);
    const std::size_t x = first_axis(frame_);
    bool inside = false;
    for_each_side(polygon, [&](std::uint32_t from, std::uint32_t to) {
      const Rational3& a = corners[from];
      const Rational3& b = corners[to];
      if ((a[y] <= point[y]) == (b[y] <= point[y])) return;
      if (a[x] < point[x] && b[x] < point[x]) return;
      const bool rises = a[y] <= point[y];
      if (turn(a, b, point) == (rises ? 1 : -1)) inside = !inside;
    });
    return inside;
  }

  const PlanarPolygon& p_;
  const PlanarPolygon& q_;
  PlanarFrame frame_;
  Monitor monitor_;
  std::vector<Seen> seen_p_;
  std::vector<std::array<std::uint32_t, 2>> sides_;
  BoxTree tree_;
};

// The segments that are not surely inside, and their ends.
struct Remaining {
  std::vector<Rational3> points;
  std::vector<std::array<std::uint32_t, 2>> sources;  // of points: corners of P and Q
  std::vector<PlanarArrangement::Segment> segments;
};

Remaining remaining_segments(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame,
                             const Monitor& monitor) {
  const std::vector<ConvolutionSegment> all = planar_convolution(p, q, frame, monitor);
  // Squares as fine as the segments are many; few segments are not worth a grid.
  constexpr std::size_t kFew = 200;
  std::optional<CoveredCells> covered;
  if (all.size() > kFew) {
    const auto cells = static_cast<std::uint32_t>(2 * std::sqrt(static_cast<double>(all.size())));
    covered.emplace(p, q, frame, std::bit_ceil(std::min(cells, 512U)));
  }
  const std::vector<Seen> of_p = seen_corners(p.corners, frame);
  const std::vector<Seen> of_q = seen_corners(q.corners, frame);
  const auto place = [&](std::uint32_t i, std::uint32_t j) {
    return Seen{of_p[i][0] + of_q[j][0], of_p[i][1] + of_q[j][1]};
  };
  Remaining result;
  std::unordered_map<std::uint64_t, std::uint32_t> number;
  const auto point = [&](std::uint32_t i, std::uint32_t j) {
    const auto [at, is_new] = number.emplace(pair_key(i, j), static_cast<std::uint32_t>(result.points.size()));
    if (is_new) {
      result.points.push_back(plus(p.corners[i], q.corners[j]));
      result.sources.push_back({i, j});
    }
    return at->second;
  };
  for (const ConvolutionSegment& s : all) {
    if (covered && covered->cover(place(s.p[0], s.q[0]), place(s.p[1], s.q[1]))) continue;
    result.segments.push_back({point(s.p[0], s.q[0]), point(s.p[1], s.q[1])});
  }
  return result;
}

// Corners at which a ring turns, and those that rings come to more than once.
std::vector<std::uint32_t> without_straight(const std::vector<std::uint32_t>& ring, const MeshPoints& points,
                                            const std::vector<std::uint32_t>& visits, const PlanarFrame& frame,
                                            const Monitor& monitor) {
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t before = ring[(i + ring.size() - 1) % ring.size()];
    const std::uint32_t after = ring[(i + 1) % ring.size()];
    if (visits[ring[i]] > 1 || points.orientation_along(before, ring[i], after, frame.axis, monitor) != 0)
      result.push_back(ring[i]);
  }
  return result;
}

}  // namespace

PlanarSum planar_sum(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame, const Monitor& monitor) {
  Remaining remaining = remaining_segments(p, q, frame, monitor);
  const PlanarArrangement arrangement(std::move(remaining.points), std::move(remaining.segments), frame, monitor);
  const PlanarMembership membership(p, q, frame, monitor);
  std::vector<std::vector<std::uint32_t>> rings = arrangement.rings(std::cref(membership));
  // The outer ring has the least point, and points are sorted.
  const auto least = [](const std::vector<std::uint32_t>& ring) { return *std::min_element(ring.begin(), ring.end()); };
  std::sort(rings.begin(), rings.end(), [&](const auto& a, const auto& b) { return least(a) < least(b); });
  std::vector<std::uint32_t> visits(arrangement.points().size(), 0);
  for (const std::vector<std::uint32_t>& ring : rings) {
    for (const std::uint32_t corner : ring) ++visits[corner];
  }
  std::vector<std::array<std::uint32_t, 2>> source(arrangement.points().size(), {kNone, kNone});
  for (std::uint32_t i = 0; i < remaining.sources.size(); ++i)
    source[arrangement.number_of_given(i)] = remaining.sources[i];
  const MeshPoints points(arrangement.points());
  PlanarSum result;
  std::vector<std::uint32_t> number(arrangement.points().size(), kNone);
  for (const std::vector<std::uint32_t>& ring : rings) {
    std::vector<std::uint32_t>& added = result.rings.emplace_back();
    for (const std::uint32_t corner : without_straight(ring, points, visits, frame, monitor)) {
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(arrangement.points()[corner]);
        result.sources.push_back(source[corner]);
      }
      added.push_back(number[corner]);
    }
  }
  return result;
}

}  // namespace nef::minkowski
