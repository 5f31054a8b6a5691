// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/runs/parts/range_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "apps/planner/command/scene_view.h"
#include "apps/planner/intersection/vectors.h"

namespace nef::planner {
namespace {

using Values = std::array<Rational, 2>;

constexpr unsigned kShownBits = 60;  // of what is shown

// The values between which nothing collides for longest; nothing if that is nowhere longer than a point.
std::optional<Values> longest_stretch(const RangeOfMotion& range, const Joint& joint) {
  std::optional<Values> best;
  double longest = 0;
  std::optional<Rational> begin;
  for (const RangePart& part : range.parts) {
    if (part.status == RangeStatus::kColliding || part.status == RangeStatus::kUndecided) {
      begin.reset();
      continue;
    }
    if (!begin) begin = enclosure(part.from.value, kShownBits)[1];
    const Rational end = enclosure(part.to.value, kShownBits)[0];
    const double length = joint.measure_of(end) - joint.measure_of(*begin);
    if (length <= longest) continue;
    longest = length;
    best = {*begin, end};
  }
  return best;
}

// Pages and glTF files move straight between the times that they are given, so turns are cut into small ones.
std::vector<Rational> shown_values(const Values& ends, const Joint& joint) {
  constexpr double kDegrees = 4;
  constexpr double kMostSteps = 2000;
  const double degrees = joint.measure_of(ends[1]) - joint.measure_of(ends[0]);
  const bool straight = joint.kind() == Joint::Kind::kSlider;
  const auto count = static_cast<unsigned>(straight ? 1 : std::clamp(std::ceil(degrees / kDegrees), 1.0, kMostSteps));
  std::vector<Rational> values;
  for (unsigned i = 0; i <= count; ++i) values.push_back(ends[0] + (ends[1] - ends[0]) * Rational(i, count));
  return values;
}

}  // namespace

std::vector<view::Layer> range_layers(const RangeOfMotion& range, const Mechanism& m) {
  std::vector<ShownSet> sets{{"moving", m.moving, kRobotColor}};
  for (std::size_t i = 0; i < m.fixed.size(); ++i) {
    sets.push_back({m.fixed_names[i], m.fixed[i], kObstaclesColor, kObstaclesOpacity});
  }
  std::vector<view::Layer> layers = layers_of(sets);
  const std::optional<Values> ends = longest_stretch(range, m.joint);
  if (!ends) return layers;
  const std::array<Rational3, 2> box = *bounding_box(m.moving);
  const Vector3d pivot = (to_vector(box[0]) + to_vector(box[1])) / 2;
  const Vector3d origin = to_vector(m.joint.point());  // of poses
  const double from = m.joint.measure_of((*ends)[0]);
  const double length = m.joint.measure_of((*ends)[1]) - from;
  view::Motion& motion = layers[0].motion;
  motion.pivot = {pivot[0], pivot[1], pivot[2]};
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (const Rational& value : shown_values(*ends, m.joint)) {
    const MotionCell pose = m.joint.sweep(value, value, 0).middle;
    const Vector3d offset = pose.turns[0] * (pivot - origin) + pose.positions[0] + origin - pivot;
    Eigen::Quaterniond turn = Eigen::Quaterniond(pose.turns[0]).normalized();
    if (turn.dot(before) < 0) turn.coeffs() *= -1;  // the shorter arc
    before = turn;
    motion.times.push_back(kPlaySeconds * (m.joint.measure_of(value) - from) / length);
    motion.offsets.push_back({offset[0], offset[1], offset[2]});
    motion.turns.push_back({turn.w(), turn.x(), turn.y(), turn.z()});
  }
  return layers;
}

}  // namespace nef::planner
