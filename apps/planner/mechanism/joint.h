// SPDX-License-Identifier: Apache-2.0
//
// A mechanism with one moving part, and how its joint moves it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "apps/planner/mechanism/quadratic_root.h"
#include "apps/planner/rigid/motion_cell.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turn.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// How the moving part moves with one number, the joint's value: at value 0 it is where its file has it.
///
/// - a hinge turns it about a line; the value is a Turn, a rational half-tangent within its quarter
/// - a slider moves it along a direction; the value is the multiple of that direction
/// - a screw does both; the value is in quarters, and within a quarter the parameter of the arc of quaternions
class Joint {
 public:
  enum class Kind : std::uint8_t { kHinge, kSlider, kScrew };

  /// Throws InputError for the zero vector.
  static Joint hinge(const Rational3& axis, const Rational3& point);
  static Joint slider(const Rational3& direction);
  /// `pitch` is the way along the axis of a full turn. Throws InputError unless the axis has a rational length.
  static Joint screw(const Rational3& axis, const Rational3& point, const Rational& pitch);

  [[nodiscard]] Kind kind() const { return kind_; }
  /// Of a hinge or screw; poses are those of parts that are shifted so that this is the origin.
  [[nodiscard]] const Rational3& point() const { return point_; }

  /// The value for degrees, or for a multiple of the direction: exact for sliders and whole quarters, else within
  /// 1e-12.
  [[nodiscard]] Rational value_of(const Rational& measure) const;
  /// Degrees, or the multiple of the direction, for people.
  [[nodiscard]] double measure_of(const Rational& value) const;

  /// Values at which cells must begin: whole quarters. Nothing for a slider.
  [[nodiscard]] std::vector<Rational> breaks(const Rational& low, const Rational& high) const;

  /// The pose at a value. Not for a screw.
  [[nodiscard]] RigidPose pose(const Rational& value) const;
  /// The quaternions of two values within one quarter so that those of values in between are linear in the value.
  [[nodiscard]] std::array<Quaternion, 2> arc(const Rational& from, const Rational& to) const;
  /// The rotation matrix and the position at a value, in its field. Not for a screw.
  [[nodiscard]] std::array<Surd3, 4> pose(const QuadraticRoot& value) const;

  /// What a cell of values sweeps, and the pose at about its middle, in doubles. For values within one quarter.
  struct Sweep {
    MotionCell all;
    MotionCell middle;
    double middle_error = 0;  ///< how far the middle's position may be off, beyond rounding
  };
  [[nodiscard]] Sweep sweep(const Rational& from, const Rational& to) const;
  /// The same for a cell around a value that is about as narrow as doubles can tell.
  [[nodiscard]] Sweep sweep(const QuadraticRoot& value) const;

 private:
  explicit Joint(Kind kind, const Rational3& direction) : kind_(kind), axis_(direction), direction_(direction) {}

  Kind kind_;
  TurningAxis axis_;
  Rational3 direction_;  // of a slider; of a screw the way of a quarter
  Rational3 point_;
};

/// A solid that a joint moves among others that stay.
struct Mechanism {
  std::string name;  ///< the file's name without folders
  Polyhedron moving;
  std::vector<Polyhedron> fixed;
  std::vector<std::string> fixed_names;
  Joint joint = Joint::slider({1, 0, 0});
  Rational low;  ///< the joint's values that are asked about
  Rational high;
  Messages messages;  ///< what was done to the input
};

/// All parts of a mechanism at the joint's value 0: the moving one, named "moving", and the others.
Assembly assembly_of(const Mechanism& mechanism);

/// Reads {"moving": SHAPE, "fixed": [SHAPE, ...], "joint": JOINT}, SHAPE as in scenes (scene.h), JOINT one of
///
///     {"type": "hinge", "axis": "z" or [x, y, z], "point": [x, y, z], "range": [degrees, degrees]}
///     {"type": "slider", "direction": "z" or [x, y, z], "range": [from, to]}
///     {"type": "screw", "axis": ..., "point": ..., "pitch": way of a turn, "range": [degrees, degrees]}
///
/// `point` is a point on the axis, the origin if it is left out. The range of a hinge is [0, 360] if it is left out.
/// All shapes must be bounded solids. Throws InputError.
Mechanism read_mechanism(const std::string& path, const MeshOptions& meshes = scene_meshes());

/// The same from text; `folder` is where file names begin.
Mechanism parse_mechanism(const std::string& text, const std::string& folder, const std::string& name,
                          const MeshOptions& meshes = scene_meshes());

}  // namespace nef::planner
