// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/skeleton.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "apps/visual_hull/skeleton_complex.h"
#include "apps/visual_hull/skeleton_view.h"
#include "nef/base/parallel.h"
#include "nef/base/predicate_counts.h"

namespace visual_hull {
namespace {

constexpr double kUnit = 0x1p-50;
// Spots with larger errors, as parts of the box's size, are computed exactly: ends of candidates, and places on them.
constexpr double kGoodEnd = 1e-9;
constexpr double kGoodPlace = 1e-7;

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

SpotName sorted_name(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  SpotName name{a, b, c};
  std::sort(name.begin(), name.end());
  return name;
}

/// A part of a line that is not yet cut off, between two spots.
struct Interval {
  Spot from, to;
};

class Skeleton : public ExactSpots {
 public:
  Skeleton(const std::vector<SkeletonInput>& inputs, const WorldBox& box) {
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = nef::nearest_double(box.low[i]);
      high_[i] = nef::nearest_double(box.high[i]);
      size_ = std::max(size_, high_[i] - low_[i]);
    }
    std::size_t edges = 0;
    for (const SkeletonInput& input : inputs) edges += input.silhouette->vertex_count();
    edges_.reserve(edges);
    views_.reserve(inputs.size());
    for (const SkeletonInput& input : inputs) {
      if (sgn(depth_range(*input.camera, box).nearest) <= 0) throw Undecided{};
      views_.emplace_back(*input.camera, *input.silhouette, static_cast<std::uint32_t>(views_.size()), *this, edges_);
    }
  }

