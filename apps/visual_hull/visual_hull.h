// SPDX-License-Identifier: Apache-2.0
//
// The library: from a scene to its exact visual hull.
//
//   visual_hull::Scene scene = visual_hull::read_scene("scene.json");
//   visual_hull::Options options;
//   options.silhouette.simplify.tolerance = 1;
//   visual_hull::Result result = visual_hull::compute(scene, options);
//   nef::write_polyhedron(result.hull, "hull.off");
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/hull.h"
#include "apps/visual_hull/silhouette.h"
#include "apps/visual_hull/verify.h"
#include "nef/geometry/predicates.h"

namespace visual_hull {

/// The steps of the work, in their order.
enum class Phase : std::uint8_t { kLoad, kContours, kCones, kIntersection, kVerify, kWrite };
inline constexpr std::size_t kPhaseCount = 6;
const char* phase_name(Phase phase);

/// Time and answers of predicates in one phase.
struct PhaseReport {
  double seconds = 0;
  nef::PredicateCounts predicates;
};
using PhaseReports = std::array<PhaseReport, kPhaseCount>;

/// Told at every step: the phase, the view or step at work, how many are done and how many there are. Called by one
/// thread at a time, not always the same.
using Progress = std::function<void(Phase, const std::string&, std::size_t, std::size_t)>;

struct Options {
  SilhouetteOptions silhouette;
  std::optional<WorldBox> box;                  ///< instead of the scene's
  std::optional<std::filesystem::path> images;  ///< a folder: the i-th image is the i-th view's
  bool verify = false;
  bool direct = true;    ///< vertex by vertex where that is possible; false: always by intersecting cones
  unsigned threads = 1;  ///< 0: as many as the machine has; the result is the same
};

/// What one view has come to.
struct ViewResult {
  std::string name;
  Camera camera;
  std::filesystem::path image;  ///< empty for polygons
  Distortion distortion;        ///< of the image
  ViewSilhouette silhouette;
  std::size_t cone_facets = 0;
  std::optional<Verification> verification;
};

/// A hull that has nothing inside: the view at which that happened.
struct Vanished {
  std::string view;
  std::string reason;
};

struct Result {
  nef::Polyhedron hull;  ///< the intersection of all that the views keep, closed; within the box
  std::vector<ViewResult> views;
  WorldBox box;
  bool box_found = false;             ///< the box comes from the cones
  std::optional<WorldBox> enclosing;  ///< holds the intersection of all cones in its interior; not always looked for
  bool direct = false;                ///< the hull was found vertex by vertex
  std::optional<Vanished> vanished;   ///< set if the hull has no interior
  PhaseReports phases;
};

/// Computes the hull. `folder` is where the scene's images are looked up. Throws InputError naming
/// the view whose image is missing or unreadable, or whose silhouette is empty, and if there
/// is no box and the cones do not bound the scene.
Result compute(const Scene& scene, const std::filesystem::path& folder, const Options& options,
               const Progress& progress = {});

/// Runs `work` and adds its time and predicates to a phase.
void timed(PhaseReports& reports, Phase phase, const std::function<void()>& work);

}  // namespace visual_hull
