// SPDX-License-Identifier: Apache-2.0
//
// A turn M takes the point c + A x of a box to M c + N A x + (M - N) A x, where N is the same for all turns of the part
// and |(M - N) A x| is at most the Frobenius norm of M - N times the radius of the box. Balls around all of it drop
// most pairs. Then planes are looked for along the fifteen directions that suffice for two boxes that stay: the axes of
// each, and their cross products [Gottschalk, Lin and Manocha, OBBTree, 1996].
#include "apps/planner/rigid/swept_box.h"

#include <algorithm>
#include <cmath>

namespace nef::planner {
namespace {

// Beyond, squares of sums may overflow.
constexpr double kLargestBoxReach = 1e150;

// Let u = 2^-53, and let R be the sum of the reaches of both nodes and of the position. All is compared in coordinates
// along the axes B of the fixed box, that is, after the linear map B^T. It takes vectors that are off by d in each
// coordinate to such that are off by 1.74 d.
// - An image in doubles, without the last rounding, is off by 187 u R (MotionCell::kImageError): 326 u R after the map.
// - The centre between images takes 7 u R for each of two images and 5 u R for sums and the difference from the fixed
//   centre, 34 u R after the map, whose own roundings are 15 u R. The ways from it to other images and positions take
//   the same again, at most three times in all: 196 u R with the centre.
// - Axes of the moving box are off by 10 u in each entry, and half an extent is no larger than R: the three of them
//   take 31 u R, the map 13 u R.
// - After the map, the fixed box is larger than its halves by 3 OrientedBox::kSkew R = 384 u R at most.
// - Products with a direction n, their sums and weights take less than 100 u R.
// Together that is below 1200 u R for |n|_1 = 1, and |n|_1 is at most 1.74 for all directions: below 2^-41 R.
constexpr double kBoxError = 0x1p-41;
// For norms: of directions above 1, and of what is computed here.
constexpr double kSpare = 1 + 0x1p-20;

// What is left of both boxes after the map: columns are the centre, the axes of the moving box and, in a part that is
// no pose, the ways to the last image, to the one in the middle and to the last position.
constexpr Eigen::Index kPoseColumns = 4;
constexpr Eigen::Index kPartColumns = 8;
template <Eigen::Index kColumns>
struct MappedBoxes {
  Eigen::Matrix<double, 3, kColumns, Eigen::RowMajor> columns;
  Vector3d half;
  Vector3d fixed_half;
  double around = 0;  // the ball, and all errors
};

// Whether they are apart in a direction, given the products of the columns with it and the extent of the fixed box.
bool apart_along(const MappedBoxes<kPoseColumns>& boxes, const Eigen::Matrix<double, 1, kPoseColumns>& at,
                 double fixed) {
  const double moving =
      std::fabs(at[1]) * boxes.half[0] + std::fabs(at[2]) * boxes.half[1] + std::fabs(at[3]) * boxes.half[2];
  return std::fabs(at[0]) > moving + boxes.around + fixed;
}

bool apart_along(const MappedBoxes<kPartColumns>& boxes, const Eigen::Matrix<double, 1, kPartColumns>& at,
                 double fixed) {
  const double moving =
      std::fabs(at[1]) * boxes.half[0] + std::fabs(at[2]) * boxes.half[1] + std::fabs(at[3]) * boxes.half[2];
  const double towards = at[0] > 0 ? -at[5] : at[5];
  const double sweep = std::max(std::fabs(at[4]), towards) + std::fabs(at[6]);
  return std::fabs(at[0]) > moving + sweep + boxes.around + fixed;
}

template <Eigen::Index kColumns>
bool apart_along_any(const MappedBoxes<kColumns>& boxes) {
  const auto& m = boxes.columns;
  const Vector3d& h = boxes.fixed_half;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (apart_along(boxes, m.row(k), h[k])) return true;
  }
  for (Eigen::Index k = 1; k < 4; ++k) {
    const Vector3d n = m.col(k);
    if (apart_along(boxes, n[0] * m.row(0) + n[1] * m.row(1) + n[2] * m.row(2), n.cwiseAbs().dot(h))) return true;
  }
  for (Eigen::Index k = 1; k < 4; ++k) {
    const Vector3d n = m.col(k);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index j = (i + 1) % 3;
      const double fixed = std::fabs(n[j]) * h[i] + std::fabs(n[i]) * h[j];
      if (apart_along(boxes, n[j] * m.row(i) - n[i] * m.row(j), fixed)) return true;
    }
  }
  return false;
}

}  // namespace

