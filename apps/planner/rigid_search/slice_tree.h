// SPDX-License-Identifier: Apache-2.0
//
// What of slices is connected with one end of a path: a tree whose nodes are components of slices, and a queue of steps
// from them to other rotations, the one with the shortest way to the other end first. A step makes the slice there and
// looks for certified motions to its components; where there is none, it makes the slice halfway and tries both halves.
// Slices and motions are in tables (made_once.h), so other threads can make them ahead of the step that asks for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid_search/made_once.h"
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

  /// All of these must outlive it. `aligned`: rotations that steps lead to besides those of the grid. `root` is the
  /// free pose where it begins, `other` where the other tree does.
  SliceTree(const MotionChecker& checker, const MotionFit& fit, const PoseMetric& metric, Slices& slices,
            const std::set<Quaternion>& aligned, const RigidPose& root, const RigidPose& other);

  /// Makes the slice that `plant` asks for.
  void prepare(const Monitor& monitor) { (void)slices_.at(root_.quaternion, monitor); }
  /// The node of the root; false if that is in no component with an inside.
  bool plant(const Monitor& monitor);
  [[nodiscard]] bool is_planted() const { return !nodes_.empty(); }

  /// All steps from its nodes to the grid of rotations of a level (rotations.h), and to aligned rotations nearby.
  void add_steps(unsigned level);
  [[nodiscard]] bool has_steps() const { return !steps_.empty(); }

  /// A part of a step that does not change the tree: the slice at a rotation, or, with a component of it, the way there
  /// from a node.
  struct Work {
    NodeIndex index;
    const Node* node;
    Quaternion rotation;
    const Slice* slice = nullptr;
    std::size_t component = 0;
  };
  /// What the next steps will ask for first, if the trees do not meet before: up to `most` pieces of work, each of
  /// another step. That of the cheapest one, which is likely to begin at once, comes last.
  std::vector<Work> foreseen(unsigned depth, std::size_t most);
  /// Does it for them, unless somebody has begun to. May be called while the tree grows.
  void do_ahead(const Work& work, const Monitor& monitor);

  /// Makes the cheapest step: joins a node with components at another rotation, halving the arc up to `depth` times
  /// where no motion is found. Up to `allowed` slices are made that are not in `made`. While others do what it asks
  /// for, it calls `meanwhile` as long as that returns true.
  Growth grow(const SliceTree& other, unsigned depth, const std::set<Quaternion>& made, std::size_t allowed,
              const Monitor& monitor, const std::function<bool()>& meanwhile = {});
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
    bool operator<(const Step& other) const {
      return std::tie(cost, node, rotation) < std::tie(other.cost, other.node, other.rotation);
    }
  };
  // Whether a component is in the tree.
  enum class Joined : std::uint8_t { kNo, kYes, kTooFar };
  // The certified way from a node to a component, if there is one.
  struct Joint {
    bool is_far = false;  // it was not looked for
    std::vector<RigidPose> poses;
  };
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
    const std::function<bool()>& meanwhile;
    Growth& growth;
  };

  void add_steps(NodeIndex node, unsigned level);
  void add_step(NodeIndex index, const Quaternion& rotation);
  [[nodiscard]] std::optional<NodeIndex> find(const Place& place) const;
  bool extend(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context);
  bool extend_by_halves(NodeIndex from, const Quaternion& rotation, unsigned depth, const Context& context);
  Joined join(NodeIndex from, const Quaternion& rotation, const Slice& slice, std::size_t component,
              const Context& context);
  std::optional<Work> foreseen(NodeIndex from, const Quaternion& rotation, unsigned depth);
  std::optional<Work> foreseen_by_halves(NodeIndex from, const Quaternion& rotation, unsigned depth);
  Joint& joint_of(const Work& work, const Monitor& monitor, const std::function<bool()>& meanwhile = {});
  [[nodiscard]] Joint made_joint(const Work& work, const Monitor& monitor) const;
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
  const std::set<Quaternion>& aligned_;
  RigidPose root_;
  RigidPose goal_;
  double reach_;
  unsigned level_ = 0;
  std::deque<Node> nodes_;                                                  // which stay where they are
  std::map<Place, NodeIndex> index_;                                        // of what the other tree may know
  std::map<Place, NodeIndex> fresh_;                                        // of the others
  MadeOnce<std::tuple<NodeIndex, Quaternion, std::size_t>, Joint> joints_;  // that were tried
  std::map<std::pair<NodeIndex, Quaternion>, unsigned> halved_;
  std::multiset<Step> steps_;
};

}  // namespace nef::planner
