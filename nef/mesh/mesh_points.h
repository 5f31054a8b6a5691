// SPDX-License-Identifier: Apache-2.0
//
// Exact predicates on the points of a mesh, by index: a double filter, which is exact where a small common denominator
// exists (decimal files), then integers of two words where homogeneous coordinates are below 2^62, then GMP.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/geometry/point_table.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/number/approximation.h"
#include "nef/number/int128.h"
#include "nef/number/number.h"

namespace nef {

/// What points near doubles (MeshPoints::near) throw where a question has not the same answer for all of them, as far
/// as is known.
class OpenQuestion {};

/// An immutable set of finite points that answers questions about their positions. All answers are exact.
class MeshPoints {
 public:
  /// Copies what it needs. O(n), on the threads of `monitor` where a common denominator is small.
  explicit MeshPoints(std::span<const Rational3> points, const Monitor& monitor = {});
  /// The same for points that a table holds; all must be finite.
  explicit MeshPoints(PointTable points);
  /// Some finite points of a table, in an order of their own: `places`. `doubles` are their coordinates, each within
  /// 2^-51 relative of the truth. Only the points `asked` (all if there are none) may be asked about, and cost
  /// O(1) each. The table, `places` and `doubles` must outlive these points and not change.
  MeshPoints(const PointTable& table, std::span<const PointId> places, std::span<const std::array<double, 3>> doubles,
             std::span<const std::uint32_t> asked);

  /// Any finite points near doubles: each coordinate within half a unit in the last place of its double, and in the
  /// order of the doubles along each axis, equal ones where these are equal. An answer holds for all such points; where
  /// doubles leave it open, OpenQuestion is thrown.
  static MeshPoints near(std::vector<std::array<double, 3>> doubles);

  MeshPoints(MeshPoints&&) = default;
  MeshPoints& operator=(MeshPoints&&) = default;
  MeshPoints(const MeshPoints&) = delete;
  MeshPoints& operator=(const MeshPoints&) = delete;
  ~MeshPoints() = default;

  [[nodiscard]] std::size_t size() const { return approximate_.size(); }

  /// The sign of det(b - a, c - a, d - a): +1 if a, b, c turn counterclockwise as seen from d's side.
  [[nodiscard]] int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                                const Monitor& monitor) const;

