// SPDX-License-Identifier: Apache-2.0
//
// Sets with labels for tests of what takes them for their points.
#pragma once

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::test {

/// The same points with labels from 2 to 5, by whether they are in `parts` and in a half-space.
inline Polyhedron labeled(const Polyhedron& a, const Polyhedron& parts) {
  const auto first = [](LabelId x, LabelId y) { return static_cast<LabelId>(x == 0 ? 0 : x + 1 + y); };
  const auto second = [](LabelId x, LabelId y) { return static_cast<LabelId>(x == 0 ? 0 : x + 2 * y); };
  return overlay(overlay(a, parts, first), make_halfspace(1, 0, 0, -1, true), second);
}

}  // namespace nef::test
