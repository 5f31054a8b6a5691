// SPDX-License-Identifier: Apache-2.0
//
// Why the rings stay simple: sides that do not share a corner are a pixel apart, and over a pixel a lens is an affine
// map but for a thousandth of a pixel or so. Where it is not, the exact check at the end finds out.
#include "apps/visual_hull/silhouette/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

// The homography of OpenCV's tilted sensor: the rotations about x and y, and the projection back along z.
std::array<double, 9> tilt_of(double about_x, double about_y) {
  const double cx = std::cos(about_x);
  const double sx = std::sin(about_x);
  const double cy = std::cos(about_y);
  const double sy = std::sin(about_y);
  // R = Ry * Rx, row by row.
  const std::array<double, 9> r{cy, sy * sx, -sy * cx, 0, cx, sx, sy, -cy * sx, cy * cx};
  std::array<double, 9> h{};
  for (std::size_t j = 0; j < 3; ++j) {
    h[j] = r[8] * r[j] - r[2] * r[6 + j];
    h[3 + j] = r[8] * r[3 + j] - r[5] * r[6 + j];
    h[6 + j] = r[6 + j];
  }
  return h;
}

bool is_finite(const std::array<double, 2>& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

}  // namespace

LensModel::LensModel(const Distortion& distortion) {
  std::copy_n(distortion.coefficients.begin(), std::min(distortion.coefficients.size(), c_.size()), c_.begin());
  tilt_ = tilt_of(c_[12], c_[13]);
  const Matrix3& k = distortion.intrinsics;
  fx_ = nef::nearest_double(k[0][0]);
  skew_ = nef::nearest_double(k[0][1]);
  cx_ = nef::nearest_double(k[0][2]);
  fy_ = nef::nearest_double(k[1][1]);
  cy_ = nef::nearest_double(k[1][2]);
}

std::array<double, 2> LensModel::distort_normalized(double x, double y) const {
  const double r2 = x * x + y * y;
  const double radial = (1 + r2 * (c_[0] + r2 * (c_[1] + r2 * c_[4]))) / (1 + r2 * (c_[5] + r2 * (c_[6] + r2 * c_[7])));
  const double xd = x * radial + 2 * c_[2] * x * y + c_[3] * (r2 + 2 * x * x) + r2 * (c_[8] + r2 * c_[9]);
  const double yd = y * radial + c_[2] * (r2 + 2 * y * y) + 2 * c_[3] * x * y + r2 * (c_[10] + r2 * c_[11]);
  if (c_[12] == 0 && c_[13] == 0) return {xd, yd};
  const double w = tilt_[6] * xd + tilt_[7] * yd + tilt_[8];
  return {(tilt_[0] * xd + tilt_[1] * yd + tilt_[2]) / w, (tilt_[3] * xd + tilt_[4] * yd + tilt_[5]) / w};
}

std::array<double, 2> LensModel::distort(const std::array<double, 2>& point) const {
  const double y = (point[1] - cy_) / fy_;
  const auto [xd, yd] = distort_normalized((point[0] - cx_ - skew_ * y) / fx_, y);
  return {fx_ * xd + skew_ * yd + cx_, fy_ * yd + cy_};
}

