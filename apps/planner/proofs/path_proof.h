// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a path is free, that it collides, that there is none, or that passages are tight, as data that anybody
// can check (docs/proofs.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/intersection/common_point.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"

namespace nef::planner {

class FreeSpace;

/// Convex pieces by their vertices. A piece whose vertices lie in one plane is flat: part of a surface, or thinner.
using ProofPieces = std::vector<std::vector<Rational3>>;

/// A claim about a path, and what shows that it holds. The motion between two poses is that of docs/rigid.md: the
/// position goes straight and evenly with the angle of the rotation, the rotation along the shorter arc.
struct PathProof {
  /// What is claimed: robot and obstacles are the unions of these pieces. Solid pieces collide if their interiors
  /// overlap, or, with kForbid, if they touch. A flat piece collides with whatever it touches. Positions outside the
  /// box collide, too.
  struct Claim {
    enum class Status : std::uint8_t {
      kFree,        ///< no pose of the path collides
      kBlocked,     ///< one pose of the path collides
      kInfeasible,  ///< the path is two poses, and every path between them collides: of translations of the robot, not
                    ///< turned, or of translations and the rotations of `rotations`
      kTight        ///< the robot, not turned, collides at no pose of the path; all positions near to one at which it
                    ///< collides neither are in the plane, on the line or at the point through it along `along`
    };
    Status status = Status::kFree;
    ContactRule contact = ContactRule::kAllow;
    std::optional<std::array<Rational3, 2>> box;
    ProofPieces robot;
    ProofPieces obstacles;
    std::vector<RigidPose> path;  ///< a path of one pose stays there
    /// kTight: for each pose two vectors, one or none, linearly independent.
    std::vector<std::vector<Rational3>> along;
    /// kInfeasible: the robot may turn; any way, if there are no quaternions, or along the arcs from each quaternion to
    /// the next one (Orientations).
    std::optional<std::vector<Quaternion>> rotations;
    /// The numbers of start and goal in that chain, if orientations that come again in it are different ones: in a
    /// range wider than a full turn.
    std::optional<std::array<std::uint32_t, 2>> places;
  };
  /// A plane with this normal lies between what a piece of the robot sweeps, on the lower side, and an obstacle's.
  struct Plane {
    std::uint32_t robot = 0;
    std::uint32_t obstacle = 0;
    Rational3 normal;
  };
  /// A part of a motion, up to this parameter of the arc of quaternions (1 - s) p + s q; it begins where the part
  /// before ends, and the last one ends at 1. Pairs whose boxes are apart have no plane.
  struct Part {
    Rational until;
    std::vector<Plane> planes;
  };
  /// Two pieces that collide at a parameter of a motion.
  struct Collision {
    std::size_t motion = 0;
    Rational parameter;
    std::array<Rational, 2> times;  ///< the position has gone a part of its way that lies between these
    std::uint32_t robot = 0;
    std::uint32_t obstacle = 0;
    std::array<CommonPoint, 2> common;  ///< with the position at each of the two times
  };

  /// A triangle of a barrier. Every position on it is outside the box, beyond one of its sides, or collides: the
  /// robot's piece at each of the three corners overlaps the obstacle's.
  struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< numbers of points
    /// The pieces that overlap, and a common point for each corner.
    /// Two pieces that overlap, by their numbers.
    struct Hit {
      std::uint32_t robot = 0;
      std::uint32_t obstacle = 0;
      std::array<CommonPoint, 3> common;
    };
    std::optional<Hit> hit;  ///< nothing for one outside the box
  };
  /// Triangles of positions that a path from start to goal has to cross: each edge is one of an even number of them,
  /// and a ray from the start crosses an odd number if one from the goal crosses an even one, or the other way round.
  struct Barrier {
    std::vector<Rational3> points;
    std::vector<Triangle> triangles;
  };

  /// A box of poses: of positions of the reference point, in each of which an orientation is a box of parameters of one
  /// chart (Orientations). It is cut in two, or all of its poses collide, or it is on one side.
  struct PoseCell {
    enum class Kind : std::uint8_t {
      kCut,      ///< in two halves
      kStart,    ///< on the side of the start
      kGoal,     ///< on the side of the goal
      kBlocked,  ///< all poses collide
      kBeyond    ///< all positions are beyond a side of the claim's box
    };
    Kind kind = Kind::kStart;
    std::uint32_t axis = 0;        ///< kCut: 0 to 2 a coordinate, 3 to 5 a parameter of the chart
    Rational at;                   ///< kCut: where
    std::vector<PoseCell> halves;  ///< kCut: the lower and the upper one
    std::uint32_t robot = 0;       ///< kBlocked: a piece of the robot
    std::uint32_t obstacle = 0;    ///< kBlocked: one of the obstacles
    /// kBlocked: for each corner of the box of positions a point of the obstacle that is inside the inner piece (see
    /// mixed_rotations) there. Bit k of a corner's number: the upper end of coordinate k.
    std::vector<Rational3> common;
    /// kBlocked: none, or for each parameter of the chart how far these points drift while it goes from the middle of
    /// the box to its upper end. They are in the obstacle, and inside the robot, all the way.
    std::vector<Rational3> drift;
    std::uint32_t side = 0;  ///< kBeyond: 0 to 2 the lower side of x, y, z, 3 to 5 the upper one
  };
  /// Boxes of poses that show that there is no path: no box on the side of the start and one on that of the goal have a
  /// facet in common.
  struct PoseCells {
    Rational3 reference;              ///< the point of the robot whose positions the boxes have
    std::array<Rational3, 2> bounds;  ///< of all boxes; they enclose all such positions if the claim has a box
    bool outside_at_start = false;    ///< what is beyond the bounds is on the side of the start, else of the goal
    std::vector<PoseCell> charts;     ///< a box for each chart
  };

