// SPDX-License-Identifier: Apache-2.0
//
// A part is at a pose of the world: what it did with others before, and first, within these, what it does now. Turns
// are cut into small ones, between which moving straight looks like the motion itself, whatever point it turns about.
#include "apps/planner/command/runs/parts/assembly_view.h"

#include <algorithm>
#include <cmath>

#include "apps/planner/command/scene_view.h"
#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid_search/pose_metric.h"

namespace nef::planner {
namespace {

// Where a part is: v goes to turn * v + move.
struct Place {
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Vector3d move = Vector3d::Zero();
};

// A place on a way, and how long the way is up to there.
struct OnWay {
  Place place;
  double way = 0;
};

// The places of a part in a step, relative to where the step began; none if it rests.
std::vector<OnWay> way_in(const DisassemblyStep& step, std::size_t part, double reach) {
  const auto found = std::find(step.parts.begin(), step.parts.end(), part);
  if (found == step.parts.end()) return {};
  std::vector<OnWay> result;
  if (!step.vectors.empty()) {
    const Vector3d end = to_vector(step.vectors[static_cast<std::size_t>(found - step.parts.begin())]);
    return {{}, {{Eigen::Quaterniond::Identity(), end}, end.norm()}};
  }
  if (!step.turning) {
    for (const Rational3& point : step.path) {
      const Vector3d at = to_vector(point);
      const double way = result.empty() ? 0 : result.back().way + (at - result.back().place.move).norm();
      result.push_back({{Eigen::Quaterniond::Identity(), at}, way});
    }
    return result;
  }
  constexpr double kSmallTurn = 0.1;
  const Vector3d pivot = to_vector(step.turning->pivot);
  const auto place = [&pivot](const Eigen::Quaterniond& turn, const Vector3d& position) {
    return Place{turn, position + pivot - turn * pivot};
  };
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Vector3d position = Vector3d::Zero();
  result.emplace_back();
  for (const RigidPose& pose : step.turning->poses) {
    const Eigen::Quaterniond next = PoseMetric::rounded(pose.quaternion);
    const Vector3d at = to_vector(pose.position);
    const double angle = turn.angularDistance(next);
    const int pieces = 1 + static_cast<int>(angle / kSmallTurn);
    const double length = (at - position).norm() + reach * angle;
    const double begin = result.back().way;
    for (int i = 1; i <= pieces && length > 0; ++i) {
      const double t = static_cast<double>(i) / pieces;
      result.push_back({place(turn.slerp(t, next), position + t * (at - position)), begin + t * length});
    }
    turn = next;
    position = at;
  }
  return result;
}

}  // namespace

std::vector<view::Layer> assembly_layers(const Disassembly& answer, const Assembly& assembly) {
  std::vector<ShownSet> parts;
  for (std::size_t part = 0; part < assembly.parts.size(); ++part) {
    parts.push_back({assembly.names[part], assembly.parts[part], view::palette_color(part)});
  }
  std::vector<view::Layer> layers = layers_of(parts);
  if (answer.steps.empty()) return layers;
  const double slot = kPlaySeconds / static_cast<double>(answer.steps.size());
  for (std::size_t part = 0; part < layers.size(); ++part) {
    view::Motion& motion = layers[part].motion;
    const bool turns = std::any_of(answer.steps.begin(), answer.steps.end(), [part](const DisassemblyStep& step) {
      return step.turning && std::find(step.parts.begin(), step.parts.end(), part) != step.parts.end();
    });
    const std::array<Rational3, 2> box = *bounding_box(assembly.parts[part]);
    const Vector3d low = to_vector(box[0]);
    const Vector3d high = to_vector(box[1]);
    const Vector3d pivot = (low + high) / 2;
    motion.pivot = {pivot[0], pivot[1], pivot[2]};
    Place before;
    const auto add = [&](double time, const Place& place) {
      if (!motion.times.empty() && !(time > motion.times.back())) return;
      motion.times.push_back(time);
      const Vector3d offset = place.turn * pivot + place.move - pivot;
      motion.offsets.push_back({offset[0], offset[1], offset[2]});
      if (turns) motion.turns.push_back({place.turn.w(), place.turn.x(), place.turn.y(), place.turn.z()});
    };
    add(0, before);
    for (std::size_t k = 0; k < answer.steps.size(); ++k) {
      const std::vector<OnWay> way = way_in(answer.steps[k], part, (high - low).norm() / 2);
      Place now = before;
      for (const OnWay& on : way) {
        now = {before.turn * on.place.turn, before.turn * on.place.move + before.move};
        if (way.back().way > 0) add(slot * (static_cast<double>(k) + on.way / way.back().way), now);
      }
      before = now;
      add(slot * static_cast<double>(k + 1), before);
    }
  }
  return layers;
}

}  // namespace nef::planner
