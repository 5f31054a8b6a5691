// SPDX-License-Identifier: Apache-2.0
//
// The residual of [Hernandez, Schmitt, Cipolla 2007] as a distance: along each line of sight through an outline the
// point is sought that lies deepest in the other silhouettes. Depths are tried one after the other, each only until a
// view says less than the best so far; the best one is then improved by following the views' distances as straight
// lines: the highest point of their lower envelope.
#include "apps/visual_hull/refine/coherence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull::refine {
namespace {

constexpr int kDepths = 64;
constexpr int kPolish = 6;
constexpr double kBehind = -1e6;  // distance of what is behind a camera

/// The line of sight of one sample, as other views see it.
class Ray {
 public:
  Ray(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
      const std::vector<std::uint8_t>& used, std::size_t view, const Eigen::Vector2d& point)
      : cameras_(cameras), outlines_(outlines) {
    const MovingCamera& own = cameras[view];
    origin_ = own.centre();
    direction_ = own.rotation().transpose() * own.ray(point);
    for (std::size_t j = 0; j < cameras.size(); ++j) {
      if (j == view || used[j] == 0) continue;
      others_.push_back(
          {static_cast<std::uint32_t>(j), cameras[j].inward(origin_), cameras[j].rotation() * direction_});
    }
  }

  [[nodiscard]] bool empty() const { return others_.empty(); }

  /// The least distance at a depth, or something below `enough` as soon as it is known to be less. The view that said
  /// so comes first from then on.
  double least(double depth, double enough) {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < others_.size(); ++k) {
      const Other& o = others_[k];
      const Eigen::Vector3d own = o.origin + depth * o.direction;
      const double d = own.z() > 0 ? outlines_[o.view].distance.value(cameras_[o.view].seen(own)) : kBehind;
      least = std::min(least, d);
      if (least < enough) {
        if (k > 0) std::swap(others_[k], others_[k / 2]);
        return least;
      }
    }
    return least;
  }

  /// The distances as straight lines about a depth; where their lower envelope is highest.
  struct Peak {
    double at = 0;  // the least distance at the depth itself
    double step = 0;
    std::array<std::uint32_t, 2> views{Coherence::kNone, Coherence::kNone};
    std::array<double, 2> weights{1, 0};
  };
  Peak peak(double depth, double reach) {
    lines_.clear();
    for (const Other& o : others_) {
      const Eigen::Vector3d own = o.origin + depth * o.direction;
      if (!(own.z() > 0)) {
        lines_.push_back({o.view, kBehind, 0});
        continue;
      }
      const MovingCamera& camera = cameras_[o.view];
      Eigen::Vector2d g;
      const double d = outlines_[o.view].distance.value(camera.seen(own), g);
      lines_.push_back({o.view, d, g.dot(camera.derivative(own) * o.direction)});
    }
    return highest(reach);
  }

 private:
  struct Other {
    std::uint32_t view;
    Eigen::Vector3d origin, direction;
  };
  struct Line {
    std::uint32_t view;
    double value, slope;
  };

  // Climbs the lowest line, over to the one that crosses it first, until that falls.
  [[nodiscard]] Peak highest(double reach) const {
    const Line* lowest = &lines_[0];
    for (const Line& line : lines_) {
      if (line.value < lowest->value) lowest = &line;
    }
    Peak peak;
    peak.at = lowest->value;
    peak.views[0] = lowest->view;
    const double sign = lowest->slope >= 0 ? 1 : -1;
    for (std::size_t round = 0; round <= lines_.size(); ++round) {
      const double up = sign * lowest->slope;
      const Line* next = nullptr;
      double first = reach;
      for (const Line& line : lines_) {
        const double fall = up - sign * line.slope;
        if (!(fall > 0) || &line == lowest) continue;
        const double crossing = (line.value - lowest->value) / fall;  // from 0, along the sign
        if (crossing >= std::abs(peak.step) && crossing < first) {
          first = crossing;
          next = &line;
        }
      }
      peak.step = sign * first;
      if (next == nullptr) break;  // still rising at the end of the reach
      if (sign * next->slope <= 0) {
        peak.views = {lowest->view, next->view};
        const double down = -sign * next->slope;
        peak.weights = {down / (up + down), up / (up + down)};
        break;
      }
      lowest = next;
      peak.views[0] = lowest->view;
    }
    return peak;
  }

