// SPDX-License-Identifier: Apache-2.0
//
// Starts that differ in the sense of rotation and the elevation of the camera are fitted with few samples of few views,
// from a loss that forgives much to one that does not; the best one is fitted to all views. A wrong sense, or a wrong
// side of the horizon, ends at residuals of several pixels, unless the camera is so far away that both are the same.
#include "apps/visual_hull/refine/find_turntable.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "apps/visual_hull/refine/fit.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull::refine {
namespace {

constexpr std::size_t kFewest = 5;
constexpr std::size_t kTried = 12;         // views
constexpr std::size_t kSamplesTried = 40;  // of each

/// Where a search begins.
struct Start {
  int sense = 1;         // 1: counterclockwise seen from above
  double elevation = 0;  // degrees
  double focal = 1;      // times the width of the image
};

std::vector<MovingCamera> cameras_at(const std::vector<Outline>& outlines, const ImageSize& size, PixelOrigin origin,
                                     const Start& start) {
  const double corner = origin == PixelOrigin::kCorner ? 0.5 : 0;
  const double focal = start.focal * size.width;
  Eigen::Matrix3d k;
  k << focal, 0, (size.width - 1) / 2.0 + corner, 0, focal, (size.height - 1) / 2.0 + corner, 0, 0, 1;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Outline& outline : outlines) middle += outline.middle / static_cast<double>(outlines.size());
  const double e = start.elevation * M_PI / 180;
  Eigen::Matrix3d r;  // upright, from (cos e, 0, sin e) towards the origin
  r << 0, 1, 0, std::sin(e), 0, -std::cos(e), -std::cos(e), 0, -std::sin(e);
  const Eigen::Vector3d t = k.inverse() * middle.homogeneous();
  std::vector<MovingCamera> cameras;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const double angle = start.sense * 2 * M_PI * static_cast<double>(i) / static_cast<double>(outlines.size());
    cameras.emplace_back(k, r * rotation_by(angle * Eigen::Vector3d::UnitZ()), t);
  }
  return cameras;
}

template <typename T>
std::vector<T> some_of(const std::vector<T>& all) {
  std::vector<T> some;
  const std::size_t n = std::min(kTried, all.size());
  for (std::size_t k = 0; k < n; ++k) some.push_back(all[k * all.size() / n]);
  return some;
}

Outline thinned(Outline outline) {
  std::vector<OutlineSample> kept;
  const std::size_t n = outline.samples.size();
  for (std::size_t k = 0; k < std::min(kSamplesTried, n); ++k) {
    kept.push_back(outline.samples[k * n / std::min(kSamplesTried, n)]);
  }
  outline.samples = std::move(kept);
  return outline;
}

double missed(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
              const nef::Monitor& monitor) {
  const std::vector<std::uint8_t> used(cameras.size(), 1);
  std::vector<std::vector<Coherence>> values;
  measure(cameras, outlines, object_ball(cameras, outlines), {used}, values, monitor);
  return summary(outlines, values, used, Pieces::kAll).mean;
}

}  // namespace

std::vector<MovingCamera> find_turntable(const std::vector<Outline>& outlines, const ImageSize& size,
                                         PixelOrigin origin, const nef::Monitor& monitor) {
  if (outlines.size() < kFewest) {
    throw nef::InputError("--turntable without --K: five images at least are needed, of one full turn in equal steps");
  }
  std::vector<Start> starts;
  for (const int sense : {1, -1}) {
    for (const double elevation : {-20.0, 5.0, 25.0, 50.0}) {
      for (const double focal : {1.2, 4.0}) starts.push_back({sense, elevation, focal});  // usual lenses, and long ones
    }
  }
  std::vector<Outline> few;
  for (const Outline& outline : some_of(outlines)) few.push_back(thinned(outline));
  const double coarse = static_cast<double>(size.width) / 20;
  std::vector<std::vector<MovingCamera>> ends(starts.size());
  std::vector<double> left(starts.size());
  nef::parallel_for(starts.size(), monitor, [&](std::size_t s, const nef::Monitor& own) {
    FitOptions options;
    options.model = Model::kTurntable;
    options.used.assign(few.size(), 1);
    options.scales = {coarse, coarse / 3, 8, 3};
    options.rounds = 12;
    const std::vector<MovingCamera> all = cameras_at(outlines, size, origin, starts[s]);
    const std::vector<MovingCamera> some = some_of(all);
    const std::vector<MovingCamera> end = fit(some, few, options, own);
    left[s] = missed(end, few, own);
    // The same motion in the camera's frame for all views.
    ends[s] = all;
    const Eigen::Matrix3d turn = end[0].rotation() * some[0].rotation().transpose();
    const Eigen::Vector3d shift = end[0].translation() - turn * some[0].translation();
    for (MovingCamera& camera : ends[s]) {
      camera.set_pose(turn * camera.rotation(), turn * camera.translation() + shift);
      camera.zoom(end[0].zoomed());
    }
  });
  const std::size_t best = static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  FitOptions options;
  options.model = Model::kTurntable;
  options.used.assign(outlines.size(), 1);
  return fit(ends[best], outlines, options, monitor);
}

}  // namespace nef::visual_hull::refine
