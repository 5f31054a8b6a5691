// SPDX-License-Identifier: Apache-2.0
//
// Levenberg and Marquardt's method with reweighting. Each residual touches at most three cameras and the focal length,
// so rows are sparse and the normal equations small (six unknowns a view), dense, and summed in the order of the views.
// Steps are damped by the motion that they make in the images, which is the one unit that all parameters share.
#include "apps/visual_hull/refine/fit.h"

#include <Eigen/Dense>
#include <cmath>

namespace nef::visual_hull::refine {
namespace {

constexpr double kPrior = 1.0 / 300;   // pixels of residual for a pixel of motion, where nothing is known of cameras
constexpr double kOutlineNoise = 0.2;  // pixels, what stairs of pixels leave of an outline
constexpr double kOutlineCount = 60;   // samples of a view whose noise is their own
constexpr double kStill = 0.003;       // pixels: a step that is none
constexpr double kNoGain = 1e-7;       // square pixels of the mean loss
constexpr double kStepGain = 3e-3;     // of the mean loss, in a step
constexpr int kBetweenSearches = 3;    // steps
constexpr double kFirstDamping = 1e-2;

using Values = std::vector<std::vector<Coherence>>;

/// Sum of squares to second order: J^T J, J^T r, and J^T J of the images of points of the ball, the measure of motions
/// (mean square in pixels).
struct NormalEquations {
  Eigen::MatrixXd h;
  Eigen::VectorXd g;
  Eigen::MatrixXd motion;
};

/// One stage of a fit: what stays the same while cameras move.
struct Stage {
  const std::vector<MovingCamera>& held;
  const std::vector<Outline>& outlines;
  const FitOptions& options;
  Ball ball;
  std::vector<Eigen::Vector3d> points;
  double scale;
  double prior;  // pixels of residual for a pixel of motion from `held`
  const nef::Monitor& monitor;
};

// A view's residuals weigh as 1 / noise^2 together, its six parameters as 1 / known_to^2 each; costs are a mean of
// squares, in which the noise is one.
double prior_of(const FitOptions& options) {
  if (options.known.empty()) return kPrior;
  return std::max(kPrior, kOutlineNoise * std::sqrt(6 / kOutlineCount) / options.known_to);
}

double number_of_samples(const Stage& stage) {
  double n = 0;
  for (std::size_t i = 0; i < stage.outlines.size(); ++i) {
    if (stage.options.used[i] == 0) continue;
    for (const OutlineSample& s : stage.outlines[i].samples) n += belongs(s, stage.options.pieces) ? 1 : 0;
  }
  return std::max(n, 1.0);
}

double loss(double r, double scale) { return r * r / (1 + r * r / (scale * scale)); }

// The mean square, over all views and points, of the motion from where cameras are held.
double moved(const Stage& stage, const std::vector<MovingCamera>& cameras) {
  double sum = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double d = image_distance(cameras[i], stage.held[i], stage.points);
    sum += d * d / static_cast<double>(cameras.size());
  }
  return sum;
}

double cost(const Stage& stage, const std::vector<MovingCamera>& cameras, const Values& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (stage.options.used[i] == 0) continue;
    for (std::size_t k = 0; k < values[i].size(); ++k) {
      const double r = std::min(0.0, values[i][k].value);
      if (r < 0 && belongs(stage.outlines[i].samples[k], stage.options.pieces)) sum += loss(r, stage.scale);
    }
  }
  return sum / number_of_samples(stage) + stage.prior * stage.prior * moved(stage, cameras);
}

/// A row's entries by parameter.
class SparseRow {
 public:
  void clear() { entries_.clear(); }
  void add(int column, double value) {
    for (auto& [c, v] : entries_) {
      if (c == column) {
        v += value;
        return;
      }
    }
    entries_.emplace_back(column, value);
  }
  void add_to(Eigen::MatrixXd& h, Eigen::VectorXd& g, double weight, double residual) const {
    for (const auto& [a, va] : entries_) {
      g[a] += weight * va * residual;
      for (const auto& [b, vb] : entries_) h(a, b) += weight * va * vb;
    }
  }

 private:
  std::vector<std::pair<int, double>> entries_;
};

void add_motions(const Stage& stage, const std::vector<MovingCamera>& cameras, const Parameters& p,
                 NormalEquations& sum) {
  SparseRow row;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(p.count());
  const double weight = 1 / static_cast<double>(cameras.size() * stage.points.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    for (const Eigen::Vector3d& point : stage.points) {
      const Eigen::Vector3d own = cameras[i].inward(point);
      const Eigen::Matrix<double, 2, 3> d = cameras[i].derivative(own);
      Matrix26 j;
      j << -d * cross_matrix(own - p.pivots()[i]), p.pivots()[i].z() * d;
      const Eigen::Vector2d seen = cameras[i].seen(own);
      const Eigen::Vector2d from = seen - stage.held[i].seen(stage.held[i].inward(point));
      const Eigen::Vector2d zoom = cameras[i].by_zoom(seen);
      for (int axis = 0; axis < 2; ++axis) {
        row.clear();
        for (const auto& [column, motion] : p.columns(i)) row.add(column, j.row(axis).dot(motion));
        if (p.zooms()) row.add(p.count() - 1, zoom[axis]);
        row.add_to(sum.motion, pull, weight, from[axis]);
      }
    }
  }
  sum.h += stage.prior * stage.prior * sum.motion;
  sum.g += stage.prior * stage.prior * pull;
}