  const std::vector<MovingCamera>& cameras_;
  const std::vector<Outline>& outlines_;
  Eigen::Vector3d origin_, direction_;
  std::vector<Other> others_;
  std::vector<Line> lines_;
};

void improve(Ray& ray, double reach, Coherence& c) {
  for (int round = 0; round < kPolish; ++round) {
    const Ray::Peak peak = ray.peak(c.depth, reach);
    c.value = peak.at;
    c.killer = peak.views;
    c.weight = peak.weights;
    double step = peak.step;
    bool better = false;
    for (int halving = 0; halving < 4 && !better; ++halving, step /= 2) {
      const double value = ray.least(c.depth + step, c.value);
      if (value > c.value + 1e-4) {
        c.depth += step;
        c.value = value;
        better = true;
      }
    }
    if (!better) break;
    reach = std::max(2 * std::abs(step), reach / 8);
  }
}

Coherence coherence_of(Ray& ray, double near, double far, const Coherence* before, Search search) {
  const bool deep = search == Search::kDeep;
  Coherence best;
  best.value = -HUGE_VAL;
  const double gap = (far - near) / kDepths;
  if (before != nullptr && before->depth > near && before->depth < far) {
    best.depth = before->depth;
    best.value = ray.least(best.depth, -HUGE_VAL);
    if (!deep && best.value >= 0) return best;
    improve(ray, gap, best);
    if ((!deep && best.value >= 0) || search == Search::kNear) return best;
  }
  bool moved = best.value == -HUGE_VAL;
  for (int k = 0; k < kDepths; ++k) {
    const double depth = near + (k + 0.5) * gap;
    const double value = ray.least(depth, best.value);
    if (value <= best.value) continue;
    best.depth = depth;
    best.value = value;
    moved = true;
    if (!deep && value >= 0) return best;
  }
  if (moved) improve(ray, gap, best);
  return best;
}

}  // namespace

Ball object_ball(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines) {
  // The nearest point, then again without the half of the lines that are farthest from it.
  Ball ball;
  std::vector<std::uint8_t> use(cameras.size(), 1);
  for (int round = 0; round < 2; ++round) {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (use[i] == 0) continue;
      const Eigen::Vector3d d = (cameras[i].rotation().transpose() * cameras[i].ray(outlines[i].middle)).normalized();
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
      h += across;
      g += across * cameras[i].centre();
    }
    ball.centre = h.ldlt().solve(g);
    std::vector<double> miss(cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const Eigen::Vector3d own = cameras[i].inward(ball.centre);
      miss[i] = own.z() > 0 ? (cameras[i].seen(own) - outlines[i].middle).norm() / outlines[i].extent : HUGE_VAL;
    }
    std::vector<double> sorted = miss;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    for (std::size_t i = 0; i < cameras.size(); ++i) use[i] = miss[i] <= sorted[sorted.size() / 2] ? 1 : 0;
    if (cameras.size() < 6) break;
  }
  std::vector<double> radii;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Eigen::Vector3d own = cameras[i].inward(ball.centre);
    if (!(own.z() > 0)) continue;
    const Eigen::Vector2d middle = cameras[i].seen(own);
    double reach = 0;
    for (const OutlineSample& s : outlines[i].samples) reach = std::max(reach, (s.point - middle).norm());
    radii.push_back(reach * own.z() / cameras[i].focal());
  }
  if (radii.empty()) return ball;
  std::sort(radii.begin(), radii.end());
  ball.radius = 1.3 * radii[radii.size() * 4 / 5];
  return ball;
}

