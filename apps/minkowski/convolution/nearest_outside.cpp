// SPDX-License-Identifier: Apache-2.0
//
// Let N be the complement of U = int A + int B, p the point of N nearest to the origin, and D the cone of translations
// that a contact of A with p - B allows (BoundaryMarker): near p, N is the intersection of the D of all contacts. If a
// D has no inside, p is a saddle point (interlock.h). Else facets of the convolution cover the boundary of each D, so
// near p, N is made of cells of the arrangement of the planes of the facets that hold p. Let L be what these planes
// have in common. N is the same along L near p, so p is the point of L nearest to the origin:
// - if L is a plane, the nearest one of a facet's plane;
// - if L is a line, the nearest one of a line in which two facets meet in a segment that p is on or at an end of: the
//   facets on both sides of an edge of a D, or, if all D are half-spaces near p, those that cover two of their
//   boundaries;
// - if L is a point, p lies on such a segment for the same reason, and on a third facet across it.
// These are the candidates. In order of their distances they are put to the definition: x is in U iff int A meets x -
// int B. The first that is not in U is the answer, whatever else was among the candidates.
//
// A bound of the distance comes first, from translations along a fan of directions; facets that are farther away are
// not made. Doubles with bounds leave out candidates that surely lie beyond it, beside their facets, or in cubes that
// are surely in U (CoveredVoxels).
#include "apps/minkowski/convolution/nearest_outside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "apps/minkowski/convolution/arrangement/facet_segments.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/threads/parallel.h"
#include "nef/number/approximation.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"

namespace nef::minkowski {
namespace {

template <typename Number>
struct PlaneForm {
  std::array<Number, 3> normal{};
  Number offset{};
};

// Where three planes meet. Of exact planes, the normals must be independent.
template <typename Number, typename Quotient>
std::array<Quotient, 3> meeting(const PlaneForm<Number>& f, const PlaneForm<Number>& g, const PlaneForm<Number>& h) {
  const std::array<Number, 3> gh = cross(g.normal, h.normal);
  const std::array<Number, 3> hf = cross(h.normal, f.normal);
  const std::array<Number, 3> fg = cross(f.normal, g.normal);
  const Quotient determinant(Number(dot(f.normal, gh)));
  std::array<Quotient, 3> point{};
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = -Quotient(Number(f.offset * gh[i] + g.offset * hf[i] + h.offset * fg[i])) / determinant;
  }
  return point;
}

template <typename Number, typename Quotient>
std::array<Quotient, 3> nearest_on_plane(const PlaneForm<Number>& f) {
  const Quotient square(Number(dot(f.normal, f.normal)));
  std::array<Quotient, 3> point{};
  for (std::size_t i = 0; i < 3; ++i) point[i] = -Quotient(Number(f.offset * f.normal[i])) / square;
  return point;
}

// The nearest point of a line is where it meets the plane through the origin across it.
template <typename Number, typename Quotient>
std::array<Quotient, 3> nearest_on_line(const PlaneForm<Number>& f, const PlaneForm<Number>& g) {
  return meeting<Number, Quotient>(f, g, {cross(f.normal, g.normal), {}});
}

PlaneForm<Integer> exact_form(const PlaneTable& planes, PlaneId plane) {
  PlaneForm<Integer> form;
  for (std::size_t i = 0; i < 3; ++i) form.normal[i] = Integer(planes.coefficient(plane, i));
  form.offset = Integer(planes.coefficient(plane, 3));
  return form;
}

// PlaneTable::approximate is within 2^-52 relative; what is infinite there stays unknown.
PlaneForm<Approximation> near_form(const PlaneTable& planes, PlaneId plane) {
  const std::array<double, 4>& c = planes.approximate(plane);
  const auto near = [](double x) { return Approximation{x, std::fabs(x) * 0x1p-52}; };
  return {{near(c[0]), near(c[1]), near(c[2])}, near(c[3])};
}

Box common_part(const Box& p, const Box& q) {
  Box result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.low[i] = std::max(p.low[i], q.low[i]);
    result.high[i] = std::min(p.high[i], q.high[i]);
  }
  return result;
}

