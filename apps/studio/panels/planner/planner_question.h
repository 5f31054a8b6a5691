// SPDX-License-Identifier: Apache-2.0
//
// What the planner's panel asks of a scene, and who answers it: one function for each kind of motion.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "apps/planner/scene/scene.h"
#include "apps/studio/caches/scene_cache.h"
#include "apps/studio/panels/panel.h"

namespace nef::studio {

/// A scene as it is dragged, and what is wanted of it.
struct PlannerQuestion {
  planner::Scene scene;                    ///< start, goal and obstacles where they are now
  std::map<std::size_t, Rational3> moves;  ///< by the numbers of obstacles
  std::shared_ptr<RestingScene> resting;   ///< the scene without the obstacles that are moved
  bool free = false;                       ///< whether free space is wanted, too
  bool dragged = false;                    ///< whether any answer will do that is there soon
  std::string ompl;                        ///< an OMPL planner to run beside ours; empty: none
  double seconds = 5;                      ///< for that one

  /// Whether it has a start and a goal.
  [[nodiscard]] bool has_ends() const { return scene.start && scene.goal; }
  /// Whether an OMPL planner is to run now.
  [[nodiscard]] bool runs_ompl() const { return !ompl.empty() && !dragged && has_ends(); }
};

/// Translations: a path or a proof that there is none, free space and tight passages, OMPL's path. Report: "answer" as
/// `planner --json` has it, "ompl". Sets: "free space" if it was made.
void answer_translations(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result);

/// The same where the robot turns about one axis ("answer": status, motions, cells, waypoints, collision; "ompl").
void answer_turning(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result);

/// The same where the robot turns freely: a path whose motions are certified, or a proof ("answer": status, motions,
/// samples, slices, boxes, waypoints, collision; "ompl").
void answer_rigid(const PlannerQuestion& question, const Monitor& monitor, PanelResult& result);

/// The scene that `layers` of an answer are made of: without obstacles, which draw_scene adds.
planner::Scene without_obstacles(const planner::Scene& scene);

/// Adds layers and the obstacles: those that are moved, or all if they are few, as layers of their own, the others as a
/// piece that stays.
void draw_scene(std::vector<view::Layer> layers, const PlannerQuestion& question, const Monitor& monitor,
                PanelResult& result);

/// Adds what an OMPL planner has found ("status", "seconds", "length" or "waypoints") to the report, as "ompl" with the
/// planner's "name", and its path, if there is one, as a layer.
void add_ompl(const PlannerQuestion& question, Json found, const std::vector<Rational3>& path, PanelResult& result);

}  // namespace nef::studio
