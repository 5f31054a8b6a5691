// SPDX-License-Identifier: Apache-2.0
//
// Outlines -> residual of the given cameras -> models, from few parameters to many, each fitted to half of the pieces
// of the outlines and judged by the other half -> the chosen one fitted to all -> space moved back so that the cameras
// stand as near to the given ones as a similarity allows -> matrices of doubles.
#include "apps/visual_hull/refine/refine.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/visual_hull/refine/find_turntable.h"
#include "apps/visual_hull/scene/pose.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull::refine {
namespace {

constexpr double kLeastGain = 0.05;  // pixels of the mean residual of held-out pieces
constexpr double kLeastShare = 0.2;  // of it
constexpr double kAxisAngle = 0.04;  // radians, and share of the distance: what is a turntable
constexpr double kBad = 3;           // pixels: no noise of an outline
constexpr std::size_t kFewestViews = 3;

// Samples of a view: few views need more.
std::size_t samples_of(std::size_t views) {
  constexpr std::size_t kAll = 4320;
  return std::clamp<std::size_t>(kAll / views, 120, 240);
}

// So many views at most are thought to be wrong; the others are right.
std::size_t most_faults(std::size_t views) { return std::max<std::size_t>(1, views / 6); }

using Cameras = std::vector<MovingCamera>;
using Values = std::vector<std::vector<Coherence>>;
using Used = std::vector<std::uint8_t>;

/// The task: what does not change.
struct Task {
  std::vector<Outline> outlines;
  Cameras given;
  std::optional<double> camera_error;  // pixels that those are known to be off by
  const nef::Monitor& monitor;

  // What fits of any kind know of cameras.
  [[nodiscard]] FitOptions options(const Used& used) const {
    FitOptions options;
    options.used = used;
    if (camera_error) {
      options.known = given;
      options.known_to = *camera_error;
    }
    return options;
  }

  [[nodiscard]] Values values(const Cameras& cameras, const Used& used) const {
    Values result;
    measure(cameras, outlines, object_ball(cameras, outlines), {used}, result, monitor);
    return result;
  }
  [[nodiscard]] ResidualSummary residual(const Cameras& cameras, const Used& used, Pieces pieces) const {
    return summary(outlines, values(cameras, used), used, pieces);
  }
};

/// Cameras and how they were found.
struct Chosen {
  Model model = Model::kNone;
  Cameras cameras;
  ResidualSummary held_out;
};

std::vector<double> scales_for(const ResidualSummary& residual) {
  if (residual.ninth_decile > 3) return {8, 3, 1};
  if (residual.ninth_decile > 1) return {3, 1};
  return {1};
}

Cameras fitted(const Task& task, const Cameras& start, const Used& used, Model model, Pieces pieces,
               const std::optional<Axis>& axis, const ResidualSummary& residual) {
  FitOptions options = task.options(used);
  options.model = model;
  options.axis = axis;
  options.pieces = pieces;
  options.scales = scales_for(residual);
  return fit(start, task.outlines, options, task.monitor);
}

// Cameras as they might as well have been given: each moved by about two pixels, as far as the model allows.
Cameras shaken(const Cameras& cameras, Model model, const std::optional<Axis>& axis, const Ball& ball) {
  constexpr double kPixels = 2;
  constexpr double kZoom = 0.02;
  Cameras result = cameras;
  const Parameters parameters(model, cameras, ball.centre, axis);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(parameters.count());
  for (Eigen::Index k = 0; k + 1 < step.size(); ++k) {
    // Turns of so many pixels at the border of the object; signs that follow no pattern.
    const double turn = kPixels / cameras[0].focal() * parameters.pivots()[0].z() / ball.radius;
    step[k] = k % 6 < 3 ? turn * std::sin(1.0 + 2.4 * static_cast<double>(k)) : 0;
  }
  step[step.size() - 1] = kZoom;
  parameters.apply(step, result);
  return result;
}

Cameras only_used(const Cameras& cameras, const Used& used) {
  Cameras result;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (used[i] != 0) result.push_back(cameras[i]);
  }
  return result;
}

// Cameras that have six parameters each may be those of a turntable nevertheless, which few parameters say better:
// tried where they are nearly that, and kept if outlines that were not used do not object.
void prefer_turntable(const Task& task, const Used& used, Chosen& chosen) {
  constexpr double kWorse = 1.1;  // times the residual of held-out pieces
  constexpr double kMuch = 0.01;  // pixels more than that
  const std::optional<Axis> axis = turntable_axis(only_used(chosen.cameras, used), kAxisAngle, kAxisAngle);
  if (!axis) return;
  for (const Model model : {Model::kTurntable, Model::kAngles}) {
    const auto structured = as_turntable(chosen.cameras, *axis, model == Model::kTurntable);
    if (!structured) continue;
    const ResidualSummary start = task.residual(*structured, used, Pieces::kFitted);
    const Cameras next = fitted(task, *structured, used, model, Pieces::kFitted, axis, start);
    const ResidualSummary held_out = task.residual(next, used, Pieces::kHeldOut);
    if (held_out.mean > kWorse * chosen.held_out.mean + kMuch) continue;
    chosen = {model, next, held_out};
    return;
  }
}

