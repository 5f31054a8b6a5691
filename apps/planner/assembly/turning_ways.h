// SPDX-License-Identifier: Apache-2.0
//
// How some parts of an assembly leave others by motions that turn, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/parts.h"
#include "apps/planner/assembly/separation.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A motion that turns: at a pose, a point v is at R(quaternion) (v - pivot) + pivot + position. Between two poses the
/// position goes straight and the rotation along the shorter arc, at constant speed (MotionTiming::kSlerp).
struct TurningWay {
  Rational3 pivot;
  std::vector<RigidPose> poses;  ///< the first one is where the parts are
};

/// What is known of a way by which parts leave others.
struct TurningWayAnswer {
  enum class Status : std::uint8_t {
    kWay,       ///< `way`; every motion of it was certified
    kNone,      ///< proved: there is no way with the rotations that the assembly allows
    kUndecided  ///< neither was found
  };
  Status status = Status::kUndecided;
  std::optional<TurningWay> way;
};

/// How far a question about turning parts is followed.
struct TurningWayLimits {
  std::size_t max_cells = 200;  ///< of angles, or slices; random poses and boxes in proportion
};

/// A way for `moving` out of what stays with the rotation of the assembly, which must have one; after it the boxes
/// around both are apart. First motions along screw axes that the shapes suggest are tried, then a search
/// (find_turning_path about one axis, find_rigid_path about all). Throws Interrupted when the monitor stops it.
TurningWayAnswer turning_way(const Assembly& assembly, const PartSet& moving, const PartSet& stay,
                             const TurningWayLimits& limits = {}, const Monitor& monitor = {});

}  // namespace nef::planner
