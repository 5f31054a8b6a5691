// SPDX-License-Identifier: Apache-2.0
//
// What was tried in vain is remembered with the depth to which its arc was halved; the next round tries it deeper.
#include "apps/planner/rigid_search/slice_tree.h"

#include <algorithm>
#include <limits>

#include "apps/planner/orientation/rotations.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/first_true.h"

namespace nef::planner {
namespace {

constexpr std::size_t kMostTries = 4;  // pairs of points for a motion between two nodes
constexpr double kSmallestArc = 0.01;  // radians; arcs that are smaller are not halved

Rational3 exact(const Vector3d& p) { return {exact_rational(p[0]), exact_rational(p[1]), exact_rational(p[2])}; }

}  // namespace

SliceTree::SliceTree(const MotionChecker& checker, const MotionFit& fit, const PoseMetric& metric, Slices& slices,
                     const std::set<Quaternion>& aligned, const RigidPose& root, const RigidPose& other)
    : checker_(checker),
      fit_(fit),
      metric_(metric),
      slices_(slices),
      aligned_(aligned),
      root_(root),
      goal_(other),
      reach_(metric.reach()) {
  root_.quaternion = canonical(root_.quaternion);
  goal_.quaternion = canonical(goal_.quaternion);
}

bool SliceTree::plant(const Monitor& monitor) {
  const Slice& slice = slices_.at(root_.quaternion, monitor);
  const std::optional<std::size_t> component = slice.component_at(root_.position);
  if (!component) return false;
  fresh_.emplace(Place(root_.quaternion, *component), 0);
  nodes_.push_back({root_.quaternion, &slice, *component, kNoParent, {root_}});
  return true;
}

void SliceTree::add_steps(unsigned level) {
  level_ = level;
  for (NodeIndex node = 0; node < nodes_.size(); ++node) add_steps(node, level);
}

// Rotations that halve arcs only lead from one end to the other.
void SliceTree::add_steps(NodeIndex node, unsigned level) {
  const Quaternion& rotation = nodes_[node].rotation;
  if (node > 0 && !is_in_grid(rotation, level) && aligned_.count(rotation) == 0) return;
  for (const Quaternion& next : grid_neighbours(rotation, level)) add_step(node, next);
  constexpr double kWidestCell = 2.0;  // radians, of a cell of the grid of level 0
  const auto is_near = [&](const Quaternion& to) { return angle_between(rotation, to) < kWidestCell / (1U << level); };
  for (const Quaternion& aligned : aligned_) {
    if (is_near(aligned) && aligned != rotation) add_step(node, aligned);
  }
  if (is_near(goal_.quaternion)) add_step(node, goal_.quaternion);
}

void SliceTree::add_step(NodeIndex index, const Quaternion& rotation) {
  const Node& node = nodes_[index];
  const Vector3d goal = to_vector(goal_.position);
  double away = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : node.part().rounded) away = std::min(away, (p - goal).norm());
  const double cost =
      away + reach_ * (angle_between(rotation, goal_.quaternion) + angle_between(rotation, node.rotation) / 4);
  steps_.insert({cost, index, rotation});
}

std::optional<SliceTree::NodeIndex> SliceTree::find(const Place& place) const {
  for (const auto* index : {&index_, &fresh_}) {
    const auto found = index->find(place);
    if (found != index->end()) return found->second;
  }
  return std::nullopt;
}

SliceTree::Growth SliceTree::grow(const SliceTree& other, unsigned depth, const std::set<Quaternion>& made,
                                  std::size_t allowed, const Monitor& monitor, const std::function<bool()>& meanwhile) {
  Growth growth;
  const Step step = *steps_.begin();
  steps_.erase(steps_.begin());
  extend(step.node, step.rotation, depth, {other, made, allowed, monitor, meanwhile, growth});
  if (growth.is_full) steps_.insert(step);
  return growth;
}

std::optional<SliceTree::Meeting> SliceTree::settle(const SliceTree& other) {
  std::optional<Meeting> meeting;
  for (const auto& [place, node] : fresh_) {
    const auto known = other.index_.find(place);
    if (known != other.index_.end() && !meeting) meeting = Meeting{node, known->second, {}};
  }
  index_.merge(fresh_);
  return meeting;
}

// True if one of the components is in the tree then, or the trees have met.
bool SliceTree::extend(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context) {
  Growth& growth = context.growth;
  const Quaternion& key = slices_.shared(rotation);
  if (context.made.count(key) == 0 && growth.slices.count(key) == 0) {
    if (growth.slices.size() >= context.allowed) {
      growth.is_full = true;
      return false;
    }
    growth.slices.insert(key);
  }
  bool reached = false;
  bool is_open = false;  // a component nearby is not in the tree
  const Slice& slice = slices_.at(rotation, context.monitor, context.meanwhile);
  for (std::size_t component = 0; component < slice.components.size() && !growth.meeting; ++component) {
    switch (join(from, rotation, slice, component, context)) {
      case Joined::kYes:
        reached = true;
        break;
      case Joined::kNo:
        is_open = true;
        break;
      case Joined::kTooFar:
        break;
    }
  }
  if (growth.meeting || !is_open || depth == 0) return reached || growth.meeting;
  unsigned& halved = halved_[{from, rotation}];
  if (halved >= depth) return reached;
  const unsigned before = halved;
  halved = depth;
  reached = extend_by_halves(from, rotation, depth, context) || reached;
  if (growth.is_full) halved_[{from, rotation}] = before;
  return reached || growth.meeting;
}

