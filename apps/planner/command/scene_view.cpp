// SPDX-License-Identifier: Apache-2.0
//
// Parts (robot, obstacles, tight passages, free space, ends) become layers of one page or glTF file. All are cut by one
// box, which is chosen from the parts that are visible at first, since free space is often unbounded. Tight passages
// are F minus the closure of its interior; their edges are drawn as lines, too. The robot's motion has times
// proportional to the length of the path.
#include "apps/planner/command/scene_view.h"

#include "apps/view/glb.h"
#include "apps/view/page.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

constexpr view::Color kFree{120, 190, 230};
constexpr view::Color kTight{200, 30, 110};
constexpr const char* kTightName = "tight passages";

Polyhedron at(const Polyhedron& robot, const Rational3& position) {
  return transform(robot, AffineMap::translate(position));
}

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

std::optional<Rational3> first_position(const Answer& answer, const Scene& scene) {
  return answer.path ? answer.path->points.front() : scene.start;
}

Polyhedron ends(const Answer& answer, const Scene& scene) {
  std::vector<Polyhedron> points;
  if (const auto start = first_position(answer, scene)) points.push_back(make_point(*start));
  if (answer.path) {
    points.push_back(make_point(answer.path->points.back()));
  } else if (scene.goal) {
    points.push_back(make_point(*scene.goal));
  }
  return unite_all(points);
}

std::vector<ShownSet> parts_of(const Answer& answer, const Scene& scene, const FreeSpace& free) {
  std::vector<ShownSet> parts;
  parts.push_back({"robot", at(scene.robot, first_position(answer, scene).value_or(Rational3{})), kRobot});
  const std::optional<Rational3> goal = answer.path ? answer.path->points.back() : scene.goal;
  if (goal) parts.push_back({"robot at the goal", at(scene.robot, *goal), kRobot, 0.3});
  parts.push_back({"obstacles", unite_all(scene.obstacles), kObstacles, 0.35});
  parts.push_back({kTightName, tight_part(free), kTight});
  parts.push_back({"free space", free.set(), kFree, 0.3, false});
  parts.push_back({answer.path ? "path" : "start and goal", ends(answer, scene), kPath});
  std::erase_if(parts, [](const ShownSet& part) { return part.set.is_empty(); });
  return parts;
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

std::vector<view::Layer> view_layers(const Answer& answer, const Scene& scene, const FreeSpace& free) {
  std::vector<view::Layer> layers = layers_of(parts_of(answer, scene, free));
  for (view::Layer& layer : layers) {
    if (layer.name == kTightName) layer.lines = tight_lines(free);
  }
  if (answer.path) move_along(answer.path->points, lengths_of(*answer.path), {}, layers);
  return layers;
}

bool is_view_file(const std::string& file) {
  const std::string extension = lower_extension(file);
  return extension == "html" || extension == "glb";
}

void write_outputs(const Arguments& a, const std::string& title,
                   const std::function<std::optional<std::string>(const std::string& file)>& text,
                   const std::function<std::vector<view::Layer>()>& layers) {
  std::vector<std::string> views;
  if (!a.page.empty()) views.push_back(a.page);
  for (const std::string& file : a.outputs) {
    if (is_view_file(file)) {
      views.push_back(file);
    } else if (const std::optional<std::string> bytes = text(file)) {
      write_file(file, *bytes);
    }
  }
  if (views.empty()) return;
  const std::vector<view::Layer> shown = layers();
  view::PageOptions options;
  options.title = title;
  for (const std::string& file : views) {
    if (lower_extension(file) == "glb") {
      view::write_glb(shown, file);
    } else {
      view::write_page(shown, file, options);
    }
  }
}

}  // namespace nef::planner