SweptBoxes::SweptBoxes(const MotionCell& cell)
    : cell_(cell),
      stays_(cell.turn_count == 1 && cell.position_count == 1),
      middle_turn_(cell.turns[0]),
      middle_position_(cell.positions[0]),
      way_(Vector3d::Zero()) {
  if (cell.turn_count > 1) middle_turn_ = (cell.turns[0] + cell.turns[cell.turn_count - 1]) / 2;
  for (std::size_t i = 0; i < cell.turn_count; ++i) {
    turn_error_ = std::max(turn_error_, (cell.turns[i] - middle_turn_).norm() * kSpare);
  }
  if (cell.position_count > 1) {
    middle_position_ = (cell.positions[0] + cell.positions[1]) / 2;
    way_ = cell.positions[1] - middle_position_;
  }
}

void SweptBoxes::take(const RigidBody::Node& moving) {
  moving_ = &moving;
  has_box_ = false;
  centre_ = middle_turn_ * moving.box.centre + middle_position_;
  // The images of the centre are no farther from it than the turn's error times its distance.
  radius_ = turn_error_ * moving.box.centre.norm() + way_.norm() + (1 + turn_error_) * moving.radius + cell_.slack;
}

void SweptBoxes::take_box() {
  has_box_ = true;
  const Vector3d& c = moving_->box.centre;
  axes_ = middle_turn_ * moving_->box.axes;
  around_ = (turn_error_ * moving_->radius + cell_.slack) * kSpare;
  if (cell_.turn_count == 1) {
    aside_ = bulge_ = Vector3d::Zero();
    return;
  }
  aside_ = (cell_.turns[cell_.turn_count - 1] - middle_turn_) * c;
  bulge_ = cell_.turn_count == 2 ? Vector3d(Vector3d::Zero()) : Vector3d((cell_.turns[1] - middle_turn_) * c);
}

bool SweptBoxes::apart(const RigidBody::Node& moving, const RigidBody::Node& fixed) {
  if (&moving != moving_) take(moving);
  const double reach = moving.reach + cell_.position_reach + fixed.reach;
  if (!(reach < kLargestBoxReach)) return false;
  const double error = kBoxError * reach + MotionCell::kVanished;
  const double together = (radius_ + fixed.radius + error) * kSpare;
  if ((centre_ - fixed.box.centre).squaredNorm() > together * together + MotionCell::kVanished) return true;
  return boxes_apart(fixed, error);
}

bool SweptBoxes::boxes_apart(const RigidBody::Node& fixed, double error) {
  if (!has_box_) take_box();
  const auto map = fixed.box.axes.transpose();
  const auto fill = [&](auto& boxes) {
    boxes.half = moving_->box.half;
    boxes.fixed_half = fixed.box.half;
    boxes.around = around_ + error;
    boxes.columns.col(0).noalias() = map * (centre_ - fixed.box.centre);
    boxes.columns.template middleCols<3>(1).noalias() = map * axes_;
  };
  if (stays_) {
    MappedBoxes<kPoseColumns> boxes;
    fill(boxes);
    return apart_along_any(boxes);
  }
  MappedBoxes<kPartColumns> boxes;
  fill(boxes);
  boxes.columns.col(4).noalias() = map * aside_;
  boxes.columns.col(5).noalias() = map * bulge_;
  boxes.columns.col(6).noalias() = map * way_;
  boxes.columns.col(7).setZero();
  return apart_along_any(boxes);
}

}  // namespace nef::planner