bool SliceTree::extend_by_halves(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context) {
  const Growth& growth = context.growth;
  const Quaternion begin = nodes_[from].rotation;
  if (angle_between(begin, rotation) < kSmallestArc) return false;
  const Quaternion middle = canonical(rotation_at(begin, rotation, Rational(1, 2)));
  if (!extend(from, middle, depth - 1, context) || growth.is_full) return false;
  bool reached = false;
  const std::size_t components = slices_.at(middle, context.monitor).components.size();
  for (std::size_t i = 0; i < components && !growth.meeting && !growth.is_full; ++i) {
    const std::optional<NodeIndex> node = find({middle, i});
    if (node) reached = extend(*node, rotation, depth - 1, context) || reached;
  }
  return reached;
}

// Joins a node with a component, unless that was tried before.
SliceTree::Joined SliceTree::join(NodeIndex from, const Quaternion& rotation, const Slice& slice, std::size_t component,
                                  const Context& context) {
  if (find({rotation, component})) return Joined::kYes;
  Joint& found = joint_of({from, &nodes_[from], rotation, &slice, component}, context.monitor, context.meanwhile);
  if (found.is_far) return Joined::kTooFar;
  if (found.poses.empty()) return Joined::kNo;
  std::vector<RigidPose> joint = std::move(found.poses);
  const auto there = context.other.index_.find({rotation, component});
  if (there != context.other.index_.end()) {
    context.growth.meeting = Meeting{from, there->second, std::move(joint)};
    return Joined::kYes;
  }
  const auto node = static_cast<NodeIndex>(nodes_.size());
  fresh_.emplace(Place(rotation, component), node);
  nodes_.push_back({rotation, &slice, component, from, std::move(joint)});
  add_steps(node, level_);
  return Joined::kYes;
}

SliceTree::Joint& SliceTree::joint_of(const Work& work, const Monitor& monitor,
                                      const std::function<bool()>& meanwhile) {
  return joints_.at(
      {work.index, work.rotation, work.component}, [&] { return made_joint(work, monitor); }, meanwhile);
}

SliceTree::Joint SliceTree::made_joint(const Work& work, const Monitor& monitor) const {
  const std::vector<Ends> ends = nearest_points(*work.node, *work.slice, work.component);
  if (ends.empty() || ends.front().distance > reach_ * angle_between(work.node->rotation, work.rotation)) {
    return {true, {}};
  }
  return {false, first_fit(*work.node, work.rotation, *work.slice, work.component, ends, monitor)};
}

std::vector<SliceTree::Work> SliceTree::foreseen(unsigned depth, std::size_t most) {
  std::vector<Work> result;
  constexpr std::size_t kSteps = 64;
  std::size_t seen = 0;
  for (auto step = steps_.begin(); step != steps_.end() && result.size() < most && seen < kSteps; ++step, ++seen) {
    if (seen == 0) continue;
    if (auto work = foreseen(step->node, step->rotation, depth)) result.push_back(*work);
  }
  if (result.size() < most && !steps_.empty()) {
    if (auto work = foreseen(steps_.begin()->node, steps_.begin()->rotation, depth)) result.push_back(*work);
  }
  return result;
}

// As extend and extend_by_halves will do it, up to where it depends on what is not known yet.
std::optional<SliceTree::Work> SliceTree::foreseen(NodeIndex from, const Quaternion& rotation, unsigned depth) {
  const auto slice = slices_.known(rotation);
  if (slice.is_being_made) return std::nullopt;
  Work work{from, &nodes_[from], rotation, slice.value};
  if (slice.value == nullptr) return work;
  bool is_open = false;
  for (; work.component < slice.value->components.size(); ++work.component) {
    if (find({rotation, work.component})) continue;
    const auto joint = joints_.known({from, rotation, work.component});
    if (joint.is_being_made) return std::nullopt;
    if (joint.value == nullptr) return work;
    is_open = is_open || (!joint.value->is_far && joint.value->poses.empty());
  }
  if (!is_open || depth == 0) return std::nullopt;
  const auto halved = halved_.find({from, rotation});
  if (halved != halved_.end() && halved->second >= depth) return std::nullopt;
  return foreseen_by_halves(from, rotation, depth);
}

std::optional<SliceTree::Work> SliceTree::foreseen_by_halves(NodeIndex from, const Quaternion& rotation,
                                                             unsigned depth) {
  const Quaternion begin = nodes_[from].rotation;
  if (angle_between(begin, rotation) < kSmallestArc) return std::nullopt;
  const Quaternion middle = canonical(rotation_at(begin, rotation, Rational(1, 2)));
  if (auto work = foreseen(from, middle, depth - 1)) return work;
  const Slice* slice = slices_.known(middle).value;
  for (std::size_t i = 0; slice != nullptr && i < slice->components.size(); ++i) {
    const std::optional<NodeIndex> node = find({middle, i});
    if (!node) continue;
    if (auto work = foreseen(*node, rotation, depth - 1)) return work;
  }
  return std::nullopt;
}

