// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/sphere_map/arrangement.h"

namespace nef::visual_hull {

/// Adds a selected svertex in the direction n_p x n_q to a drawing over the planes of a table; returns its number.
inline std::uint32_t add_boundary_node(nef::Arrangement& drawing, const nef::PlaneTable& planes, nef::PlaneId p,
                                       nef::PlaneId q) {
  nef::Arrangement::Node node;
  node.direction = nef::Direction::cross(planes, p, q);
  node.mark = 1;
  drawing.nodes.push_back(node);
  return static_cast<std::uint32_t>(drawing.nodes.size() - 1);
}

}  // namespace nef::visual_hull
