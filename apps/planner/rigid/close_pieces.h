// SPDX-License-Identifier: Apache-2.0
//
// Pieces of two bodies that boxes cannot keep apart while one of the bodies moves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/planner/rigid/motion_cell.h"
#include "apps/planner/rigid/rigid_body.h"
#include "apps/planner/rigid/swept_box.h"

namespace nef::planner {

/// Two nodes of trees of boxes: of the moving body, and of the other one.
using NodePair = std::array<std::uint32_t, 2>;

/// Appends the pairs of children of two nodes of which one has some; the larger one is opened.
void split(const NodePair& pair, const RigidBody::Node& moving, const RigidBody::Node& fixed,
           std::vector<NodePair>& pairs);

/// Whether found(piece of the moving body, piece of the other one) is true for one of the pairs of pieces below the
/// pairs of nodes whose boxes may meet; asks no more once it was.
template <typename Found>
bool any_close_leaf(const MotionCell& cell, const RigidBody& moving, const RigidBody& fixed,
                    std::vector<NodePair> stack, Found&& found) {
  SweptBoxes boxes(cell);
  while (!stack.empty()) {
    const NodePair pair = stack.back();
    stack.pop_back();
    const RigidBody::Node& a = moving.nodes()[pair[0]];
    const RigidBody::Node& b = fixed.nodes()[pair[1]];
    if (boxes.apart(a, b)) continue;
    if (!a.leaf || !b.leaf) {
      split(pair, a, b, stack);
    } else if (found(a.first, b.first)) {
      return true;
    }
  }
  return false;
}

/// The pair of roots of two trees, if both have one.
inline std::vector<NodePair> root_pair(const RigidBody& moving, const RigidBody& fixed) {
  if (moving.nodes().empty() || fixed.nodes().empty()) return {};
  return {{0, 0}};
}

/// The pairs below those given that are not proved to be apart in a part of a motion, where leaf_apart(piece of the
/// moving body, piece of the other one) tells of two pieces. Pairs that sweep far beside their size stay as they are,
/// since halving the time will help more, unless it is the `last` part.
template <typename LeafApart>
std::vector<NodePair> nodes_not_apart(const MotionCell& cell, const RigidBody& moving, const RigidBody& fixed,
                                      std::vector<NodePair> stack, bool last, LeafApart&& leaf_apart) {
  std::vector<NodePair> rest;
  SweptBoxes boxes(cell);
  while (!stack.empty()) {
    const NodePair pair = stack.back();
    stack.pop_back();
    const RigidBody::Node& a = moving.nodes()[pair[0]];
    const RigidBody::Node& b = fixed.nodes()[pair[1]];
    if (boxes.apart(a, b)) continue;
    if (a.leaf && b.leaf) {
      if (!leaf_apart(a.first, b.first)) rest.push_back(pair);
    } else if (!last && cell.position_spread + cell.turn_spread * a.reach > a.radius + b.radius) {
      rest.push_back(pair);
    } else {
      split(pair, a, b, stack);
    }
  }
  return rest;
}

}  // namespace nef::planner
