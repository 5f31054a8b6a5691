// SPDX-License-Identifier: Apache-2.0
//
// Points of a grid that all silhouettes of a series contain stand for its hull: they give its centre, its principal
// axes, and how much two hulls overlap after a rotation. Rotations spread evenly [Alexa 2022] and those that map
// principal axes to each other are sorted by that. Hulls of two poses differ where each has seen too little, so overlap
// only chooses where to start: the fit minimizes what outlines of either series miss in the silhouettes of both, by
// Levenberg and Marquardt's method in seven parameters (turn, shift, scale) or six.
#include "apps/visual_hull/combine/placement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using refine::Coherence;
using refine::MovingCamera;
using refine::Pieces;
using refine::Similarity;

constexpr std::size_t kSearchViews = 10;    // of a series
constexpr std::size_t kSearchSamples = 40;  // of a view
constexpr std::size_t kRotations = 2000;    // about 15 degrees apart
constexpr std::size_t kStarts = 10;
constexpr std::size_t kPromising = 4;  // after the coarsest fit
constexpr std::size_t kOverlapPoints = 300;
constexpr int kGridSide = 32;
constexpr double kStartsApart = 20;  // degrees
constexpr double kPlacesApart = 15;  // degrees: one place, if less

double degrees_between(const Matrix3d& a, const Matrix3d& b) {
  return std::acos(std::clamp(((a.transpose() * b).trace() - 1) / 2, -1.0, 1.0)) * 180 / M_PI;
}

// Fewer views, with fewer samples.
OutlineSeries thinned(const OutlineSeries& series) {
  OutlineSeries result;
  const std::size_t n = series.cameras.size();
  const std::size_t count = std::min(n, kSearchViews);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * n / count;
    result.cameras.push_back(series.cameras[i]);
    refine::Outline outline = series.outlines[i];
    std::vector<refine::OutlineSample> few;
    const std::size_t step = std::max<std::size_t>(1, outline.samples.size() / kSearchSamples);
    for (std::size_t j = 0; j < outline.samples.size(); j += step) few.push_back(outline.samples[j]);
    outline.samples = std::move(few);
    result.outlines.push_back(std::move(outline));
  }
  return result;
}

bool contains_point(const OutlineSeries& series, const Vector3d& point) {
  for (std::size_t i = 0; i < series.cameras.size(); ++i) {
    const Vector3d own = series.cameras[i].inward(point);
    if (!(own.z() > 0) || series.outlines[i].distance.value(series.cameras[i].seen(own)) < 0) return false;
  }
  return true;
}

/// The hull of a series as points of a grid.
struct Body {
  std::vector<Vector3d> points;  // spread over it
  Vector3d centre = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();  // columns, right-handed
  double spread = 1;                     // root mean square distance from the centre
};

Body body_of(const OutlineSeries& series) {
  const refine::Ball ball = refine::object_ball(series.cameras, series.outlines);
  std::vector<Vector3d> all;
  for (int k = 0; k < kGridSide * kGridSide * kGridSide; ++k) {
    const std::array<int, 3> index{k % kGridSide, k / kGridSide % kGridSide, k / (kGridSide * kGridSide)};
    const Vector3d cell(index[0], index[1], index[2]);
    const Vector3d point = ball.centre + ball.radius * ((2 * cell + Vector3d::Ones()) / kGridSide - Vector3d::Ones());
    if (contains_point(series, point)) all.push_back(point);
  }
  if (all.size() < 20) throw nef::InputError("the silhouettes of a series have no part of space in common");
  Body body;
  const auto count = static_cast<double>(all.size());
  for (const Vector3d& p : all) body.centre += p / count;
  Matrix3d moments = Matrix3d::Zero();
  for (const Vector3d& p : all) moments += (p - body.centre) * (p - body.centre).transpose() / count;
  body.spread = std::sqrt(moments.trace());
  body.axes = Eigen::SelfAdjointEigenSolver<Matrix3d>(moments).eigenvectors();
  if (body.axes.determinant() < 0) body.axes.col(0) *= -1;
  const std::size_t step = std::max<std::size_t>(1, all.size() / kOverlapPoints);
  for (std::size_t k = 0; k < all.size(); k += step) body.points.push_back(all[k]);
  return body;
}