void measure(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines, const Ball& ball,
             const Measure& what, std::vector<std::vector<Coherence>>& result, const nef::Monitor& monitor) {
  const bool again = result.size() == cameras.size();
  if (!again) result.assign(cameras.size(), {});
  nef::parallel_for(cameras.size(), monitor, [&](std::size_t i, const nef::Monitor& own) {
    if (what.only ? *what.only != i : what.used[i] == 0) return;
    const std::vector<OutlineSample>& samples = outlines[i].samples;
    std::vector<Coherence>& values = result[i];
    const bool known = values.size() == samples.size();
    values.resize(samples.size());
    const double middle = cameras[i].inward(ball.centre).z();
    const double near = std::max(middle - ball.radius, 0.02 * middle);
    const double far = middle + ball.radius;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (!belongs(samples[k], what.pieces)) continue;
      own.check_interruption();
      Ray ray(cameras, outlines, what.used, i, samples[k].point);
      if (ray.empty() || !(far > near)) {
        values[k] = {};
        continue;
      }
      values[k] = coherence_of(ray, near, far, known && values[k].depth > 0 ? &values[k] : nullptr, what.search);
    }
  });
}

CoherenceRow derivative(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
                        const std::vector<Eigen::Vector3d>& pivots, std::size_t view, std::size_t sample,
                        const Coherence& value) {
  CoherenceRow row;
  const MovingCamera& own = cameras[view];
  const Eigen::Vector2d& point = outlines[view].samples[sample].point;
  const Eigen::Vector3d at = value.depth * own.ray(point);
  const Eigen::Vector3d world = own.outward(at);
  row.view[0] = static_cast<std::uint32_t>(view);
  row.by_motion[0].setZero();
  row.count = 1;
  Eigen::Vector3d by_point = Eigen::Vector3d::Zero();  // of the value, by the point in space
  for (std::size_t k = 0; k < 2; ++k) {
    if (value.killer[k] == Coherence::kNone || value.weight[k] == 0) continue;
    const std::uint32_t j = value.killer[k];
    const MovingCamera& other = cameras[j];
    const Eigen::Vector3d there = other.inward(world);
    if (!(there.z() > 0)) continue;
    const Eigen::Vector2d seen = other.seen(there);
    Eigen::Vector2d g;
    static_cast<void>(outlines[j].distance.value(seen, g));
    const Eigen::RowVector3d d = value.weight[k] * g.transpose() * other.derivative(there);
    row.view[row.count] = j;
    row.by_motion[row.count] << (-d * cross_matrix(there - pivots[j])).transpose(), pivots[j].z() * d.transpose();
    row.by_zoom += value.weight[k] * g.dot(other.by_zoom(seen));
    ++row.count;
    by_point += (d * other.rotation()).transpose();
  }
  // A motion of the sample's own camera moves its ray the other way.
  const Eigen::RowVector3d d = by_point.transpose() * own.rotation().transpose();
  row.by_motion[0] << (d * cross_matrix(at - pivots[view])).transpose(), -pivots[view].z() * d.transpose();
  row.by_zoom += d.dot(value.depth * own.ray_by_zoom(point));
  return row;
}

ResidualSummary summary(const std::vector<Outline>& outlines, const std::vector<std::vector<Coherence>>& values,
                        const std::vector<std::uint8_t>& used, Pieces pieces) {
  std::vector<double> all;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (used[i] == 0) continue;
    for (std::size_t k = 0; k < values[i].size(); ++k) {
      if (!belongs(outlines[i].samples[k], pieces)) continue;
      all.push_back(std::max(0.0, -values[i][k].value));
    }
  }
  ResidualSummary result;
  result.count = all.size();
  if (all.empty()) return result;
  for (const double r : all) result.mean += r / static_cast<double>(all.size());
  const auto ninth = static_cast<std::ptrdiff_t>(all.size() * 9 / 10);
  std::nth_element(all.begin(), all.begin() + ninth, all.end());
  result.ninth_decile = all[static_cast<std::size_t>(ninth)];
  return result;
}

}  // namespace nef::visual_hull::refine
