// SPDX-License-Identifier: Apache-2.0
//
// From each end grows a tree of nodes. The motion that is tried next leads to the rotation nearest to the other end.
// What was tried in vain is remembered with the depth to which its arc was halved; the next round tries it deeper.
#include "apps/planner/rigid_search/slice_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>

#include "apps/planner/path/path.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/motion_fit.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "apps/planner/rigid_search/rotations.h"
#include "apps/planner/rigid_search/slices.h"

namespace nef::planner {
namespace {

using NodeIndex = std::uint32_t;
constexpr NodeIndex kNoParent = ~0U;

// How fine a round is: the grid's level, and how often arcs between its rotations are halved.
struct Round {
  unsigned level;
  unsigned depth;
};
constexpr std::array<Round, 10> kRounds{Round{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4},
                                        {1, 1},      {1, 2}, {1, 3}, {2, 2}, {2, 3}};

constexpr std::size_t kMostTries = 4;  // pairs of points for a motion between two nodes
constexpr double kSmallestArc = 0.01;  // radians; arcs that are smaller are not halved

}  // namespace

class SliceSearch::State {
 public:
  State(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker, const Monitor& monitor)
      : checker_(checker),
        fit_(checker),
        slices_(scene, monitor),
        ends_{question.start, question.goal},
        metric_(checker.robot().nodes().front().reach),
        reach_(metric_.reach()) {
    for (RigidPose& end : ends_) end.quaternion = canonical(end.quaternion);
  }