  /// The hull of three or four positions (a triangle, a tetrahedron) at a range of orientations. None of these poses is
  /// free: the positions are beyond one side of the claim's box, or a piece of the robot overlaps an obstacle's.
  struct BlockedSimplex {
    /// Two pieces that overlap, by their numbers.
    struct Hit {
      std::uint32_t robot = 0;
      std::uint32_t obstacle = 0;
      /// For each corner a point of the obstacle that is inside the inner piece (see mixed_rotations) there.
      std::vector<Rational3> common;
    };
    std::vector<std::uint32_t> corners;  ///< numbers of points
    std::optional<Hit> hit;              ///< nothing for one beyond a side
  };
  /// A range of orientations in a chart of one parameter, from where the layer before ends.
  struct Layer {
    Rational until;                       ///< the parameter, up to 1
    std::vector<BlockedSimplex> barrier;  ///< triangles without a border modulo 2, blocked at all of the orientations
    /// Tetrahedra that are blocked at the orientation `until`: modulo 2 they fill what is between the barrier and that
    /// of the next layer.
    std::vector<BlockedSimplex> closing;
  };
  /// A barrier of positions and orientations along a chain of arcs.
  struct Layers {
    std::vector<Rational3> points;
    std::vector<std::vector<Layer>> charts;  ///< for each arc of the chain
  };

  /// Why a position is tight. Directions are cut into cones; in all directions of a cone but those along the passage
  /// the robot collides at once, by one contact.
  struct Tight {
    /// Two pieces that touch (piece_contact.h), the robot's at the position, or a side of the box that has the
    /// position: the lower ones of x, y, z are 0 to 2, the upper ones 3 to 5.
    struct Contact {
      std::uint32_t robot = 0;
      std::uint32_t obstacle = 0;
      CommonPoint common;
      std::optional<std::uint32_t> side;
    };
    /// The directions that three vectors span: two halves, cut by the balanced_sum of the ends of `edge`, or what
    /// blocks them.
    struct Cone {
      std::optional<std::uint32_t> edge;
      std::vector<Cone> halves;  ///< none or two: the first one has the sum in place of the later end
      std::uint32_t contact = 0;
    };
    std::vector<Plane> planes;  ///< the robot collides with nothing at the position, as in a Part
    std::vector<Contact> contacts;
    /// Octant i is spanned by the vectors of tight_frame, the k-th negated if bit k of i is set.
    std::array<Cone, 8> octants;
  };

  Claim claim;
  std::vector<std::vector<Part>> motions;  ///< of a free path: each cut into parts
  std::optional<Collision> collision;      ///< of a path that collides
  std::optional<std::size_t> outside;      ///< of a path that collides: the number of a pose outside the box
  std::optional<Barrier> barrier;          ///< if there is no path of translations
  std::optional<PoseCells> cells;          ///< if there is no path of a robot that turns about all axes
  std::optional<Layers> layers;            ///< if there is none of one that turns along a chain of arcs
  std::vector<Tight> tight;                ///< of each pose, if these are tight
};

/// The proof of what is known of a path; nothing if that is kUndecided. `known` must come from `checker` with the
/// timing kSlerp and CheckLimits::keep_parts. O(parts pieces of the robot times pieces of obstacles), and some
/// milliseconds for each pair and part in which they touch. `monitor` is told how many motions are done, and can stop
/// it.
std::optional<PathProof> make_path_proof(const MotionChecker& checker, std::span<const RigidPose> poses,
                                         const CertifiedPath& known, const Monitor& monitor = {});

/// The same for a path that is not certified yet.
std::optional<PathProof> make_path_proof(const MotionChecker& checker, std::span<const RigidPose> poses,
                                         const Monitor& monitor = {});

/// The proof that start and goal lie in different components of the free positions; nothing if there is none: both are
/// in one component, the components have no distance, or only surfaces are in the way. The barrier is the boundary of
/// the sum of a bounded component and a small cube, cut until each triangle is in the way of one pair of pieces. Costs
/// the sum, and for every triangle a search through the pairs of pieces.
std::optional<PathProof> make_barrier_proof(const Scene& scene, const Polyhedron& free, const Rational3& start,
                                            const Rational3& goal, const Monitor& monitor = {});

/// The proof that the tight passages of a free space are tight, each at a position inside of its largest cell; nothing
/// if there are none, or if the contacts of one do not show it: those of an edge along the passage, say, that changes
/// there. Needs the roadmap for the positions. Costs a linear program for each pair of pieces that touch, and the
/// cones.
std::optional<PathProof> make_tight_proof(const Scene& scene, const FreeSpace& free, const Monitor& monitor = {});

/// What is wrong with a proof; nothing if its claim holds. Everything is rational, and nothing of the search is used:
/// no doubles, no tree, and of hulls and boxes of orientations (orientation_cells.h) only what a proof of no path of a
/// robot that turns is about. O(parts pieces of the robot times pieces of obstacles); O(n log n) for n boxes of poses,
/// or triangles and tetrahedra in layers, where `monitor` can stop it (Interrupted).
std::optional<std::string> complaint_about(const PathProof& proof, const Monitor& monitor = {});

/// What is different between a claim and a scene; nothing if the claim is about the scene. The pieces are united and
/// compared with the sets of the scene, exactly. If a pose of the claim is turned, the robot is that in the scene's own
/// file (with_robot_as_in_its_file).
std::optional<std::string> complaint_about(const PathProof::Claim& claim, const Scene& scene,
                                           const Monitor& monitor = {});

}  // namespace nef::planner
