// SPDX-License-Identifier: Apache-2.0
//
// Parts (robot, obstacles, tight passages, free space, ends) become layers of one page or glTF file. All are cut by one
// box, which is chosen from the parts that are visible at first, since free space is often unbounded. Tight passages
// are F minus the closure of its interior; their edges are drawn as lines, too. The robot's motion has times
// proportional to the length of the path.
#include "apps/planner/command/scene_view.h"

namespace nef::planner {
namespace {

constexpr view::Color kPath{20, 90, 200};
constexpr view::Color kFree{120, 190, 230};
constexpr view::Color kTight{200, 30, 110};
constexpr const char* kTightName = "tight passages";

view::Point to_double(const Rational3& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }

// F minus the closure of its interior.
Polyhedron tight_part(const FreeSpace& free) {
  if (free.passages().empty()) return {};
  return subtract(free.set(), closure(interior(free.set())));
}

// Edges show their marks by their colour, not their layer's; these lines do.
std::vector<view::Polyline> tight_lines(const FreeSpace& free) {
  std::vector<view::Polyline> lines;
  for (const TightPassage& passage : free.passages()) {
    for (const CellId cell : passage.cells) {
      if (free.cells().dimension(cell) != 1) continue;
      const std::vector<Rational3> ends = free.vertices(cell);
      lines.push_back({"tight passage", {to_double(ends[0]), to_double(ends[1])}, kTight});
    }
  }
  return lines;
}

}  // namespace

std::vector<view::Layer> layers_of(const std::vector<ShownSet>& parts) {
  // The free space may be unbounded; it is cut where the rest is, so that this stays large.
  std::vector<Polyhedron> sets;
  for (const ShownSet& part : parts) {
    if (part.visible) sets.push_back(part.set);
  }
  view::SceneOptions options;
  options.box = view::visible_box(sets);
  std::vector<view::Layer> layers;
  for (const ShownSet& part : parts) {
    view::Layer& layer = layers.emplace_back();
    layer.name = part.name;
    layer.scene = view::build_scene(part.set, options);
    layer.color = part.color;
    layer.opacity = part.opacity;
    layer.visible = part.visible;
  }
  return layers;
}

std::vector<view::Layer> scene_layers(const Scene& scene, const std::optional<AffineMap>& start,
                                      const std::optional<AffineMap>& goal, bool has_path, const FreeSpace* free) {
  std::vector<ShownSet> parts{{"robot", start ? transform(scene.robot, *start) : scene.robot, kRobotColor}};
  if (goal) parts.push_back({"robot at the goal", transform(scene.robot, *goal), kRobotColor, 0.3});
  parts.push_back({"obstacles", unite_all(scene.obstacles), kObstaclesColor, kObstaclesOpacity});
  if (free != nullptr) {
    parts.push_back({kTightName, tight_part(*free), kTight});
    parts.push_back({"free space", free->set(), kFree, 0.3, false});
  }
  std::vector<Polyhedron> ends;
  for (const std::optional<AffineMap>& end : {start, goal}) {
    if (end) ends.push_back(make_point(end->translation));
  }
  parts.push_back({has_path ? "path" : "start and goal", unite_all(ends), kPath});
  std::erase_if(parts, [](const ShownSet& part) { return part.set.is_empty(); });
  std::vector<view::Layer> layers = layers_of(parts);
  for (view::Layer& layer : layers) {
    if (layer.name == kTightName) layer.lines = tight_lines(*free);
  }
  return layers;
}

void move_along(const std::vector<Rational3>& points, const std::vector<double>& lengths, const TurnAt& turn,
                std::vector<view::Layer>& layers) {
  if (points.size() < 2) return;
  std::vector<double> way{0};
  for (const double length : lengths) way.push_back(way.back() + length);
  view::Motion& motion = layers.front().motion;
  view::Polyline& line = layers.back().lines.emplace_back(view::Polyline{"path", {}, kPath});
  const view::Point begin = to_double(points.front());
  if (turn) motion.pivot = begin;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const view::Point here = to_double(points[i]);
    line.points.push_back(here);
    if (i > 0 && way[i] == way[i - 1]) continue;  // times must increase
    motion.times.push_back(way.back() > 0 ? kPlaySeconds * way[i] / way.back() : 0);
    motion.offsets.push_back({here[0] - begin[0], here[1] - begin[1], here[2] - begin[2]});
    if (turn) motion.turns.push_back(turn(i));
  }
}

std::vector<view::Layer> view_layers(const Answer& answer, const Scene& scene, const FreeSpace* free) {
  const auto placed = [](const std::optional<Rational3>& position) {
    return position ? std::optional(AffineMap::translate(*position)) : std::nullopt;
  };
  if (!answer.path) return scene_layers(scene, placed(scene.start), placed(scene.goal), false, free);
  const std::vector<Rational3>& points = answer.path->points;
  std::vector<view::Layer> layers = scene_layers(scene, placed(points.front()), placed(points.back()), true, free);
  move_along(points, lengths_of(*answer.path), {}, layers);
  return layers;
}

}  // namespace nef::planner