// The models in their order; the cameras of the last one that earns its parameters, fitted to all pieces.
Chosen choose(const Task& task, const Used& used) {
  Chosen chosen;
  chosen.cameras = task.given;
  chosen.held_out = task.residual(task.given, used, Pieces::kHeldOut);
  std::optional<Axis> axis = turntable_axis(only_used(task.given, used), kAxisAngle, kAxisAngle);
  std::vector<Model> models{Model::kViews};
  if (axis) models = {Model::kTurntable, Model::kAngles, Model::kViews};
  for (const Model model : models) {
    const Cameras next = fitted(task, chosen.cameras, used, model, Pieces::kFitted, axis, chosen.held_out);
    const ResidualSummary held_out = task.residual(next, used, Pieces::kHeldOut);
    const double gain = chosen.held_out.mean - held_out.mean;
    if (gain < kLeastGain || gain < kLeastShare * chosen.held_out.mean) continue;
    chosen = {model, next, held_out};
  }
  if (chosen.model == Model::kNone) return chosen;
  if (chosen.model == Model::kViews) prefer_turntable(task, used, chosen);
  if (chosen.model != Model::kViews) {
    axis = turntable_axis(only_used(chosen.cameras, used), kAxisAngle, kAxisAngle);
    if (!axis) return chosen;
  }
  chosen.cameras = fitted(task, chosen.cameras, used, chosen.model, Pieces::kAll, axis, chosen.held_out);
  return chosen;
}

/// Samples that are off by more than noise, and the view that has to do with most of them.
struct Bad {
  std::size_t count = 0;
  std::size_t view = 0;
  std::size_t of_view = 0;
};

Bad bad_samples(const Values& values, const Used& used) {
  Bad bad;
  std::vector<std::size_t> by_view(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (used[i] == 0) continue;
    for (const Coherence& c : values[i]) {
      if (c.value > -kBad) continue;
      ++bad.count;
      ++by_view[i];
      for (const std::uint32_t j : c.killer) {
        if (j != Coherence::kNone) ++by_view[j];
      }
    }
  }
  const auto most = std::max_element(by_view.begin(), by_view.end());
  bad.view = static_cast<std::size_t>(most - by_view.begin());
  bad.of_view = *most;
  return bad;
}

/// A sample of a view.
using SampleOf = std::array<std::size_t, 2>;

// The samples of held-out pieces that a view has to do with: its own, and those of others that it holds down below 0.
std::vector<SampleOf> held_out_with(const Task& task, const Values& values, const Used& used, std::size_t view) {
  std::vector<SampleOf> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (used[i] == 0) continue;
    for (std::size_t k = 0; k < values[i].size(); ++k) {
      if (!task.outlines[i].samples[k].held_out) continue;
      const Coherence& c = values[i][k];
      const bool holds_down = c.value < 0 && (c.killer[0] == view || c.killer[1] == view);
      if (i == view || holds_down) result.push_back({i, k});
    }
  }
  return result;
}

// What samples miss together, in pixels.
double missed_by(const std::vector<SampleOf>& samples, const Values& values) {
  double sum = 0;
  for (const auto& [i, k] : samples) sum += std::max(0.0, -values[i][k].value);
  return sum;
}

// One camera of many that stands off is lost in the mean over all outlines: the view that has to do with most of what
// is missed moves alone, if the held-out samples that it has to do with are better explained then, by as much as is
// asked of all otherwise, and those of all together are, too.
bool move_one(const Task& task, const Used& used, Chosen& chosen) {
  const Values before = task.values(chosen.cameras, used);
  std::size_t worst = 0;
  std::vector<SampleOf> samples;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    std::vector<SampleOf> of_view = held_out_with(task, before, used, i);
    if (missed_by(of_view, before) <= missed_by(samples, before)) continue;
    worst = i;
    samples = std::move(of_view);
  }
  if (samples.empty()) return false;
  const auto count = static_cast<double>(samples.size());
  const double most = missed_by(samples, before) / count;
  if (most < kLeastGain) return false;
  FitOptions options = task.options(used);
  options.free.assign(used.size(), 0);
  options.free[worst] = 1;
  options.pieces = Pieces::kFitted;
  const Cameras judged = fit(chosen.cameras, task.outlines, options, task.monitor);
  const double gain = most - missed_by(samples, task.values(judged, used)) / count;
  if (gain < kLeastGain || gain < kLeastShare * most) return false;
  const ResidualSummary held_out = task.residual(judged, used, Pieces::kHeldOut);
  if (held_out.mean >= chosen.held_out.mean) return false;
  options.pieces = Pieces::kAll;
  chosen.cameras = fit(judged, task.outlines, options, task.monitor);
  chosen.held_out = held_out;
  chosen.model = Model::kViews;
  return true;
}

