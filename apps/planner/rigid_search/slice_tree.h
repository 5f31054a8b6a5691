// SPDX-License-Identifier: Apache-2.0
//
// What of slices is connected with one end of a path.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid_search/motion_fit.h"
#include "apps/planner/rigid_search/pose_metric.h"
#include "apps/planner/rigid_search/slices.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A tree of components of slices. What it knows of the other tree is what that one knew when it was settled last, so
/// both may grow at the same time, each on a thread of its own.
class SliceTree {
 public:
  using NodeIndex = std::uint32_t;
  static constexpr NodeIndex kNoParent = ~0U;
  /// A component of a slice: the canonical rotation, and its place in Slice::components.
  using Place = std::pair<Quaternion, std::size_t>;

  struct Node {
    Quaternion rotation;
    const Slice* slice;
    std::size_t component;  ///< in slice->components
    NodeIndex parent;
    /// The certified way from the parent: from a point of it to a point of the node.
    std::vector<RigidPose> joint;
    [[nodiscard]] const SliceComponent& part() const { return slice->components[component]; }
  };

  /// A way from a node to one of the other tree; without a joint both are the same component.
  struct Meeting {
    NodeIndex from = 0;
    NodeIndex to = 0;
    std::vector<RigidPose> joint;
  };

  /// What came of a step.
  struct Growth {
    std::optional<Meeting> meeting;  ///< from this tree to the other one
    bool is_full = false;            ///< it takes more slices than were allowed; another try goes on with it
    std::set<Quaternion> slices;     ///< that were asked for, as Slices::shared names them
  };

  /// All of these must outlive it. `root` is the free pose where it begins, `other` where the other tree does.
  SliceTree(const MotionChecker& checker, const MotionFit& fit, const PoseMetric& metric, Slices& slices,
            const RigidPose& root, const RigidPose& other);

  /// The node of the root; false if that is in no component with an inside.
  bool plant(const Monitor& monitor);
  [[nodiscard]] bool is_planted() const { return !nodes_.empty(); }

  /// All steps from its nodes on the grid of rotations of a level (rotations.h).
  void add_steps(unsigned level);
  [[nodiscard]] bool has_steps() const { return !steps_.empty(); }

  /// Makes the cheapest step: joins a node with components at another rotation, halving the arc up to `depth` times
  /// where no motion is found. Up to `allowed` slices are made that are not in `made`.
  Growth grow(const SliceTree& other, unsigned depth, const std::set<Quaternion>& made, std::size_t allowed,
              const Monitor& monitor);
  /// Lets the other tree know of all nodes. The first of those that it did not know and that are nodes of the other
  /// one, too, as that one knows them; to be called when neither grows.
  std::optional<Meeting> settle(const SliceTree& other);

  [[nodiscard]] const Node& operator[](NodeIndex node) const { return nodes_[node]; }
  /// The nodes from the root to a node, in this order.
  [[nodiscard]] std::vector<NodeIndex> ancestry(NodeIndex node) const;

 private:
  struct Step {
    double cost;
    NodeIndex node;
    Quaternion rotation;
    bool operator<(const Step& other) const {  // the queue begins with the largest
      return std::tie(other.cost, other.node, other.rotation) < std::tie(cost, node, rotation);
    }
  };
  // Whether a component is in the tree.
  enum class Joined : std::uint8_t { kNo, kYes, kTooFar };
  // A point of a node and one of a component at another rotation.
  struct Ends {
    double distance;
    Vector3d from;
    Vector3d to;
  };
  // A step on its way.
  struct Context {
    const SliceTree& other;
    const std::set<Quaternion>& made;
    std::size_t allowed;
    const Monitor& monitor;
    Growth& growth;
  };

  void add_steps(NodeIndex node, unsigned level);
  void add_step(NodeIndex index, const Quaternion& rotation);
  [[nodiscard]] std::optional<NodeIndex> find(const Place& place) const;
  bool extend(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context);
  bool extend_by_halves(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context);
  Joined join(NodeIndex from, const Quaternion& rotation, const Slice& slice, std::size_t component,
              const Context& context);
  [[nodiscard]] std::vector<Ends> nearest_points(const Node& node, const Slice& slice, std::size_t component) const;
  [[nodiscard]] std::vector<RigidPose> first_fit(const Node& node, const Quaternion& rotation, const Slice& slice,
                                                 std::size_t component, const std::vector<Ends>& ends,
                                                 const Monitor& monitor) const;
  [[nodiscard]] std::vector<RigidPose> fitted(const Node& node, const Quaternion& rotation, const Slice& slice,
                                              std::size_t component, const Ends& ends, const Monitor& monitor) const;

  const MotionChecker& checker_;
  const MotionFit& fit_;
  const PoseMetric& metric_;
  Slices& slices_;
  RigidPose root_;
  RigidPose goal_;
  double reach_;
  unsigned level_ = 0;
  std::vector<Node> nodes_;
  std::map<Place, NodeIndex> index_;  // of what the other tree may know
  std::map<Place, NodeIndex> fresh_;  // of the others
  std::map<std::tuple<NodeIndex, Quaternion, std::size_t>, Joined> tried_;
  std::map<std::pair<NodeIndex, Quaternion>, unsigned> halved_;
  std::priority_queue<Step> steps_;
};

}  // namespace nef::planner
