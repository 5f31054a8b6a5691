// SPDX-License-Identifier: Apache-2.0
//
// Which items of a mechanism's sets touch where its status changes.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/planner/mechanism/joint_events.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// The sets that pieces are of, with the joint's point at the origin.
struct MechanismSets {
  const Polyhedron& moving;
  const std::vector<Polyhedron>& fixed;
  const std::vector<std::size_t>& owners;  ///< for each piece that stays, which of `fixed` it is of
};

/// The items that touch at an event, each pair once; where a screw's event is not known exactly, those that may.
std::vector<ContactPair> stops_at(const JointEvent& event, const Joint& joint, const MechanismPieces& pieces,
                                  const MechanismSets& sets);

}  // namespace nef::planner
