// SPDX-License-Identifier: Apache-2.0
//
// Cameras that refinement has found beside the true ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/visual_hull/refine/refine.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/visual_hull/refine/rendered.h"

namespace nef::visual_hull::testing {

inline constexpr double kObjectRadius = 0.8;  // of the objects: points to measure by are on a ball of this radius

/// The cameras of shots, and those that refinement has found.
inline std::vector<Camera> cameras_by(const std::vector<Shot>& shots) {
  std::vector<Camera> cameras;
  for (const Shot& shot : shots) cameras.push_back(make_view("view", shot.matrix()).camera);
  return cameras;
}

inline std::vector<Camera> cameras_by(const refine::Refinement& refined) {
  std::vector<Camera> cameras;
  for (const refine::RefinedView& view : refined.views) cameras.push_back(view.camera);
  return cameras;
}

/// What refinement makes of cameras by the silhouettes of a set.
inline refine::Refinement refined_cameras(const Set& set, const std::vector<Shot>& given, unsigned threads = 1,
                                          std::optional<double> camera_error = {}) {
  std::vector<refine::GivenView> views;
  const std::vector<Camera> cameras = cameras_by(given);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    views.push_back({std::to_string(i), cameras[i], &set.silhouettes[i], {}, {}});
  }
  return refine::refine_cameras(views, {PixelOrigin::kCenter, {}, camera_error}, nef::Monitor{}.on_threads(threads));
}

/// How far cameras are from the truth, in pixels, after the best similarity of space.
struct Difference {
  double pixels = 0;          ///< root mean square of all views
  std::vector<double> views;  ///< of each
  double scale = 1;           ///< lengths of the cameras' space over those of the truth
};

/// The similarity is found by the views that `left_out` does not name.
inline Difference difference(const std::vector<Camera>& cameras, const std::vector<Shot>& truth,
                             const std::vector<std::size_t>& left_out = {}) {
  std::vector<refine::MovingCamera> all;
  std::vector<refine::MovingCamera> moving;
  std::vector<refine::MovingCamera> fixed;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    all.emplace_back(cameras[i]);
    if (std::find(left_out.begin(), left_out.end(), i) != left_out.end()) continue;
    moving.push_back(all.back());
    fixed.emplace_back(truth[i].k, truth[i].r, truth[i].t);
  }
  const std::vector<Eigen::Vector3d> points = refine::ball_points({0, 0, 0}, kObjectRadius);
  const refine::Similarity s = refine::similarity(moving, fixed, points);
  Difference result;
  result.scale = s.scale;
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    all[i].move_space(s.scale, s.rotation, s.shift);
    double square = 0;
    for (const Eigen::Vector3d& p : points) square += (all[i].seen(all[i].inward(p)) - truth[i].seen(p)).squaredNorm();
    square /= static_cast<double>(points.size());
    result.views.push_back(std::sqrt(square));
    if (std::find(left_out.begin(), left_out.end(), i) == left_out.end()) sum += square;
  }
  result.pixels = std::sqrt(sum / static_cast<double>(moving.size()));
  return result;
}

/// The volume of the hull of a set, seen by cameras.
inline double volume_of_hull(const Set& set, const std::vector<Camera>& cameras) {
  Scene scene;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    View view;
    view.name = std::to_string(i);
    view.camera = cameras[i];
    view.polygons = set.silhouettes[i].rings;
    scene.views.push_back(view);
  }
  Options options;
  options.silhouette.simplify.tolerance = 0.5;
  return nef::approximate_volume(compute(scene, "", options).hull).value;
}

}  // namespace nef::visual_hull::testing
