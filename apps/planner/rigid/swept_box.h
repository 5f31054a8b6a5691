// SPDX-License-Identifier: Apache-2.0
//
// Boxes of a body that moves, against boxes of one that stays: which are apart during a whole part of a motion?
#pragma once

#include "apps/planner/rigid/motion_cell.h"
#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

/// Compares the boxes of nodes in one part of a motion, which must outlive this.
class SweptBoxes {
 public:
  explicit SweptBoxes(const MotionCell& cell);

  /// Are the boxes of a node of the moving body and of one that stays apart during the whole part? In doubles with a
  /// proven bound: true is proved. Cheaper if the moving node is that of the last call.
  [[nodiscard]] bool apart(const RigidBody::Node& moving, const RigidBody::Node& fixed);

 private:
  void take(const RigidBody::Node& moving);
  void take_box();
  [[nodiscard]] bool boxes_apart(const RigidBody::Node& fixed, double error);

  const MotionCell& cell_;
  bool stays_ = false;           // the part is a pose
  Eigen::Matrix3d middle_turn_;  // between the first and the last turn
  Vector3d middle_position_;     // between both positions
  Vector3d way_;                 // from there to the last one
  double turn_error_ = 0;        // no turn takes a point at distance 1 farther from where the middle one takes it

  // What encloses the sweep of a node's box: the sum of the hull of the images of its centre, a box about the origin
  // and a ball.
  const RigidBody::Node* moving_ = nullptr;
  Vector3d centre_;       // between the first and the last image
  double radius_ = 0;     // of a ball about the centre, around all of it
  bool has_box_ = false;  // what follows is set
  Vector3d aside_;        // from the centre to the last image
  Vector3d bulge_;        // from the centre to the image in the middle
  Eigen::Matrix3d axes_;  // of the box, as columns, about of length 1
  double around_ = 0;     // the radius of the ball
};

}  // namespace nef::planner
