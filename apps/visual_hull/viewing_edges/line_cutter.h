// SPDX-License-Identifier: Apache-2.0
//
// What the silhouettes leave of a line of space: cut in the images, where the line is a line again [Matusik, Buehler,
// McMillan 2001].
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_scene.h"

namespace visual_hull {

/// A part of a line that is not yet cut off, between two spots.
struct Interval {
  Spot from, to;
};

/// Cuts lines, one after the other. For one thread.
class LineCutter {
 public:
  /// Appends the names of the ends of what is left to `found`, which must outlive the cutter.
  LineCutter(const EdgeScene& scene, std::vector<SpotName>& found)
      : s_(scene), found_(found), order_(scene.views.size()), stamps_(scene.views.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
  }

  // What all views but i and j leave of an interval on the line of two edges' planes. False if that remains undecided.
  [[nodiscard]] bool cut(Interval whole, std::uint32_t e, std::uint32_t f, std::uint32_t i, std::uint32_t j) {
    if (!refine_ends(whole, s_.size * 1e-6)) return false;  // good enough to find the box
    Interval clipped = whole;
    if (!clip_to_box(clipped)) return true;
    const Interval rough = whole;
    if (!refine_ends(whole, s_.size * kGoodEnd)) return false;
    if (whole.from.error != rough.from.error || whole.to.error != rough.to.error) {
      clipped = whole;
      if (!clip_to_box(clipped)) return true;
    }
    left_.assign(1, clipped);
    line_ = clipped;
    if (i == j) prefer(best_view(clipped, i, j));
    for (std::size_t k = 0; k < order_.size() && !left_.empty(); ++k) {
      const std::uint32_t view = order_[k];
      if (view == i || view == j) continue;
      next_.clear();
      for (const Interval& interval : left_) {
        if (!cut_by_view(interval, e, f, view)) return false;
      }
      left_.swap(next_);
      if (left_.empty()) prefer(view);
    }
    for (const Interval& interval : left_) {
      if (interval.from.name == kNoName || interval.to.name == kNoName) return false;
      found_.push_back(interval.from.name);
      found_.push_back(interval.to.name);
    }
    return true;
  }

 private:
  // Spots with larger errors, as parts of the box's size, are computed exactly: ends of candidates, places on them.
  // These are choices between the time of one exact point and that of many vague questions; no answer depends on them,
  // since every spot carries its proven error.
  static constexpr double kGoodEnd = 1e-9;
  static constexpr double kGoodPlace = 1e-7;

  // Makes named ends exact that are not within an error; false if that is not possible.
  [[nodiscard]] bool refine_ends(Interval& interval, double error) const {
    for (Spot* spot : {&interval.from, &interval.to}) {
      if (spot->error <= error || spot->name == kNoName) continue;
      if (!s_.refine(*spot)) return false;
    }
    return true;
  }

  // What a view cuts off entirely, it will probably cut off nearby, too: it comes first from now on.
  void prefer(std::uint32_t view) {
    const auto at = std::find(order_.begin(), order_.end(), view);
    std::rotate(order_.begin(), at, at + 1);
  }

