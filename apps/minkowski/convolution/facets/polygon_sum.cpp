// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/facets/polygon_sum.h"

#include <algorithm>

#include "nef/construct/planar_hull.h"

namespace nef::minkowski {
namespace {

// The corners on one side of the hull, from one of its ends to the other, which may be the same.
std::vector<std::uint32_t> chain(const MarkedPolygon& p, std::uint32_t from, std::uint32_t to) {
  std::vector<std::uint32_t> result{from};
  const auto size = static_cast<std::uint32_t>(p.corners.size());
  while (result.back() != to) result.push_back((result.back() + 1) % size);
  return result;
}

// Part of a chain: a corner, or the open side between two.
struct Part {
  Rational from, to;  // along the side of the hull
  std::uint8_t mark = 0;
  [[nodiscard]] bool is_corner() const { return from == to; }
};

std::vector<Part> parts_of(const MarkedPolygon& p, const std::vector<std::uint32_t>& chain, std::size_t axis,
                           bool backwards) {
  const auto place = [&](std::uint32_t i) { return backwards ? Rational(-p.corners[i][axis]) : p.corners[i][axis]; };
  std::vector<Part> parts;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    parts.push_back({place(chain[k]), place(chain[k]), p.corner_marks[chain[k]]});
    if (k + 1 < chain.size()) parts.push_back({place(chain[k]), place(chain[k + 1]), p.sides[chain[k]]});
  }
  return parts;
}

// One side of the hull of p + q, from the sum of two corners to that of two others.
class HullSide {
 public:
  HullSide(const MarkedPolygon& p, const MarkedPolygon& q, const SumCorner& from, const SumCorner& to) {
    const std::vector<std::uint32_t> of_p = chain(p, from.p, to.p);
    const std::vector<std::uint32_t> of_q = chain(q, from.q, to.q);
    std::size_t axis = 0;
    const auto extent = [&](std::size_t i) {
      return Rational(p.corners[to.p][i] + q.corners[to.q][i] - p.corners[from.p][i] - q.corners[from.q][i]);
    };
    while (axis < 2 && sgn(extent(axis)) == 0) ++axis;
    const bool backwards = sgn(extent(axis)) < 0;
    p_ = parts_of(p, of_p, axis, backwards);
    q_ = parts_of(q, of_q, axis, backwards);
    for (std::size_t i = 0; i < p_.size(); i += 2) {
      for (std::size_t j = 0; j < q_.size(); j += 2)
        cuts_.push_back({p_[i].from + q_[j].from, of_p[i / 2], of_q[j / 2]});
    }
    std::sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) { return a.at < b.at; });
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) { return a.at == b.at; }),
                cuts_.end());
  }

  void append_to(std::vector<SumCorner>& ring) const {
    for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
      ring.push_back({cuts_[k].p, cuts_[k].q, mark(cuts_[k].at, cuts_[k].at), mark(cuts_[k].at, cuts_[k + 1].at)});
    }
  }

 private:
  struct Cut {
    Rational at;
    std::uint32_t p = 0, q = 0;
  };

  // Of the point `from`, if that is `to`, or else of what lies between them.
  [[nodiscard]] std::uint8_t mark(const Rational& from, const Rational& to) const {
    for (const Part& a : p_) {
      for (const Part& b : q_) {
        if (a.mark == 0 || b.mark == 0) continue;
        const Rational low = a.from + b.from;
        const Rational high = a.to + b.to;
        const bool is_point = a.is_corner() && b.is_corner();
        if (is_point ? low == from && from == to : from == to ? low < from && from < high : low <= from && to <= high) {
          return 1;
        }
      }
    }
    return 0;
  }

  std::vector<Part> p_, q_;
  std::vector<Cut> cuts_;
};

}  // namespace

bool MarkedPolygon::is_full() const {
  const auto marked = [](std::uint8_t mark) { return mark != 0; };
  return inside != 0 && std::all_of(sides.begin(), sides.end(), marked) &&
         std::all_of(corner_marks.begin(), corner_marks.end(), marked);
}

bool MarkedPolygon::is_void() const {
  const auto marked = [](std::uint8_t mark) { return mark != 0; };
  return inside == 0 && std::none_of(sides.begin(), sides.end(), marked) &&
         std::none_of(corner_marks.begin(), corner_marks.end(), marked);
}

std::vector<SumCorner> polygon_sum(const MarkedPolygon& p, const MarkedPolygon& q, const Rational3& normal) {
  std::vector<Rational3> points;
  for (const Rational3& a : p.corners) {
    for (const Rational3& b : q.corners) points.push_back({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
  }
  const bool uniform = (p.is_full() && q.is_full()) || p.is_void() || q.is_void();
  const std::uint8_t mark = p.is_full() && q.is_full() ? 1 : 0;
  std::vector<SumCorner> hull;
  const auto count = static_cast<std::uint32_t>(q.corners.size());
  for (const std::uint32_t i : detail::planar_hull(points, normal)) hull.push_back({i / count, i % count, mark, mark});
  if (uniform) return hull;
  std::vector<SumCorner> ring;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    HullSide(p, q, hull[i], hull[i + 1 < hull.size() ? i + 1 : 0]).append_to(ring);
  }
  return ring;
}

}  // namespace nef::minkowski