// The nearest point of one, two or three planes in common.
struct NearestPoint {
  double lower = 0;  // of its distance from the origin
  std::array<PlaneId, 3> planes;
  std::uint32_t count = 0;
};

class Search {
 public:
  Search(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)
      : a_(a), b_(b), monitor_(monitor), membership_(a, negate(b, monitor)) {}

  std::optional<NearestOutside> run(std::string& why) {
    const bool convex_a = is_convex(closure(a_, monitor_), monitor_);
    const bool convex_b = is_convex(closure(b_, monitor_), monitor_);
    if (convex_a && convex_b) {
      why = "both operands are convex";
      return std::nullopt;
    }
    const SolidFeatures of_a(a_, monitor_);
    const SolidFeatures of_b(b_, monitor_);
    const bool may_interlock = !convex_a && !convex_b;
    if (may_interlock && !(of_a.has_simple_edges() && of_b.has_simple_edges())) {
      why = "an edge has several wedges, and neither operand is convex";
      return std::nullopt;
    }
    leave_by_axes();
    leave_by_fan();
    // Shares of the time are measured, for the bar only.
    monitor_.tell_progress(kSumPhase, 1, 10);
    const NearOrigin near(bound_);
    facets_ = reduced_convolution(of_a, of_b, monitor_, near);
    const RoundedFacets rounded(facets_, monitor_);
    if (!rounded.are_proven()) {
      why = "coordinates are too large or too small for doubles";
      return std::nullopt;
    }
    rounded_ = &rounded;
    monitor_.tell_progress(kSumPhase, 4, 10);
    if (may_interlock) {
      const Saddles saddles_a(a_, monitor_);
      const Saddles saddles_b(b_, monitor_);
      for (const SaddlePoint& saddle :
           saddle_points(saddles_a, saddles_b, membership_, facets_.covered, monitor_, near)) {
        try_point(saddle.point);
      }
    }
    find_on_planes();
    try_candidates();
    monitor_.tell_progress(kSumPhase, 6, 10);
    find_on_segments();
    monitor_.tell_progress(kSumPhase, 8, 10);
    try_candidates();
    monitor_.tell_progress(kSumPhase, 10, 10);
    result_.facets = near_facets_.size();
    return std::move(result_);
  }

 private:
  // Sets the answer so far, to a point that is not in the sum.
  void set_best(const Rational3& point, const Rational& squared) {
    result_.point = point;
    result_.squared = squared;
    // Rounded up: the nearest double of the square is within 2^-53, its root within 2^-52.
    bound_ = std::sqrt(nearest_double(squared)) * (1 + 0x1p-40);
  }

  // Takes a point for the answer if it is nearer than that, and not in the sum.
  bool try_point(const Rational3& point) {
    const Rational squared = dot(point, point);
    if (squared >= result_.squared) return false;
    ++result_.tested;
    if (membership_.in_sum(point, monitor_)) return false;
    set_best(point, squared);
    return true;
  }