// The 24 rotations that map coordinate axes to coordinate axes.
std::vector<Matrix3d> axis_rotations() {
  std::vector<Matrix3d> result;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d m = Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) m(i, order[static_cast<std::size_t>(i)]) = (signs >> i & 1) != 0 ? -1 : 1;
      if (m.determinant() > 0) result.push_back(m);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

// The i-th of n rotations that cover all of them evenly: super-Fibonacci spirals [Alexa 2022].
Matrix3d spread_rotation(std::size_t i, std::size_t n) {
  constexpr double kPhi = 1.41421356237309504880;
  constexpr double kPsi = 1.53375116875520428811;
  const double s = static_cast<double>(i) + 0.5;
  const double t = s / static_cast<double>(n);
  const double a = 2 * M_PI * s / kPhi;
  const double b = 2 * M_PI * s / kPsi;
  const double r = std::sqrt(t);
  const double q = std::sqrt(1 - t);
  return Eigen::Quaterniond(q * std::cos(b), r * std::sin(a), r * std::cos(a), q * std::sin(b)).toRotationMatrix();
}

/// Where the second series may stand: its space from that of the first.
struct Start {
  Similarity map;
  double overlap = 0;  ///< share of the points of both hulls that lie in the other one
};

// Centre on centre, turned: X = scale R (X' - centre of the first) + centre of the second.
Similarity map_by(const Matrix3d& rotation, const Body& first, const Body& second) {
  Similarity map;
  map.scale = second.spread / first.spread;
  map.rotation = rotation;
  map.shift = second.centre - map.scale * (rotation * first.centre);
  return map;
}

double overlap_of(const Similarity& map, const OutlineSeries& first, const OutlineSeries& second, const Body& a,
                  const Body& b) {
  std::size_t common = 0;
  for (const Vector3d& p : a.points) {
    common += contains_point(second, map.scale * (map.rotation * p) + map.shift) ? 1 : 0;
  }
  for (const Vector3d& p : b.points) {
    common += contains_point(first, map.rotation.transpose() * (p - map.shift) / map.scale) ? 1 : 0;
  }
  return static_cast<double>(common) / static_cast<double>(a.points.size() + b.points.size());
}

std::vector<Start> starts_of(const OutlineSeries& first, const OutlineSeries& second, const nef::Monitor& monitor) {
  const Body a = body_of(first);
  const Body b = body_of(second);
  std::vector<Start> all;
  for (const Matrix3d& m : axis_rotations()) all.push_back({map_by(b.axes * m * a.axes.transpose(), a, b)});
  for (std::size_t i = 0; i < kRotations; ++i) all.push_back({map_by(spread_rotation(i, kRotations), a, b)});
  nef::parallel_for(all.size(), monitor, [&](std::size_t i, const nef::Monitor& own) {
    own.check_interruption();
    all[i].overlap = overlap_of(all[i].map, first, second, a, b);
  });
  std::stable_sort(all.begin(), all.end(), [](const Start& x, const Start& y) { return x.overlap > y.overlap; });
  std::vector<Start> best;
  for (const Start& start : all) {
    if (best.size() == kStarts) break;
    const bool known = std::any_of(best.begin(), best.end(), [&start](const Start& s) {
      return degrees_between(s.map.rotation, start.map.rotation) < kStartsApart;
    });
    if (!known) best.push_back(start);
  }
  return best;
}

using Values = std::vector<std::vector<Coherence>>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

Similarity inverse(const Similarity& map) {
  Similarity back;
  back.scale = 1 / map.scale;
  back.rotation = map.rotation.transpose();
  back.shift = -back.scale * (back.rotation * map.shift);
  return back;
}