  // The names of all vertices, once for each edge that ends there.
  std::vector<SpotName> run(unsigned threads) {
    const std::size_t n = views_.size();
    std::vector<std::array<std::uint32_t, 2>> tasks;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = i; j < n; ++j) tasks.push_back({i, j});
    }
    std::vector<std::vector<SpotName>> found(tasks.size());
    nef::parallel_for(tasks.size(), threads, [&](std::size_t k) {
      Worker worker(*this, found[k]);
      if (tasks[k][0] == tasks[k][1]) {
        worker.rays(tasks[k][0]);
      } else {
        worker.pairs(tasks[k][0], tasks[k][1]);
      }
    });
    std::vector<SpotName> names;
    for (const auto& part : found) names.insert(names.end(), part.begin(), part.end());
    return names;
  }

  [[nodiscard]] const std::vector<SkeletonEdge>& edges() const { return edges_; }
  [[nodiscard]] const SkeletonView& view(std::uint32_t i) const { return views_[i]; }

  [[nodiscard]] Rational3 exact(const Spot& spot) const override {
    if (spot.name == kNoName) throw Undecided{};
    std::array<RationalPlane, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const SkeletonEdge& edge = edges_[spot.name[i]];
      p[i] = plane_through(views_[edge.view].camera(), *edge.from, *edge.to);
    }
    // Cramer's rule by cross products of the normals.
    const auto product = [](const Rational3& a, const Rational3& b) {
      return Rational3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Rational3 qr = product(p[1].normal, p[2].normal);
    const Rational3 rp = product(p[2].normal, p[0].normal);
    const Rational3 pq = product(p[0].normal, p[1].normal);
    const Rational determinant = p[0].normal[0] * qr[0] + p[0].normal[1] * qr[1] + p[0].normal[2] * qr[2];
    if (sgn(determinant) == 0) throw Undecided{};
    Rational3 x;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = -(p[0].offset * qr[i] + p[1].offset * rp[i] + p[2].offset * pq[i]) / determinant;
    }
    return x;
  }

 private:
  /// The work on one pair of views, or on the rays of one.
  class Worker {
   public:
    Worker(const Skeleton& all, std::vector<SpotName>& found) : s_(all), found_(found), stamps_(all.views_.size()) {}

    // Edges on the edges of view i's cone.
    void rays(std::uint32_t i) {
      const SkeletonView& view = s_.views_[i];
      for (std::uint32_t e = view.first_edge(); e < view.first_edge() + view.edge_count(); ++e) {
        if (s_.edges_[e].place != e) continue;
        const Vector& ray = s_.edges_[e].ray;
        Spot apex{view.centre().at, view.centre().error, kNoName};
        // A far end beyond the box; the apex is in front of it.
        double reach = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          reach += std::max(std::abs(s_.low_[k] - apex.at[k]), std::abs(s_.high_[k] - apex.at[k]));
        }
        Spot far = apex;
        const double scale = 2 * reach / norm(ray.at);
        for (std::size_t k = 0; k < 3; ++k) far.at[k] += scale * ray.at[k];
        far.error = apex.error + scale * ray.error + reach * kUnit;
        cut({apex, far}, s_.edges_[e].previous, e, i, i);
      }
    }

    // Edges in a facet of each of two cones.
    void pairs(std::uint32_t i, std::uint32_t j) {
      meetings_.clear();
      spots_.clear();
      sweep(i, j);
      sweep(j, i);
      std::sort(meetings_.begin(), meetings_.end());
      for (std::size_t k = 0; k < meetings_.size();) {
        std::size_t end = k + 1;
        while (end < meetings_.size() && meetings_[end].edges == meetings_[k].edges) ++end;
        const auto [e, f] = meetings_[k].edges;
        const Spot& a = spots_[meetings_[k].spot];
        if (end - k > 2) throw Undecided{};
        cut(end - k == 2 ? Interval{a, spots_[meetings_[k + 1].spot]} : Interval{a, far_end(a, e, f)}, e, f, i, j);
        k = end;
      }
    }

   private:
    /// A place where the facets of two edges (of the first view and the second) begin or end to meet.
    struct Meeting {
      std::array<std::uint32_t, 2> edges{};
      std::uint32_t spot = 0;
      bool operator<(const Meeting& o) const { return std::tie(edges, spot) < std::tie(o.edges, o.spot); }
    };

    /// A ray as seen along the line through the two centres.
    struct Turn {
      double angle = 0;
      std::uint32_t edge = 0;
      bool operator<(const Turn& o) const { return angle < o.angle; }
    };

    struct Axis {
      Vec3 along{}, u{}, w{};
      double error = 0;
    };

    Axis axis_between(std::uint32_t i, std::uint32_t j) const {
      Axis axis;
      const Vector& a = s_.views_[i].centre();
      const Vector& b = s_.views_[j].centre();
      for (std::size_t k = 0; k < 3; ++k) axis.along[k] = b.at[k] - a.at[k];
      const double length = norm(axis.along);
      axis.error = a.error + b.error + length * kUnit;
      if (!(length > axis.error * 1e6)) throw Undecided{};  // (nearly) one centre
      std::size_t least = 0;
      for (std::size_t k = 1; k < 3; ++k) {
        if (std::abs(axis.along[k]) < std::abs(axis.along[least])) least = k;
      }
      Vec3 unit{};
      unit[least] = 1;
      axis.u = cross(axis.along, unit);
      const double scale = norm(axis.u);
      for (double& c : axis.u) c /= scale;
      axis.w = cross(axis.along, axis.u);
      for (double& c : axis.w) c /= length;
      return axis;
    }

    // The angle of a ray around the axis; NaN if it runs nearly along the axis.
    static double angle_of(const Axis& axis, const Vec3& ray) {
      const double x = dot(ray, axis.u);
      const double y = dot(ray, axis.w);
      return std::hypot(x, y) > 1e-6 * norm(ray) ? std::atan2(y, x) : NAN;
    }

    // Where the rays of view i meet the facets of view j.
    void sweep(std::uint32_t i, std::uint32_t j) {
      const Axis axis = axis_between(i, j);
      const SkeletonView& from = s_.views_[i];
      const SkeletonView& to = s_.views_[j];
      turns_.clear();
      std::vector<std::uint32_t> polar;
      for (std::uint32_t e = from.first_edge(); e < from.first_edge() + from.edge_count(); ++e) {
        if (s_.edges_[e].place != e) continue;
        const double angle = angle_of(axis, s_.edges_[e].ray.at);
        if (std::isnan(angle)) {
          polar.push_back(e);
        } else {
          turns_.push_back({angle, e});
        }
      }
      std::sort(turns_.begin(), turns_.end());
      for (std::uint32_t f = to.first_edge(); f < to.first_edge() + to.edge_count(); ++f) {
        const double a = angle_of(axis, s_.edges_[f].ray.at);
        const double b = angle_of(axis, s_.edges_[s_.edges_[f].next].ray.at);
        const double turn = std::remainder(b - a, 2 * M_PI);
        constexpr double kSlack = 1e-7;
        if (!(std::abs(turn) < 3)) {  // also for NaN: all rays
          for (const Turn& t : turns_) meet(axis, i, j, t.edge, f);
        } else {
          const double low = std::min(a, a + turn) - kSlack;
          const double high = std::max(a, a + turn) + kSlack;
          for (const double shift : {-2 * M_PI, 0.0, 2 * M_PI}) {
            auto it = std::lower_bound(turns_.begin(), turns_.end(), Turn{low + shift, 0});
            for (; it != turns_.end() && it->angle <= high + shift; ++it) meet(axis, i, j, it->edge, f);
          }
        }
        for (const std::uint32_t e : polar) meet(axis, i, j, e, f);
      }
    }

    // The sign of det(axis, ray of e, ray of g): the side of ray g on which ray e passes.
    int side(const Axis& axis, std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t g) const {
      const Vector& r = s_.edges_[e].ray;
      const Vector& q = s_.edges_[g].ray;
      const double nr = norm(r.at);
      const double nq = norm(q.at);
      const double nb = norm(axis.along);
      const double value = dot(axis.along, cross(r.at, q.at));
      // Each factor is off by its error; 16 covers norms of components and the roundings.
      const double bound = 16 * (nb * nr * nq * kUnit + axis.error * nr * nq + nb * (r.error * nq + q.error * nr));
      if (value > bound || value < -bound) {
        ++nef::predicate_counts().filter;
        return value > 0 ? 1 : -1;
      }
      ++nef::predicate_counts().exact;
      const Camera& a = s_.views_[i].camera();
      const Camera& b = s_.views_[j].camera();
      const Rational3 x = a.ray(*s_.edges_[e].from);
      const Rational3 y = b.ray(*s_.edges_[g].from);
      Rational determinant;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        const std::size_t m = (k + 2) % 3;
        determinant += (b.centre()[k] - a.centre()[k]) * (x[l] * y[m] - x[m] * y[l]);
      }
      if (sgn(determinant) == 0) throw Undecided{};
      return sgn(determinant);
    }

    // Ray e of view i and the facet of edge f of view j.
    void meet(const Axis& axis, std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t f) {
      if (side(axis, i, j, e, f) == side(axis, i, j, e, s_.edges_[f].next)) return;
      Spot spot;
      if (!pierce(i, j, e, f, spot)) return;
      const auto index = static_cast<std::uint32_t>(spots_.size());
      spots_.push_back(spot);
      for (std::uint32_t at = e; at != UINT32_MAX; at = s_.edges_[at].next_at_place) {
        for (const std::uint32_t own : {s_.edges_[at].previous, at}) {
          meetings_.push_back({i < j ? std::array{own, f} : std::array{f, own}, index});
        }
      }
    }

    // Where the line of ray e meets the plane of edge f; true if in front of both cameras.
    bool pierce(std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t f, Spot& spot) const {
      const SkeletonEdge& edge = s_.edges_[f];
      const Vector& ray = s_.edges_[e].ray;
      const Vector& centre = s_.views_[i].centre();
      spot.name = sorted_name(s_.edges_[e].previous, e, f);
      double height_error = 0;
      const double height = s_.height(edge, centre.at, centre.error, height_error);
      const double slope = dot(edge.normal.at, ray.at);
      const double slope_error =
          4 * (norm(edge.normal.at) * (ray.error + norm(ray.at) * kUnit) + edge.normal.error * norm(ray.at));
      const double t = -height / slope;
      const double t_error =
          (height_error + std::abs(t) * slope_error) / (std::abs(slope) - slope_error) * 1.0001 + std::abs(t) * kUnit;
      const bool sure = std::abs(slope) > 2 * slope_error;
      if (sure && t < -t_error) return false;
      if (sure && t > t_error) {
        double largest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          spot.at[k] = centre.at[k] + t * ray.at[k];
          largest = std::max({largest, std::abs(centre.at[k]), std::abs(t * ray.at[k])});
        }
        spot.error = norm(ray.at) * t_error + t * ray.error + centre.error + largest * kUnit;
        double depth_error = 0;
        const double depth = s_.views_[j].depth(spot, depth_error);
        if (depth < -depth_error) return false;
        if (depth > depth_error) return true;
      }
      const Rational3 exact = s_.exact(spot);
      const int own = sgn(s_.views_[i].camera().depth(exact));
      const int other = sgn(s_.views_[j].camera().depth(exact));
      if (own == 0 || other == 0) throw Undecided{};
      if (own < 0 || other < 0) return false;
      s_.refine(spot);
      return true;
    }

    // A point far out on the line of two edges' planes, in front of both cameras.
    Spot far_end(const Spot& a, std::uint32_t e, std::uint32_t f) const {
      const SkeletonEdge& p = s_.edges_[e];
      const SkeletonEdge& q = s_.edges_[f];
      Vec3 direction = cross(p.normal.at, q.normal.at);
      const double length = norm(direction);
      const double np = norm(p.normal.at);
      const double nq = norm(q.normal.at);
      const double error = 8 * (np * q.normal.error + nq * p.normal.error + np * nq * kUnit);
      if (!(length > 4 * error)) throw Undecided{};
      const auto deeper = [&](std::uint32_t view) {
        const auto& m = s_.views_[view].depth_row();
        const Vec3 row{m[0], m[1], m[2]};
        const double value = dot(row, direction);
        if (!(std::abs(value) > 4 * norm(row) * (error + length * kUnit))) throw Undecided{};
        return value > 0;
      };
      const bool forward = deeper(p.view);
      if (forward != deeper(q.view)) throw Undecided{};
      double reach = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        reach += std::max(std::abs(s_.low_[k] - a.at[k]), std::abs(s_.high_[k] - a.at[k]));
      }
      const double scale = (forward ? 2 : -2) * reach / length;
      Spot far;
      for (std::size_t k = 0; k < 3; ++k) far.at[k] = a.at[k] + scale * direction[k];
      far.error = a.error + std::abs(scale) * error + (reach + norm(a.at)) * kUnit;
      return far;
    }

    // What all views but i and j leave of an interval on the line of two edges' planes.
    void cut(Interval whole, std::uint32_t e, std::uint32_t f, std::uint32_t i, std::uint32_t j) {
      refine_ends(whole, s_.size_ * 1e-6);  // good enough to find the box
      Interval clipped = whole;
      if (!clip_to_box(clipped)) return;
      if (refine_ends(whole, s_.size_ * kGoodEnd)) {
        clipped = whole;
        if (!clip_to_box(clipped)) return;
      }
      left_.assign(1, clipped);
      line_ = clipped;
      const std::size_t n = s_.views_.size();
      const std::size_t first = best_view(clipped, i, j);
      for (std::size_t k = 0; k < n && !left_.empty(); ++k) {
        const std::size_t view = (first + k) % n;
        if (view == i || view == j) continue;
        next_.clear();
        for (const Interval& interval : left_) cut_by_view(interval, e, f, static_cast<std::uint32_t>(view));
        left_.swap(next_);
      }
      for (const Interval& interval : left_) {
        if (interval.from.name == kNoName || interval.to.name == kNoName) throw Undecided{};
        found_.push_back(interval.from.name);
        found_.push_back(interval.to.name);
      }
    }

    // Makes named ends exact that are not within an error; true if there was one.
    bool refine_ends(Interval& interval, double error) const {
      bool any = false;
      for (Spot* spot : {&interval.from, &interval.to}) {
        if (spot->error <= error || spot->name == kNoName) continue;
        s_.refine(*spot);
        any = true;
      }
      return any;
    }

    // The view that looks across the interval most: likely to cut off much.
    std::size_t best_view(const Interval& interval, std::uint32_t i, std::uint32_t j) const {
      Vec3 direction{};
      for (std::size_t k = 0; k < 3; ++k) direction[k] = interval.to.at[k] - interval.from.at[k];
      std::size_t best = 0;
      double least = INFINITY;
      for (std::size_t view = 0; view < s_.views_.size(); ++view) {
        if (view == i || view == j) continue;
        const double along = std::abs(dot(s_.views_[view].axis(), direction));
        if (along < least) {
          least = along;
          best = view;
        }
      }
      return best;
    }

    // The part of an interval, from 0 to 1, in the box with some slack.
    std::optional<std::array<double, 2>> part_in_box(const Interval& interval, double slack) const {
      double low = 0;
      double high = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = interval.from.at[k];
        const double d = interval.to.at[k] - a;
        const double l = s_.low_[k] - slack - a;
        const double h = s_.high_[k] + slack - a;
        if (std::abs(d) < s_.size_ * 1e-12) {
          if (l > 0 || h < 0) return std::nullopt;
          continue;
        }
        low = std::max(low, std::min(l / d, h / d));
        high = std::min(high, std::max(l / d, h / d));
      }
      if (!(low < high)) return std::nullopt;
      return std::array{low, high};
    }

    // Cuts off what is outside of the box, which is larger than the hull: an inexact end will do there. What only comes
    // near the box goes, so that nothing very short is left in its corners.
    bool clip_to_box(Interval& interval) const {
      const double slack = s_.size_ * 1e-4;
      if (!part_in_box(interval, slack / 2)) return false;
      const auto part = part_in_box(interval, slack);
      if (!part) return false;
      const auto [low, high] = *part;
      const Interval given = interval;
      const auto place = [&given](double t, Spot& spot) {
        double largest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          spot.at[k] = given.from.at[k] + t * (given.to.at[k] - given.from.at[k]);
          largest = std::max({largest, std::abs(given.from.at[k]), std::abs(given.to.at[k])});
        }
        spot.error = (1 - t) * given.from.error + t * given.to.error + largest * kUnit;
        spot.name = kNoName;
      };
      if (low > 0) place(low, interval.from);
      if (high < 1) place(high, interval.to);
      return true;
    }

    struct Event {
      double t = 0;
      double error = 0;
      std::uint32_t edge = 0;
    };

    void cut_by_view(const Interval& interval, std::uint32_t e, std::uint32_t f, std::uint32_t view) {
      const SkeletonView& v = s_.views_[view];
      const Seen a = v.project(interval.from);
      const Seen b = v.project(interval.to);
      auto& stamps = stamps_[view];
      if (stamps.empty()) stamps.resize(v.edge_count(), 0);
      events_.clear();
      v.visit_crossed(a, b, stamps, ++stamp_, [&](std::uint32_t g) { events_.push_back(event(g)); });
      bool inside = v.inside(a);
      if (events_.empty()) {
        if (inside) next_.push_back(interval);
        return;
      }
      sort_events(e, f);
      Spot from = interval.from;
      for (std::size_t k = 0; k < events_.size(); ++k) {
        const Spot at = spot_of(events_[k], e, f);
        if (inside) next_.push_back({from, at});
        inside = !inside;
        from = at;
      }
      if (inside) next_.push_back({from, interval.to});
    }

    // Where the plane of an edge cuts the line, 0 and 1 at its ends. (From the ends of what is left of it, errors would
    // grow with every cut.)
    Event event(std::uint32_t g) const {
      double error_a = 0;
      double error_b = 0;
      const double a = s_.height(s_.edges_[g], line_.from.at, line_.from.error, error_a);
      const double b = s_.height(s_.edges_[g], line_.to.at, line_.to.error, error_b);
      Event result;
      result.edge = g;
      result.t = a / (a - b);
      result.error = 2 * (error_a + error_b) / std::abs(a - b) + 4 * kUnit;
      if (!(error_a + error_b < std::abs(a - b) * 0.25)) result.error = INFINITY;
      return result;
    }

    void sort_events(std::uint32_t e, std::uint32_t f) {
      const auto exactly = [&] {
        refine_ends(line_, 0);
        for (Event& event : events_) event = exact_event(event, e, f);
      };
      const auto vague = [](const Event& x) { return !(x.error < 1e-3); };
      const auto earlier = [](const Event& x, const Event& y) { return x.t < y.t; };
      const auto close = [](const Event& x, const Event& y) { return !(y.t - x.t > x.error + y.error); };
      if (std::any_of(events_.begin(), events_.end(), vague)) exactly();
      std::sort(events_.begin(), events_.end(), earlier);
      if (std::adjacent_find(events_.begin(), events_.end(), close) == events_.end()) return;
      exactly();
      std::sort(events_.begin(), events_.end(), earlier);
      if (std::adjacent_find(events_.begin(), events_.end(), close) != events_.end()) throw Undecided{};
    }

    Event exact_event(Event event, std::uint32_t e, std::uint32_t f) const {
      Spot spot;
      spot.name = sorted_name(e, f, event.edge);
      s_.refine(spot);
      Vec3 d{};
      Vec3 x{};
      for (std::size_t k = 0; k < 3; ++k) {
        d[k] = line_.to.at[k] - line_.from.at[k];
        x[k] = spot.at[k] - line_.from.at[k];
      }
      // Both are points of one line, so errors count by their size over the length.
      const double square = dot(d, d);
      event.t = dot(x, d) / square;
      event.error = 8 * (spot.error + line_.from.error + line_.to.error) / std::sqrt(square) + 8 * kUnit;
      if (!(event.error < 0.01)) throw Undecided{};
      return event;
    }

    Spot spot_of(const Event& event, std::uint32_t e, std::uint32_t f) const {
      Spot spot;
      spot.name = sorted_name(e, f, event.edge);
      double largest = 0;
      double length = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = line_.to.at[k] - line_.from.at[k];
        spot.at[k] = line_.from.at[k] + event.t * d;
        largest = std::max({largest, std::abs(line_.from.at[k]), std::abs(line_.to.at[k])});
        length = std::max(length, std::abs(d));
      }
      spot.error = (1 - event.t) * line_.from.error + event.t * line_.to.error + length * event.error + largest * kUnit;
      if (spot.error > s_.size_ * kGoodPlace) s_.refine(spot);
      return spot;
    }

    const Skeleton& s_;
    std::vector<SpotName>& found_;
    std::vector<Meeting> meetings_;
    std::vector<Spot> spots_;
    std::vector<Turn> turns_;
    Interval line_;  // of which left_ is a part
    std::vector<Interval> left_;
    std::vector<Interval> next_;
    std::vector<Event> events_;
    std::vector<std::vector<std::uint32_t>> stamps_;
    std::uint32_t stamp_ = 0;
  };

  // n . x + d and its error.
  [[nodiscard]] double height(const SkeletonEdge& edge, const Vec3& at, double at_error, double& error) const {
    double value = edge.offset;
    double size = std::abs(edge.offset);
    double reach = 0;
    double slope = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      value += edge.normal.at[k] * at[k];
      size += std::abs(edge.normal.at[k] * at[k]);
      reach += std::abs(at[k]) + at_error;
      slope += std::abs(edge.normal.at[k]);
    }
    error = size * kUnit + edge.offset_error + reach * edge.normal.error + slope * at_error * 1.0001;
    return value;
  }

  // Exact coordinates, rounded.
  void refine(Spot& spot) const {
    ++nef::predicate_counts().exact;
    const Rational3 x = exact(spot);
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      spot.at[k] = nef::nearest_double(x[k]);
      largest = std::max(largest, std::abs(spot.at[k]));
    }
    spot.error = largest * kUnit;
  }

  std::vector<SkeletonView> views_;
  std::vector<SkeletonEdge> edges_;
  Vec3 low_{}, high_{};
  double size_ = 0;
};