NormalEquations equations(const Stage& stage, const std::vector<MovingCamera>& cameras, const Parameters& p,
                          const Values& values) {
  NormalEquations sum;
  sum.h = Eigen::MatrixXd::Zero(p.count(), p.count());
  sum.motion = sum.h;
  sum.g = Eigen::VectorXd::Zero(p.count());
  const double n = number_of_samples(stage);
  SparseRow row;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (stage.options.used[i] == 0) continue;
    for (std::size_t k = 0; k < values[i].size(); ++k) {
      const double r = values[i][k].value;
      if (!(r < 0) || !belongs(stage.outlines[i].samples[k], stage.options.pieces)) continue;
      const CoherenceRow d = derivative(cameras, stage.outlines, p.pivots(), i, k, values[i][k]);
      row.clear();
      for (std::size_t v = 0; v < d.count; ++v) {
        for (const auto& [column, motion] : p.columns(d.view[v])) row.add(column, d.by_motion[v].dot(motion));
      }
      if (p.zooms()) row.add(p.count() - 1, d.by_zoom);
      const double q = 1 + r * r / (stage.scale * stage.scale);
      row.add_to(sum.h, sum.g, 1 / (q * q * n), r);
    }
  }
  add_motions(stage, cameras, p, sum);
  return sum;
}

void run_stage(const Stage& stage, std::vector<MovingCamera>& cameras) {
  Measure what{stage.options.used, stage.options.pieces, Search::kFull};
  Values values;
  const auto look = [&](const std::vector<MovingCamera>& at, Values& found) {
    measure(at, stage.outlines, stage.ball, what, found, stage.monitor);
  };
  look(cameras, values);
  double now = cost(stage, cameras, values);
  double damping = kFirstDamping;
  for (int round = 0; round < stage.options.rounds; ++round) {
    // Best points move little from step to step: all depths are searched now and then.
    what.search = round % kBetweenSearches == kBetweenSearches - 1 ? Search::kFull : Search::kNear;
    const Parameters p(stage.options.model, cameras, stage.ball.centre, stage.options.axis, stage.options.free);
    const NormalEquations sum = equations(stage, cameras, p, values);
    bool better = false;
    double step_size = 0;
    double gain = 0;
    for (int attempt = 0; attempt < 6 && !better; ++attempt) {
      Eigen::MatrixXd h = sum.h + damping * sum.motion;
      h.diagonal().array() += 1e-12 * h.diagonal().maxCoeff();
      const Eigen::VectorXd step = -h.ldlt().solve(sum.g);
      step_size = std::sqrt(std::max(0.0, step.dot(sum.motion * step)));
      std::vector<MovingCamera> moved_cameras = cameras;
      p.apply(step, moved_cameras);
      Values next = values;
      look(moved_cameras, next);
      const double then = cost(stage, moved_cameras, next);
      if (then < now) {
        gain = now - then;
        cameras = std::move(moved_cameras);
        values = std::move(next);
        now = then;
        better = true;
        damping = std::max(damping / 4, 1e-6);
      } else {
        damping *= 5;
        if (step_size < kStill) break;
      }
    }
    if (!better || step_size < kStill || gain < std::max(kNoGain, kStepGain * now)) break;
  }
}

}  // namespace

Parameters::Parameters(Model model, const std::vector<MovingCamera>& cameras, const Eigen::Vector3d& centre,
                       const std::optional<Axis>& axis, const std::vector<std::uint8_t>& free)
    : model_(model), axis_(axis), zoom_(free.empty()), first_(cameras.size(), -1), columns_(cameras.size()) {
  const std::size_t n = cameras.size();
  for (const MovingCamera& camera : cameras) pivots_.push_back(camera.inward(centre));
  if (model == Model::kViews) {
    for (std::size_t i = 0; i < n; ++i) {
      if (!free.empty() && free[i] == 0) continue;
      first_[i] = count_;
      for (int k = 0; k < 6; ++k) columns_[i].emplace_back(count_++, Vector6::Unit(k));
    }
  } else {
    Eigen::Vector3d common = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : pivots_) common += p / static_cast<double>(n);
    pivots_.assign(n, common);
    for (std::size_t i = 0; i < n; ++i) {
      for (int k = 0; k < 6; ++k) columns_[i].emplace_back(k, Vector6::Unit(k));
      if (model != Model::kAngles) continue;
      const Eigen::Vector3d direction = cameras[i].rotation() * axis->direction;
      Vector6 turn;
      turn << direction, -direction.cross(cameras[i].inward(axis->point) - common) / common.z();
      columns_[i].emplace_back(6 + static_cast<int>(i), turn);
    }
    count_ = model == Model::kAngles ? 6 + static_cast<int>(n) : 6;
  }
  if (zoom_) ++count_;
}

