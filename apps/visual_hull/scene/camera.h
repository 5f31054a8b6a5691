// SPDX-License-Identifier: Apache-2.0
//
// Exact cameras: pinholes, and parallel projections.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "apps/visual_hull/polygon/polygon.h"

namespace nef::visual_hull {

using Matrix3 = std::array<Rational3, 3>;
using Matrix34 = std::array<std::array<Rational, 4>, 3>;

/// What a point of space looks like from a camera: u = x/depth, v = y/depth if depth > 0.
struct Projection {
  Rational x, y, depth;
};

/// A projection matrix P with rational entries: x = P X, u = x1/x3 to the right, v = x2/x3 down,
/// and x3 > 0 in front of the camera. (So P and -P are different cameras.) If the third row is (0, 0, 0, w), w > 0, the
/// lines of sight are parallel (an orthographic or affine camera, a telecentric lens), and all of space is in front.
class Camera {
 public:
  /// The identity: centre at the origin, looking along +z.
  Camera();

  /// Throws InputError, with `name` in front, if the left 3x3 block is singular and the lines of sight are not
  /// parallel.
  Camera(std::string name, const Matrix34& matrix);

  /// P = K [R | t]. R need not be orthogonal to the last digit: P is what counts.
  static Camera from_parts(std::string name, const Matrix3& k, const Matrix3& r, const Rational3& t);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Matrix34& matrix() const { return matrix_; }

  /// Whether the lines of sight are parallel.
  [[nodiscard]] bool is_parallel() const { return parallel_; }

  /// Where the camera looks: of a pinhole the normal of the planes of constant depth, else the direction of sight.
  [[nodiscard]] const Rational3& axis() const { return axis_; }

  /// The point that P maps to zero. Not for parallel lines of sight.
  [[nodiscard]] const Rational3& centre() const;

  /// The sign of the determinant of the left block: -1 if the images are mirrored. 1 for parallel lines of sight, which
  /// do not tell from which end they are looked along.
  [[nodiscard]] int handedness() const { return handedness_; }

  [[nodiscard]] Projection project(const Rational3& point) const;

  /// How far along the axis a point is: x3 = m3 . X + p34, positive in front; for parallel lines of sight axis . X, of
  /// either sign.
  [[nodiscard]] Rational depth(const Rational3& point) const;

  /// The direction in which image point (u, v) is seen: from the centre to depth 1, or the axis.
  [[nodiscard]] Rational3 ray(const Point2& image_point) const;

  /// The point of a depth that is seen at an image point.
  [[nodiscard]] Rational3 sight_point(const Point2& image_point, const Rational& depth) const;

 private:
  std::string name_;
  Matrix34 matrix_;
  bool parallel_ = false;
  Rational3 axis_;
  Matrix3 inverse_;  ///< of the left block, with the axis as its third row
  Rational3 centre_;
  int handedness_ = 1;
};

/// Throws InputError naming the view if the lines of sight are parallel: `what` is for pinhole cameras only.
void require_pinhole(const Camera& camera, const std::string& what);

/// A plane a x + b y + c z + d = 0 with rational coefficients.
struct RationalPlane {
  Rational3 normal;
  Rational offset;
};

/// The plane through the camera's centre that is seen as the line from `a` to `b`. Of the points
/// in front of the camera, those seen to the left of the line (see orientation) are on its positive side.
RationalPlane plane_through(const Camera& camera, const Point2& a, const Point2& b);

/// The points of depth s; deeper ones are on the positive side.
RationalPlane plane_at_depth(const Camera& camera, const Rational& s);

}  // namespace nef::visual_hull
