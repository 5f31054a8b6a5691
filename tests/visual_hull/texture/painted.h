// SPDX-License-Identifier: Apache-2.0
//
// Images of things whose colours are known, by rays that this header follows itself.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/visual_hull/color/vertex_colors.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull::testing {

using Vec = std::array<double, 3>;

/// Where a ray meets something first, in units of its direction, and the colour there; infinity if it meets nothing.
using Hit = std::pair<double, Color>;
using Tracer = std::function<Hit(const Vec& from, const Vec& direction)>;

/// A box of six colours: -x, +x, -y, +y, -z, +z.
struct PaintedBox {
  Vec low, high;
  std::array<Color, 6> sides;
};

inline const std::array<Color, 6> kSix{
    {{200, 0, 0}, {0, 200, 0}, {0, 0, 200}, {200, 200, 0}, {200, 0, 200}, {0, 200, 200}}};

inline Hit first_along(const std::vector<PaintedBox>& boxes, const Vec& from, const Vec& direction) {
  Hit nearest{INFINITY, {}};
  for (const PaintedBox& box : boxes) {
    double enter = -INFINITY;
    double leave = INFINITY;
    std::size_t side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double a = (box.low[k] - from[k]) / direction[k];
      double b = (box.high[k] - from[k]) / direction[k];
      const bool back = a > b;
      if (back) std::swap(a, b);
      if (a > enter) {
        enter = a;
        side = 2 * k + (back ? 1 : 0);
      }
      leave = std::min(leave, b);
    }
    if (enter < leave && enter < nearest.first) nearest = {enter, box.sides[side]};
  }
  return nearest;
}

inline Tracer tracer_of(const std::vector<PaintedBox>& boxes) {
  return [boxes](const Vec& from, const Vec& direction) { return first_along(boxes, from, direction); };
}

/// Colours that change smoothly in space.
inline Color smooth_color(const Vec& p) {
  const auto wave = [](double x) { return static_cast<std::uint8_t>(std::lround(128 + 90 * std::sin(x))); };
  return {wave(2.1 * p[0] + 0.3), wave(1.7 * p[1] + p[2] + 1), wave(1.9 * p[2] - p[0] + 2)};
}

/// An ellipsoid about the origin in smooth_color.
inline Tracer ellipsoid(const Vec& radii) {
  return [radii](const Vec& from, const Vec& direction) -> Hit {
    double a = 0;
    double b = 0;
    double c = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      a += direction[k] * direction[k] / (radii[k] * radii[k]);
      b += direction[k] * from[k] / (radii[k] * radii[k]);
      c += from[k] * from[k] / (radii[k] * radii[k]);
    }
    const double root = b * b - a * c;
    if (root < 0) return {INFINITY, {}};
    const double at = (-b - std::sqrt(root)) / a;
    Vec p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + at * direction[k];
    return {at, smooth_color(p)};
  };
}

/// Cameras all around on the sphere of radius 10 about the origin, which they look at.
struct Rig {
  std::size_t views = 26;
  int width = 240;
  int height = 240;
  double focal = 500;

  /// Where a camera is: a little off every axis.
  [[nodiscard]] Vec position(std::size_t view) const {
    const double z = 1 - (2 * static_cast<double>(view) + 1) / static_cast<double>(views);
    const double angle = 2.399963 * static_cast<double>(view) + 0.3;
    const double r = std::sqrt(1 - z * z);
    return {10 * r * std::cos(angle), 10 * r * std::sin(angle), 10 * z};
  }

  /// Right, down and ahead.
  [[nodiscard]] std::array<Vec, 3> axes(std::size_t view) const {
    const Vec at = position(view);
    const double length = std::hypot(at[0], at[1]);
    const Vec right{-at[1] / length, at[0] / length, 0};
    const Vec ahead{-at[0] / 10, -at[1] / 10, -at[2] / 10};
    const Vec down{ahead[1] * right[2] - ahead[2] * right[1], ahead[2] * right[0] - ahead[0] * right[2],
                   ahead[0] * right[1] - ahead[1] * right[0]};
    return {right, down, ahead};
  }

  /// In how many views nothing comes before a place.
  [[nodiscard]] std::size_t views_that_see(const Tracer& trace, const Vec& place) const {
    std::size_t count = 0;
    for (std::size_t view = 0; view < views; ++view) {
      const Vec from = position(view);
      Vec ray{};
      for (std::size_t k = 0; k < 3; ++k) ray[k] = 0.999 * (place[k] - from[k]);
      if (trace(from, ray).first > 1) ++count;
    }
    return count;
  }
};

inline std::string name_of_view(std::size_t view) { return "view" + std::to_string(10 + view) + ".png"; }

/// Writes images with alpha, and the cameras in a text file of matrices. `exposure`: a factor of the colours of a view.
/// Returns the scene's file.
inline std::filesystem::path render(const Tracer& trace, const Rig& rig, const Scratch& scratch,
                                    const std::function<double(std::size_t)>& exposure = {}) {
  std::string cameras;
  for (std::size_t view = 0; view < rig.views; ++view) {
    const Vec from = rig.position(view);
    const std::array<Vec, 3> axes = rig.axes(view);
    const double factor = exposure ? exposure(view) : 1;
    cv::Mat image(rig.height, rig.width, CV_8UC4, cv::Scalar(90, 90, 90, 0));
    for (int y = 0; y < rig.height; ++y) {
      for (int x = 0; x < rig.width; ++x) {
        const double u = (x - rig.width / 2.0) / rig.focal;
        const double v = (y - rig.height / 2.0) / rig.focal;
        Vec ray{};
        for (std::size_t k = 0; k < 3; ++k) ray[k] = u * axes[0][k] + v * axes[1][k] + axes[2][k];
        const auto [distance, color] = trace(from, ray);
        if (!std::isfinite(distance)) continue;
        cv::Vec4b& pixel = image.at<cv::Vec4b>(y, x);
        for (int c = 0; c < 3; ++c)
          pixel[c] = cv::saturate_cast<std::uint8_t>(factor * color[2 - static_cast<std::size_t>(c)]);
        pixel[3] = 255;
      }
    }
    REQUIRE(cv::imwrite((scratch.folder() / name_of_view(view)).string(), image));
    cameras += name_of_view(view);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec row = axes[i];
      if (i < 2) {
        const double middle = (i == 0 ? rig.width : rig.height) / 2.0;
        for (std::size_t k = 0; k < 3; ++k) row[k] = rig.focal * axes[i][k] + middle * axes[2][k];
      }
      const double offset = -(row[0] * from[0] + row[1] * from[1] + row[2] * from[2]);
      for (const double number : {row[0], row[1], row[2], offset}) cameras += " " + std::to_string(number);
    }
    cameras += "\n";
  }
  return scratch.write("cameras.txt", cameras);
}

}  // namespace nef::visual_hull::testing
