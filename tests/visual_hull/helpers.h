// SPDX-License-Identifier: Apache-2.0
//
// Cameras, silhouettes and solids with answers that are known by arithmetic.
#pragma once

#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "apps/visual_hull/visual_hull.h"
#include "nef/construct/construct.h"

namespace nef::visual_hull::testing {

/// A RapidCheck property as a Catch assertion; RapidCheck prints the seed and the shrunk example.
template <typename Testable>
void property(const std::string& description, Testable&& testable) {
  REQUIRE(rc::check(description, std::forward<Testable>(testable)));
}

/// A ring of points (u, v) that are doubles.
inline Ring ring(const std::vector<std::array<double, 2>>& points) {
  Ring result;
  for (const auto& p : points) result.push_back(Point2::from_doubles(p[0], p[1]));
  return result;
}

inline Ring rectangle(double x0, double y0, double x1, double y1) {
  return ring({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// A camera at `centre` that looks along an axis (0..2), up or down; depth is the distance along it, and
/// (u, v) are the other two coordinates (axis + 1, axis + 2) over the depth, relative to the centre.
inline Camera axis_camera(const Rational3& centre, std::size_t axis, int direction,
                          const std::string& name = "camera") {
  Matrix34 m;
  const std::array<std::size_t, 3> row{(axis + 1) % 3, (axis + 2) % 3, axis};
  for (std::size_t i = 0; i < 3; ++i) {
    const int sign = i == 2 ? direction : 1;
    m[i][row[i]] = sign;
    m[i][3] = -sign * centre[row[i]];
  }
  return {name, m};
}

/// The exact silhouette of a convex solid that lies in front of a camera: the hull of its vertices' images.
inline Silhouette convex_silhouette(const Camera& camera, const std::vector<Rational3>& vertices) {
  std::vector<Point2> points;
  for (const Rational3& v : vertices) {
    const Projection p = camera.project(v);
    points.emplace_back(p.x / p.depth, p.y / p.depth);
  }
  // Gift wrapping: the next vertex has all others to its left.
  std::size_t first = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].x() < points[first].x() || (points[i].x() == points[first].x() && points[i].y() < points[first].y()))
      first = i;
  }
  Ring hull;
  std::size_t at = first;
  do {
    hull.push_back(points[at]);
    std::size_t next = at;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i] == points[at]) continue;
      if (next == at) {
        next = i;
        continue;
      }
      const int turn = orientation(points[at], points[next], points[i]);
      const auto reach = [&](std::size_t k) {
        const Rational dx = points[k].x() - points[at].x();
        const Rational dy = points[k].y() - points[at].y();
        return Rational(dx * dx + dy * dy);
      };
      if (turn < 0 || (turn == 0 && reach(i) > reach(next))) next = i;
    }
    at = next;
  } while (!(points[at] == points[first]));
  return make_silhouette({hull}, "test");
}

inline std::vector<Rational3> box_corners(const Rational3& low, const Rational3& high) {
  std::vector<Rational3> corners;
  for (unsigned k = 0; k < 8; ++k) {
    corners.push_back(
        {(k & 1U) != 0 ? high[0] : low[0], (k & 2U) != 0 ? high[1] : low[1], (k & 4U) != 0 ? high[2] : low[2]});
  }
  return corners;
}

/// A scene of polygon views.
inline Scene scene_of(const std::vector<std::pair<Camera, std::vector<Ring>>>& views, const WorldBox& box) {
  Scene scene;
  for (const auto& [camera, rings] : views) {
    View view;
    view.name = camera.name();
    view.camera = camera;
    view.polygons = rings;
    scene.views.push_back(view);
  }
  scene.box = box;
  return scene;
}

inline WorldBox cube(int half) { return {{-half, -half, -half}, {half, half, half}}; }

/// A random blob: noise, smoothed and cut, so that there are holes, islands and corner contacts.
inline cv::Mat random_mask(int width, int height, int smoothing, std::uint64_t seed) {
  cv::Mat noise(height, width, CV_32F);
  cv::RNG rng(seed);
  rng.fill(noise, cv::RNG::UNIFORM, 0.0, 1.0);
  if (smoothing > 0) cv::GaussianBlur(noise, noise, cv::Size(), smoothing, smoothing, cv::BORDER_REFLECT);
  return noise > cv::mean(noise)[0];
}

/// Whether `part` is a subset of `whole`, exactly.
inline bool subset(const nef::Polyhedron& part, const nef::Polyhedron& whole) {
  return nef::subtract(part, whole).is_empty();
}

}  // namespace nef::visual_hull::testing
