// SPDX-License-Identifier: Apache-2.0
//
// The library: from a scene to its exact visual hull [Laurentini 1994].
//
//   nef::visual_hull::Scene scene = nef::visual_hull::read_scene("scene.json");
//   nef::visual_hull::Options options;
//   options.silhouette.simplify.tolerance = 1;
//   const std::filesystem::path folder = nef::visual_hull::scene_folder("scene.json");
//   nef::visual_hull::Result result = nef::visual_hull::compute(scene, folder, options);
//   nef::write_polyhedron("hull.off", result.hull);  // nef/io/polyhedron_file.h
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/mask_repair/repair_masks.h"
#include "apps/visual_hull/masks/mask_method.h"
#include "apps/visual_hull/refine/refine.h"
#include "apps/visual_hull/scene/images.h"
#include "apps/visual_hull/silhouette/silhouette.h"
#include "apps/visual_hull/verify/consistency.h"
#include "apps/visual_hull/verify/verify.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/geometry/predicates.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {

/// The steps of the work, in their order.
enum class Phase : std::uint8_t { kLoad, kContours, kRefine, kBox, kSuspects, kCones, kIntersection, kVerify, kWrite };
inline constexpr std::size_t kPhaseCount = 9;
const char* phase_name(Phase phase);

/// Time and answers of predicates in one phase.
struct PhaseReport {
  double seconds = 0;      ///< on the wall
  double cpu_seconds = 0;  ///< of all threads of the process
  nef::PredicateCounts predicates;
};
using PhaseReports = std::array<PhaseReport, kPhaseCount>;

/// How the hull is found; the answer is the same set.
enum class Way : std::uint8_t {
  kBest,    ///< vertex by vertex where that is possible and worth it
  kDirect,  ///< vertex by vertex, or not at all
  kCones,   ///< by intersecting cones
};

struct Options {
  SilhouetteOptions silhouette;                 ///< but for `origin`, which is the scene's
  std::optional<MaskMethod> mask;               ///< the images are photographs: masks are made of them, no threshold
  bool repair_masks = false;                    ///< of photographs: decide again what the other views contradict
  std::optional<PixelOrigin> origin;            ///< instead of the scene's
  std::optional<WorldBox> box;                  ///< instead of the scene's
  std::optional<std::filesystem::path> images;  ///< a folder: the i-th image is the i-th view's
  Way way = Way::kBest;
  bool refine = false;                  ///< correct the cameras by the silhouettes first: Result::refinement
  bool suspects = false;                ///< compare the views: Result::consistency
  bool drop_suspects = false;           ///< leave out the guilty view, compare again, and so on; three views stay
  std::optional<std::size_t> at_least;  ///< the points in at least so many silhouettes, instead of in all
  bool largest = false;                 ///< keep the piece of the largest volume only: Result::pieces
  bool verify = false;
  /// Cancellation, progress, counters; its referents must outlive compute. It is told the steps: the name of the phase
  /// and of the view at work, "contours left.png", how many are done, and how many there are.
  nef::Monitor monitor = {};
};

/// What one view has come to.
struct ViewResult {
  std::string name;
  Camera camera;
  std::filesystem::path image;            ///< empty for polygons
  Distortion distortion;                  ///< of the image
  std::optional<MaskChange> mask_change;  ///< if masks were repaired
  ViewSilhouette silhouette;
  std::optional<std::size_t> cone_facets;  ///< where the cone was built
  std::optional<Verification> verification;
};

/// A hull that has nothing inside: a view at which that happened.
struct Vanished {
  std::string view;
  std::string reason;
  /// Of an empty hull: smallest sets of views that have no point in common, by name.
  std::vector<std::vector<std::string>> sets;
};

/// A view that was left out because it disagrees with the others.
struct Dropped {
  std::string view;
  ViewConsistency measures;
  double share = 0;  ///< of the inconsistency that went with it
};

struct Result {
  nef::Polyhedron hull;  ///< the intersection of all that the views keep, closed; within the box
  std::vector<ViewResult> views;
  WorldBox box;
  PixelOrigin origin = PixelOrigin::kCenter;  ///< of the images
  bool box_found = false;                     ///< the box comes from the cones
  /// Volumes of the pieces (connected components) of the hull, the largest first, if there are several; of those that
  /// Options::largest has left out, too.
  std::vector<double> pieces;
  std::optional<WorldBox> enclosing;  ///< holds the intersection of all cones in its interior; not always looked for
  std::optional<refine::Refinement> refinement;  ///< what became of the cameras, if they were refined
  bool direct = false;                           ///< the hull was found vertex by vertex
  std::optional<Consistency> consistency;        ///< of `views`, if they were compared
  std::vector<Dropped> dropped;                  ///< views that were left out
  std::optional<Vanished> vanished;              ///< set if the hull has no interior
  nef::Messages notes;  ///< what a user may want to know about how images were paired with views and masks were made
  PhaseReports phases;
};

/// Computes the hull. `folder` is where the scene's images are looked up. Throws InputError naming
/// the view whose image is missing or unreadable, or whose silhouette is empty, and if there
/// is no box and the cones do not bound the scene, or if the direct way is asked for and cannot be gone.
Result compute(const Scene& scene, const std::filesystem::path& folder, const Options& options);

/// The views with their silhouettes alone: `views`, `origin` and `notes` of the result of compute. Of the options,
/// those of silhouettes and images count. Throws InputError as compute does for images.
Result silhouettes_of(const Scene& scene, const std::filesystem::path& folder, const Options& options);

/// Runs `work` and adds its time, and the predicates that it counts with what it is given, to a phase.
void timed(PhaseReports& reports, Phase phase, const nef::Monitor& monitor,
           const std::function<void(const nef::Monitor&)>& work);

}  // namespace nef::visual_hull