/// A view that disagrees with the others is left out, and they are fitted again without it, from the start.
struct Agreed {
  Chosen chosen;
  Used used;
  std::vector<std::size_t> out;
};

Agreed agree(const Task& task) {
  const std::size_t n = task.given.size();
  Agreed agreed;
  agreed.used.assign(n, 1);
  agreed.chosen = choose(task, agreed.used);
  const std::size_t most = most_faults(n);
  while (agreed.out.size() < most && n - agreed.out.size() > kFewestViews + 2) {
    const Bad bad = bad_samples(task.values(agreed.chosen.cameras, agreed.used), agreed.used);
    const std::size_t samples = samples_of(n) * (n - agreed.out.size());
    if (bad.count < std::max<std::size_t>(6, samples / 200) || 2 * bad.of_view < bad.count) break;
    Used without = agreed.used;
    without[bad.view] = 0;
    Chosen next = choose(task, without);
    const Bad rest = bad_samples(task.values(next.cameras, without), without);
    if (4 * rest.count > bad.count) break;
    agreed.chosen = std::move(next);
    agreed.used = std::move(without);
    agreed.out.push_back(bad.view);
  }
  return agreed;
}

std::vector<Eigen::Vector3d> points_of(const Task& task) {
  const Ball ball = object_ball(task.given, task.outlines);
  return ball_points(ball.centre, ball.radius / 1.3);
}

// Space moved so that the cameras stand where they were given; those that moved most do not count.
void align(const Task& task, const Used& used, const std::vector<Eigen::Vector3d>& points, Cameras& cameras) {
  Used counted = used;
  for (int round = 0; round < 3; ++round) {
    Cameras moving = only_used(cameras, counted);
    const Cameras fixed = only_used(task.given, counted);
    // The similarity is found for those that count and applied to all: as that of one more camera's frame.
    const Similarity s = similarity(moving, fixed, points);
    for (MovingCamera& camera : cameras) camera.move_space(s.scale, s.rotation, s.shift);
    std::vector<double> moved;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (used[i] != 0) moved.push_back(image_distance(cameras[i], task.given[i], points));
    }
    std::nth_element(moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2), moved.end());
    const double median = moved[moved.size() / 2];
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      counted[i] = used[i] != 0 && image_distance(cameras[i], task.given[i], points) <= 2 * median ? 1 : 0;
    }
  }
}

Camera exact_camera(const std::string& name, const MovingCamera& camera) {
  return make_view(name, camera.matrix()).camera;
}

double mean_of_view(const Values& values, std::size_t view) {
  if (values[view].empty()) return 0;
  double sum = 0;
  for (const Coherence& c : values[view]) sum += std::max(0.0, -c.value);
  return sum / static_cast<double>(values[view].size());
}

double turned_between(const MovingCamera& a, const MovingCamera& b) {
  const double c = ((a.rotation().transpose() * b.rotation()).trace() - 1) / 2;
  return std::acos(std::clamp(c, -1.0, 1.0)) * 180 / M_PI;
}

// Which cameras moved unlike the others.
void name_moved(std::vector<RefinedView>& views) {
  std::vector<double> moved;
  for (const RefinedView& view : views) moved.push_back(view.moved_px);
  std::nth_element(moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2), moved.end());
  const double median = moved[moved.size() / 2];
  for (RefinedView& view : views) {
    if (view.fault == Fault::kNone && view.moved_px > 0.5 + 3 * median) view.fault = Fault::kCamera;
  }
}

// Whether a view's outline fits where it was placed: few of its samples are off by more than noise, either way.
bool fits(const Task& task, const Cameras& cameras, const Used& used, std::size_t view) {
  Used all = used;
  all[view] = 1;
  const Values values = task.values(cameras, all);
  std::size_t bad = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const Coherence& c : values[i]) {
      ++count;
      const bool has_part = i == view || c.killer[0] == view || c.killer[1] == view;
      if (c.value < -kBad && has_part) ++bad;
    }
  }
  return bad < std::max<std::size_t>(4, count / 400);
}