void Parameters::apply(const Eigen::VectorXd& step, std::vector<MovingCamera>& cameras) const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (model_ == Model::kViews) {
      if (first_[i] >= 0) cameras[i].move(step.segment<6>(first_[i]), pivots_[i]);
    } else {
      if (model_ == Model::kAngles) {
        cameras[i].turn_object(rotation_by(step[6 + at] * axis_->direction), axis_->point);
      }
      cameras[i].move(step.head<6>(), pivots_[i]);
    }
    if (zoom_) cameras[i].zoom(step[step.size() - 1]);
  }
}

std::vector<MovingCamera> fit(const std::vector<MovingCamera>& start, const std::vector<Outline>& outlines,
                              const FitOptions& options, const nef::Monitor& monitor) {
  std::vector<MovingCamera> cameras = start;
  for (const double scale : options.scales) {
    const Ball ball = object_ball(cameras, outlines);
    // What is determined has come nearer to its place at coarser scales and is not to be held by where it began, unless
    // that is known.
    const std::vector<MovingCamera> held = options.known.empty() ? cameras : options.known;
    const std::vector<Eigen::Vector3d> points = ball_points(ball.centre, ball.radius / 1.3);
    const Stage stage{held, outlines, options, ball, points, scale, prior_of(options), monitor};
    run_stage(stage, cameras);
  }
  return cameras;
}

namespace {

// The hull of the other views is larger than the object, so lines of sight that pass through it some pixels deep are no
// contradiction, and those that miss it are: they weigh so many times as much. With equal weights the best pose is one
// that trades the one for the other, up to 5 pixels off.
constexpr double kMissed = 10;

// The loss of the rays of one view, and J^T J and J^T r by its own six parameters.
struct OwnEquations {
  double loss = 0;
  Eigen::Matrix<double, 6, 6> curvature = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 slope = Vector6::Zero();
};

OwnEquations own_equations(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
                           const std::vector<Eigen::Vector3d>& pivots, std::size_t view,
                           const std::vector<Coherence>& values, double scale, Pieces pieces) {
  OwnEquations own;
  const double n = static_cast<double>(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!belongs(outlines[view].samples[k], pieces)) continue;
    const double r = values[k].value;
    const double w = r < 0 ? kMissed : 1;
    own.loss += w * loss(r, scale) / n;
    const CoherenceRow d = derivative(cameras, outlines, pivots, view, k, values[k]);
    const double q = 1 + r * r / (scale * scale);
    own.curvature += w * d.by_motion[0] * d.by_motion[0].transpose() / (q * q * n);
    own.slope += w * d.by_motion[0] * (r / (q * q * n));
  }
  return own;
}

}  // namespace

MovingCamera resect(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
                    const std::vector<std::uint8_t>& used, std::size_t view, const nef::Monitor& monitor) {
  constexpr double kLeastFall = 0.2;
  const Ball ball = object_ball(cameras, outlines);
  const Measure what{used, Pieces::kAll, Search::kDeep, view};
  std::vector<Eigen::Vector3d> pivots(cameras.size());
  const auto equations_at = [&](const std::vector<MovingCamera>& at, double scale, Pieces pieces) {
    Values values;
    measure(at, outlines, ball, what, values, monitor);
    for (std::size_t i = 0; i < at.size(); ++i) pivots[i] = at[i].inward(ball.centre);
    return own_equations(at, outlines, pivots, view, values[view], scale, pieces);
  };
  std::vector<MovingCamera> now = cameras;
  for (const double scale : {16.0, 8.0, 3.0, 1.0}) {
    double damping = kFirstDamping;
    for (int round = 0; round < 20; ++round) {
      const OwnEquations own = equations_at(now, scale, Pieces::kFitted);
      const Eigen::Vector3d pivot = pivots[view];
      bool better = false;
      double size = 0;
      for (int attempt = 0; attempt < 6 && !better; ++attempt, damping *= 5) {
        Eigen::Matrix<double, 6, 6> held = own.curvature;
        held.diagonal() +=
            damping * own.curvature.diagonal() + Vector6::Constant(1e-9 * own.curvature.diagonal().maxCoeff());
        const Vector6 step = -held.ldlt().solve(own.slope);
        std::vector<MovingCamera> next = now;
        next[view].move(step, pivot);
        better = equations_at(next, scale, Pieces::kFitted).loss < own.loss;
        size = step.norm() * now[view].focal();
        if (better) now = std::move(next);
      }
      damping = std::max(damping / 25, 1e-6);
      if (!better || size < kStill) break;
    }
  }
  const double given = equations_at(cameras, 3, Pieces::kHeldOut).loss;
  const bool earned = equations_at(now, 3, Pieces::kHeldOut).loss < (1 - kLeastFall) * given;
  return earned ? now[view] : cameras[view];
}

}  // namespace nef::visual_hull::refine
