// SPDX-License-Identifier: Apache-2.0
//
// The expression language of `nef eval`: sets written as text, for the command line, tests and
// scene files.
//
//   text     := (name '=' (sum | number) ';')* sum       variables: sets and numbers
//   sum      := product (('+' | '-' | '^') product)*     union, difference, symmetric difference
//   product  := factor ('*' factor)*                     intersection
//   factor   := '!' factor | '(' sum ')' | primary       complement
//   primary  := everything | nothing | name
//             | file("path") | box(x0,y0,z0, x1,y1,z1) | halfspace(a,b,c,d)    ax+by+cz+d <= 0
//             | point(x,y,z) | segment(points) | polyline(points) | hull(points) | polygon(points; points...)
//             | sphere(r) | sphere(r, corners) | cylinder(h, r) | cylinder(h, r0, r1) | cylinder(h, r0, r1, corners)
//             | hull(sum, ...) | minkowski(sum, sum) | erode(sum, sum) | ball(r, n)
//             | union(sum, ...) | intersection(sum, ...) | difference(sum, sum) | symdiff(sum, sum)
//             | complement(sum) | interior(sum) | closure(sum) | boundary(sum) | exterior(sum)
//             | regularize(sum)
//             | translate(sum, x,y,z) | scale(sum, s) | scale(sum, sx,sy,sz)
//             | rotate(sum, axis, degrees[, tolerance])    axis: x, y, z or a vector (a,b,c)
//             | transform(sum, 12 or 16 numbers)           the rows of a matrix
//   points   := coordinates, three for each point; a point may stand in parentheses or brackets
//   number   := product (('+' | '-') product)*           with '*', '/', parentheses, '-' in front, and variables
//
// Numbers are exact: 3, -0.1 (a tenth), 1e-3, 22/7. Wherever numbers are listed, some may stand in brackets: [x,y,z].
// Round shapes have 32 corners around if nothing is said, a sphere at most 4000, others 100000. The hull of bounded
// sets is closed; that of others has their marks. Operators of one line associate to the left. Rings after ';' in a
// polygon are holes (or further pieces) by parity. '#' begins a comment that ends with its line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef {

/// The most corners around that texts may ask for: balls have their square, other shapes as many vertices.
inline constexpr unsigned kMostCornersOfBall = 4000;
inline constexpr unsigned kMostCornersOfCircle = 100000;
/// Balls of more corners than this take a minute or more: they get a warning before they are computed.
inline constexpr unsigned kManyCornersOfBall = 1000;

/// What is wrong with an expression, and where. what() is "column C: ..." ("line L, column C: ..."
/// from the second line on).
class ExpressionError : public InputError {
 public:
  ExpressionError(const std::string& what, std::size_t offset) : InputError(what), offset_(offset) {}
  /// Bytes before the place of the error.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::size_t offset_;
};

struct ExpressionOptions {
  // Each of these is given `monitor`.
  /// Makes the set of `file("path")`. Without it, files are refused.
  std::function<Polyhedron(const std::string& path, const Monitor& monitor)> load;
  /// Makes minkowski(A, B), and erode(A, B) by it. Without it, both are refused.
  std::function<Polyhedron(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor)> minkowski = {};
  /// Makes ball(r, n). Without it, balls are refused.
  std::function<Polyhedron(const Rational& radius, const Rational& splits, const Monitor& monitor)> ball = {};
  /// Makes the hull of a set that is not bounded. Without it, such hulls are refused.
  std::function<Polyhedron(const Polyhedron& unbounded, const Monitor& monitor)> hull = {};
  Monitor monitor = {};  ///< cancellation, progress, counters; its referents must outlive the call
  /// Is told what is legal but likely a mistake (sizes of OpenSCAD's shapes that make nothing), a line each.
  std::function<void(const std::string& warning)> warn = {};
};

/// The set that `text` describes. The whole text is parsed before anything is computed. Throws
/// ExpressionError for a wrong expression and for arguments that make no set (a polygon that is
/// not planar, say); errors of `load` pass through.
Polyhedron evaluate_expression(std::string_view text, const ExpressionOptions& options = {});

/// The paths of the files that an expression names, as they stand in it, in their order; one path may occur often.
/// Throws ExpressionError for a wrong expression.
std::vector<std::string> files_of_expression(std::string_view text);

/// Whether a text has nothing but white space and comments.
bool is_blank_expression(std::string_view text);

/// The closed convex hull of the union of sets. Throws InputError if one is unbounded. O(n log n) expected.
Polyhedron convex_hull_of_sets(std::span<const Polyhedron> sets, const Monitor& monitor = {});

/// Warns before a ball of many corners is computed, by its size and what fewer corners would do; `name` is what the
/// text calls it.
void warn_of_corners(const ExpressionOptions& options, const std::string& name, unsigned corners);

/// The affine map given by 12 or 16 numbers, the rows of a 3x4 or 4x4 matrix. A 4x4 matrix must
/// have the last row 0,0,0,w with w other than 0. Throws InputError.
AffineMap affine_map_of(std::span<const Rational> numbers);

}  // namespace nef
