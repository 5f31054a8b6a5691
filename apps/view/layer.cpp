// SPDX-License-Identifier: Apache-2.0
#include "apps/view/layer.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/vectors.h"

namespace nef::view {
namespace {

void add_point(std::optional<std::array<Point, 2>>& bounds, const Point& point) {
  if (!bounds) bounds = {point, point};
  for (std::size_t i = 0; i < 3; ++i) {
    (*bounds)[0][i] = std::min((*bounds)[0][i], point[i]);
    (*bounds)[1][i] = std::max((*bounds)[1][i], point[i]);
  }
}

// A point wherever the turns of a motion take it.
void add_moved(std::optional<std::array<Point, 2>>& bounds, const Motion& motion, const Point& point,
               const Point& offset) {
  if (motion.turns.empty()) return add_point(bounds, plus(point, offset));
  const Point center = plus(motion.pivot, offset);
  const double reach = std::hypot(point[0] - motion.pivot[0], point[1] - motion.pivot[1], point[2] - motion.pivot[2]);
  for (const double r : {-reach, reach}) add_point(bounds, plus(center, {r, r, r}));
}

}  // namespace

Color palette_color(std::size_t index) {
  static constexpr std::array<Color, 8> kPalette{{{86, 143, 196},
                                                  {230, 171, 64},
                                                  {94, 168, 120},
                                                  {188, 112, 164},
                                                  {204, 121, 87},
                                                  {112, 186, 196},
                                                  {170, 160, 88},
                                                  {134, 128, 190}}};
  return kPalette[index % kPalette.size()];
}

LayerColors colors_of(const std::vector<Layer>& layers, std::size_t index) {
  const Layer& layer = layers[index];
  LayerColors colors;
  colors.layer = layer.color ? *layer.color : palette_color(index);
  colors.volumes.assign(layer.scene.volumes.size(), colors.layer);
  if (layer.color || layers.size() > 1) return colors;
  std::size_t next = 0;
  for (std::size_t v = 0; v < colors.volumes.size(); ++v) {
    if (Scene::selected(layer.scene.volumes[v].mark)) colors.volumes[v] = palette_color(next++);
  }
  return colors;
}

FacetSide facet_side(const Scene& scene, const SceneFacet& facet, bool seen_from_above) {
  const std::uint32_t front = seen_from_above ? facet.above : facet.below;
  const std::uint32_t behind = seen_from_above ? facet.below : facet.above;
  if (Scene::selected(scene.volumes[behind].mark)) return {behind, false};
  if (Scene::selected(scene.volumes[front].mark)) return {front, true};
  return {};
}

std::optional<std::array<Point, 2>> bounds_of(const std::vector<Layer>& layers, Framing framing) {
  std::optional<std::array<Point, 2>> result;
  for (const Layer& layer : layers) {
    if (framing == Framing::kFocus && !layer.visible) continue;
    if (const auto bounds = layer.scene.bounds()) {
      for (const Point& corner : *bounds) {
        if (layer.motion.empty()) add_point(result, corner);
        for (const Point& offset : layer.motion.offsets) add_moved(result, layer.motion, corner, offset);
      }
    }
    for (const Polyline& line : layer.lines) {
      for (const Point& point : line.points) add_point(result, point);
    }
  }
  if (framing == Framing::kFocus && result) return result;
  for (const Layer& layer : layers) {
    if (framing == Framing::kFocus && !layer.visible) continue;
    for (const Photo& photo : layer.photos) {
      for (const Point& point : photo.corners) add_point(result, point);
      if (photo.eye) add_point(result, *photo.eye);
    }
  }
  return result;
}

}  // namespace nef::view
