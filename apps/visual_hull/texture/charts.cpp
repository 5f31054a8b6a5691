// SPDX-License-Identifier: Apache-2.0
//
// A breadth-first search over triangles of the same view. The pixels whose centres lie in the triangles of the chart
// are marked in an image of the view; a triangle with a pixel that is marked is not taken, and becomes the first of a
// chart of its own later.
#include "apps/visual_hull/texture/charts.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "apps/visual_hull/color/projection.h"

namespace nef::visual_hull {
namespace {

/// The pixels that a chart has taken, in the image of a view and around it.
class TakenPixels {
 public:
  /// Forgets all, for a chart of a view whose image has this size.
  void begin(const cv::Size& size) {
    const cv::Size around(2 * size.width + 2, 2 * size.height + 2);  // twice as large, the image in the middle
    left_ = size.width / 2;
    top_ = size.height / 2;
    if (marks_.size() == around) {
      for (const cv::Point& pixel : list_) marks_.at<std::uint8_t>(pixel) = 0;
    } else {
      marks_ = cv::Mat(around, CV_8U, cv::Scalar(0));
    }
    list_.clear();
  }

  /// Takes the pixels inside of a triangle, unless one is taken already.
  bool take(Triangle2 triangle) {
    for (Place2& place : triangle) {
      place[0] += left_;
      place[1] += top_;
    }
    const double area = doubled_area(triangle);
    const std::size_t before = list_.size();
    bool free = true;
    if (!(std::abs(area) > 1e-9)) return true;
    for_each_pixel_near(triangle, 1e-6, marks_.cols, marks_.rows, [&](int x, int y) {
      constexpr double kInside = 1e-6;
      const Weights w = weights_at(triangle, area, x, y);
      if (!free || w[0] < kInside || w[1] < kInside || w[2] < kInside) return;
      std::uint8_t& mark = marks_.at<std::uint8_t>(y, x);
      free = mark == 0;
      if (!free) return;
      mark = 1;
      list_.emplace_back(x, y);
    });
    if (free) return true;
    for (std::size_t i = before; i < list_.size(); ++i) marks_.at<std::uint8_t>(list_[i]) = 0;
    list_.resize(before);
    return false;
  }

 private:
  cv::Mat marks_;
  std::vector<cv::Point> list_;
  int left_ = 0;
  int top_ = 0;
};

class ChartMaker {
 public:
  ChartMaker(const Surface& surface, const std::vector<std::uint32_t>& choice,
             const std::vector<const ViewResult*>& views, PixelOrigin origin)
      : surface_(surface), choice_(choice), views_(views) {
    for (const ViewResult* view : views) projections_.emplace_back(view->camera, origin, "--texture");
    atlas_.chart_of.assign(surface.size(), kNoView);
    atlas_.places.resize(surface.size());
  }

  Atlas run() {
    // View by view, so that the marks are of one size for long.
    for (std::uint32_t v = 0; v < views_.size(); ++v) {
      for (std::uint32_t t = 0; t < surface_.size(); ++t) {
        if (choice_[t] == v && atlas_.chart_of[t] == kNoView) grow_in_view(t);
      }
    }
    scale_ = resolution() / 4;
    for (std::uint32_t t = 0; t < surface_.size(); ++t) {
      if (atlas_.chart_of[t] == kNoView) grow_unseen(t);
    }
    for (Chart& chart : atlas_.charts) {
      bound(chart);
      if (chart.view == kNoView) shrink(chart);
    }
    return std::move(atlas_);
  }

 private:
  Triangle2 image_of(std::uint32_t t, std::uint32_t view) const {
    Triangle2 image{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto place = projections_[view](surface_.points()[surface_.triangle(t)[i]]);
      if (place) image[i] = {place->u, place->v};  // always: the view sees the triangle
    }
    return image;
  }