  // Along an axis, until the boxes of the operands touch.
  void leave_by_axes() {
    const std::array<Rational3, 2> box_a = bounding_box(a_, monitor_).value();
    const std::array<Rational3, 2> box_b = bounding_box(b_, monitor_).value();
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t side : {0U, 1U}) {
        Rational3 point;
        point[i] = box_a[side][i] + box_b[side][i];
        const Rational squared = dot(point, point);
        if (any && squared >= result_.squared) continue;
        set_best(point, squared);
        any = true;
      }
    }
  }

  // Along some directions, by less than the answer so far.
  void leave_by_fan() {
    constexpr int kSteps = 2;
    constexpr std::array<double, 3> kShares = {0.9, 0.97, 0.99};
    for (const double share : kShares) {
      for (int x = -kSteps; x <= kSteps; ++x) {
        for (int y = -kSteps; y <= kSteps; ++y) {
          for (int z = -kSteps; z <= kSteps; ++z) {
            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) < kSteps) continue;
            const double length = std::sqrt(x * x + y * y + z * z);
            while (true) {
              const double step = bound_ * share / length;
              if (!(step > 0) || !try_point({Rational(x * step), Rational(y * step), Rational(z * step)})) break;
            }
          }
        }
      }
    }
  }

  // True unless a point in doubles, each coordinate with its error, surely lies beside a facet.
  [[nodiscard]] bool may_be_on(std::uint32_t facet, const Double3& x, double error) const {
    for (const RoundedSide& side : rounded_->sides(facet)) {
      if (side.value(x) < -(side.slack + side.weight * error)) return false;
    }
    return true;
  }

  // Keeps a candidate unless it surely lies beyond the answer so far, beside one of the facets, or in the sum. Where
  // doubles do not tell where it is, it is not nearer than `lower`.
  void add(const std::array<Approximation, 3>& point, double lower, std::span<const std::uint32_t> facets) {
    const double extent = rounded_->extent();
    double error = 0;
    Double3 x{};
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = point[i].value;
      error = std::max(error, point[i].error);
    }
    if (error < 0x1p-20 * extent) {
      const Approximation square = dot(point, point);
      const double least = square.value - square.error;
      if (least > 0) lower = std::max(lower, std::sqrt(least) * (1 - 0x1p-50));
      if (lower > bound_ || std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])}) > 2 * extent) return;
      for (const std::uint32_t f : facets) {
        if (!may_be_on(f, x, error)) return;
      }
      if (facets_.covered.cover({&x, 1}, error)) return;
    }
    NearestPoint& c = candidates_.emplace_back();
    c.lower = lower;
    for (const std::uint32_t f : facets) c.planes[c.count++] = facets_.plane[f];
  }

  void find_on_planes() {
    const NearOrigin near(bound_);
    forms_.resize(facets_.size());
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      if (!near.may_hold(rounded_->box(f))) continue;
      forms_[f] = near_form(facets_.planes, facets_.plane[f]);
      near_facets_.push_back(f);
      add(nearest_on_plane<Approximation, Approximation>(forms_[f]), 0, {&f, 1});
    }
  }

  // A lower bound of the distance of a part of a segment from the origin. Its ends are within `error` in each
  // coordinate, which is at least 4u of the largest coordinate; coordinates of the point at t are rounded by less than
  // 6u of that, and the error of t moves it along the segment by less than 10u of it.
  static double distance_of(const Double3& from, const Double3& to, double error) {
    double along = 0;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      along -= from[i] * (to[i] - from[i]);
      square += (to[i] - from[i]) * (to[i] - from[i]);
    }
    const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
    double nearest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = from[i] + t * (to[i] - from[i]);
      nearest += x * x;
    }
    return std::sqrt(nearest) * (1 - 0x1p-40) - 16 * error;
  }

  void find_on_segments() {
    const NearOrigin near(bound_);
    std::vector<Box> boxes;
    std::vector<std::uint32_t> facets;
    Box ball;
    ball.low.fill(-bound_);
    ball.high.fill(bound_);
    for (const std::uint32_t f : near_facets_) {
      if (!comes_near(f)) continue;
      facets.push_back(f);
      boxes.push_back(common_part(rounded_->box(f), ball));
    }
    const BoxTree tree(boxes);
    SegmentFinder finder(facets_, *rounded_, monitor_);
    std::size_t pairs = 0;
    tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) {
      if (!near.may_hold(common_part(boxes[i], boxes[j]))) return;
      if (++pairs % 1024 == 0) monitor_.check_interruption();
      const std::optional<FacetSegment> s = finder.find(facets[i], facets[j]);
      if (s) find_on_segment(*s, tree, facets);
    });
  }

  // False if the plane of a facet is surely farther than the answer so far.
  [[nodiscard]] bool comes_near(std::uint32_t f) const {
    const PlaneForm<Approximation>& form = forms_[f];
    const Approximation square = dot(form.normal, form.normal);
    const Approximation offset = form.offset * form.offset;
    return !(offset.value - offset.error > bound_ * bound_ * (square.value + square.error) * (1 + 0x1p-40));
  }

  void find_on_segment(const FacetSegment& s, const BoxTree& tree, const std::vector<std::uint32_t>& facets) {
    // The part that may be in the ball.
    Interval part{0, 1};
    if (!clip_to_ball(s, part)) return;
    const Double3 from = s.at(part.low);
    const Double3 to = s.at(part.high);
    if (facets_.covered.cover(std::array{from, to}, s.error)) return;
    const double lower = std::max(0.0, distance_of(from, to, s.error));
    const std::array<std::uint32_t, 2> two = {s.f, s.g};
    add(nearest_on_line<Approximation, Approximation>(forms_[s.f], forms_[s.g]), lower, two);
    const Box box = s.box_of(part);
    tree.for_each_overlap(box, [&](std::uint32_t i) {
      const std::uint32_t h = facets[i];
      if (h == s.f || h == s.g) return;
      const FormOnSegment form(rounded_->plane(h), s);
      const double first = form.at + form.slope * part.low;
      const double last = form.at + form.slope * part.high;
      if ((first > form.error && last > form.error) || (first < -form.error && last < -form.error)) return;
      const std::array<std::uint32_t, 3> three = {s.f, s.g, h};
      add(meeting<Approximation, Approximation>(forms_[s.f], forms_[s.g], forms_[h]), lower, three);
    });
  }

  // Halves of what is surely outside go, a few times.
  [[nodiscard]] bool clip_to_ball(const FacetSegment& s, Interval& part) const {
    const auto is_far = [&](double low, double high) { return distance_of(s.at(low), s.at(high), s.error) > bound_; };
    if (is_far(part.low, part.high)) return false;
    for (int i = 0; i < 8; ++i) {
      const double middle = (part.low + part.high) / 2;
      const double quarter = (part.high - part.low) / 4;
      if (is_far(part.low, middle)) {
        part.low = middle;
      } else if (is_far(middle, part.high)) {
        part.high = middle;
      } else if (is_far(part.low, part.low + quarter)) {
        part.low += quarter;
      } else if (is_far(part.high - quarter, part.high)) {
        part.high -= quarter;
      } else {
        break;
      }
    }
    return true;
  }

  [[nodiscard]] std::optional<Rational3> exact_point(const NearestPoint& c) const {
    const PlaneForm<Integer> f = exact_form(facets_.planes, c.planes[0]);
    if (c.count == 1) return nearest_on_plane<Integer, Rational>(f);
    const PlaneForm<Integer> g = exact_form(facets_.planes, c.planes[1]);
    const Integer3 line = cross(f.normal, g.normal);
    if (is_zero(line)) return std::nullopt;
    if (c.count == 2) return nearest_on_line<Integer, Rational>(f, g);
    const PlaneForm<Integer> h = exact_form(facets_.planes, c.planes[2]);
    if (dot(line, h.normal) == 0) return std::nullopt;
    return meeting<Integer, Rational>(f, g, h);
  }

  void try_candidates() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const NearestPoint& p, const NearestPoint& q) { return p.lower < q.lower; });
    result_.candidates += candidates_.size();
    for (const NearestPoint& c : candidates_) {
      if (c.lower > bound_) break;
      monitor_.tell_progress(kSumPhase, 8, 10);
      const std::optional<Rational3> point = exact_point(c);
      if (point && tried_.insert(*point).second) try_point(*point);
    }
    candidates_.clear();
  }

  const Polyhedron& a_;
  const Polyhedron& b_;
  Monitor monitor_;
  SumMembership membership_;
  ConvolutionFacets facets_;
  const RoundedFacets* rounded_ = nullptr;
  std::vector<std::uint32_t> near_facets_;
  std::vector<PlaneForm<Approximation>> forms_;  // of facets that are near
  std::vector<NearestPoint> candidates_;
  std::set<Rational3> tried_;
  NearestOutside result_;
  double bound_ = 0;  // of the distance of the answer so far, rounded up
};

}  // namespace

std::optional<NearestOutside> nearest_outside(const Polyhedron& a, const Polyhedron& b, std::string& why,
                                              const Monitor& monitor) {
  return Search(a, b, monitor).run(why);
}

}  // namespace nef::minkowski
