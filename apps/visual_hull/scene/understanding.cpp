// SPDX-License-Identifier: Apache-2.0
//
// What a camera matrix says is read off its rows: the third row is the optical axis, and the parts of the first two
// rows across it are the focal lengths. The common point of all axes solves a linear system of least squares; an
// eigenvalue that is nearly zero means that the axes are parallel.
#include "apps/visual_hull/scene/understanding.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/scene/pose.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

struct Range {
  double low = INFINITY;
  double high = -INFINITY;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  // "12", or "12 to 13" where that says more.
  [[nodiscard]] std::string text() const {
    const std::string a = fmt::format("{:.4g}", low);
    const std::string b = fmt::format("{:.4g}", high);
    return a == b ? a : a + " to " + b;
  }
};

std::string text(const Eigen::Vector3d& p, double scale) {
  std::string result;
  for (int i = 0; i < 3; ++i) {
    const double x = std::abs(p[i]) < 1e-6 * scale ? 0 : p[i];
    result += fmt::format("{}{:.4g}", i == 0 ? "(" : ", ", x);
  }
  return result + ")";
}

// "; ignored: a, b", a few of them.
std::string ignored_text(const std::vector<std::string>& names) {
  constexpr std::size_t kTold = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kTold); ++i) {
    text += (i == 0 ? "; ignored: " : ", ") + nef::in_quotes(names[i]);
  }
  if (names.size() > kTold) text += fmt::format(" and {} more", names.size() - kTold);
  return text;
}

Sight parallel_sight_of(const Camera& camera) {
  const Eigen::Matrix<double, 3, 4> p = to_doubles(camera);
  const Rational3 at = camera.sight_point(Point2::from_doubles(0, 0), Rational(0));
  Sight sight;
  sight.parallel = true;
  for (int i = 0; i < 3; ++i) {
    sight.centre[i] = nef::nearest_double(at[static_cast<std::size_t>(i)]);
    sight.axis[i] = nef::nearest_double(camera.axis()[static_cast<std::size_t>(i)]);
  }
  sight.axis.normalize();
  sight.focal_x = p.row(0).head<3>().norm() / p(2, 3);
  sight.focal_y = p.row(1).head<3>().norm() / p(2, 3);
  return sight;
}

}  // namespace

Sight sight_of(const Camera& camera) {
  if (camera.is_parallel()) return parallel_sight_of(camera);
  const Eigen::Matrix<double, 3, 4> p = to_doubles(camera);
  const double depth = p.row(2).head<3>().norm();
  const Eigen::Vector3d m1 = p.row(0).head<3>() / depth;
  const Eigen::Vector3d m2 = p.row(1).head<3>() / depth;
  const Eigen::Vector3d m3 = p.row(2).head<3>() / depth;
  Sight sight;
  for (int i = 0; i < 3; ++i) sight.centre[i] = nef::nearest_double(camera.centre()[static_cast<std::size_t>(i)]);
  sight.axis = m3;
  // Of K R with a triangular K: the parts of the first rows that lie across the axis.
  sight.focal_x = m1.cross(m3).norm();
  sight.focal_y = m2.cross(m3).norm();
  return sight;
}

std::optional<Eigen::Vector3d> common_point(const std::vector<Sight>& sights) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sight& s : sights) {
    if (s.parallel) continue;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - s.axis * s.axis.transpose();
    sum += across;
    right += across * s.centre;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  if (!(solver.eigenvalues()[0] > 1e-4 * solver.eigenvalues()[2])) return std::nullopt;
  return Eigen::Vector3d(sum.ldlt().solve(right));
}

std::string understood(const Scene& scene) {
  std::vector<Sight> sights;
  Range focal;
  Range scale;
  std::size_t parallel = 0;
  std::size_t mirrored = 0;
  bool pixels = false;
  for (const View& view : scene.views) {
    sights.push_back(sight_of(view.camera));
    pixels = pixels || !view.polygons;
    Range& range = sights.back().parallel ? scale : focal;
    range.add(sights.back().focal_x);
    range.add(sights.back().focal_y);
    if (sights.back().parallel) ++parallel;
    if (view.camera.handedness() < 0) ++mirrored;
  }
  std::string line = fmt::format("{} view{} from {}", sights.size(), sights.size() == 1 ? "" : "s", scene.format);
  if (scene.guessed) return line;
  if (pixels) {
    line += scene.origin == PixelOrigin::kCorner ? "; (0, 0) is the corner of a pixel"
                                                 : "; (0, 0) is the centre of a pixel";
  }
  if (parallel < sights.size()) line += fmt::format("; focal length {}{}", focal.text(), pixels ? " pixels" : "");
  if (parallel > 0) {
    line += fmt::format("; {} with parallel lines of sight, {}{} per unit of length",
                        parallel == sights.size() ? "all" : std::to_string(parallel), scale.text(),
                        pixels ? " pixels" : "");
  }
  if (const auto point = common_point(sights)) {
    Range distance;
    std::size_t away = 0;
    for (const Sight& s : sights) {
      if (s.parallel) continue;
      distance.add((*point - s.centre).norm());
      if ((*point - s.centre).dot(s.axis) <= 0) ++away;
    }
    line += fmt::format("; the cameras look at {} from {} away", text(*point, distance.high), distance.text());
    if (away > 0)
      line += fmt::format("; {} of them look AWAY from it (matrices of the other sign, or other axes?)", away);
  } else if (sights.size() > 1 && parallel == 0) {
    line += "; the cameras look in one direction";
  }
  if (mirrored > 0 && mirrored < sights.size()) {
    line += fmt::format("; the images of {} are mirrored", mirrored);
  } else if (mirrored > 0) {
    line += "; all images are mirrored, or the axes of space are left-handed";
  }
  const auto distorted = std::count_if(scene.views.begin(), scene.views.end(),
                                       [](const View& view) { return !view.distortion.coefficients.empty(); });
  if (distorted > 0 && static_cast<std::size_t>(distorted) == scene.views.size()) {
    line += "; lens distortion is undone";
  } else if (distorted > 0) {
    line += fmt::format("; lens distortion of {} is undone", distorted);
  }
  return line + ignored_text(scene.ignored);
}

std::vector<std::string> view_lines(const Scene& scene, const std::vector<std::filesystem::path>& images) {
  std::vector<Sight> sights;
  for (const View& view : scene.views) sights.push_back(sight_of(view.camera));
  const auto point = common_point(sights);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const View& view = scene.views[i];
    const Sight& s = sights[i];
    const std::string source =
        view.polygons ? fmt::format("{} polygons", view.polygons->size())
                      : (i < images.size() && !images[i].empty() ? images[i].string() : std::string("no image"));
    std::string line = s.parallel
                           ? fmt::format("{}: {}; parallel lines of sight along {}, {:.5g} x {:.5g} per unit of length",
                                         view.name, source, text(s.axis, 1), s.focal_x, s.focal_y)
                           : fmt::format("{}: {}; focal length {:.5g} x {:.5g}, centre {}", view.name, source,
                                         s.focal_x, s.focal_y, text(s.centre, s.centre.norm()));
    if (point && !s.parallel && (*point - s.centre).norm() > 0) {
      const double cosine = (*point - s.centre).normalized().dot(s.axis);
      line +=
          fmt::format(", {:.1f} degrees off the common point", std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI);
    }
    if (!view.distortion.coefficients.empty()) {
      line += fmt::format(", {} distortion coefficients", view.distortion.coefficients.size());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace nef::visual_hull
