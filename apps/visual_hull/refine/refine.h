// SPDX-License-Identifier: Apache-2.0
//
// Cameras from silhouettes: those given, corrected so that the outlines of all views agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/refine/coherence.h"
#include "apps/visual_hull/refine/fit.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull::refine {

/// A view as it is given.
struct GivenView {
  std::string name;
  Camera camera;
  const Silhouette* silhouette = nullptr;  ///< along the sides of pixels, not simplified
  ImageSize frame;                         ///< of the image whose frame cuts the silhouette; {} if none does
  Distortion distortion;                   ///< that was undone
};

/// What is wrong with a view, as far as the others tell.
enum class Fault : std::uint8_t {
  kNone,
  kCamera,  ///< its camera stood elsewhere than the others say, and was moved
  kMask,    ///< its silhouette disagrees with the others wherever its camera stands
};

/// What has become of a view.
struct RefinedView {
  std::string name;
  Camera camera;              ///< as written down: its numbers are doubles
  double moved_px = 0;        ///< root mean square motion of the object's image, after the best similarity of space
  double turned_degrees = 0;  ///< of the object in the frame of the camera
  double residual_before = 0, residual_after = 0;  ///< mean over its outline, in pixels
  Fault fault = Fault::kNone;
};

/// The outcome. Pixels are those of the images (of polygons without images: units of their coordinates).
struct Refinement {
  bool accepted = false;  ///< cameras have changed
  bool found = false;     ///< they were those of an unknown turntable
  double focal = 0;       ///< of the first view, in pixels
  Model model = Model::kNone;
  ResidualSummary before, after;                    ///< over all outlines
  ResidualSummary held_out_before, held_out_after;  ///< over pieces of outlines that the fit did not use
  double focal_factor = 1;                          ///< refined over given focal length
  std::vector<std::string> undetermined;            ///< what the outlines do not determine, if cameras have changed
  std::vector<RefinedView> views;
};

/// A word for a model: "none", "turntable", "angles", "views".
const char* model_name(Model model);

/// What refinement starts from.
struct RefineOptions {
  PixelOrigin origin = PixelOrigin::kCenter;
  /// Size of the images of a turntable of which nothing is known but that its steps are equal: its cameras are found
  /// first (find_turntable.h) instead of taking those of the views.
  std::optional<ImageSize> turntable = {};
  /// Root mean square of what the given cameras are off by in their images of the object, in pixels, where that is
  /// known: as far as outlines do not say more, cameras stay there. Above zero.
  std::optional<double> camera_error = {};
};

/// Refines cameras. The smallest model is taken that explains pieces of outlines that it has not seen better than what
/// there was, by a fifth and a twentieth of a pixel at least; otherwise the cameras stay as they are, to the last
/// digit. A view that stays at odds with all others is left out of the fit, named, and placed by its own lines of
/// sight. The result does not depend on the number of threads. Throws InputError for less than three views. About
/// 100 evaluations of `measure`.
Refinement refine_cameras(const std::vector<GivenView>& views, const RefineOptions& options,
                          const nef::Monitor& monitor);

}  // namespace nef::visual_hull::refine
