// SPDX-License-Identifier: Apache-2.0
//
// Cameras whose outlines agree best: least squares of what outlines do not explain, with a robust loss.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "apps/visual_hull/refine/coherence.h"
#include "apps/visual_hull/refine/turntable_axis.h"

namespace nef::visual_hull::refine {

/// What may move, from few parameters to many.
enum class Model : std::uint8_t {
  kNone,
  kTurntable,  ///< one camera before a turntable: two angles of the axis, its offset, the focal length
  kAngles,     ///< and the angle of each view
  kViews,      ///< six a view, and the focal length
};

/// How a model's parameters move the cameras as they stand: motion of view i (MovingCamera::move about pivots[i]) =
/// sum of parameter * column. The last parameter is the logarithm of the common focal length.
class Parameters {
 public:
  /// `axis`: of the turntable, for the first two models. `free`: as in FitOptions.
  Parameters(Model model, const std::vector<MovingCamera>& cameras, const Eigen::Vector3d& centre,
             const std::optional<Axis>& axis, const std::vector<std::uint8_t>& free = {});

  using Column = std::pair<int, Vector6>;

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool zooms() const { return zoom_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& pivots() const { return pivots_; }
  [[nodiscard]] const std::vector<Column>& columns(std::size_t view) const { return columns_[view]; }
  /// Moves cameras by a vector of parameters.
  void apply(const Eigen::VectorXd& step, std::vector<MovingCamera>& cameras) const;

 private:
  Model model_;
  std::optional<Axis> axis_;
  bool zoom_;
  int count_ = 0;
  std::vector<Eigen::Vector3d> pivots_;
  std::vector<int> first_;  // of the parameters of a view
  std::vector<std::vector<Column>> columns_;
};

struct FitOptions {
  Model model = Model::kViews;
  std::optional<Axis> axis;
  Pieces pieces = Pieces::kAll;
  std::vector<std::uint8_t> used;  ///< views that take part; others move with the model only
  std::vector<std::uint8_t> free =
      {};  ///< views that move, of the model of six a view; none: all, and the focal length
  /// Where cameras are known to stand, as far as `known_to` says; empty: nothing is known.
  std::vector<MovingCamera> known = {};
  double known_to = 0;                  ///< pixels that the images of the known cameras are off by
  std::vector<double> scales{8, 3, 1};  ///< of the loss, in pixels, one after the other
  int rounds = 25;                      ///< steps at most, at each scale
};

/// Levenberg and Marquardt's method on the residuals min(0, coherence) with the loss of [Geman, McClure 1987]. Motions
/// are held by a weak prior (a 300th of a pixel for each pixel that a view moves at a scale), so that what outlines
/// do not determine stays; where it is known how far cameras are off, by what that says against the noise of outlines.
/// The position, orientation and size of the scene are free (moving_camera.h: similarity). O(rounds) times `measure`.
std::vector<MovingCamera> fit(const std::vector<MovingCamera>& start, const std::vector<Outline>& outlines,
                              const FitOptions& options, const nef::Monitor& monitor);

/// The camera of one view alone, by the lines of sight through its own outline: those that pass through the space that
/// the others leave count, too, a tenth of those that miss it, so that what a mask has lost is an outlier and not a
/// pull. The others (`used`) stay. Six parameters; fitted to half of the pieces, and the camera stays as it is unless
/// the loss of the others falls by a fifth.
MovingCamera resect(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
                    const std::vector<std::uint8_t>& used, std::size_t view, const nef::Monitor& monitor);

}  // namespace nef::visual_hull::refine
