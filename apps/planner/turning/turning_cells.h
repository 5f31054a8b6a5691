// SPDX-License-Identifier: Apache-2.0
//
// What the search for turning paths knows: free spaces at angles and over ranges of angles, each made when it is first
// asked for.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "apps/minkowski/sum/fixed_obstacles.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/turning/turning_question.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A component of the exact free space at one angle.
using Node = std::uint32_t;
inline constexpr Node kNoNode = 0xffffffffU;

/// A turn in place that is proved to be free: from a component of one slice to one of another.
struct Bridge {
  Node from = 0, to = 0;
  Turn from_turn, to_turn;
  Rational3 position;                      ///< of a point in the component of ...
  std::shared_ptr<const FreeSpace> outer;  ///< ... where the robot may turn
};

/// A range of angles. Whoever moves within it stays in one component of the inner free space, where only a robot that
/// every angle holds is in the way: the one of this range, or of a wider one as long as that was enough, or nothing.
struct AngleCell {
  Turn low, high;
  std::shared_ptr<const FreeSpace> inner;
  Turn inner_low, inner_high;        ///< whose inner robot that is; none if they are the same
  std::vector<std::uint32_t> below;  ///< the component of `inner` that holds each component of the lower slice
  std::vector<std::uint32_t> above;  ///< ... of the upper slice
  bool has_own_inner = false;
  bool has_bridges = false;
};

/// A range that is cut into cells of angles.
class TurningCells {
 public:
  /// Scene and question must outlive the object. Throws InputError unless the robot is a bounded solid and the
  /// obstacles are bounded or the scene has a box.
  TurningCells(const Scene& scene, const TurningQuestion& question, const Monitor& monitor);

  [[nodiscard]] const TurningRobot& robot() const { return robot_; }
  /// By their lower ends.
  [[nodiscard]] const std::map<Turn, AngleCell>& cells() const { return cells_; }
  /// All that have been found; those of cells that have been split hold on.
  [[nodiscard]] const std::vector<Bridge>& bridges() const { return bridges_; }
  /// How many there have been, those that were split included.
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

  /// The exact free space at an angle. The ends of a ring are one.
  const FreeSpace& slice(const Turn& turn, const Monitor& monitor) { return *slice_at(turn, monitor).free; }
  /// The first node of the slice at an angle; those of its other components follow.
  Node first_node(const Turn& turn, const Monitor& monitor) { return slice_at(turn, monitor).first_node; }
  /// The node of a pose; kNoNode if it is not free.
  Node node_of(const Pose& pose, const Monitor& monitor);
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }

  /// Adds a cell about which nothing is known.
  void add(const Turn& low, const Turn& high, const Monitor& monitor);
  /// Makes two cells of the one that begins at `low`; they have its inner free space.
  void split(const Turn& low, const Turn& at, const Monitor& monitor);
  /// Gives a cell the inner free space of its own range.
  void find_inner(const Turn& low, const Monitor& monitor);
  /// Finds the turns through all of a cell.
  void find_bridges(const Turn& low, const Monitor& monitor);
  /// True if two nodes of slices at different angles have a common position, as a few points of each show; then a cell
  /// between them joins them, whatever its inner robot is.
  [[nodiscard]] bool surely_meet(Node a, Node b) const;

 private:
  struct Slice {
    std::shared_ptr<const FreeSpace> free;
    Node first_node = 0;
  };
  // What a node stands for.
  struct SliceComponent {
    const FreeSpace* free = nullptr;
    std::uint32_t component = 0;
  };
  const Slice& slice_at(const Turn& turn, const Monitor& monitor);
  [[nodiscard]] std::shared_ptr<const FreeSpace> free_space_of(const std::vector<Mesh>& robot,
                                                               const Monitor& monitor) const;
  // The components of the cell's inner free space that hold those of the slices at its ends.
  void find_holders(AngleCell& cell, const Monitor& monitor);

  const TurningQuestion& q_;
  TurningRobot robot_;
  minkowski::FixedObstacles obstacles_;
  std::shared_ptr<const FreeSpace> without_robot_;
  std::map<Turn, Slice> slices_;
  std::vector<SliceComponent> nodes_;  // of nodes
  std::vector<Bridge> bridges_;
  std::map<Turn, AngleCell> cells_;
  std::size_t looked_at_ = 0;
};

/// A point of each component.
std::vector<Rational3> points_of_components(const FreeSpace& free, const Monitor& monitor);

/// The turns in the question's range at which a face of the robot looks against a face of an obstacle or with it, as
/// far as they are rational. O(n m) for n directions of the robot's faces and m of the obstacles'.
std::set<Turn> turns_of_parallel_faces(const Scene& scene, const TurningQuestion& question, const Monitor& monitor);

}  // namespace nef::planner
