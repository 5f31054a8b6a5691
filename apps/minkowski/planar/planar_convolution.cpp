// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/planar/planar_convolution.h"

#include <algorithm>
#include <numeric>

#include "nef/number/approximation.h"

namespace nef::minkowski {
namespace {

// The direction of a side, as it is seen.
struct SideDirection {
  Rational x, y;
  Approximation near_x, near_y;
  bool is_upper = false;  // its angle is in [0, 180) degrees
};

SideDirection direction_of_side(const Rational3& from, const Rational3& to, const PlanarFrame& frame) {
  SideDirection d;
  d.x = to[first_axis(frame)] - from[first_axis(frame)];
  d.y = to[second_axis(frame)] - from[second_axis(frame)];
  if (frame.sign < 0) d.y = -d.y;
  d.near_x = approximation_of(d.x);
  d.near_y = approximation_of(d.y);
  d.is_upper = sgn(d.y) > 0 || (sgn(d.y) == 0 && sgn(d.x) > 0);
  return d;
}

// +1 if b is counterclockwise of a by less than a half-turn, 0 if they are parallel.
int turn(const SideDirection& a, const SideDirection& b, const Monitor& monitor) {
  return sign_by_ladder(a.near_x * b.near_y - a.near_y * b.near_x, monitor,
                        [&] { return sgn(Rational(a.x * b.y - a.y * b.x)); });
}

// A corner between two sides, which are numbered as the corners at which they begin; ranks of their directions.
struct Corner {
  std::uint32_t corner = 0, next = 0;
  std::uint32_t in = 0, out = 0;
  bool is_convex = false;
};

class Directions {
 public:
  Directions(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame, const Monitor& monitor)
      : monitor_(monitor) {
    for (const PlanarPolygon* polygon : {&p, &q}) {
      for (std::size_t ring = 0, c = 0; ring < polygon->ring_end.size(); ++ring) {
        for (; c < polygon->ring_end[ring]; ++c) {
          const std::uint32_t next = polygon->next(ring, static_cast<std::uint32_t>(c));
          sides_.push_back(direction_of_side(polygon->corners[c], polygon->corners[next], frame));
        }
      }
    }
    rank_sides();
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }

  // `first`: the number of the polygon's first side.
  [[nodiscard]] std::vector<Corner> corners(const PlanarPolygon& polygon, std::size_t first) const {
    std::vector<Corner> result(polygon.corners.size());
    for (std::size_t ring = 0, c = 0; ring < polygon.ring_end.size(); ++ring) {
      for (; c < polygon.ring_end[ring]; ++c) {
        const auto here = static_cast<std::uint32_t>(c);
        const std::uint32_t next = polygon.next(ring, here);
        result[here].corner = here;
        result[here].next = next;
        result[here].out = rank_[first + here];
        result[next].in = rank_[first + here];
        result[next].is_convex = turn(sides_[first + here], sides_[first + next], monitor_) > 0;
      }
    }
    return result;
  }

 private:
  void rank_sides() {
    std::vector<std::uint32_t> order(sides_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
      if (sides_[i].is_upper != sides_[j].is_upper) return sides_[i].is_upper;
      return turn(sides_[i], sides_[j], monitor_) > 0;
    };
    std::sort(order.begin(), order.end(), before);
    rank_.resize(sides_.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k > 0 && before(order[k - 1], order[k])) ++count_;
      rank_[order[k]] = count_;
    }
    ++count_;
  }

  Monitor monitor_;
  std::vector<SideDirection> sides_;
  std::vector<std::uint32_t> rank_;
  std::uint32_t count_ = 0;  // of different directions
};

}  // namespace

std::vector<ConvolutionSegment> planar_convolution(const PlanarPolygon& p, const PlanarPolygon& q,
                                                   const PlanarFrame& frame, const Monitor& monitor) {
  const Directions directions(p, q, frame, monitor);
  const std::vector<Corner> of_p = directions.corners(p, 0);
  const std::vector<Corner> of_q = directions.corners(q, p.corners.size());
  const std::uint32_t count = directions.count();
  const auto steps = [count](std::uint32_t from, std::uint32_t to) {
    return to >= from ? to - from : to + count - from;
  };
  std::vector<ConvolutionSegment> result;
  for (const Corner& a : of_p) {
    monitor.check_interruption();
    for (const Corner& b : of_q) {
      if (b.is_convex && steps(b.in, a.out) < steps(b.in, b.out)) {
        result.push_back({{a.corner, a.next}, {b.corner, b.corner}});
      }
      if (a.is_convex && steps(b.out, a.out) < steps(a.in, a.out)) {
        result.push_back({{a.corner, a.corner}, {b.corner, b.next}});
      }
    }
  }
  return result;
}

}  // namespace nef::minkowski
