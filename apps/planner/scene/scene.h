// SPDX-License-Identifier: Apache-2.0
//
// A motion planning problem as a file says it: robot, obstacles, start and goal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// What counts as a collision.
enum class ContactRule : std::uint8_t {
  kAllow,  ///< only a meeting of points that are not on the border of robot or obstacle (minkowski::without_border)
  kForbid  ///< touching too
};

/// The angles by which a robot may be turned about its reference point: the question has start and goal angles then.
struct AxisRotation {
  Rational3 axis{0, 0, 1};  ///< a direction of any length
  Rational low = 0;         ///< degrees
  Rational high = 360;
  Rational start = 0;  ///< degrees of the start
  Rational goal = 0;
};

/// A robot that translates among obstacles. All numbers are the rationals that the file spells.
struct Scene {
  std::string name;  ///< the file's name without folders
  Polyhedron robot;  ///< with its reference point at the origin
  /// The rotation that was applied to the robot of a .cfg file, whose start and goal are turned alike.
  AffineMap robot_rotation = AffineMap::identity();
  std::vector<Polyhedron> obstacles;
  std::vector<std::string> obstacle_names;
  std::optional<std::array<Rational3, 2>> box;  ///< bounds of the reference point
  std::optional<Rational3> start;
  std::optional<Rational3> goal;
  std::optional<AxisRotation> rotation;  ///< nothing: it only translates
  /// How the robot, as it is in its own file, is turned at start and goal: quaternions w, x, y, z of any length but
  /// zero. For OMPL.app problems and robots that turn freely.
  std::optional<std::array<std::array<Rational, 4>, 2>> quaternions;
  /// The robot may turn about all axes (SO(3)): in JSON by its key, in an OMPL.app problem if start and goal are turned
  /// about different axes, or if asked for. `rotation` is nothing then.
  bool turns_freely = false;
  ContactRule contact = ContactRule::kAllow;
  Messages messages;  ///< what was done to the input

  /// Whether the robot keeps its orientation from start to goal.
  [[nodiscard]] bool only_translates() const { return !rotation && !turns_freely; }
};

/// True if a position of the reference point is in the box, if there is one.
inline bool is_in_box(const Rational3& position, const std::optional<std::array<Rational3, 2>>& box) {
  for (std::size_t i = 0; box && i < 3; ++i) {
    if (position[i] < (*box)[0][i] || position[i] > (*box)[1][i]) return false;
  }
  return true;
}

/// Throws InputError if the robot of the scene may turn, about one axis or freely: for what knows translations only, so
/// that no answer about one orientation passes for an answer about all.
void require_no_rotation(const Scene& scene);

/// Throws InputError if the robot of the scene is unbounded, which files are not allowed to say, but code may.
void require_bounded_robot(const Scene& scene);

/// How scenes read meshes unless told otherwise, like all programs: what is enclosed at least once is solid.
inline MeshOptions scene_meshes(const Monitor& monitor = {}) {
  return {.crossings = Crossings::kUnion, .monitor = monitor};
}

/// Reads a scene. `.cfg` files are OMPL.app problems, everything else is JSON:
///
///     { "robot": SHAPE, "obstacles": [SHAPE, ...],
///       "reference": POINT, "box": [POINT, POINT], "start": POINT, "goal": POINT,
///       "contact": "allow" | "forbid",
///       "rotation": {"axis": "x" | "y" | "z" | DIRECTION, "range": [degrees, degrees]} | "SO(3)" }
///
/// robot and obstacles are required. POINT (and DIRECTION) is three numbers or strings such as "1/3"; a JSON number
/// is the rational that its text spells (0.1 is one tenth). SHAPE is a string: the path of a mesh or
/// nef file, relative to the scene, or else an expression of `nef eval` such as
/// "box(0,0,0, 9,3,3) - box(1,1,1, 2,2,2)". With a rotation about an axis, start and goal have a fourth number:
/// degrees. With SO(3) each is a pose, {"position": POINT, "quaternion": [w, x, y, z]}, the quaternion of any length
/// but zero. Throws InputError with one line for anything else. `meshes`: how mesh files are read (read_shape_file),
/// and the Monitor.
Scene read_scene(const std::string& path, const MeshOptions& meshes = scene_meshes());

/// The same from text; `folder` is where file names begin.
Scene parse_scene(const std::string& text, const std::string& folder, const std::string& name,
                  const MeshOptions& meshes = scene_meshes());

/// Which rotations the robot of an OMPL.app problem may have on its way.
enum class CfgRotations : std::uint8_t {
  kOfEnds,  ///< those that lead from start to goal: none, about one axis, or all
  kAll      ///< all, as in OMPL.app
};

/// An OMPL.app problem: [problem] robot, world, start.*, goal.*, volume.*. If the rotations of start and goal are the
/// same, that one is applied to the robot once, and answers hold for translations at that orientation, as a message
/// says; if they differ about one axis, the robot may turn about that, by any angle; if the axes differ, too, or with
/// CfgRotations::kAll, the robot turns freely. The robot's reference point (also the centre of rotation) is the mean of
/// its vertices as OMPL.app computes it, unless `robot.origin = mesh`; our own keys are `contact` and exact numbers
/// such as 1/3. A mesh that bounds no solid is what meaning_of (nearly_closed.h) says.
Scene read_cfg(const std::string& path, const MeshOptions& meshes = scene_meshes(),
               CfgRotations rotations = CfgRotations::kOfEnds);

/// read_cfg with all rotations. Throws InputError for another file than .cfg: a scene in JSON says itself how its robot
/// may turn.
Scene freely_turning_scene(const std::string& path, const MeshOptions& meshes = scene_meshes());

/// What of an obstacle the robot may reach, however it is turned about its reference point: all of a bounded one, else
/// what is near the scene's box, cut far enough off that the cuts stay away from the robot. Throws InputError, which
/// begins with `name`, if the obstacle is unbounded and the scene has no box, and if the robot is unbounded.
Polyhedron reachable_part(const Polyhedron& obstacle, const Scene& scene, const Monitor& monitor,
                          const std::string& name = "an obstacle");

}  // namespace nef::planner