void SliceTree::do_ahead(const Work& work, const Monitor& monitor) {
  if (work.slice == nullptr) {
    const auto known = slices_.known(work.rotation);
    if (known.value == nullptr && !known.is_being_made) (void)slices_.at(work.rotation, monitor);
  } else if (!joints_.known({work.index, work.rotation, work.component}).is_being_made) {
    (void)joint_of(work, monitor);
  }
}

// Some pairs of points that are near each other, those first at which the robot may turn on the spot.
std::vector<SliceTree::Ends> SliceTree::nearest_points(const Node& node, const Slice& slice,
                                                       std::size_t component) const {
  std::vector<Vector3d> points = node.part().rounded;
  points.push_back(to_vector(node.joint.back().position));
  const std::vector<Vector3d>& others = slice.components[component].rounded;
  std::vector<Ends> shared;
  for (const Vector3d& p : points) {
    if (slice.component_at(exact(p)) == component) shared.push_back({0, p, p});
  }
  for (const Vector3d& p : others) {
    if (node.slice->component_at(exact(p)) == node.component) shared.push_back({0, p, p});
  }
  std::vector<Ends> result = shared;
  if (shared.size() > 1) {  // the first one, and the one that is farthest from it
    result = {shared.front(), *std::max_element(shared.begin(), shared.end(), [&](const Ends& a, const Ends& b) {
                return (a.from - shared.front().from).squaredNorm() < (b.from - shared.front().from).squaredNorm();
              })};
  }
  std::vector<Ends> near;
  for (const Vector3d& b : others) {
    Ends best{std::numeric_limits<double>::infinity(), {}, b};
    for (const Vector3d& a : points) {
      if ((a - b).norm() < best.distance) best = {(a - b).norm(), a, b};
    }
    near.push_back(best);
  }
  std::stable_sort(near.begin(), near.end(), [](const Ends& a, const Ends& b) { return a.distance < b.distance; });
  for (std::size_t i = 0; i < near.size() && result.size() < kMostTries; ++i) result.push_back(near[i]);
  return result;
}

// The motion of the first of some pairs of points that has one, however many threads look at others meanwhile.
std::vector<RigidPose> SliceTree::first_fit(const Node& node, const Quaternion& rotation, const Slice& slice,
                                            std::size_t component, const std::vector<Ends>& ends,
                                            const Monitor& monitor) const {
  std::vector<std::vector<RigidPose>> found(ends.size());
  const std::size_t first = first_true(ends.size(), monitor, [&](std::size_t i, const Monitor& own) {
    found[i] = fitted(node, rotation, slice, component, ends[i], own);
    return !found[i].empty();
  });
  return first < ends.size() ? std::move(found[first]) : std::vector<RigidPose>();
}

// A certified motion from a node to a component, beginning and ending near two points; nothing if there is none.
std::vector<RigidPose> SliceTree::fitted(const Node& node, const Quaternion& rotation, const Slice& slice,
                                         std::size_t component, const Ends& ends, const Monitor& monitor) const {
  const double angle = angle_between(node.rotation, rotation);
  const std::size_t parts = angle > 0.6 ? 8 : angle > 0.15 ? 4 : 2;
  std::vector<Quaternion> rotations;
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i <= parts; ++i) {
    const Rational share = Rational(static_cast<long>(i)) / static_cast<long>(parts);
    rotations.push_back(i == 0       ? node.rotation
                        : i == parts ? rotation
                                     : canonical(rotation_at(node.rotation, rotation, share)));
    positions.emplace_back(ends.from + (ends.to - ends.from) * (static_cast<double>(i) / static_cast<double>(parts)));
  }
  if (fit_.is_worthwhile()) {
    const double gap = fit_.fit(rotations, positions, reach_ / 4, reach_ / 50, monitor);
    if (gap < -reach_ / 64) return {};
  }
  std::vector<RigidPose> poses;
  for (std::size_t i = 0; i <= parts; ++i) poses.push_back({metric_.exact(positions[i]), rotations[i]});
  if (node.slice->component_at(poses.front().position) != node.component) return {};
  if (slice.component_at(poses.back().position) != component) return {};
  const std::size_t blocked = first_true(parts, monitor, [&](std::size_t i, const Monitor& own) {
    return !moves_freely(checker_, poses[i], poses[i + 1], own);
  });
  return blocked == parts ? poses : std::vector<RigidPose>();
}

std::vector<SliceTree::NodeIndex> SliceTree::ancestry(NodeIndex node) const {
  std::vector<NodeIndex> result;
  for (; node != kNoParent; node = nodes_[node].parent) result.push_back(node);
  std::reverse(result.begin(), result.end());
  return result;
}

}  // namespace nef::planner
