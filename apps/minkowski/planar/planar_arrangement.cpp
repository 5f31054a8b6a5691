// SPDX-License-Identifier: Apache-2.0
//
// A tree of boxes gives pairs of segments; exact signs say where they meet. Points are sorted lexicographically, so
// that numbers of points order those on a segment, and the half-plane of larger points is where a turn around a point
// starts. Half-atoms around each point are sorted by angle, which links them to the cycles around faces. A cycle is
// inside if a segment says so; else a point beside it is asked about, half-way to what a ray along a coordinate axis
// meets first.
#include "apps/minkowski/planar/planar_arrangement.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

Box box_around(const Rational3& a, const Rational3& b) {
  Box box;
  for (const Rational3* p : {&a, &b}) box.add_rounded(nearest_doubles(*p));
  return box;
}

}  // namespace

PlanarArrangement::PlanarArrangement(std::vector<Rational3> points, std::vector<Segment> segments,
                                     const PlanarFrame& frame, const Monitor& monitor)
    : points_(std::move(points)),
      given_(points_.size()),
      segments_(std::move(segments)),
      frame_(frame),
      monitor_(monitor) {
  std::iota(given_.begin(), given_.end(), 0U);
  cut_segments();
  link_atoms();
}

void PlanarArrangement::cut_segments() {
  std::vector<Cut> cuts;
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    for (const std::uint32_t end : segments_[s]) cuts.push_back({s, end});
  }
  const MeshPoints known(points_);
  std::vector<Box> boxes;
  for (const auto& [from, to] : segments_) boxes.push_back(box_around(points_[from], points_[to]));
  BoxTree(boxes).for_each_pair([&](std::uint32_t s, std::uint32_t t) {
    monitor_.check_interruption();
    cut_pair(known, s, t, cuts);
  });
  sort_points(cuts);
  make_atoms(std::move(cuts));
}

// True for a point on the line of a segment that lies between its ends.
bool PlanarArrangement::between(const MeshPoints& known, std::uint32_t s, std::uint32_t point) const {
  const int from = known.compare(segments_[s][0], point);
  return from != 0 && from == known.compare(point, segments_[s][1]);
}

void PlanarArrangement::cut_pair(const MeshPoints& known, std::uint32_t s, std::uint32_t t, std::vector<Cut>& cuts) {
  const std::array<std::uint32_t, 2> pair = {s, t};
  std::array<std::array<int, 2>, 2> side{};  // of the ends of the other segment
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& [from, to] = segments_[pair[k]];
    const Segment& other = segments_[pair[1 - k]];
    for (std::size_t e = 0; e < 2; ++e) {
      const bool is_end = other[e] == from || other[e] == to;
      side[k][e] = is_end ? 0 : known.orientation_along(from, to, other[e], frame_.axis, monitor_);
    }
    if (side[k][0] * side[k][1] > 0) return;
  }
  if (side[0][0] * side[0][1] < 0 && side[1][0] * side[1][1] < 0) return cross(s, t, cuts);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t e = 0; e < 2; ++e) {
      const std::uint32_t end = segments_[pair[1 - k]][e];
      if (side[k][e] == 0 && between(known, pair[k], end)) cuts.push_back({pair[k], end});
    }
  }
}

void PlanarArrangement::cross(std::uint32_t s, std::uint32_t t, std::vector<Cut>& cuts) {
  const std::size_t x = first_axis(frame_);
  const std::size_t y = second_axis(frame_);
  const Rational3& a = points_[segments_[s][0]];
  const Rational3& b = points_[segments_[s][1]];
  const Rational3& c = points_[segments_[t][0]];
  const Rational3& d = points_[segments_[t][1]];
  const Rational of_c = (c[x] - a[x]) * (d[y] - c[y]) - (c[y] - a[y]) * (d[x] - c[x]);
  const Rational all = (b[x] - a[x]) * (d[y] - c[y]) - (b[y] - a[y]) * (d[x] - c[x]);
  const Rational part = of_c / all;
  Rational3 point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = a[i] + part * (b[i] - a[i]);
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(std::move(point));
  cuts.push_back({s, number});
  cuts.push_back({t, number});
}

