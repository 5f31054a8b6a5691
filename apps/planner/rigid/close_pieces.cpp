// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/close_pieces.h"

namespace nef::planner {

void split(const NodePair& pair, const RigidBody::Node& a, const RigidBody::Node& b, std::vector<NodePair>& pairs) {
  const bool split_a = b.leaf || (!a.leaf && a.radius > b.radius);
  for (const std::uint32_t child : {0U, 1U}) {
    pairs.push_back(split_a ? NodePair{a.first + child, pair[1]} : NodePair{pair[0], b.first + child});
  }
}

}  // namespace nef::planner