  /// det(b - a, c - a, d - a) in the scaled space of approximate(). Its sign, if it tells one, is that of
  /// orientation(), and much cheaper where points are in one plane, or all but. Tells nothing if the points are not
  /// moderate.
  [[nodiscard]] Approximation determinant(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;

  /// The sign of component `axis` of (b - a) x (c - a): orientation of the three points in the projection along
  /// that axis.
  [[nodiscard]] int orientation_along(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis,
                                      const Monitor& monitor) const;

  /// The same for each axis if doubles can tell, and 0 where they can not.
  [[nodiscard]] std::array<std::int8_t, 3> filtered_turns(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// True if the three points lie on one line.
  [[nodiscard]] bool collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Monitor& monitor) const;

  /// True if all of `others` lie in the plane of a, b and c, which are not on one line.
  [[nodiscard]] bool coplanar(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              std::span<const std::uint32_t> others) const;

  /// An axis along which the three points, not collinear, do not project to one line; usually the one along which
  /// their triangle looks largest.
  [[nodiscard]] std::size_t projection_axis(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                            const Monitor& monitor) const;

  /// The sign of a[axis] - b[axis].
  [[nodiscard]] int compare(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
    const double gap = approximate_[a][axis] - approximate_[b][axis];
    // The margins are far above the rounding of this difference.
    const bool is_told = are_ordered_by_doubles() || (filter_ && std::abs(gap) > 4 * margin_[axis]);
    return is_told ? (gap > 0) - (gap < 0) : compare_exact(a, b, axis);
  }
  /// Lexicographic comparison.
  [[nodiscard]] int compare(std::uint32_t a, std::uint32_t b) const;

  /// True if there is one denominator D of all points such that the integers x D, y D, z D are below 2^40.
  [[nodiscard]] bool are_integers() const { return are_integers_; }
  /// These integers of a point, where there are such.
  [[nodiscard]] std::array<std::int64_t, 3> integers(std::uint32_t p) const {
    const std::array<double, 3>& x = approximate_[p];
    return {static_cast<std::int64_t>(x[0]), static_cast<std::int64_t>(x[1]), static_cast<std::int64_t>(x[2])};
  }
  [[nodiscard]] std::int64_t denominator() const { return denominator_; }

  /// Homogeneous coordinates x, y, z, w below 2^62, as PointTable::small_coordinates has them, and questions about
  /// such: the sign of a[axis] - b[axis], and orientation_along.
  using Small = std::array<std::int64_t, 7>;
  static int compare(const Small& a, const Small& b, std::size_t axis);
  static int orientation_along(const Small& a, const Small& b, const Small& c, std::size_t axis);
  /// Reads them; false if a point has none, or only doubles are known.
  [[nodiscard]] bool read_small(std::uint32_t p, Small& out) const;

  /// The points as a table with the same numbers, where there are no small integers; empty if there are, and for points
  /// of another table.
  [[nodiscard]] const PointTable& table() const { return table_; }

  /// Coordinates in a space that is scaled by one positive factor, each within margin(axis) of the truth: exactly the
  /// integers, with a margin of 0, where there are such.
  [[nodiscard]] const std::array<double, 3>& approximate(std::uint32_t p) const { return approximate_[p]; }
  [[nodiscard]] std::span<const std::array<double, 3>> approximate() const { return approximate_; }
  [[nodiscard]] double margin(std::size_t axis) const { return margin_[axis]; }

  /// True if points are equal exactly where these are.
  [[nodiscard]] bool are_ordered_by_doubles() const { return are_integers_ || only_doubles_; }
  /// False for any points near doubles.
  [[nodiscard]] bool are_numbers() const { return !only_doubles_; }

  /// True if these are below 1e75, so that sums of products of four do not overflow, and fast paths are on.
  [[nodiscard]] bool moderate() const { return filter_; }

  /// Encloses the point, in the same scaled space.
  void extend(Box& box, std::uint32_t p) const;

 private:
  class PlaneThrough;

  bool make_integers(std::span<const Rational3> points, const Monitor& monitor);
  bool enlarge_denominator(std::int64_t more);
  bool find_denominator(std::span<const std::uint32_t> asked);
  bool scale_to_integers(std::span<const std::array<double, 3>> doubles, std::span<const std::uint32_t> asked);
  void find_margins(std::span<const std::uint32_t> asked);
  [[nodiscard]] const PointTable& source() const { return other_table_ != nullptr ? *other_table_ : table_; }
  [[nodiscard]] PointId place(std::uint32_t p) const { return other_table_ != nullptr ? places_[p] : PointId{p}; }
  MeshPoints() = default;
  void require_numbers() const {
    if (only_doubles_) throw OpenQuestion();
  }
  void difference(std::uint32_t a, std::uint32_t b, std::span<Integer> out, std::size_t first = 0) const;
  [[nodiscard]] int orientation_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
  // Of (b - a) x (c - a), in the scaled space. Nothing if the points are not moderate.
  [[nodiscard]] Approximation component(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const;
  [[nodiscard]] int orientation_along_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const;
  [[nodiscard]] int compare_exact(std::uint32_t a, std::uint32_t b, std::size_t axis) const;

  std::vector<std::array<double, 3>> own_;  // empty where the doubles are another's
  std::span<const std::array<double, 3>> approximate_;
  bool are_integers_ = false;  // what approximate_ holds
  bool only_doubles_ = false;  // no other numbers are known
  std::int64_t denominator_ = 1;
  PointTable table_;                         // filled only where these are not, and no other table is
  const PointTable* other_table_ = nullptr;  // and the points there
  std::span<const PointId> places_;
  std::array<double, 3> margin_{};
  bool filter_ = true;
};

}  // namespace nef
