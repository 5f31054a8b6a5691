// SPDX-License-Identifier: Apache-2.0
//
// Where one link of a linkage is, seen from another one, and what it sweeps while joints move evenly.
#pragma once

#include <span>
#include <vector>

#include "apps/planner/linkage/linkage.h"
#include "apps/planner/rigid/motion_cell.h"

namespace nef::planner {

/// From values to values of all joints, each going evenly with a parameter from 0 to 1.
struct JointMotion {
  std::span<const double> from;
  std::span<const double> to;
};

/// What lies between two links: fixed steps and joints.
class LinkChain {
 public:
  /// Of link `moving` in the coordinates of link `seen_from`, which is in another place of the tree. O(links).
  LinkChain(const Linkage& linkage, std::size_t seen_from, std::size_t moving);

  /// True if no joint is in between: nothing moves.
  [[nodiscard]] bool is_rigid() const { return joints_ == 0; }

  /// Encloses what a body of points with |x| <= reach sweeps in a part of a motion: the hull of its places at both
  /// ends, and a ball as large as the cell's slack.
  ///
  /// On a curve x(s) a point is no farther from the chord over a length h than h^2 / 8 times the largest |x''|. Let Y,
  /// D and A bound |x|, |x'| and |x''| of a point seen from one step of the chain. A joint that turns by w in all makes
  /// D + w Y and A + 2 w D + w^2 Y of these, one that slides by s makes Y + its largest shift, and D + s.
  ///
  /// Rounding: with u = 2^-53, sine and cosine are off by 1 u and by what the angle is, 4 u times the largest one; an
  /// entry of a joint's matrix by 20 u and twice that, of a fixed one by 12 u; a product of matrices adds 6 u to each
  /// entry. So N steps turn a point that is up to Y away by N (78 u + 24 u times the largest angle) Y, and shifts add
  /// less than N 10 u Y: all of it is below N (100 + 32 |angle|) u Y.
  [[nodiscard]] MotionCell part(const JointMotion& motion, double from, double to, double reach) const;

  /// The pose at a parameter; the slack is that of rounding.
  [[nodiscard]] MotionCell pose(const JointMotion& motion, double at, double reach) const;

 private:
  struct Step {
    LinkageJoint::Kind kind = LinkageJoint::Kind::kFixed;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // of a fixed step
    Vector3d shift = Vector3d::Zero();
    Vector3d axis = Vector3d::Zero();  // of a joint
    double sign = 1;                   // -1 if the joint is passed from the link to its parent
    std::size_t value = 0;
  };
  struct Place {
    Eigen::Matrix3d turn;
    Vector3d shift;
  };
  void add_link(const Linkage& linkage, std::size_t link, std::size_t value, bool down);
  [[nodiscard]] Place place_at(const JointMotion& motion, double s) const;
  // How far a chord may be from its curve over a part of length 1, and the error of rounding.
  struct Bounds {
    double bend = 0;
    double rounding = 0;
  };
  [[nodiscard]] Bounds bounds(const JointMotion& motion, double reach) const;

  std::vector<Step> steps_;  // the first one is nearest to the link that is seen from
  std::size_t joints_ = 0;
};

}  // namespace nef::planner