void PlanarArrangement::sort_points(std::vector<Cut>& cuts) {
  struct Place {
    std::array<double, 3> rounded;
    std::uint32_t point = 0;
  };
  std::vector<Place> places(points_.size());
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) places[i].rounded[k] = nearest_double(points_[i][k]);
    places[i].point = i;
  }
  // Rounding keeps the order.
  const auto before = [&](const Place& a, const Place& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.rounded[k] != b.rounded[k]) return a.rounded[k] < b.rounded[k];
      const int order = cmp(points_[a.point][k], points_[b.point][k]);
      if (order != 0) return order < 0;
    }
    return false;
  };
  std::sort(places.begin(), places.end(), before);
  std::vector<std::uint32_t> number(points_.size());
  std::vector<Rational3> sorted;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || before(places[i - 1], places[i])) sorted.push_back(points_[places[i].point]);
    number[places[i].point] = static_cast<std::uint32_t>(sorted.size() - 1);
  }
  points_ = std::move(sorted);
  for (std::uint32_t& g : given_) g = number[g];
  for (Cut& cut : cuts) cut.point = number[cut.point];
  for (Segment& segment : segments_) {
    for (std::uint32_t& end : segment) end = number[end];
  }
}

void PlanarArrangement::make_atoms(std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.point < b.point;
  });
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i].segment != cuts[i + 1].segment || cuts[i].point == cuts[i + 1].point) continue;
    const Segment& segment = segments_[cuts[i].segment];
    const bool upwards = segment[0] < segment[1];
    atoms_.push_back({cuts[i].point, cuts[i + 1].point, upwards, !upwards});
  }
  std::sort(atoms_.begin(), atoms_.end(),
            [](const Atom& a, const Atom& b) { return pair_key(a.low, a.high) < pair_key(b.low, b.high); });
  std::size_t kept = 0;
  for (const Atom& atom : atoms_) {
    if (kept > 0 && atoms_[kept - 1].low == atom.low && atoms_[kept - 1].high == atom.high) {
      atoms_[kept - 1].inside_left |= atom.inside_left;
      atoms_[kept - 1].inside_right |= atom.inside_right;
    } else {
      atoms_[kept++] = atom;
    }
  }
  atoms_.resize(kept);
}

void PlanarArrangement::link_atoms() {
  const auto halves = static_cast<std::uint32_t>(2 * atoms_.size());
  next_.resize(halves);
  std::vector<std::uint32_t> clockwise(halves);  // the next half-atom that leaves the same point
  std::vector<std::uint32_t> leaving(halves);
  std::iota(leaving.begin(), leaving.end(), 0U);
  const MeshPoints known(points_);
  std::sort(leaving.begin(), leaving.end(), [&](std::uint32_t g, std::uint32_t h) {
    const std::uint32_t at = source(g);
    if (at != source(h)) return at < source(h);
    const bool g_upwards = target(g) > at;
    if (g_upwards != (target(h) > at)) return g_upwards;
    return frame_.sign * known.orientation_along(at, target(g), target(h), frame_.axis, monitor_) > 0;
  });
  for (std::size_t first = 0; first < leaving.size();) {
    std::size_t end = first;
    while (end < leaving.size() && source(leaving[end]) == source(leaving[first])) ++end;
    for (std::size_t i = first; i < end; ++i) clockwise[leaving[i]] = leaving[i == first ? end - 1 : i - 1];
    first = end;
  }
  for (std::uint32_t h = 0; h < halves; ++h) next_[h] = clockwise[h ^ 1U];
}