// What the outlines leave open of cameras that were refined, in words: where cameras that start a little elsewhere do
// not come back, the outlines allow both.
std::vector<std::string> open_motions(const Task& task, const Chosen& chosen, const Used& used,
                                      const std::vector<GivenView>& views, const std::vector<Eigen::Vector3d>& points) {
  constexpr double kApart = 0.5;     // pixels
  constexpr std::size_t kNamed = 3;  // views that are named one by one
  constexpr double kZoomed = 0.005;  // of the focal length
  const Model model = chosen.model;
  if (model == Model::kNone) return {};
  std::optional<Axis> axis;
  if (model != Model::kViews) axis = turntable_axis(only_used(chosen.cameras, used), kAxisAngle, kAxisAngle);
  if (model != Model::kViews && !axis) return {};
  const Ball ball = object_ball(chosen.cameras, task.outlines);
  const Cameras start = shaken(chosen.cameras, model, axis, ball);
  Cameras other = fitted(task, start, used, model, Pieces::kFitted, axis, task.residual(start, used, Pieces::kFitted));
  const Similarity s = similarity(only_used(other, used), only_used(chosen.cameras, used), points);
  std::vector<std::string> moved;
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (used[i] == 0) continue;
    other[i].move_space(s.scale, s.rotation, s.shift);
    if (image_distance(other[i], chosen.cameras[i], points) > kApart) moved.push_back(views[i].name);
  }
  std::vector<std::string> words;
  if (std::abs(std::log(other[0].focal() / chosen.cameras[0].focal())) > kZoomed) words.emplace_back("focal length");
  if (moved.size() > kNamed) {
    words.push_back("poses of " + std::to_string(moved.size()) + " views");
  } else {
    for (const std::string& name : moved) words.push_back("pose of view " + name);
  }
  return words;
}

}  // namespace

const char* model_name(Model model) {
  static constexpr std::array<const char*, 4> kNames{"none", "turntable", "angles", "views"};
  return kNames[static_cast<std::size_t>(model)];
}

Refinement refine_cameras(const std::vector<GivenView>& views, const RefineOptions& options,
                          const nef::Monitor& monitor) {
  if (views.size() < kFewestViews) throw nef::InputError("--refine: three views at least are needed");
  Task task{{}, {}, options.turntable ? std::nullopt : options.camera_error, monitor};
  task.outlines.resize(views.size());
  nef::parallel_for(views.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const GivenView& view = views[i];
    task.outlines[i] =
        make_outline(*view.silhouette, view.frame, view.distortion, options.origin, samples_of(views.size()));
  });
  if (options.turntable) {
    task.given = find_turntable(task.outlines, *options.turntable, options.origin, monitor);
  } else {
    for (const GivenView& view : views) task.given.emplace_back(view.camera);
  }
  Agreed agreed = agree(task);
  const Used all(views.size(), 1);
  const std::vector<Eigen::Vector3d> points = points_of(task);
  Cameras& cameras = agreed.chosen.cameras;
  Refinement result;
  result.model = agreed.chosen.model;
  if (result.model == Model::kNone) {
    for (std::size_t moved = 0; moved < most_faults(views.size()) && move_one(task, agreed.used, agreed.chosen);)
      ++moved;
    result.model = agreed.chosen.model;
  }
  if (result.model != Model::kNone) align(task, agreed.used, points, cameras);
  result.undetermined = open_motions(task, agreed.chosen, agreed.used, views, points);
  for (const std::size_t i : agreed.out) {
    const MovingCamera placed = resect(cameras, task.outlines, agreed.used, i, monitor);
    if (image_distance(placed, cameras[i], points) > 0) result.model = Model::kViews;
    cameras[i] = placed;
  }
  result.found = options.turntable.has_value();
  result.accepted = result.found || result.model != Model::kNone;
  result.focal = cameras[0].focal();
  if (result.model == Model::kNone && result.found) result.model = Model::kTurntable;
  const Values before = task.values(task.given, all);
  result.before = summary(task.outlines, before, all, Pieces::kAll);
  result.held_out_before = summary(task.outlines, before, agreed.used, Pieces::kHeldOut);
  const Values after = task.values(cameras, all);
  result.after = summary(task.outlines, after, all, Pieces::kAll);
  result.held_out_after =
      agreed.out.empty() ? agreed.chosen.held_out : summary(task.outlines, after, agreed.used, Pieces::kHeldOut);
  result.focal_factor = cameras[0].focal() / task.given[0].focal();
  for (std::size_t i = 0; i < views.size(); ++i) {
    RefinedView view;
    view.name = views[i].name;
    view.camera = result.accepted ? exact_camera(views[i].name, cameras[i]) : views[i].camera;
    view.moved_px = image_distance(cameras[i], task.given[i], points);
    view.turned_degrees = turned_between(cameras[i], task.given[i]);
    view.residual_before = mean_of_view(before, i);
    view.residual_after = mean_of_view(after, i);
    result.views.push_back(std::move(view));
  }
  for (const std::size_t i : agreed.out) {
    result.views[i].fault = fits(task, cameras, agreed.used, i) ? Fault::kCamera : Fault::kMask;
  }
  if (result.accepted) name_moved(result.views);
  return result;
}

}  // namespace nef::visual_hull::refine
