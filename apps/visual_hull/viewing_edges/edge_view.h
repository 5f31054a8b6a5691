// SPDX-License-Identifier: Apache-2.0
//
// A view as the direct way to the hull sees it: doubles with proven errors, and a grid over the silhouette.
//
// The direct way is not made for everything: degenerate positions, a hull that reaches its box, more exact answers than
// it is worth. Functions that may meet such a thing return an optional, or whether all was decided; nothing (false)
// goes up to direct_hull, and the general way takes over.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/visual_hull/scene/camera.h"

namespace visual_hull {

using Vec3 = std::array<double, 3>;

/// Three edges of silhouettes (numbers in the list of all views' edges, ascending) whose planes meet in a point.
using SpotName = std::array<std::uint32_t, 3>;
inline constexpr SpotName kNoName{UINT32_MAX, UINT32_MAX, UINT32_MAX};

/// A point of space, each coordinate within `error` of the truth. Without a name it is some point of a line, about
/// here.
struct Spot {
  Vec3 at{};
  double error = 0;
  SpotName name = kNoName;
};

/// A point of an image plane: the image of a spot, a vertex of a silhouette, or a pair of doubles.
struct Seen {
  double u = 0;
  double v = 0;
  double error = 0;
  const Spot* spot = nullptr;
  const Point2* point = nullptr;
};

/// A vector whose components are within `error` of the truth.
struct Vector {
  Vec3 at{};
  double error = 0;
};

/// An edge of a silhouette with its plane n . x + d, positive towards the region; the numbers within the errors.
struct ViewingEdge {
  const Point2* from = nullptr;
  const Point2* to = nullptr;
  std::uint32_t view = 0;
  std::uint32_t next = 0;      ///< the edge that starts where this one ends
  std::uint32_t previous = 0;  ///< the edge that ends where this one starts
  std::uint32_t place = 0;     ///< the first edge that starts at the same vertex: another one where rings touch
  std::uint32_t next_at_place = UINT32_MAX;
  Vector normal;
  double offset = 0;
  double offset_error = 0;
  Vector ray;  ///< in which `from` is seen, of depth 1
  double ray_length = 0;
};

/// Exact coordinates of a named spot; nothing for others.
class ExactSpots {
 public:
  virtual ~ExactSpots() = default;
  [[nodiscard]] virtual std::optional<Rational3> exact(const Spot& spot) const = 0;
};

class EdgeView {
 public:
  /// Appends the view's edges to `edges`. Keeps references to camera, exact and edges. Coordinates of spots to be
  /// projected are at most `reach`. Nothing if vertices are equal but for rounding, the silhouette is flat, or lies on
  /// points of its grid.
  static std::optional<EdgeView> make(const Camera& camera, const Silhouette& silhouette, std::uint32_t index,
                                      const Vec3& reach, const ExactSpots& exact, std::vector<ViewingEdge>& edges);

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] std::uint32_t first_edge() const { return first_; }
  [[nodiscard]] std::uint32_t edge_count() const { return count_; }
  [[nodiscard]] const Vector& centre() const { return centre_; }

  /// Depth and its error.
  [[nodiscard]] double depth(const Spot& spot, double& error) const;
  /// The direction in which the camera looks, of length about 1.
  [[nodiscard]] const Vec3& axis() const { return axis_; }
  /// The row of the matrix that gives depth.
  [[nodiscard]] const std::array<double, 4>& depth_row() const { return matrix_[2]; }

  /// The image of a spot in front of the camera; nothing if it may not be in front. Refers to the spot.
  [[nodiscard]] std::optional<Seen> project(const Spot& spot) const;
  [[nodiscard]] static Seen seen(const Point2& point);

  /// A rectangle of the image, and where its middle is.
  struct Window {
    std::array<double, 2> middle{}, half{};
  };
  /// Holds the images of all points of a box, with some room for roundings; nothing if some may not be in front.
  [[nodiscard]] std::optional<Window> window(const Vec3& middle, const Vec3& half) const;
  /// The middle as the pair of doubles that it is.
  [[nodiscard]] static Seen middle_of(const Window& window) {
    return {window.middle[0], window.middle[1], 0, nullptr, nullptr};
  }