/// Both series, and where the second one stands now.
class Pair {
 public:
  // Of the views of `both`, those from `second` on are the second series.
  Pair(const OutlineSeries& both, std::size_t second, const refine::Ball& ball, const Similarity& map,
       const nef::Monitor& monitor)
      : outlines_(both.outlines),
        cameras_(both.cameras),
        second_(second),
        used_(both.cameras.size(), 1),
        ball_(ball),
        monitor_(monitor) {
    move(map, cameras_, map_);
  }

  [[nodiscard]] const Similarity& map() const { return map_; }

  // Space about the object is moved: the new point X' is seen where scale R X' + shift was.
  void place_at(const Similarity& map) {
    move(inverse(map_), cameras_, map_);
    map_ = {};
    move(map, cameras_, map_);
  }

  // The same place with one unit of length for both.
  [[nodiscard]] Similarity unscaled() const {
    Similarity map = map_;
    map.scale = 1;
    map.shift = map_.scale * (map_.rotation * ball_.centre) + map_.shift - map_.rotation * ball_.centre;
    return map;
  }

  [[nodiscard]] refine::ResidualSummary residual(Pieces pieces) const {
    Values values;
    refine::measure(cameras_, outlines_, ball_, {used_, pieces}, values, monitor_);
    return refine::summary(outlines_, values, used_, pieces);
  }

  void fit(const std::vector<double>& scales, bool scaled, Pieces pieces) {
    for (const double scale : scales) fit_at(scale, scaled, pieces);
  }

 private:
  void move(const Similarity& by, std::vector<MovingCamera>& cameras, Similarity& map) const {
    for (std::size_t i = second_; i < cameras.size(); ++i) cameras[i].move_space(by.scale, by.rotation, by.shift);
    map.shift += map.scale * (map.rotation * by.shift);
    map.rotation = map.rotation * by.rotation;
    map.scale *= by.scale;
  }

  static double robust(double r, double scale) { return r * r / (1 + r * r / (scale * scale)); }