  // Grows a chart from a triangle; `take` decides about each neighbour and gives it its place.
  template <typename Take>
  void grow(std::uint32_t first, Take&& take) {
    const auto number = static_cast<std::uint32_t>(atlas_.charts.size());
    Chart chart;
    chart.view = choice_[first];
    std::deque<std::uint32_t> open{first};
    while (!open.empty()) {
      const std::uint32_t t = open.front();
      open.pop_front();
      if (atlas_.chart_of[t] != kNoView || !take(t)) continue;
      atlas_.chart_of[t] = number;
      chart.triangles.push_back(t);
      for (const std::uint32_t s : surface_.sides_of(t)) {
        const std::uint32_t next = surface_.beyond(s, t);
        if (choice_[next] == chart.view && atlas_.chart_of[next] == kNoView) open.push_back(next);
      }
    }
    atlas_.charts.push_back(std::move(chart));
  }

  void grow_in_view(std::uint32_t first) {
    const std::uint32_t view = choice_[first];
    taken_.begin(views_[view]->silhouette.image_size);
    grow(first, [&](std::uint32_t t) {
      const Triangle2 image = image_of(t, view);
      if (!taken_.take(image)) return false;
      atlas_.places[t] = image;
      return true;
    });
  }

  void grow_unseen(std::uint32_t first) {
    const nef::Double3 normal = unit(surface_.normal(first));
    const nef::Double3 right = unit(nef::across(normal));
    const nef::Double3 up = nef::cross(normal, right);
    const nef::Double3 origin = surface_.points()[surface_.triangle(first)[0]];
    grow(first, [&](std::uint32_t t) {
      if (t != first && !(nef::dot(unit(surface_.normal(t)), normal) > 0.5)) return false;
      for (std::size_t i = 0; i < 3; ++i) {
        const nef::Double3 from = nef::minus(surface_.points()[surface_.triangle(t)[i]], origin);
        atlas_.places[t][i] = {finite(scale_ * nef::dot(from, right)), finite(scale_ * nef::dot(from, up))};
      }
      return true;
    });
  }

  static nef::Double3 unit(const nef::Double3& v) {
    const double length = std::sqrt(nef::dot(v, v));
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 1};
    return {v[0] / length, v[1] / length, v[2] / length};
  }

  static double finite(double x) { return std::isfinite(x) ? std::clamp(x, -1e6, 1e6) : 0; }

  // Pixels for a unit of length, on the whole.
  [[nodiscard]] double resolution() const {
    double pixels = 0;
    double area = 0;
    double all = 0;
    for (std::uint32_t t = 0; t < surface_.size(); ++t) {
      const nef::Double3 normal = surface_.normal(t);
      const double own = std::sqrt(nef::dot(normal, normal));
      all += own;
      if (atlas_.chart_of[t] == kNoView) continue;
      pixels += std::abs(doubled_area(atlas_.places[t]));
      area += own;
    }
    if (area > 0 && pixels > 0) return std::sqrt(pixels / area);
    return all > 0 ? 100 / std::sqrt(all) : 1;  // no view sees anything
  }

  void bound(Chart& chart) const {
    chart.low = {INFINITY, INFINITY};
    chart.high = {-INFINITY, -INFINITY};
    for (const std::uint32_t t : chart.triangles) {
      for (const Place2& place : atlas_.places[t]) {
        for (std::size_t k = 0; k < 2; ++k) {
          chart.low[k] = std::min(chart.low[k], std::floor(place[k]));
          chart.high[k] = std::max(chart.high[k], std::ceil(place[k]));
        }
      }
    }
  }

  // What no view sees may be far larger than what the views see, and needs no resolution.
  void shrink(Chart& chart) {
    constexpr double kLargest = 512;
    const double size = std::max(chart.high[0] - chart.low[0], chart.high[1] - chart.low[1]);
    if (size <= kLargest) return;
    for (const std::uint32_t t : chart.triangles) {
      for (Place2& place : atlas_.places[t]) {
        for (double& x : place) x *= kLargest / size;
      }
    }
    bound(chart);
  }

  const Surface& surface_;
  const std::vector<std::uint32_t>& choice_;
  const std::vector<const ViewResult*>& views_;
  std::vector<ImageProjection> projections_;
  TakenPixels taken_;
  double scale_ = 1;
  Atlas atlas_;
};

}  // namespace

Atlas make_charts(const Surface& surface, const std::vector<std::uint32_t>& choice,
                  const std::vector<const ViewResult*>& views, PixelOrigin origin) {
  return ChartMaker(surface, choice, views, origin).run();
}

}  // namespace nef::visual_hull
