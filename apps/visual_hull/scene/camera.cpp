// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/camera.h"

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

Rational cofactor(const Matrix34& m, std::size_t row, std::size_t column) {
  const std::size_t r1 = (row + 1) % 3;
  const std::size_t r2 = (row + 2) % 3;
  const std::size_t c1 = (column + 1) % 3;
  const std::size_t c2 = (column + 2) % 3;
  return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
}

Matrix34 identity() {
  Matrix34 m;
  for (std::size_t i = 0; i < 3; ++i) m[i][i] = 1;
  return m;
}

}  // namespace

Camera::Camera() : Camera("", identity()) {}

Camera::Camera(std::string name, const Matrix34& matrix) : name_(std::move(name)), matrix_(matrix) {
  Matrix34 m = matrix;  // whose left block is inverted
  const auto& last = matrix[2];
  parallel_ = last[0] == 0 && last[1] == 0 && last[2] == 0;
  if (parallel_ && sgn(last[3]) <= 0) {
    throw nef::InputError("view " + name_ +
                          ": nothing is in front: the last row of the matrix is 0, 0, 0 and no positive number");
  }
  if (parallel_) {
    for (std::size_t j = 0; j < 3; ++j) m[2][j] = cofactor(matrix, 2, j);  // across the first two rows
  }
  axis_ = {m[2][0], m[2][1], m[2][2]};
  Rational determinant;
  for (std::size_t j = 0; j < 3; ++j) determinant += m[0][j] * cofactor(m, 0, j);
  handedness_ = sgn(determinant);
  if (handedness_ == 0) {
    throw nef::InputError("view " + name_ + ": the matrix is singular (its left 3x3 block has determinant 0)");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse_[j][i] = cofactor(m, i, j) / determinant;
  }
  if (parallel_) return;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) centre_[i] -= inverse_[i][j] * matrix_[j][3];
  }
}

const Rational3& Camera::centre() const {
  NEF_ASSERT(!parallel_);
  return centre_;
}

Camera Camera::from_parts(std::string name, const Matrix3& k, const Matrix3& r, const Rational3& t) {
  Matrix34 p;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t l = 0; l < 3; ++l) {
      for (std::size_t j = 0; j < 3; ++j) p[i][j] += k[i][l] * r[l][j];
      p[i][3] += k[i][l] * t[l];
    }
  }
  return {std::move(name), p};
}

Projection Camera::project(const Rational3& point) const {
  Rational3 x;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = matrix_[i][3];
    for (std::size_t j = 0; j < 3; ++j) x[i] += matrix_[i][j] * point[j];
  }
  return {x[0], x[1], x[2]};
}

Rational Camera::depth(const Rational3& point) const {
  Rational d = parallel_ ? Rational(0) : matrix_[2][3];
  for (std::size_t j = 0; j < 3; ++j) d += axis_[j] * point[j];
  return d;
}

Rational3 Camera::ray(const Point2& p) const {
  if (parallel_) return axis_;
  Rational3 direction;
  for (std::size_t i = 0; i < 3; ++i) direction[i] = inverse_[i][0] * p.x() + inverse_[i][1] * p.y() + inverse_[i][2];
  return direction;
}

Rational3 Camera::sight_point(const Point2& p, const Rational& depth) const {
  const Rational& scale = parallel_ ? matrix_[2][3] : depth;
  const Rational last = parallel_ ? depth : Rational(depth - matrix_[2][3]);
  const Rational3 right{p.x() * scale - matrix_[0][3], p.y() * scale - matrix_[1][3], last};
  Rational3 point;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) point[i] += inverse_[i][j] * right[j];
  }
  return point;
}

void require_pinhole(const Camera& camera, const std::string& what) {
  if (!camera.is_parallel()) return;
  throw nef::InputError("view " + camera.name() + ": its lines of sight are parallel; " + what +
                        " is for pinhole cameras only");
}

RationalPlane plane_through(const Camera& camera, const Point2& a, const Point2& b) {
  // l = a x b is the line; l . (P X) = 0 is the plane. l . x > 0 for x to the left, x3 > 0.
  const Rational3 line{a.y() - b.y(), b.x() - a.x(), a.x() * b.y() - a.y() * b.x()};
  RationalPlane plane;
  const Matrix34& p = camera.matrix();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) plane.normal[j] += line[i] * p[i][j];
    plane.offset += line[i] * p[i][3];
  }
  return plane;
}

RationalPlane plane_at_depth(const Camera& camera, const Rational& s) {
  return {camera.axis(), camera.is_parallel() ? Rational(-s) : Rational(camera.matrix()[2][3] - s)};
}

}  // namespace nef::visual_hull