  [[nodiscard]] double cost(const Values& values, double scale, Pieces pieces) const {
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t k = 0; k < values[i].size(); ++k) {
        if (!refine::belongs(outlines_[i].samples[k], pieces)) continue;
        ++count;
        if (values[i][k].value < 0) sum += robust(values[i][k].value, scale);
      }
    }
    return sum / std::max(count, 1.0);
  }

  // How turn, shift (in radii of the object) and the logarithm of the scale move a camera of the second series
  // (MovingCamera::move about its pivot). Scaling about the pivot looks like a shift along the line of sight to it.
  [[nodiscard]] Eigen::Matrix<double, 6, 7> columns(std::size_t view, const Vector3d& pivot) const {
    Eigen::Matrix<double, 6, 7> m = Eigen::Matrix<double, 6, 7>::Zero();
    const Matrix3d& r = cameras_[view].rotation();
    m.block<3, 3>(0, 0) = r;
    m.block<3, 3>(3, 3) = ball_.radius / pivot.z() * r;
    m.block<3, 1>(3, 6) = -pivot / pivot.z();
    return m;
  }

  void equations(const Values& values, double scale, Pieces pieces, Eigen::Matrix<double, 7, 7>& h, Vector7& g) const {
    std::vector<Vector3d> pivots;
    for (const MovingCamera& camera : cameras_) pivots.push_back(camera.inward(ball_.centre));
    h.setZero();
    g.setZero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t k = 0; k < values[i].size(); ++k) {
        const double r = values[i][k].value;
        if (!(r < 0) || !refine::belongs(outlines_[i].samples[k], pieces)) continue;
        const refine::CoherenceRow d = refine::derivative(cameras_, outlines_, pivots, i, k, values[i][k]);
        Vector7 row = Vector7::Zero();
        for (std::size_t v = 0; v < d.count; ++v) {
          if (d.view[v] < second_) continue;
          row += columns(d.view[v], pivots[d.view[v]]).transpose() * d.by_motion[v];
        }
        const double q = 1 + r * r / (scale * scale);
        h += row * row.transpose() / (q * q);
        g += row * (r / (q * q));
      }
    }
  }

  [[nodiscard]] Similarity step_of(const Vector7& step) const {
    Similarity by;
    by.scale = std::exp(step[6]);
    by.rotation = refine::rotation_by(step.head<3>());
    by.shift = ball_.centre - by.scale * (by.rotation * ball_.centre) + ball_.radius * step.segment<3>(3);
    return by;
  }

  void fit_at(double scale, bool scaled, Pieces pieces) {
    constexpr int kRounds = 20;
    constexpr int kBetweenSearches = 3;
    constexpr double kStill = 1e-6;     // of the size of the object
    constexpr double kStepGain = 1e-3;  // of the cost
    Values values;
    refine::Measure what{used_, pieces};
    refine::measure(cameras_, outlines_, ball_, what, values, monitor_);
    double now = cost(values, scale, pieces);
    double damping = 1e-3;
    for (int round = 0; round < kRounds; ++round) {
      // Best points move little from step to step: all depths are searched now and then.
      what.search = round % kBetweenSearches == kBetweenSearches - 1 ? refine::Search::kFull : refine::Search::kNear;
      Eigen::Matrix<double, 7, 7> h;
      Vector7 g;
      equations(values, scale, pieces, h, g);
      if (!scaled) {
        h.row(6).setZero();
        h.col(6).setZero();
        g[6] = 0;
      }
      bool better = false;
      double gain = 0;
      double size = 0;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        Eigen::Matrix<double, 7, 7> held = h;
        held.diagonal() *= 1 + damping;
        held.diagonal().array() += 1e-9 * h.diagonal().maxCoeff() + 1e-300;
        const Vector7 step = -held.ldlt().solve(g);
        size = step.norm();
        std::vector<MovingCamera> next = cameras_;
        Similarity there = map_;
        move(step_of(step), next, there);
        Values seen = values;
        refine::measure(next, outlines_, ball_, what, seen, monitor_);
        const double then = cost(seen, scale, pieces);
        better = then < now;
        if (better) {
          gain = now - then;
          now = then;
          cameras_ = std::move(next);
          map_ = there;
          values = std::move(seen);
          damping = std::max(damping / 4, 1e-7);
        } else {
          damping *= 8;
        }
      }
      if (!better || size < kStill || gain < kStepGain * now) break;
    }
  }

  const std::vector<refine::Outline>& outlines_;
  std::vector<MovingCamera> cameras_;
  std::size_t second_;
  std::vector<std::uint8_t> used_;
  refine::Ball ball_;
  Similarity map_;
  const nef::Monitor& monitor_;
};

OutlineSeries joined(OutlineSeries first, OutlineSeries second) {
  std::move(second.cameras.begin(), second.cameras.end(), std::back_inserter(first.cameras));
  std::move(second.outlines.begin(), second.outlines.end(), std::back_inserter(first.outlines));
  return first;
}

double median_extent(const OutlineSeries& first, const OutlineSeries& second) {
  std::vector<double> extents;
  for (const OutlineSeries* series : {&first, &second}) {
    for (const refine::Outline& outline : series->outlines) extents.push_back(outline.extent);
  }
  std::nth_element(extents.begin(), extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2), extents.end());
  return extents[extents.size() / 2];
}

double alone_residual(const OutlineSeries& first, const OutlineSeries& second, const nef::Monitor& monitor) {
  double sum = 0;
  double count = 0;
  for (const OutlineSeries* series : {&first, &second}) {
    const std::vector<std::uint8_t> used(series->cameras.size(), 1);
    Values values;
    refine::measure(series->cameras, series->outlines, refine::object_ball(series->cameras, series->outlines), {used},
                    values, monitor);
    const refine::ResidualSummary found = refine::summary(series->outlines, values, used, Pieces::kAll);
    sum += found.mean * static_cast<double>(found.count);
    count += static_cast<double>(found.count);
  }
  return count > 0 ? sum / count : 0;
}

