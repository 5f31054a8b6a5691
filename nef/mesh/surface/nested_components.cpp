// SPDX-License-Identifier: Apache-2.0
//
// Around every edge a component separates two sides, so all of its triangles lie between the same two winding numbers.
// One of these is that of infinity, so the component winds once around what is inside of it, or once backward: the sign
// of its volume tells. The others wind around all of its triangles equally often, since they cross it nowhere; a ray
// from one of its vertices counts how often.
#include "nef/mesh/surface/nested_components.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "nef/base/union_find.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/edge_order.h"

namespace nef {
namespace {

UnionFind edge_components(const MeshSurface& surface) {
  struct Side {
    std::uint64_t key = 0;
    std::uint32_t triangle = 0;
  };
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [u, v] = std::minmax(surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]);
      sides.push_back({pair_key(u, v), t});
    }
  }
  sort_by_pair(sides, surface.points.size());
  UnionFind components(surface.triangles.size());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].key == sides[i - 1].key) components.unite(sides[i].triangle, sides[i - 1].triangle);
  }
  return components;
}

struct Component {
  std::uint32_t origin = 0;                            // a vertex, from which its volume is measured
  std::array<std::array<std::uint32_t, 2>, 3> ends{};  // its lowest and highest vertex along each axis
  double volume = 0;                                   // six times
  double error = 0;
};

std::vector<Component> measured_components(const MeshSurface& surface, std::vector<std::uint32_t>& component_of) {
  const MeshPoints& points = surface.points;
  UnionFind sets = edge_components(surface);
  std::vector<Component> components;
  component_of.resize(surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const std::uint32_t first = sets.find(t);  // its smallest triangle
    const std::array<std::uint32_t, 3>& corners = surface.triangles[t];
    if (first == t) {
      component_of[t] = static_cast<std::uint32_t>(components.size());
      Component& made = components.emplace_back();
      made.origin = corners[0];
      made.ends.fill({corners[0], corners[0]});
    } else {
      component_of[t] = component_of[first];
    }
    Component& component = components[component_of[t]];
    const Approximation volume = points.determinant(component.origin, corners[0], corners[1], corners[2]);
    component.volume += volume.value;
    component.error += volume.error;
    for (const std::uint32_t v : corners) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto& [low, high] = component.ends[axis];
        if (points.approximate(v)[axis] < points.approximate(low)[axis]) low = v;
        if (points.approximate(v)[axis] > points.approximate(high)[axis]) high = v;
      }
    }
  }
  return components;
}

// Rays from the ends of components along the axes.
class Rays {
 public:
  Rays(const MeshSurface& surface, std::span<const std::uint32_t> component_of, const Monitor& monitor)
      : surface_(surface), component_of_(component_of), monitor_(monitor) {
    std::vector<Box> boxes(surface.triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t) {
      for (const std::uint32_t v : surface.triangles[t]) surface.points.extend(boxes[t], v);
    }
    tree_ = BoxTree(boxes);
  }

  // How often the other components wind around the component, if none of the rays from its ends that are tried meets
  // a side or a corner of theirs.
  [[nodiscard]] std::optional<int> winding_around(std::uint32_t number, const Component& component) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        const std::optional<int> winding = along(component.ends[axis][up ? 1 : 0], axis, up, number);
        if (winding) return winding;
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<int> along(std::uint32_t from, std::size_t axis, bool up, std::uint32_t own) const {
    Box ray;
    surface_.points.extend(ray, from);
    (up ? ray.high : ray.low)[axis] = up ? HUGE_VAL : -HUGE_VAL;
    int winding = 0;
    bool clear = true;
    tree_.for_each_overlap(ray, [&](std::uint32_t t) {
      if (!clear || component_of_[t] == own) return;
      const std::optional<int> passed = passage(from, axis, up, surface_.triangles[t]);
      clear = passed.has_value();
      winding += passed.value_or(0);
    });
    return clear ? std::optional(winding) : std::nullopt;
  }

  // +1 if the ray leaves the solid through the triangle, -1 if it comes in, 0 if it misses it; nothing if it meets a
  // side or a corner, or begins on it.
  [[nodiscard]] std::optional<int> passage(std::uint32_t from, std::size_t axis, bool up,
                                           const std::array<std::uint32_t, 3>& t) const {
    const MeshPoints& points = surface_.points;
    std::array<int, 3> signs{};
    for (std::size_t i = 0; i < 3; ++i) signs[i] = points.orientation_along(t[i], t[(i + 1) % 3], from, axis, monitor_);
    const auto [least, most] = std::minmax({signs[0], signs[1], signs[2]});
    if (least < 0 && most > 0) return 0;
    if (least == 0 || most == 0) return std::nullopt;
    // The normal points along the axis iff the corners turn left as seen from its far end; then what is above the
    // triangle is in front of it.
    const int side = points.orientation(t[0], t[1], t[2], from, monitor_);
    if (side == 0) return std::nullopt;
    const bool above = side == least;
    if (above == up) return 0;
    return up ? least : -least;
  }

  const MeshSurface& surface_;
  std::span<const std::uint32_t> component_of_;
  Monitor monitor_;
  BoxTree tree_;
};

}  // namespace

bool surely_one_solid(const MeshSurface& surface, const Monitor& monitor) {
  if (!surface.points.moderate()) return false;
  std::vector<std::uint32_t> component_of;
  const std::vector<Component> components = measured_components(surface, component_of);
  // A sum of n terms below 6 s^3 rounds by n 2^-53 6 s^3 at most for each, and their errors are 2^-47 s^3 or more.
  const double rounding = 1 + 0x1p-3 * static_cast<double>(surface.triangles.size());
  for (const Component& component : components) {
    if (!(std::abs(component.volume) > rounding * component.error)) return false;
  }
  if (components.size() == 1) return components[0].volume > 0;
  const Rays rays(surface, component_of, monitor);
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const std::optional<int> winding = rays.winding_around(c, components[c]);
    if (!winding || *winding != (components[c].volume > 0 ? 0 : 1)) return false;
  }
  return true;
}

}  // namespace nef