  /// Whether the silhouette covers all of a segment, or nothing of it, as the grid tells at a glance.
  [[nodiscard]] std::optional<bool> all_inside(const Seen& a, const Seen& b) const;

  /// True if the point lies in the silhouette; nothing if it may lie on the boundary.
  [[nodiscard]] std::optional<bool> inside(const Seen& p) const;

  /// True if the point lies to the left of an edge, where the region is; nothing if it may lie on its line.
  [[nodiscard]] std::optional<bool> left_of(const Seen& p, std::uint32_t edge) const;

  /// Calls visit(edge) for every edge that the segment ab crosses; false if one of them remains undecided. `stamps` has
  /// a number for each edge of the view that is not yet `stamp`.
  template <typename Visit>
  [[nodiscard]] bool visit_crossed(const Seen& a, const Seen& b, std::vector<std::uint32_t>& stamps,
                                   std::uint32_t stamp, Visit&& visit) const {
    const double slack = a.error + b.error + margin_;
    const auto [top, bottom] = rows(std::min(a.v, b.v) - slack, std::max(a.v, b.v) + slack);
    const bool flat = bottom - top <= 1;  // all columns between the ends are as well
    for (std::int64_t row = top; row <= bottom; ++row) {
      const auto [left, right] = flat ? columns(std::min(a.u, b.u) - slack, std::max(a.u, b.u) + slack)
                                      : columns(a.u, a.v, b.u, b.v, row, slack);
      for (std::int64_t column = left; column <= right; ++column) {
        const std::size_t cell = static_cast<std::size_t>(row * width_ + column);
        for (std::uint32_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i) {
          const std::uint32_t e = cell_edges_[i];
          if (stamps[e - first_] == stamp) continue;
          stamps[e - first_] = stamp;
          const std::optional<bool> crossed = crosses(a, b, e);
          if (!crossed) return false;
          if (*crossed) visit(e);
        }
      }
    }
    return true;
  }

 private:
  EdgeView(const Camera& camera, const Vec3& reach, const ExactSpots& exact, std::vector<ViewingEdge>& edges);
  void collect_edges(const Silhouette& silhouette, std::uint32_t index);
  [[nodiscard]] bool join_places();
  void prepare_edge(ViewingEdge& edge, const Vector& ray0, const Vector& ray_u, const Vector& ray_v) const;
  [[nodiscard]] bool build_grid();
  void fill_cells();
  void sum_cells();
  [[nodiscard]] bool mark_cells();
  [[nodiscard]] std::optional<bool> crosses(const Seen& a, const Seen& b, std::uint32_t edge) const;
  [[nodiscard]] std::optional<int> orient(const Seen& a, const Seen& b, const Seen& c) const;
  [[nodiscard]] std::optional<Point2> exact(const Seen& p) const;
  [[nodiscard]] std::array<std::int64_t, 2> rows(double low, double high) const;
  [[nodiscard]] std::array<std::int64_t, 2> columns(double low, double high) const;
  [[nodiscard]] std::array<std::int64_t, 2> columns(double u0, double v0, double u1, double v1, std::int64_t row,
                                                    double slack) const;
  [[nodiscard]] std::array<double, 2> reference(std::int64_t column, std::int64_t row) const;

  const Camera& camera_;
  const ExactSpots& exact_;
  std::vector<ViewingEdge>& edges_;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
  std::array<std::array<double, 4>, 3> matrix_{};
  Vec3 rounding_{};  // of each row of the matrix times a spot
  Vec3 slope_{};     // sums of magnitudes of the rows: by how much errors of spots grow
  Vector centre_;
  Vec3 axis_{};
  std::vector<std::array<Seen, 2>> ends_;  // of edges
  // The grid: `side_` wide cells from (low_u_, low_v_) on; each has a reference point, inside or not.
  double low_u_ = 0;
  double low_v_ = 0;
  double side_ = 1;
  double margin_ = 0;
  std::int64_t width_ = 1;
  std::int64_t height_ = 1;
  std::vector<std::uint32_t> cell_begin_;
  std::vector<std::uint32_t> cell_edges_;
  std::vector<bool> cell_inside_;
  std::vector<std::uint32_t> crossed_cells_;  // cells with edges above and to the left of each corner of the grid
};

}  // namespace visual_hull