  // The view that looks across the interval most: likely to cut off much.
  std::uint32_t best_view(const Interval& interval, std::uint32_t i, std::uint32_t j) const {
    Vec3 direction{};
    for (std::size_t k = 0; k < 3; ++k) direction[k] = interval.to.at[k] - interval.from.at[k];
    std::uint32_t best = 0;
    double least = INFINITY;
    for (std::uint32_t view = 0; view < s_.views.size(); ++view) {
      if (view == i || view == j) continue;
      const double along = std::abs(dot(s_.views[view].axis(), direction));
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
      const double l = s_.low[k] - slack - a;
      const double h = s_.high[k] + slack - a;
      // (Nearly) along two sides of the box, which is a hundredth larger than the hull: nothing of the hull is lost.
      if (std::abs(d) < s_.size * 1e-12) {
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
    const double slack = s_.size * 1e-4;
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
      spot.error = (1 - t) * given.from.error + t * given.to.error + largest * kRounding;
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

  [[nodiscard]] bool cut_by_view(const Interval& interval, std::uint32_t e, std::uint32_t f, std::uint32_t view) {
    const EdgeView& v = s_.views[view];
    const std::optional<Seen> a = v.project(interval.from);
    const std::optional<Seen> b = v.project(interval.to);
    if (!a || !b) return false;
    if (const std::optional<bool> all = v.all_inside(*a, *b)) {
      if (*all) next_.push_back(interval);
      return true;
    }
    auto& stamps = stamps_[view];
    if (stamps.empty()) stamps.resize(v.edge_count(), 0);
    events_.clear();
    if (!v.visit_crossed(*a, *b, stamps, ++stamp_, [&](std::uint32_t g) { events_.push_back(event(g)); })) return false;
    if (events_.empty()) {
      const std::optional<bool> all = v.inside(*a);
      if (all && *all) next_.push_back(interval);
      return all.has_value();
    }
    if (!sort_events(e, f)) return false;
    const std::optional<bool> starts_inside = v.left_of(*a, events_[0].edge);
    if (!starts_inside) return false;
    bool inside = *starts_inside;
    Spot from = interval.from;
    for (const Event& event : events_) {
      const std::optional<Spot> at = spot_of(event, e, f);
      if (!at) return false;
      if (inside) next_.push_back({from, *at});
      inside = !inside;
      from = *at;
    }
    if (inside) next_.push_back({from, interval.to});
    return true;
  }

  // Where the plane of an edge cuts the line, 0 and 1 at its ends. (From the ends of what is left of it, errors would
  // grow with every cut.)
  Event event(std::uint32_t g) const {
    double error_a = 0;
    double error_b = 0;
    const double a = s_.height(s_.edges[g], line_.from.at, line_.from.error, error_a);
    const double b = s_.height(s_.edges[g], line_.to.at, line_.to.error, error_b);
    Event result;
    result.edge = g;
    result.t = a / (a - b);
    result.error = 2 * (error_a + error_b) / std::abs(a - b) + 4 * kRounding;
    if (!(error_a + error_b < std::abs(a - b) * 0.25)) result.error = INFINITY;
    return result;
  }

  // False if two of them may be in one place.
  [[nodiscard]] bool sort_events(std::uint32_t e, std::uint32_t f) {
    const auto exactly = [&] {
      if (!refine_ends(line_, 0)) return false;
      for (Event& event : events_) {
        if (!make_exact(event, e, f)) return false;
      }
      return true;
    };
    const auto vague = [](const Event& x) { return !(x.error < 1e-3); };
    const auto earlier = [](const Event& x, const Event& y) { return x.t < y.t; };
    const auto close = [](const Event& x, const Event& y) { return !(y.t - x.t > x.error + y.error); };
    if (std::any_of(events_.begin(), events_.end(), vague) && !exactly()) return false;
    std::sort(events_.begin(), events_.end(), earlier);
    if (std::adjacent_find(events_.begin(), events_.end(), close) == events_.end()) return true;
    if (!exactly()) return false;
    std::sort(events_.begin(), events_.end(), earlier);
    return std::adjacent_find(events_.begin(), events_.end(), close) == events_.end();
  }

  [[nodiscard]] bool make_exact(Event& event, std::uint32_t e, std::uint32_t f) const {
    Spot spot;
    spot.name = sorted_name(e, f, event.edge);
    if (!s_.refine(spot)) return false;
    Vec3 d{};
    Vec3 x{};
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = line_.to.at[k] - line_.from.at[k];
      x[k] = spot.at[k] - line_.from.at[k];
    }
    // Both are points of one line, so errors count by their size over the length.
    const double square = dot(d, d);
    event.t = dot(x, d) / square;
    event.error = 8 * (spot.error + line_.from.error + line_.to.error) / std::sqrt(square) + 8 * kRounding;
    return event.error < 0.01;
  }

  [[nodiscard]] std::optional<Spot> spot_of(const Event& event, std::uint32_t e, std::uint32_t f) const {
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
    spot.error =
        (1 - event.t) * line_.from.error + event.t * line_.to.error + length * event.error + largest * kRounding;
    if (spot.error > s_.size * kGoodPlace && !s_.refine(spot)) return std::nullopt;
    return spot;
  }

  const EdgeScene& s_;
  std::vector<SpotName>& found_;
  Interval line_;  // of which left_ is a part
  std::vector<Interval> left_;
  std::vector<Interval> next_;
  std::vector<Event> events_;
  std::vector<std::uint32_t> order_;  // of views
  std::vector<std::vector<std::uint32_t>> stamps_;
  std::uint32_t stamp_ = 0;
};

}  // namespace visual_hull
