// SPDX-License-Identifier: Apache-2.0
//
// Where a second series of views of one object, which was turned over in between, stands in the space of the first.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "apps/visual_hull/refine/coherence.h"
#include "apps/visual_hull/refine/moving_camera.h"
#include "apps/visual_hull/refine/outline.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull {

/// Views of an object that does not move relative to the space of their cameras.
struct OutlineSeries {
  std::vector<refine::MovingCamera> cameras;
  std::vector<refine::Outline> outlines;  ///< of each camera
};

/// The place of a series. Pixels are means over all outlines.
struct Placement {
  /// X = scale * rotation * X' + shift: where a point X' of the first series' space is in that of the second.
  refine::Similarity map;
  bool scaled = false;       ///< the two have different units of length; else map.scale is 1
  double alone_px = 0;       ///< by how much outlines are off within their own series
  double together_px = 0;    ///< among both
  double held_out_px = 0;    ///< the same of pieces that the fit did not use
  double runner_up_px = 0;   ///< of the next best place, turned by 15 degrees at least, as the search left it
  double best_found_px = 0;  ///< of the best place, as the search left it
  double extent_px = 0;      ///< the median of the silhouettes' larger sides

  [[nodiscard]] refine::Similarity to_first() const;  ///< the inverse of map
  [[nodiscard]] bool fits() const;       ///< together is hardly worse than alone, for the size of the silhouettes
  [[nodiscard]] bool ambiguous() const;  ///< the next best place is hardly worse than the best
};

/// The motion of the second series after which the outlines of both agree best. Unit lengths are taken to be the same
/// unless other ones explain pieces of outlines that were not used better, by a fifth and a twentieth of a pixel at
/// least. Thousands of rotations, and those that map principal axes of the one hull to those of the other, are judged
/// by how much the hulls overlap; the best few are fitted by the coherence of outlines (refine/coherence.h), and the
/// best of these with all views. Throws InputError if the silhouettes of a series have no point in common. About 300
/// evaluations of refine::measure with ten views of each series, 40 with all of them.
Placement place_series(OutlineSeries first, OutlineSeries second, const nef::Monitor& monitor);

/// The camera of the second series as it sees the space of the first.
refine::MovingCamera placed_camera(refine::MovingCamera camera, const Placement& placement);

}  // namespace nef::visual_hull