// Nothing if no segment bounds what lies to the left of it.
std::optional<Rational3> PlanarArrangement::point_left_of(std::uint32_t half, const BoxTree& tree) const {
  const std::array<std::size_t, 2> axes = {first_axis(frame_), second_axis(frame_)};
  const Rational3& a = points_[source(half)];
  const Rational3& b = points_[target(half)];
  const Rational3 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  // Left is (-dy, dx); the ray goes along the axis where that is larger.
  const Rational left[2] = {Rational(frame_.sign * (a[axes[1]] - b[axes[1]])),
                            Rational(frame_.sign * (b[axes[0]] - a[axes[0]]))};
  const std::size_t along = abs(left[0]) > abs(left[1]) ? 0 : 1;
  const int forward = sgn(left[along]);
  const std::size_t x = axes[along];
  const std::size_t y = axes[1 - along];
  const double place = nearest_double(middle[y]);
  const double from = nearest_double(middle[x]);
  Box thin;
  thin.add_rounded({place, place, place});
  std::optional<Rational> nearest;  // how far along the ray, as a multiple of the axis
  std::optional<Rational3> hit;
  const auto may_meet = [&](const Box& box) {
    return box.low[y] <= thin.high[y] && thin.low[y] <= box.high[y] &&
           (forward > 0 ? box.high[x] >= from - std::fabs(from) * 0x1p-50
                        : box.low[x] <= from + std::fabs(from) * 0x1p-50);
  };
  tree.for_each_if(may_meet, [&](std::uint32_t atom) {
    const Rational3& p = points_[atoms_[atom].low];
    const Rational3& q = points_[atoms_[atom].high];
    const int of_p = cmp(p[y], middle[y]);
    const int of_q = cmp(q[y], middle[y]);
    if (of_p * of_q > 0) return;
    const auto look_at = [&](const Rational3& point) {
      const Rational distance = forward * (point[x] - middle[x]);
      if (sgn(distance) <= 0 || (nearest && *nearest <= distance)) return;
      nearest = distance;
      hit = point;
    };
    if (of_p == of_q) {  // on the ray's line
      look_at(p);
      look_at(q);
      return;
    }
    const Rational part = (middle[y] - p[y]) / (q[y] - p[y]);
    look_at({p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1]), p[2] + part * (q[2] - p[2])});
  });
  if (!hit) return std::nullopt;
  return Rational3{((*hit)[0] + middle[0]) / 2, ((*hit)[1] + middle[1]) / 2, ((*hit)[2] + middle[2]) / 2};
}

// Of each half-atom, whether the face on its left is inside.
std::vector<std::uint8_t> PlanarArrangement::insides(const std::function<bool(const Rational3&)>& is_inside) const {
  std::vector<Box> boxes;
  for (const Atom& atom : atoms_) boxes.push_back(box_around(points_[atom.low], points_[atom.high]));
  const BoxTree tree(boxes);
  enum : std::uint8_t { kOut, kIn, kUnknown };
  std::vector<std::uint8_t> state(next_.size(), kUnknown);
  std::vector<std::uint32_t> cycle;
  for (std::uint32_t first = 0; first < next_.size(); ++first) {
    if (state[first] != kUnknown) continue;
    monitor_.check_interruption();
    cycle.clear();
    bool is_in = false;
    for (std::uint32_t h = first; cycle.empty() || h != first; h = next_[h]) {
      cycle.push_back(h);
      is_in = is_in || inside_of(h);
    }
    if (!is_in) {
      const std::optional<Rational3> point = point_left_of(first, tree);
      is_in = point && is_inside(*point);
    }
    for (const std::uint32_t h : cycle) state[h] = is_in ? kIn : kOut;
  }
  return state;
}

std::vector<std::vector<std::uint32_t>> PlanarArrangement::rings(
    const std::function<bool(const Rational3&)>& is_inside) const {
  const std::vector<std::uint8_t> inside = insides(is_inside);
  const auto is_border = [&](std::uint32_t h) { return inside[h] != 0 && inside[h ^ 1U] == 0; };
  std::vector<std::vector<std::uint32_t>> result;
  std::vector<std::uint8_t> done(next_.size(), 0);
  for (std::uint32_t first = 0; first < next_.size(); ++first) {
    if (done[first] != 0 || !is_border(first)) continue;
    std::vector<std::uint32_t>& ring = result.emplace_back();
    std::uint32_t h = first;
    do {
      done[h] = 1;
      ring.push_back(source(h));
      h = next_[h];
      while (!is_border(h)) h = next_[h ^ 1U];
    } while (h != first);
  }
  return result;
}

}  // namespace nef::minkowski
