// SPDX-License-Identifier: Apache-2.0
//
// A mechanism with one moving part, and how its joint moves it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "apps/planner/mechanism/four_bar.h"
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
/// - a screw does both, the way going evenly with the angle; the value is a Turn
/// - a four-bar linkage moves its coupler or its rocker; the value is the Turn of its crank
class Joint {
 public:
  enum class Kind : std::uint8_t { kHinge, kSlider, kScrew, kFourBar };

  /// Throws InputError for the zero vector.
  static Joint hinge(const Rational3& axis, const Rational3& point);
  static Joint slider(const Rational3& direction);
  /// `pitch` is the way along the axis of a full turn. Throws InputError unless the axis has a rational length.
  static Joint screw(const Rational3& axis, const Rational3& point, const Rational& pitch);
  /// The pivots of crank and rocker and the pins of the coupler, that of the crank first; the rest as of FourBar.
  static Joint four_bar(const Rational3& axis, const std::array<Rational3, 2>& pivots,
                        const std::array<Rational3, 2>& pins, FourBar::Link link);

  [[nodiscard]] Kind kind() const { return kind_; }
  /// Whether contact is found as the zeros of contact products (contact_events.h), and not by bisection.
  [[nodiscard]] bool has_products() const { return kind_ != Kind::kFourBar; }
  /// Throws InputError if the bars of a four-bar linkage do not meet at all values of a range, or come so near to a
  /// line that this is not known.
  void require_range(const Rational& low, const Rational& high) const;
  /// A point on the axis; of a four-bar linkage the crank's pivot. Poses are those of parts that are shifted so that
  /// this is the origin.
  [[nodiscard]] const Rational3& point() const { return point_; }
  /// The direction of the axis. Of a four-bar linkage: nothing moves along it.
  [[nodiscard]] const Rational3& axis() const { return axis_.direction(); }

  /// Of a slider; of a screw the way of a quarter.
  [[nodiscard]] const Rational3& direction() const { return direction_; }

  /// The value for degrees, or for a multiple of the direction: exact for sliders and whole quarters, else within
  /// 1e-12.
  [[nodiscard]] Rational value_of(const Rational& measure) const;
  /// Degrees, or the multiple of the direction, for people.
  [[nodiscard]] double measure_of(const Rational& value) const;

  /// Values at which cells must begin: whole quarters. Nothing for a slider.
  [[nodiscard]] std::vector<Rational> breaks(const Rational& low, const Rational& high) const;

  /// The pose at a value, if there are products; the position of a screw is within 2^-100 of its way of a
  /// quarter, and exact at whole quarters.
  [[nodiscard]] RigidPose pose(const Rational& value) const;
  /// The quaternions of two values within one quarter so that those of values in between are linear in the value: of a
  /// four-bar linkage those of the crank.
  [[nodiscard]] std::array<Quaternion, 2> arc(const Rational& from, const Rational& to) const;
  /// The rotation matrix and the position at a value, in its field, if there are products. The value of a screw must
  /// be one of exact_turns() (screw_contact.h).
  [[nodiscard]] std::array<Surd3, 4> pose(const QuadraticRoot& value) const;

  /// A point, in the coordinates of poses, about which the part turns while that point moves: of a four-bar linkage the
  /// crank's pin or the rocker's pivot, of other joints the origin.
  [[nodiscard]] Rational3 turning_point() const { return bars_ ? bars_->centre() : Rational3{}; }

  /// What a cell of values sweeps, and the pose at about its middle, in doubles. For values within one quarter.
  struct Sweep {
    MotionCell all;
    MotionCell middle;
    double middle_error = 0;  ///< how far the middle's position may be off, beyond rounding
  };
  /// `reach`: no point of the moving part is farther from turning_point(). (Only cells of a four-bar linkage depend on
  /// it.)
  [[nodiscard]] Sweep sweep(const Rational& from, const Rational& to, double reach) const;
  /// The same for a cell around a value that is about as narrow as doubles can tell, if there are products.
  [[nodiscard]] Sweep sweep(const QuadraticRoot& value) const;

 private:
  // Positions of a screw that are not exact.
  static constexpr unsigned kShareBits = 100;

  explicit Joint(Kind kind, const Rational3& direction) : kind_(kind), axis_(direction), direction_(direction) {}

  Kind kind_;
  TurningAxis axis_;
  Rational3 direction_;
  Rational3 point_;
  std::optional<FourBar> bars_;  // seen from the point
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
///     {"type": "four-bar", "axis": ..., "pivots": [POINT, POINT], "pins": [POINT, POINT],
///      "moves": "coupler" or "rocker", "range": [degrees, degrees]}
///
/// `point` is a point on the axis, the origin if it is left out. The range of a hinge is [0, 360] if it is left out.
/// Pivots of a four-bar linkage are those of crank and rocker, `pins` those of the coupler, that of the crank first,
/// all as they are at 0 degrees of the crank; `moves` says to which bar the moving part belongs. All shapes must be
/// bounded solids. Throws InputError.
Mechanism read_mechanism(const std::string& path, const MeshOptions& meshes = scene_meshes());

/// The same from text; `folder` is where file names begin.
Mechanism parse_mechanism(const std::string& text, const std::string& folder, const std::string& name,
                          const MeshOptions& meshes = scene_meshes());

}  // namespace nef::planner
