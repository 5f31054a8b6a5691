// SPDX-License-Identifier: Apache-2.0
//
// Sets that the tests look at.
#pragma once

#include "apps/view/layer.h"
#include "nef/construct/construct.h"

namespace nef::view {

inline Polyhedron cube(int low, int high) { return make_box({low, low, low}, {high, high, high}); }

/// A frame: a flat box with a square hole through it.
inline Polyhedron frame() { return subtract(make_box({0, 0, 0}, {4, 4, 1}), make_box({1, 1, -1}, {3, 3, 2})); }

/// Parts of every dimension, marks of both kinds: a box without one of its facets, a sheet, a segment and a point
/// beside it.
inline Polyhedron mixture() {
  const std::vector<std::vector<Rational3>> sheet{{{2, 0, 0}, {3, 0, 0}, {3, 0, 2}, {2, 0, 2}}};
  const Polyhedron open_box = subtract(cube(0, 2), make_box({0, 0, 2}, {2, 2, 3}));
  const std::vector<Polyhedron> parts{open_box, make_polygon(sheet), make_segment({2, 2, 1}, {3, 3, 1}),
                                      make_point({Rational(10, 3), 1, Rational(5, 2)})};
  return unite_all(parts);
}

inline Layer layer_of(const std::string& name, const Polyhedron& set, const SceneOptions& options = {}) {
  Layer layer;
  layer.name = name;
  layer.scene = build_scene(set, options);
  return layer;
}

}  // namespace nef::view
