// SPDX-License-Identifier: Apache-2.0
//
// A chain is a list of fixed steps and joints from the link that is seen from to the one that moves; a joint that is
// passed from its link to its parent goes the other way. Matrices are multiplied along it; bounds are added up from its
// far end (link_chain.h derives them).
#include "apps/planner/linkage/link_chain.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"

namespace nef::planner {
namespace {

using Eigen::Matrix3d;

Matrix3d matrix_of(const std::array<double, 4>& q) {
  const auto& [w, x, y, z] = q;
  const double square = w * w + x * x + y * y + z * z;
  Matrix3d m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m / square;
}

// About a unit vector [Rodrigues].
Matrix3d turn_about(const Vector3d& n, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Matrix3d across;
  across << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
  return c * Matrix3d::Identity() + s * across + (1 - c) * n * n.transpose();
}

double value_at(const JointMotion& motion, std::size_t value, double s) {
  return (1 - s) * motion.from[value] + s * motion.to[value];
}

double largest_value(const JointMotion& motion, std::size_t value) {
  return std::max(std::fabs(motion.from[value]), std::fabs(motion.to[value]));
}

}  // namespace

std::size_t Linkage::dimension() const {
  return static_cast<std::size_t>(
      std::count_if(links.begin() + (links.empty() ? 0 : 1), links.end(),
                    [](const Link& l) { return l.joint.kind != LinkageJoint::Kind::kFixed; }));
}

void require_valid(const Linkage& linkage) {
  if (linkage.links.empty()) throw InputError("a linkage needs a link, its base");
  for (std::size_t i = 1; i < linkage.links.size(); ++i) {
    const Link& link = linkage.links[i];
    const LinkageJoint& joint = link.joint;
    if (joint.parent >= i) throw InputError("link '" + link.name + "': its parent must come before it");
    const Eigen::Vector4d turn(joint.turn[0], joint.turn[1], joint.turn[2], joint.turn[3]);
    // Squares must neither overflow nor vanish.
    const auto has_direction = [](double square) { return square > 1e-200 && square < 1e200; };
    if (!joint.shift.allFinite() || !has_direction(turn.squaredNorm()) || !has_direction(joint.axis.squaredNorm())) {
      throw InputError("link '" + link.name + "': shift, turn and axis must be finite, and turn and axis not zero");
    }
  }
  for (const auto& [a, b] : linkage.allowed) {
    if (std::max(a, b) >= linkage.links.size()) throw InputError("an allowed pair names a link that does not exist");
  }
}

LinkChain::LinkChain(const Linkage& linkage, std::size_t seen_from, std::size_t moving) {
  const std::vector<Link>& links = linkage.links;
  std::vector<std::size_t> values(links.size());  // the number of each link's value
  std::size_t count = 0;
  for (std::size_t i = 1; i < links.size(); ++i) {
    values[i] = count;
    if (links[i].joint.kind != LinkageJoint::Kind::kFixed) ++count;
  }
  // Up to the link where both ways meet, the larger number first, since parents come before children.
  std::vector<std::size_t> down;
  std::size_t up = seen_from;
  while (up != moving) {
    if (up > moving) {
      add_link(linkage, up, values[up], false);
      up = links[up].joint.parent;
    } else {
      down.push_back(moving);
      moving = links[moving].joint.parent;
    }
  }
  std::for_each(down.rbegin(), down.rend(), [&](std::size_t link) { add_link(linkage, link, values[link], true); });
}

void LinkChain::add_link(const Linkage& linkage, std::size_t link, std::size_t value, bool down) {
  const LinkageJoint& joint = linkage.links[link].joint;
  Step fixed;
  const Matrix3d turn = matrix_of(joint.turn);
  fixed.turn = down ? turn : Matrix3d(turn.transpose());
  fixed.shift = down ? joint.shift : Vector3d(-(turn.transpose() * joint.shift));
  Step moved;
  moved.kind = joint.kind;
  moved.axis = joint.axis.normalized();
  moved.sign = down ? 1 : -1;
  moved.value = value;
  const bool moves = joint.kind != LinkageJoint::Kind::kFixed;
  if (moves) ++joints_;
  if (down) steps_.push_back(fixed);
  if (moves) steps_.push_back(moved);
  if (!down) steps_.push_back(fixed);
}

LinkChain::Place LinkChain::place_at(const JointMotion& motion, double s) const {
  Place place{Matrix3d::Identity(), Vector3d::Zero()};
  for (const Step& step : steps_) {
    switch (step.kind) {
      case LinkageJoint::Kind::kRevolute:
        place.turn *= turn_about(step.axis, step.sign * value_at(motion, step.value, s));
        break;
      case LinkageJoint::Kind::kPrismatic:
        place.shift += place.turn * (step.sign * value_at(motion, step.value, s) * step.axis);
        break;
      case LinkageJoint::Kind::kFixed:
        place.shift += place.turn * step.shift;
        place.turn *= step.turn;
        break;
    }
  }
  return place;
}

LinkChain::Bounds LinkChain::bounds(const JointMotion& motion, double reach) const {
  double far = reach;  // Y
  double speed = 0;    // D
  double bend = 0;     // A
  double largest = 0;
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    if (step->kind == LinkageJoint::Kind::kFixed) {
      far += step->shift.norm();
      continue;
    }
    const double way = std::fabs(motion.to[step->value] - motion.from[step->value]);
    if (step->kind == LinkageJoint::Kind::kRevolute) {
      bend += 2 * way * speed + way * way * far;
      speed += way * far;
      largest = std::max(largest, largest_value(motion, step->value));
    } else {
      far += largest_value(motion, step->value);
      speed += way;
    }
  }
  constexpr double kSpare = 1 + 0x1p-30;  // for the roundings of these sums
  const double steps = static_cast<double>(steps_.size()) + 1;
  return {bend / 8 * kSpare, steps * (100 + 32 * largest) * 0x1p-53 * far * kSpare + MotionCell::kVanished};
}

MotionCell LinkChain::part(const JointMotion& motion, double from, double to, double reach) const {
  const Place begin = place_at(motion, from);
  const Place end = place_at(motion, to);
  const Bounds all = bounds(motion, reach);
  MotionCell cell;
  cell.turn_count = 2;
  cell.turns[0] = begin.turn;
  cell.turns[1] = end.turn;
  cell.position_count = 2;
  cell.positions = {begin.shift, end.shift};
  cell.position_reach = std::max(begin.shift.lpNorm<1>(), end.shift.lpNorm<1>());
  cell.turn_spread = (end.turn - begin.turn).norm();
  cell.position_spread = (end.shift - begin.shift).norm();
  cell.slack = all.bend * (to - from) * (to - from) + all.rounding;
  return cell;
}

MotionCell LinkChain::pose(const JointMotion& motion, double at, double reach) const {
  const Place place = place_at(motion, at);
  MotionCell cell;
  cell.turns[0] = place.turn;
  cell.positions[0] = place.shift;
  cell.position_reach = place.shift.lpNorm<1>();
  cell.slack = bounds(motion, reach).rounding;
  return cell;
}

}  // namespace nef::planner
