// SPDX-License-Identifier: Apache-2.0
//
// Robots of several rigid links, joined by hinges and sliders.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

/// How a link stands on its parent: a shift and a turn, and then a joint. A point v of the link is at
/// R(turn) J(value) v + shift in the parent's coordinates. All numbers are doubles, and mean exactly what they are; the
/// axis and the quaternion are taken with length 1.
struct LinkageJoint {
  enum class Kind : std::uint8_t {
    kFixed,     ///< no value
    kRevolute,  ///< J turns about the axis through the link's origin, by the value in radians
    kPrismatic  ///< J shifts along the axis, by the value
  };
  Kind kind = Kind::kFixed;
  std::size_t parent = 0;                  ///< the number of a link before this one
  Vector3d shift = Vector3d::Zero();       ///< of the link's origin
  std::array<double, 4> turn{1, 0, 0, 0};  ///< quaternion w, x, y, z, not zero
  Vector3d axis = Vector3d::UnitZ();       ///< not zero; of a fixed joint without meaning
};

/// One link, and its joint.
struct Link {
  std::string name;
  std::optional<RigidBody> body;  ///< in the link's own coordinates; nothing if it has no shape
  LinkageJoint joint;             ///< of the first link, the base, without meaning: it stays at the world's origin
};

/// A tree of links. Link 0 is the base, and parents come before their children.
struct Linkage {
  std::vector<Link> links;
  /// Pairs of links that are never compared. Those that share a joint are not, either.
  std::vector<std::array<std::size_t, 2>> allowed;

  /// How many joints have a value; values are in the order of the links.
  [[nodiscard]] std::size_t dimension() const;
};

/// Throws InputError if a parent does not come before its link, a quaternion or an axis is zero or not finite, or there
/// is no link.
void require_valid(const Linkage& linkage);

}  // namespace nef::planner