// How many edges of the hull end in a vertex: one on a ray and two in the facets of each corner there, or three.
std::size_t edges_at(const SpotName& name, const std::vector<SkeletonEdge>& edges) {
  const std::optional<std::uint32_t> corner = corner_of(name, edges);
  if (!corner) return 3;
  std::size_t count = 1;
  for (std::uint32_t at = *corner; at != UINT32_MAX; at = edges[at].next_at_place) count += 2;
  return count;
}

}  // namespace

std::optional<nef::Polyhedron> direct_hull(const std::vector<SkeletonInput>& views, const WorldBox& box,
                                           unsigned threads) {
  if (views.size() < 3) return std::nullopt;
  try {
    Skeleton skeleton(views, box);
    std::vector<SpotName> names = skeleton.run(threads);
    std::sort(names.begin(), names.end());
    std::vector<SpotName> vertices;
    for (std::size_t k = 0; k < names.size();) {
      std::size_t end = k;
      while (end < names.size() && names[end] == names[k]) ++end;
      if (end - k != edges_at(names[k], skeleton.edges())) return std::nullopt;
      vertices.push_back(names[k]);
      k = end;
    }
    std::vector<const Camera*> cameras;
    for (const SkeletonInput& input : views) cameras.push_back(input.camera);
    return complex_of(vertices, skeleton.edges(), cameras);
  } catch (const Undecided&) {
    return std::nullopt;
  }
}

}  // namespace visual_hull
