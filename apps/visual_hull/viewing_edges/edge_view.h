// SPDX-License-Identifier: Apache-2.0
//
// A view as the direct way to the hull sees it: doubles with proven errors, a grid over the silhouette, and integers
// where the doubles do not decide.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/camera_planes.h"
#include "nef/geometry/vectors.h"

namespace nef::visual_hull {

using nef::Double3;

/// Three edges of silhouettes (numbers in the list of all views' edges, ascending) whose planes meet in a point.
using SpotName = std::array<std::uint32_t, 3>;

/// A point of space, each coordinate within `error` of the truth.
struct Spot {
  Double3 at{};
  double error = 0;
};

/// A point of space in homogeneous integers, the last one positive.
using ExactPoint = std::array<Integer, 4>;

/// A point of an image plane, each coordinate within `error` of the truth.
struct Seen {
  double u = 0;
  double v = 0;
  double error = 0;
};

/// The normal of a plane; components are within `error` of the truth.
struct RoundedNormal {
  Double3 at{};
  double error = 0;
};

/// An edge of a silhouette with its plane n . x + d, positive towards the region; the numbers within the errors.
struct ViewingEdge {
  const Point2* from = nullptr;
  const Point2* to = nullptr;
  std::uint32_t view = 0;
  std::uint32_t previous = 0;  ///< the edge that ends where this one starts
  std::uint32_t place = 0;     ///< the first edge that starts at the same vertex: another one where rings touch
  std::uint32_t next_at_place = UINT32_MAX;
  RoundedNormal normal;
  double offset = 0;
  double offset_error = 0;
};

/// The sign of a plane's a x + b y + c z + d at a point. Exact.
int side_of(const std::array<Integer, 4>& plane, const ExactPoint& point);

class EdgeView {
 public:
  /// Makes the view's edges, which are numbered from `first` on in `edges`, the list of all views' edges. Keeps
  /// references to camera and edges. Coordinates of spots to be projected are at most `reach`. Nothing if vertices are
  /// equal but for rounding, the silhouette is flat, or lies on points of its grid, or numbers are so large or small
  /// that bounds of rounding errors do not hold (has_moderate_sizes).
  static std::optional<EdgeView> make(const Camera& camera, const Silhouette& silhouette, std::uint32_t index,
                                      std::uint32_t first, const Double3& reach, std::span<ViewingEdge> edges);

  [[nodiscard]] std::uint32_t first_edge() const { return first_; }
  [[nodiscard]] std::uint32_t edge_count() const { return count_; }

  /// The image of a spot in front of the camera; nothing if it may not be in front.
  [[nodiscard]] std::optional<Seen> project(const Spot& spot) const;

  /// A rectangle of the image, and where its middle is.
  struct Window {
    std::array<double, 2> middle{}, half{};
  };
  /// Holds the images of all points of a box, with some room for roundings; nothing if some may not be in front.
  [[nodiscard]] std::optional<Window> window(const Double3& middle, const Double3& half) const;

  /// True if the point lies in the interior of the silhouette, false if outside; nothing if doubles do not decide.
  [[nodiscard]] std::optional<bool> inside(const Seen& p, const nef::Monitor& monitor) const;
  /// The same for a point of the image, or the image of a point in front of the camera, which is about at `p`. Exact;
  /// nothing if `p` is too vague to be found in the grid.
  [[nodiscard]] Side locate(const Point2& point, const nef::Monitor& monitor) const;
  [[nodiscard]] std::optional<Side> locate(const Seen& p, const ExactPoint& point, const nef::Monitor& monitor) const;

  /// Of a point on the line of an edge: true if it lies between the ends, false if beyond one of them; nothing if
  /// doubles do not decide.
  [[nodiscard]] std::optional<bool> between(const Seen& p, std::uint32_t edge) const;
  /// The same of the image of a point. Exact.
  [[nodiscard]] Side between(const ExactPoint& point, std::uint32_t edge, const nef::Monitor& monitor) const;

  /// Appends the edges, ends included, on which the image of a point lies that is about at `p`. Exact; false if `p` is
  /// too vague to be found in the grid.
  [[nodiscard]] bool edges_at(const Seen& p, const ExactPoint& point, std::vector<std::uint32_t>& edges) const;

  /// The plane of an edge, positive towards the region. Exact.
  [[nodiscard]] std::array<Integer, 4> plane(std::uint32_t edge) const;

 private:
  EdgeView(const Camera& camera, std::uint32_t first, const Double3& reach, std::span<ViewingEdge> edges);
  void collect_edges(const Silhouette& silhouette, std::uint32_t index);
  [[nodiscard]] bool has_moderate_sizes(const Double3& reach) const;
  [[nodiscard]] bool join_places();
  void prepare_edge(ViewingEdge& edge) const;
  [[nodiscard]] bool build_grid();
  void fill_cells();
  [[nodiscard]] bool mark_cells();
  struct Cell {
    std::int64_t column = 0;
    std::int64_t row = 0;
    std::size_t index = 0;
  };
  [[nodiscard]] std::optional<Cell> cell_at(double u, double v) const;
  [[nodiscard]] std::optional<bool> crosses(const Seen& p, const Seen& reference, std::uint32_t edge) const;
  template <typename Image>
  [[nodiscard]] Side locate_in_cell(const Cell& cell, const Image& image, const nef::Monitor& monitor) const;
  template <typename Image>
  [[nodiscard]] Side between_ends(const Image& image, std::uint32_t edge) const;
  [[nodiscard]] std::array<std::int64_t, 2> rows(double low, double high) const;
  [[nodiscard]] std::array<std::int64_t, 2> columns(double low, double high) const;
  [[nodiscard]] std::array<std::int64_t, 2> columns(double u0, double v0, double u1, double v1, std::int64_t row,
                                                    double slack) const;
  [[nodiscard]] std::array<double, 2> reference(std::int64_t column, std::int64_t row) const;

  CameraPlanes planes_;
  std::span<ViewingEdge> edges_;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
  std::array<std::array<double, 4>, 3> matrix_{};
  Double3 rounding_{};                     // of each row of the matrix times a spot
  Double3 slope_{};                        // sums of magnitudes of the rows: by how much errors of spots grow
  std::vector<std::array<Seen, 2>> ends_;  // of edges
  // The grid: `side_` wide cells from (low_u_, low_v_) on; each has a reference point, inside or not.
  double low_u_ = 0;
  double low_v_ = 0;
  double side_ = 1;
  double per_side_ = 1;
  double margin_ = 0;
  std::int64_t width_ = 1;
  std::int64_t height_ = 1;
  std::vector<std::uint32_t> cell_begin_;
  std::vector<std::uint32_t> cell_edges_;
  std::vector<bool> cell_inside_;
};

}  // namespace nef::visual_hull