std::optional<std::array<double, 2>> LensModel::straighten(const std::array<double, 2>& point) const {
  constexpr int kSteps = 100;
  constexpr double kHalf = 0x1p-20;  // of a central difference
  constexpr double kPixels = 1e-6;   // by how much the answer may miss
  constexpr double kLongest = 0.25;  // step, in focal lengths
  const double v = (point[1] - cy_) / fy_;
  const double u = (point[0] - cx_ - skew_ * v) / fx_;
  const auto miss = [&](double x, double y) {
    const auto [xd, yd] = distort_normalized(x, y);
    return std::hypot(xd - u, yd - v);
  };
  // From the centre of the image on, so that the root before a fold is found: the first steps take parts of the way.
  double x = 0;
  double y = 0;
  for (int step = 0; step < kSteps; ++step) {
    const auto [xd, yd] = distort_normalized(x, y);
    const auto right = distort_normalized(x + kHalf, y);
    const auto left = distort_normalized(x - kHalf, y);
    const auto below = distort_normalized(x, y + kHalf);
    const auto above = distort_normalized(x, y - kHalf);
    const double a = (right[0] - left[0]) / (2 * kHalf);
    const double b = (below[0] - above[0]) / (2 * kHalf);
    const double c = (right[1] - left[1]) / (2 * kHalf);
    const double d = (below[1] - above[1]) / (2 * kHalf);
    const double determinant = a * d - b * c;
    if (!(determinant > 0)) return std::nullopt;  // the fold
    double dx = (d * (u - xd) - b * (v - yd)) / determinant;
    double dy = (a * (v - yd) - c * (u - xd)) / determinant;
    const double before = std::hypot(xd - u, yd - v);
    if (const double length = std::hypot(dx, dy); length > kLongest) {
      dx *= kLongest / length;
      dy *= kLongest / length;
    }
    for (int halving = 0; halving < 20 && !(miss(x + dx, y + dy) < before); ++halving) {
      dx /= 2;
      dy /= 2;
    }
    if (!(miss(x + dx, y + dy) < before)) break;  // as near as doubles come
    x += dx;
    y += dy;
  }
  const std::array<double, 2> answer{fx_ * x + skew_ * y + cx_, fy_ * y + cy_};
  if (!is_finite(answer) || !(miss(x, y) * std::max(fx_, fy_) < kPixels)) return std::nullopt;
  return answer;
}

namespace {

// The ends of a pixel's sides along a ring whose edges are runs of them, or pieces of sides.
std::vector<std::array<double, 2>> sides_of(const Ring& ring) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& from = ring[i].approximate;
    const auto& to = ring[i + 1 < ring.size() ? i + 1 : 0].approximate;
    const double length = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    const int pieces = std::max(1, static_cast<int>(std::ceil(length)));
    // Whole and half steps are exact, so points that rings share stay shared.
    for (int k = 0; k < pieces; ++k) {
      std::array<double, 2> point = from;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        if (to[axis] > from[axis]) point[axis] += k;
        if (to[axis] < from[axis]) point[axis] -= k;
      }
      points.push_back(point);
    }
  }
  return points;
}

Ring straight_ring(const Ring& ring, const LensModel& lens, const std::string& view) {
  Ring result;
  for (const auto& point : sides_of(ring)) {
    const auto straight = lens.straighten(point);
    if (!straight) {
      throw nef::InputError(fmt::format(
          "view {}: the lens distortion cannot be undone at ({:.6g}, {:.6g}), where the silhouette has its border: the "
          "lens folds the image before that point; check the coefficients and their order (k1, k2, p1, p2, k3, ...), "
          "or erase that part of the mask",
          view, point[0], point[1]));
    }
    result.push_back(Point2::from_doubles((*straight)[0], (*straight)[1]));
  }
  return result;
}

Ring rectangle_around(const std::vector<Ring>& rings) {
  std::array<double, 2> low{0, 0};
  std::array<double, 2> high{1, 1};
  for (const Ring& ring : rings) {
    for (const Point2& p : ring) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], p.approximate[axis]);
        high[axis] = std::max(high[axis], p.approximate[axis]);
      }
    }
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low[axis] = std::floor(low[axis]) - 1;
    high[axis] = std::ceil(high[axis]) + 1;
  }
  return {Point2::from_doubles(low[0], low[1]), Point2::from_doubles(high[0], low[1]),
          Point2::from_doubles(high[0], high[1]), Point2::from_doubles(low[0], high[1])};
}

}  // namespace

Silhouette straighten(const Silhouette& traced, const Distortion& distortion, const std::string& view,
                      std::optional<std::size_t> frame, const nef::Monitor& monitor) {
  const LensModel lens(distortion);
  Silhouette result{{}, traced.parent, traced.depth};
  for (std::size_t i = 0; i < traced.rings.size(); ++i) {
    result.rings.push_back(i == frame ? Ring{} : straight_ring(traced.rings[i], lens, view));
  }
  if (frame) result.rings[*frame] = rectangle_around(result.rings);
  if (const std::string crossing = first_crossing(result.rings, monitor); !crossing.empty()) {
    throw nef::InputError(fmt::format(
        "view {}: the lens distortion cannot be undone, since the lens folds the silhouette ({}); check the "
        "coefficients and their order (k1, k2, p1, p2, k3, ...)",
        view, crossing));
  }
  return result;
}

}  // namespace nef::visual_hull
