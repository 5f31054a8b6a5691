// SPDX-License-Identifier: Apache-2.0
//
// How well outlines agree: what of each one no point of its line of sight explains.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/visual_hull/refine/moving_camera.h"
#include "apps/visual_hull/refine/outline.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull::refine {

/// Where the object is: rays are searched in a ball.
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 1;
};

/// The ball that the outlines suggest: the point nearest to the lines of sight through their middles, and the radius
/// that most outlines show around it.
Ball object_ball(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines);

/// One sample of view i: value = max over the points of its line of sight of the least distance to the outlines of the
/// other views there, in pixels, positive inside. Coherent outlines have none below 0. At the best point one or two
/// views hold it down; their weights are such that the derivative along the line of sight vanishes.
struct Coherence {
  double value = 0;
  double depth = 0;                                   ///< of the best point, in the frame of view i
  std::array<std::uint32_t, 2> killer{kNone, kNone};  ///< the views that hold it down
  std::array<double, 2> weight{1, 0};

  static constexpr std::uint32_t kNone = 0xffffffff;
};

/// Which pieces of outlines.
enum class Pieces : std::uint8_t { kAll, kFitted, kHeldOut };

/// How much is searched.
enum class Search : std::uint8_t {
  kNear,  ///< from the depth that is known, if one is: may miss a better one elsewhere on the ray
  kFull,  ///< all depths, but for rays that are explained (0 or more)
  kDeep,  ///< all depths of all rays: values above 0 are the best ones, too
};

/// What is measured.
struct Measure {
  std::vector<std::uint8_t> used;  ///< views that count, as samples and against the others
  Pieces pieces = Pieces::kAll;    ///< others are left as they are
  Search search = Search::kFull;
  std::optional<std::size_t> only = {};  ///< the samples of this view, others are left as they are
};

/// The coherence of all samples of all views: result[i][k] belongs to outlines[i].samples[k]. `result` is what an
/// earlier call gave for similar cameras, or empty: its depths are tried first. O(samples * views * depths) at worst.
void measure(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines, const Ball& ball,
             const Measure& what, std::vector<std::vector<Coherence>>& result, const nef::Monitor& monitor);

/// The derivative of a value by the motions of up to three views (MovingCamera::move about `pivots`) and the logarithm
/// of the common focal length.
struct CoherenceRow {
  std::array<std::uint32_t, 3> view{};  ///< that of the sample, then those that hold it down
  std::array<Vector6, 3> by_motion;
  std::size_t count = 0;  ///< how many of them
  double by_zoom = 0;
};
CoherenceRow derivative(const std::vector<MovingCamera>& cameras, const std::vector<Outline>& outlines,
                        const std::vector<Eigen::Vector3d>& pivots, std::size_t view, std::size_t sample,
                        const Coherence& value);

/// Whether a sample belongs to pieces.
inline bool belongs(const OutlineSample& sample, Pieces pieces) {
  return pieces == Pieces::kAll || (pieces == Pieces::kHeldOut) == sample.held_out;
}

/// Mean and ninth decile of what is not explained, in pixels.
struct ResidualSummary {
  double mean = 0;
  double ninth_decile = 0;
  std::size_t count = 0;
};
ResidualSummary summary(const std::vector<Outline>& outlines, const std::vector<std::vector<Coherence>>& values,
                        const std::vector<std::uint8_t>& used, Pieces pieces);

}  // namespace nef::visual_hull::refine