  std::optional<std::vector<RigidPose>> run(std::size_t max_slices, const Monitor& monitor) {
    max_slices_ = max_slices;
    is_full_ = false;
    monitor_ = monitor;
    while (nodes_.size() < 2) {
      if (!add_end(nodes_.size())) return std::nullopt;
    }
    for (; round_ < kRounds.size(); ++round_, is_begun_ = false) {
      if (!is_begun_) {
        for (NodeIndex node = 0; node < nodes_.size(); ++node) add_steps(node);
      }
      is_begun_ = true;
      while (!meeting_) {
        const auto step = next_step();
        if (!step) break;
        extend(step->node, step->rotation, kRounds[round_].depth);
        if (!is_full_) continue;
        steps_[nodes_[step->node].end].push(*step);
        return std::nullopt;
      }
      if (meeting_) return path();
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t slices() const { return slices_.made(); }

 private:
  // A component of a slice that is connected with one of the ends.
  struct Node {
    Quaternion rotation;
    const Slice* slice;
    std::size_t component;  // in slice->components
    std::size_t end;        // 0: connected with the start, 1: with the goal
    NodeIndex parent;
    std::vector<RigidPose> joint;  // the certified way from the parent: from a point of it to a point of the node
    [[nodiscard]] const SliceComponent& part() const { return slice->components[component]; }
  };
  struct Step {
    double cost;
    NodeIndex node;
    Quaternion rotation;
    bool operator<(const Step& other) const {  // the queue begins with the largest
      return std::tie(other.cost, other.node, other.rotation) < std::tie(cost, node, rotation);
    }
  };
  // Where the trees meet: the way leads from a node of one to a node of the other.
  struct Meeting {
    NodeIndex from;
    NodeIndex to;
    std::vector<RigidPose> joint;
  };

  // Start and goal are the first two nodes. False if one is in no component with an inside.
  bool add_end(std::size_t end) {
    const RigidPose& pose = ends_[end];
    const Slice& slice = slices_.at(pose.quaternion, monitor_);
    const std::optional<std::size_t> component = slice.component_at(pose.position);
    if (!component) return false;
    if (end == 1 && index_.count({pose.quaternion, *component}) > 0) meeting_ = Meeting{0, 1, {}};
    index_.try_emplace({pose.quaternion, *component}, static_cast<NodeIndex>(end));
    nodes_.push_back({pose.quaternion, &slice, *component, end, kNoParent, {pose}});
    return true;
  }

  // Rotations between those of the round's grid only lead from one to another.
  void add_steps(NodeIndex node) {
    const unsigned level = kRounds[round_].level;
    if (node > 1 && !is_in_grid(nodes_[node].rotation, level)) return;
    for (const Quaternion& next : grid_neighbours(nodes_[node].rotation, level)) add_step(node, next);
    const Quaternion& other = ends_[1 - nodes_[node].end].quaternion;
    constexpr double kWidestCell = 2.0;  // radians, of a cell of the grid of level 0
    if (angle_between(nodes_[node].rotation, other) < kWidestCell / (1U << level)) add_step(node, other);
  }

  void add_step(NodeIndex index, const Quaternion& rotation) {
    const Node& node = nodes_[index];
    const RigidPose& other = ends_[1 - node.end];
    double away = std::numeric_limits<double>::infinity();
    for (const Vector3d& p : node.part().rounded) away = std::min(away, (p - to_vector(other.position)).norm());
    const double cost =
        away + reach_ * (angle_between(rotation, other.quaternion) + angle_between(rotation, node.rotation) / 4);
    steps_[node.end].push({cost, index, rotation});
  }

  // The cheapest step, by turns of both trees; nothing if there is none left.
  std::optional<Step> next_step() {
    turn_ = 1 - turn_;
    if (steps_[turn_].empty()) turn_ = 1 - turn_;
    if (steps_[turn_].empty()) return std::nullopt;
    const Step step = steps_[turn_].top();
    steps_[turn_].pop();
    return step;
  }

  // Joins a node with components at another rotation, halving the arc up to `depth` times where no motion is found.
  // True if one of them is in the same tree then, or the trees have met.
  bool extend(NodeIndex from, const Quaternion& rotation, unsigned depth) {
    if (!slices_.has(rotation) && slices_.made() >= max_slices_) {
      is_full_ = true;
      return false;
    }
    bool reached = false;
    bool is_open = false;  // a component nearby is not in the tree
    const Slice& slice = slices_.at(rotation, monitor_);
    for (std::size_t component = 0; component < slice.components.size() && !meeting_; ++component) {
      switch (join(from, rotation, slice, component)) {
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
    if (meeting_ || !is_open || depth == 0) return reached || meeting_;
    unsigned& halved = halved_[{from, rotation}];
    if (halved >= depth) return reached;
    const unsigned before = halved;
    halved = depth;
    reached = extend_by_halves(from, rotation, depth) || reached;
    if (is_full_) halved_[{from, rotation}] = before;
    return reached || meeting_;
  }

  bool extend_by_halves(NodeIndex from, const Quaternion& rotation, unsigned depth) {
    const Quaternion begin = nodes_[from].rotation;
    if (angle_between(begin, rotation) < kSmallestArc) return false;
    const Quaternion middle = canonical(rotation_at(begin, rotation, Rational(1, 2)));
    if (!extend(from, middle, depth - 1) || is_full_) return false;
    bool reached = false;
    const std::size_t components = slices_.at(middle, monitor_).components.size();
    for (std::size_t i = 0; i < components && !meeting_ && !is_full_; ++i) {
      const auto node = index_.find({middle, i});
      if (node == index_.end() || nodes_[node->second].end != nodes_[from].end) continue;
      reached = extend(node->second, rotation, depth - 1) || reached;
    }
    return reached;
  }

  // Whether a component is in the tree of a node.
  enum class Joined : std::uint8_t { kNo, kYes, kTooFar };

  // Joins a node with a component, unless that was tried before.
  Joined join(NodeIndex from, const Quaternion& rotation, const Slice& slice, std::size_t component) {
    const auto known = index_.find({rotation, component});
    if (known != index_.end() && nodes_[known->second].end == nodes_[from].end) return Joined::kYes;
    const auto [tried, is_new] = tried_.try_emplace({from, rotation, component}, Joined::kNo);
    if (!is_new) return tried->second;
    const std::vector<Ends> ends = nearest_points(nodes_[from], slice, component);
    if (ends.empty() || ends.front().distance > reach_ * angle_between(nodes_[from].rotation, rotation)) {
      return tried->second = Joined::kTooFar;
    }
    std::vector<RigidPose> joint;
    for (std::size_t i = 0; i < ends.size() && joint.empty(); ++i) {
      joint = fitted(nodes_[from], rotation, slice, component, ends[i]);
    }
    if (joint.empty()) return Joined::kNo;
    if (known != index_.end()) {
      meeting_ = Meeting{from, known->second, std::move(joint)};
      return Joined::kYes;
    }
    const auto node = static_cast<NodeIndex>(nodes_.size());
    index_.emplace(std::pair(rotation, component), node);
    nodes_.push_back({rotation, &slice, component, nodes_[from].end, from, std::move(joint)});
    add_steps(node);
    return Joined::kYes;
  }

  // A point of a node and one of a component at another rotation.
  struct Ends {
    double distance;
    Vector3d from;
    Vector3d to;
  };

  // Some pairs of points that are near each other, those first at which the robot may turn on the spot.
  [[nodiscard]] std::vector<Ends> nearest_points(const Node& node, const Slice& slice, std::size_t component) const {
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
    std::vector<Ends> result = spread(shared);
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

  // The first of some pairs, and the one that is farthest from it.
  [[nodiscard]] static std::vector<Ends> spread(const std::vector<Ends>& ends) {
    if (ends.size() < 2) return ends;
    const auto farthest = std::max_element(ends.begin(), ends.end(), [&](const Ends& a, const Ends& b) {
      return (a.from - ends.front().from).squaredNorm() < (b.from - ends.front().from).squaredNorm();
    });
    return {ends.front(), *farthest};
  }

  // A certified motion from a node to a component, beginning and ending near two points; nothing if there is none.
  [[nodiscard]] std::vector<RigidPose> fitted(const Node& node, const Quaternion& rotation, const Slice& slice,
                                              std::size_t component, const Ends& ends) const {
    monitor_.check_interruption();
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
      const double gap = fit_.fit(rotations, positions, reach_ / 4, reach_ / 50);
      if (gap < -reach_ / 64) return {};
    }
    std::vector<RigidPose> poses;
    for (std::size_t i = 0; i <= parts; ++i) poses.push_back({metric_.exact(positions[i]), rotations[i]});
    if (node.slice->component_at(poses.front().position) != node.component) return {};
    if (slice.component_at(poses.back().position) != component) return {};
    for (std::size_t i = 0; i < parts; ++i) {
      if (!moves_freely(checker_, poses[i], poses[i + 1])) return {};
    }
    return poses;
  }

  [[nodiscard]] static Rational3 exact(const Vector3d& p) {
    return {exact_rational(p[0]), exact_rational(p[1]), exact_rational(p[2])};
  }

  // The nodes from an end to a node, in this order.
  [[nodiscard]] std::vector<NodeIndex> ancestry(NodeIndex node) const {
    std::vector<NodeIndex> result;
    for (; node != kNoParent; node = nodes_[node].parent) result.push_back(node);
    std::reverse(result.begin(), result.end());
    return result;
  }

  [[nodiscard]] std::vector<RigidPose> path() const {
    const bool from_start = nodes_[meeting_->from].end == 0;
    std::vector<RigidPose> result{ends_[0]};
    const auto go = [&](std::vector<RigidPose> joint, const Node& first, bool back) {
      if (back) std::reverse(joint.begin(), joint.end());
      translate(first, joint.front().position, result);
      result.insert(result.end(), joint.begin() + 1, joint.end());
    };
    const std::vector<NodeIndex> begin = ancestry(from_start ? meeting_->from : meeting_->to);
    for (std::size_t i = 1; i < begin.size(); ++i) go(nodes_[begin[i]].joint, nodes_[begin[i - 1]], false);
    if (!meeting_->joint.empty()) go(meeting_->joint, nodes_[begin.back()], !from_start);
    const std::vector<NodeIndex> end = ancestry(from_start ? meeting_->to : meeting_->from);
    for (std::size_t i = end.size(); i-- > 1;) go(nodes_[end[i]].joint, nodes_[end[i]], true);
    translate(nodes_[1], ends_[1].position, result);
    return result;
  }

  // Goes on to another position within a node.
  void translate(const Node& node, const Rational3& to, std::vector<RigidPose>& path) const {
    const Rational3 from = path.back().position;
    if (from == to) return;
    PathOptions options;
    options.thorough = false;
    options.clearance = true;
    const std::optional<ExactPath> way = find_path(*node.slice->free, from, to, options, monitor_);
    NEF_ASSERT(way.has_value());
    for (std::size_t i = 1; i < way->points.size(); ++i) path.push_back({way->points[i], node.rotation});
  }

  const MotionChecker& checker_;
  MotionFit fit_;
  Slices slices_;
  std::array<RigidPose, 2> ends_;
  PoseMetric metric_;
  double reach_;
  std::size_t max_slices_ = 0;
  bool is_full_ = false;
  Monitor monitor_;
  std::size_t round_ = 0;
  bool is_begun_ = false;
  std::size_t turn_ = 1;
  std::vector<Node> nodes_;
  std::map<std::pair<Quaternion, std::size_t>, NodeIndex> index_;
  std::map<std::tuple<NodeIndex, Quaternion, std::size_t>, Joined> tried_;
  std::map<std::pair<NodeIndex, Quaternion>, unsigned> halved_;
  std::array<std::priority_queue<Step>, 2> steps_;
  std::optional<Meeting> meeting_;
};

SliceSearch::SliceSearch(const Scene& scene, const RigidQuestion& question, const MotionChecker& checker,
                         const Monitor& monitor)
    : state_(std::make_unique<State>(scene, question, checker, monitor)) {}
SliceSearch::~SliceSearch() = default;

std::optional<std::vector<RigidPose>> SliceSearch::run(std::size_t max_slices, const Monitor& monitor) {
  return state_->run(max_slices, monitor);
}
std::size_t SliceSearch::slices() const { return state_->slices(); }

}  // namespace nef::planner
