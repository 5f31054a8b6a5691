// SPDX-License-Identifier: Apache-2.0
//
// Whether triangles meet in nothing but their common corners, told by sets made of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::test {

/// The hull of some of the places.
inline Polyhedron hull_of(const std::vector<Rational3>& places, std::span<const std::uint32_t> corners) {
  std::vector<Rational3> chosen;
  for (const std::uint32_t v : corners) chosen.push_back(places[v]);
  return convex_hull(chosen);
}

/// True if two triangles have nothing in common beyond shared corners and the edge between them.
inline bool meet_in_common_corners_only(const std::vector<Rational3>& places, const std::array<std::uint32_t, 3>& a,
                                        const std::array<std::uint32_t, 3>& b) {
  std::vector<std::uint32_t> common;
  for (const std::uint32_t v : a) {
    if (std::find(b.begin(), b.end(), v) != b.end()) common.push_back(v);
  }
  return equal(intersect(hull_of(places, a), hull_of(places, b)), hull_of(places, common));
}

}  // namespace nef::test