// The best place that few views find, and how good the next best one is.
Similarity searched_place(const OutlineSeries& first, const OutlineSeries& second, Placement& result,
                          const nef::Monitor& monitor) {
  const OutlineSeries few = thinned(first);
  const OutlineSeries others = thinned(second);
  const OutlineSeries both = joined(few, others);
  const refine::Ball ball = refine::object_ball(few.cameras, few.outlines);
  const double size = result.extent_px;
  std::vector<std::pair<double, Similarity>> found;
  for (const Start& start : starts_of(few, others, monitor)) found.emplace_back(0, start.map);
  const auto improve = [&](const std::vector<double>& scales) {
    for (auto& [residual, map] : found) {
      Pair pair(both, few.cameras.size(), ball, map, monitor);
      pair.fit(scales, true, Pieces::kAll);
      residual = pair.residual(Pieces::kAll).mean;
      map = pair.map();
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  };
  improve({size / 8});
  found.resize(std::min(found.size(), kPromising));
  improve({size / 30, size / 100});
  result.best_found_px = found[0].first;
  result.runner_up_px = HUGE_VAL;
  for (const auto& [residual, map] : found) {
    if (degrees_between(map.rotation, found[0].second.rotation) < kPlacesApart) continue;
    result.runner_up_px = residual;
    break;
  }
  return found[0].second;
}

}  // namespace

Similarity Placement::to_first() const { return inverse(map); }

bool Placement::fits() const {
  constexpr double kPixels = 0.5;
  constexpr double kShare = 0.004;  // of the size of the silhouettes
  return together_px <= 2 * alone_px + std::max(kPixels, kShare * extent_px);
}

bool Placement::ambiguous() const {
  constexpr double kPixels = 0.3;
  return runner_up_px <= 1.5 * best_found_px + kPixels;
}

Placement place_series(OutlineSeries first, OutlineSeries second, const nef::Monitor& monitor) {
  constexpr double kNearlyOne = 0.05;  // logarithm of a scale that may be 1
  constexpr double kLeastGain = 0.05;  // pixels of the mean residual of held-out pieces
  constexpr double kLeastShare = 0.2;  // of it
  Placement result;
  result.extent_px = median_extent(first, second);
  result.alone_px = alone_residual(first, second, monitor);
  const std::vector<double> scales{result.extent_px / 100, std::max(1.0, result.extent_px / 300)};
  const Similarity start = searched_place(first, second, result, monitor);
  const refine::Ball ball = refine::object_ball(first.cameras, first.outlines);
  const std::size_t count = first.cameras.size();
  const OutlineSeries both = joined(std::move(first), std::move(second));
  Pair pair(both, count, ball, start, monitor);
  pair.fit(scales, true, Pieces::kFitted);
  result.scaled = true;
  result.held_out_px = pair.residual(Pieces::kHeldOut).mean;
  if (std::abs(std::log(pair.map().scale)) < kNearlyOne) {
    const Similarity scaled = pair.map();
    pair.place_at(pair.unscaled());
    pair.fit(scales, false, Pieces::kFitted);
    const double plain = pair.residual(Pieces::kHeldOut).mean;
    const double gain = plain - result.held_out_px;  // of a scale
    if (gain < kLeastGain || gain < kLeastShare * plain) {
      result.scaled = false;
      result.held_out_px = plain;
    } else {
      pair.place_at(scaled);
    }
  }
  pair.fit({scales.back()}, result.scaled, Pieces::kAll);
  result.together_px = pair.residual(Pieces::kAll).mean;
  result.map = pair.map();
  return result;
}

MovingCamera placed_camera(MovingCamera camera, const Placement& placement) {
  const Similarity& map = placement.map;
  camera.move_space(map.scale, map.rotation, map.shift);
  return camera;
}

}  // namespace nef::visual_hull
