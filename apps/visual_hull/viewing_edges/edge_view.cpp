// SPDX-License-Identifier: Apache-2.0
//
// The grid has about 48 cells for each edge of the silhouette. A cell lists the edges that come near it and knows
// whether its reference point is inside; a point is inside if the segment to the reference point of its cell crosses an
// even number of these edges, or an odd number if the reference point is outside. Each step exists twice: in doubles
// with error bounds, which may leave the answer open, and exactly.
#include "apps/visual_hull/viewing_edges/edge_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nef/number/approximation.h"

namespace nef::visual_hull {
namespace {

// What sums of at most four products lose, as a part of the sum of magnitudes: u for the matrix, u for a product, at
// most 3u for the sums: 5u. The rest of 8u leaves room for the roundings of the bounds.
constexpr double kSumRounding = 8 * nef::kRoundingUnit;

Seen seen(const Point2& point) {
  const auto& p = point.approximate;
  return {p[0], p[1], point.lattice ? 0 : std::max(std::abs(p[0]), std::abs(p[1])) * 0x1p-52};
}

// The sign of (b - a) x (c - a); nothing if doubles do not decide.
std::optional<int> orient(const Seen& a, const Seen& b, const Seen& c) {
  const double bu = b.u - a.u;
  const double bv = b.v - a.v;
  const double cu = c.u - a.u;
  const double cv = c.v - a.v;
  const double left = bu * cv;
  const double right = bv * cu;
  // A difference is off by 2e and its rounding u, a product of two by 2e(|x| + |y|) + 4e^2, 2u for the differences' and
  // u for its own rounding; that of the two products adds u: 2e and 4u where 3e and 8u stand.
  const double e = std::max({a.error, b.error, c.error});
  const double sum = std::abs(bu) + std::abs(bv) + std::abs(cu) + std::abs(cv);
  const double bound = 3 * e * sum + 9 * e * e + (std::abs(left) + std::abs(right)) * kSumRounding;
  const double value = left - right;
  // Never 0, even where nothing is off: what lies on a line is for exact location.
  return nef::Approximation{value, bound + 1e-300}.sign();
}

// What exact location asks of a point of the image: on which side of a line it lies.
class PointImage {
 public:
  PointImage(const Point2& point, const nef::Monitor& monitor) : point_(point), monitor_(monitor) {}
  int side(const Point2& a, const Point2& b) const { return orientation(a, b, point_, monitor_); }

 private:
  const Point2& point_;
  nef::Monitor monitor_;
};

// The same of the image of a point in front of the camera.
class SpaceImage {
 public:
  SpaceImage(const CameraPlanes& planes, const ExactPoint& point) : planes_(planes), point_(point) {}
  int side(const Point2& a, const Point2& b) const { return side_of(planes_.through(a, b), point_); }

 private:
  const CameraPlanes& planes_;
  const ExactPoint& point_;
};

}  // namespace

int side_of(const std::array<Integer, 4>& plane, const ExactPoint& point) {
  Integer sum = plane[0] * point[0];
  for (std::size_t i = 1; i < 4; ++i) mpz_addmul(sum.get_mpz_t(), plane[i].get_mpz_t(), point[i].get_mpz_t());
  return sgn(sum);
}

std::optional<EdgeView> EdgeView::make(const Camera& camera, const Silhouette& silhouette, std::uint32_t index,
                                       std::uint32_t first, const Double3& reach, std::span<ViewingEdge> edges) {
  EdgeView view(camera, first, reach, edges);
  view.collect_edges(silhouette, index);
  if (!view.has_moderate_sizes(reach) || !view.join_places() || !view.build_grid()) return std::nullopt;
  return view;
}

// Of the box, of the image, and of each edge's plane in the box: then products of three planes' sizes, those in small
// parts of the box included, are far from where doubles overflow or lose digits.
bool EdgeView::has_moderate_sizes(const Double3& reach) const {
  const auto moderate = [](double size) { return size > 0x1p-150 && size < 0x1p150; };
  double image = 0;
  for (std::uint32_t e = first_; e < first_ + count_; ++e) {
    double size = std::abs(edges_[e].offset);
    for (std::size_t k = 0; k < 3; ++k) size += std::abs(edges_[e].normal.at[k]) * reach[k];
    if (!moderate(size)) return false;
    for (const double x : edges_[e].from->approximate) image = std::max(image, std::abs(x));
  }
  return moderate(image) && moderate(std::max({reach[0], reach[1], reach[2]}));
}

EdgeView::EdgeView(const Camera& camera, std::uint32_t first, const Double3& reach, std::span<ViewingEdge> edges)
    : planes_(camera), edges_(edges), first_(first) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix_[i][j] = nef::nearest_double(camera.matrix()[i][j]);
    double size = std::abs(matrix_[i][3]);
    double slope = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      size += std::abs(matrix_[i][j]) * reach[j];
      slope += std::abs(matrix_[i][j]);
    }
    rounding_[i] = size * kSumRounding;
    slope_[i] = slope * 1.0001;
  }
}

void EdgeView::collect_edges(const Silhouette& silhouette, std::uint32_t index) {
  std::uint32_t base = first_;
  ends_.reserve(silhouette.vertex_count());
  for (const Ring& ring : silhouette.rings) {
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      ViewingEdge& edge = edges_[base + k];
      edge.from = &ring[k];
      edge.to = &ring[(k + 1) % n];
      edge.view = index;
      edge.previous = base + (k + n - 1) % n;
      prepare_edge(edge);
      ends_.push_back({seen(*edge.from), seen(*edge.to)});
    }
    base += n;
  }
  count_ = base - first_;
}

// Links the edges that start at the same point. False where points are equal but for rounding.
bool EdgeView::join_places() {
  std::vector<std::uint32_t> order(count_);
  std::iota(order.begin(), order.end(), first_);
  std::stable_sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
    return edges_[a].from->approximate < edges_[b].from->approximate;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    ViewingEdge& edge = edges_[order[k]];
    edge.place = order[k];
    if (k == 0) continue;
    ViewingEdge& before = edges_[order[k - 1]];
    if (edge.from->approximate != before.from->approximate) continue;
    if (!(*edge.from == *before.from)) return false;
    edge.place = before.place;
    before.next_at_place = order[k];
  }
  return true;
}

void EdgeView::prepare_edge(ViewingEdge& edge) const {
  const auto& a = edge.from->approximate;
  const auto& b = edge.to->approximate;
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(b[0]), std::abs(b[1])});
  const std::array<double, 3> line{a[1] - b[1], b[0] - a[0], a[0] * b[1] - a[1] * b[0]};
  // L is the largest coordinate. A difference of two is off by 2uL and its rounding, 2uL; a product of two by 2u L^2
  // and its rounding, u L^2, and the difference of two products by 6u L^2 and its rounding, 2u L^2.
  const double difference_error = 8 * nef::kRoundingUnit * largest;
  const std::array<double, 3> line_error{difference_error, difference_error,
                                         16 * nef::kRoundingUnit * largest * largest};
  std::array<double, 4> plane{};
  std::array<double, 4> error{};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      plane[j] += line[i] * matrix_[i][j];
      error[j] += std::abs(line[i] * matrix_[i][j]) * kSumRounding + std::abs(matrix_[i][j]) * line_error[i];
    }
  }
  edge.normal.at = {plane[0], plane[1], plane[2]};
  edge.normal.error = std::max({error[0], error[1], error[2]});
  edge.offset = plane[3];
  edge.offset_error = error[3];
}

std::optional<Seen> EdgeView::project(const Spot& spot) const {
  const auto row = [&](std::size_t i) {
    return matrix_[i][0] * spot.at[0] + matrix_[i][1] * spot.at[1] + matrix_[i][2] * spot.at[2] + matrix_[i][3];
  };
  const double depth = row(2);
  const double depth_error = rounding_[2] + slope_[2] * spot.error;
  if (!(depth > 2 * depth_error)) return std::nullopt;
  Seen seen;
  seen.u = row(0) / depth;
  seen.v = row(1) / depth;
  const double largest = std::max(std::abs(seen.u), std::abs(seen.v));
  const double error = std::max(rounding_[0], rounding_[1]) + std::max(slope_[0], slope_[1]) * spot.error;
  seen.error = (error + depth_error * largest) / (depth - depth_error) * 1.0001 + largest * 0x1p-51;
  return seen;
}

// (x + a) / (z + c) - x / z = (a - (x / z) c) / (z + c).
std::optional<EdgeView::Window> EdgeView::window(const Double3& middle, const Double3& half) const {
  std::array<double, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = matrix_[i][0] * middle[0] + matrix_[i][1] * middle[1] + matrix_[i][2] * middle[2] + matrix_[i][3];
  }
  const double reach =
      std::abs(matrix_[2][0]) * half[0] + std::abs(matrix_[2][1]) * half[1] + std::abs(matrix_[2][2]) * half[2];
  const double nearest = x[2] - reach;
  if (!(nearest > 4 * rounding_[2])) return std::nullopt;
  Window result;
  const double per_depth = 1 / x[2];
  const double per_nearest = 1 / nearest;
  for (std::size_t i = 0; i < 2; ++i) {
    result.middle[i] = x[i] * per_depth;
    double spread = 0;
    for (std::size_t j = 0; j < 3; ++j) spread += std::abs(matrix_[i][j] - result.middle[i] * matrix_[2][j]) * half[j];
    // Of the middle, of the quotients and of the sums: far below the margin, or the window tells nothing.
    const double error =
        4 * (rounding_[i] + rounding_[2] * std::abs(result.middle[i]) + spread * kSumRounding) * per_nearest;
    if (!(error < margin_)) return std::nullopt;
    result.half[i] = spread * per_nearest + 2 * margin_;
  }
  return result;
}

std::array<std::int64_t, 2> EdgeView::rows(double low, double high) const {
  const double last = static_cast<double>(height_ - 1);
  const double first_row = std::floor((low - low_v_) / side_);
  const double last_row = std::floor((high - low_v_) / side_);
  if (!(first_row <= last) || !(last_row >= 0)) return {0, -1};
  return {static_cast<std::int64_t>(std::max(first_row, 0.0)), static_cast<std::int64_t>(std::min(last_row, last))};
}

std::array<std::int64_t, 2> EdgeView::columns(double low, double high) const {
  const double last = static_cast<double>(width_ - 1);
  const double first_column = std::floor((low - low_u_) / side_);
  const double last_column = std::floor((high - low_u_) / side_);
  if (!(first_column <= last) || !(last_column >= 0)) return {0, -1};
  return {static_cast<std::int64_t>(std::max(first_column, 0.0)),
          static_cast<std::int64_t>(std::min(last_column, last))};
}

// The columns that a segment passes in a row.
std::array<std::int64_t, 2> EdgeView::columns(double u0, double v0, double u1, double v1, std::int64_t row,
                                              double slack) const {
  const double top = low_v_ + static_cast<double>(row) * side_ - slack;
  const double bottom = top + side_ + 2 * slack;
  double low = std::min(u0, u1);
  double high = std::max(u0, u1);
  if (std::abs(v1 - v0) > side_ / 4) {
    const double slope = (u1 - u0) / (v1 - v0);
    const double x0 = u0 + (top - v0) * slope;
    const double x1 = u0 + (bottom - v0) * slope;
    low = std::max(low, std::min(x0, x1));
    high = std::min(high, std::max(x0, x1));
  }
  return columns(low - slack, high + slack);
}

std::array<double, 2> EdgeView::reference(std::int64_t column, std::int64_t row) const {
  // Somewhere in the middle of the cell, not in line with pixels.
  return {low_u_ + (static_cast<double>(column) + 0.51371) * side_,
          low_v_ + (static_cast<double>(row) + 0.48713) * side_};
}

bool EdgeView::build_grid() {
  double high_u = -INFINITY;
  double high_v = -INFINITY;
  low_u_ = low_v_ = INFINITY;
  for (std::uint32_t e = first_; e < first_ + count_; ++e) {
    const auto& p = edges_[e].from->approximate;
    low_u_ = std::min(low_u_, p[0]);
    low_v_ = std::min(low_v_, p[1]);
    high_u = std::max(high_u, p[0]);
    high_v = std::max(high_v, p[1]);
  }
  const double width = high_u - low_u_;
  const double height = high_v - low_v_;
  if (!(width > 0) || !(height > 0)) return false;
  const double cells = 48.0 * count_ + 16;
  side_ = std::max({std::sqrt(width * height / cells), width / 4000, height / 4000});
  per_side_ = 1 / side_;
  margin_ = side_ * 1e-3;
  low_u_ -= side_ / 3;
  low_v_ -= side_ / 3;
  width_ = static_cast<std::int64_t>((width + side_) / side_) + 1;
  height_ = static_cast<std::int64_t>((height + side_) / side_) + 1;
  fill_cells();
  return mark_cells();
}

// The edges that come near each cell.
void EdgeView::fill_cells() {
  const auto cell_count = static_cast<std::size_t>(width_ * height_);
  cell_begin_.assign(cell_count + 1, 0);
  // Twice over the edges: count, then fill.
  for (const bool fill : {false, true}) {
    for (std::uint32_t e = first_; e < first_ + count_; ++e) {
      const auto& a = edges_[e].from->approximate;
      const auto& b = edges_[e].to->approximate;
      const auto [top, bottom] = rows(std::min(a[1], b[1]) - 2 * margin_, std::max(a[1], b[1]) + 2 * margin_);
      for (std::int64_t row = top; row <= bottom; ++row) {
        const auto [left, right] = columns(a[0], a[1], b[0], b[1], row, 2 * margin_);
        for (std::int64_t column = left; column <= right; ++column) {
          const auto cell = static_cast<std::size_t>(row * width_ + column);
          if (fill) {
            cell_edges_[--cell_begin_[cell + 1]] = e;
          } else {
            ++cell_begin_[cell + 1];
          }
        }
      }
    }
    if (!fill) {
      for (std::size_t cell = 0; cell < cell_count; ++cell) cell_begin_[cell + 1] += cell_begin_[cell];
      cell_edges_.resize(cell_begin_[cell_count]);
    }
  }
  // Filling has moved each end to the beginning: cell c now begins at cell_begin_[c + 1].
  const auto total = static_cast<std::uint32_t>(cell_edges_.size());
  std::move(cell_begin_.begin() + 1, cell_begin_.end(), cell_begin_.begin());
  cell_begin_[cell_count] = total;
}

// Whether the reference points are inside: by the crossings of a line through those of a row. False if one is too near
// to an edge, or the line to a vertex.
bool EdgeView::mark_cells() {
  cell_inside_.assign(static_cast<std::size_t>(width_ * height_), false);
  std::vector<double> crossings;
  std::vector<std::uint32_t> edges;
  for (std::int64_t row = 0; row < height_; ++row) {
    const double v = reference(0, row)[1];
    edges.assign(cell_edges_.begin() + cell_begin_[static_cast<std::size_t>(row * width_)],
                 cell_edges_.begin() + cell_begin_[static_cast<std::size_t>((row + 1) * width_)]);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    crossings.clear();
    // So far from u or v is what is on a known side of them; more than rounding only costs grids.
    double safe = side_ * 1e-9;
    for (const std::uint32_t e : edges) {
      const auto& a = edges_[e].from->approximate;
      const auto& b = edges_[e].to->approximate;
      const double error = std::max(ends_[e - first_][0].error, ends_[e - first_][1].error);
      if (std::abs(a[1] - v) < safe + 3 * error || std::abs(b[1] - v) < safe + 3 * error) return false;
      if ((a[1] < v) == (b[1] < v)) continue;
      crossings.push_back(a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      // Ends that are moved by an error move the crossing by that and by its multiple with the slope, which is larger
      // by half at most, as the ends' difference is above 6 errors. The quotient is at most 1 and, with the
      // differences, rounds by 4u of itself, u = 2^-53, the product by u more, the sum by u of the larger end.
      const double slope = std::abs(b[0] - a[0]) / std::abs(b[1] - a[1]);
      const double largest = std::max(std::abs(a[0]), std::abs(b[0]));
      safe = std::max(safe, 4 * error * (1 + slope) + 16 * nef::kRoundingUnit * largest);
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (std::int64_t column = 0; column < width_; ++column) {
      const double u = reference(column, row)[0];
      while (passed < crossings.size() && crossings[passed] < u) ++passed;
      const bool close = (passed > 0 && u - crossings[passed - 1] < safe) ||
                         (passed < crossings.size() && crossings[passed] - u < safe);
      if (close) return false;
      cell_inside_[static_cast<std::size_t>(row * width_ + column)] = passed % 2 == 1;
    }
  }
  return true;
}

std::optional<EdgeView::Cell> EdgeView::cell_at(double u, double v) const {
  const double column = (u - low_u_) * per_side_;
  const double row = (v - low_v_) * per_side_;
  if (!(column >= 0 && row >= 0 && column < static_cast<double>(width_) && row < static_cast<double>(height_))) {
    return std::nullopt;
  }
  Cell cell{static_cast<std::int64_t>(column), static_cast<std::int64_t>(row), 0};
  cell.index = static_cast<std::size_t>(cell.row * width_ + cell.column);
  return cell;
}

std::optional<bool> EdgeView::crosses(const Seen& p, const Seen& reference, std::uint32_t edge) const {
  const auto& [c, d] = ends_[edge - first_];
  const std::optional<int> side_p = orient(c, d, p);
  const std::optional<int> side_r = orient(c, d, reference);
  if (!side_p || !side_r) return std::nullopt;
  if (*side_p == *side_r) return false;
  const std::optional<int> side_c = orient(p, reference, c);
  const std::optional<int> side_d = orient(p, reference, d);
  if (!side_c || !side_d) return std::nullopt;
  return *side_c != *side_d;
}

std::optional<bool> EdgeView::inside(const Seen& p, const nef::Monitor& monitor) const {
  if (!(p.error < margin_)) return std::nullopt;
  const std::optional<Cell> cell = cell_at(p.u, p.v);
  if (!cell) return false;  // the grid is larger than the silhouette by more than the error
  bool result = cell_inside_[cell->index];
  const std::uint32_t begin = cell_begin_[cell->index];
  const std::uint32_t end = cell_begin_[cell->index + 1];
  if (begin == end) return result;
  const auto [u, v] = reference(cell->column, cell->row);
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::optional<bool> crossed = crosses(p, {u, v, 0}, cell_edges_[i]);
    if (!crossed) return std::nullopt;
    if (*crossed) result = !result;
  }
  monitor.count_filter(end - begin);
  return result;
}

Side EdgeView::locate(const Point2& point, const nef::Monitor& monitor) const {
  const std::optional<Cell> cell = cell_at(point.approximate[0], point.approximate[1]);
  return cell ? locate_in_cell(*cell, PointImage(point, monitor), monitor) : Side::kOutside;
}

std::optional<Side> EdgeView::locate(const Seen& p, const ExactPoint& point, const nef::Monitor& monitor) const {
  if (!(p.error < margin_)) return std::nullopt;
  const std::optional<Cell> cell = cell_at(p.u, p.v);
  return cell ? locate_in_cell(*cell, SpaceImage(planes_, point), monitor) : Side::kOutside;
}

// By the crossings of the segment to the cell's reference point r. An end of an edge on the line through both counts as
// on its left; r lies on no edge, so where the line separates the ends, r does not lie on the line through them.
template <typename Image>
Side EdgeView::locate_in_cell(const Cell& cell, const Image& image, const nef::Monitor& monitor) const {
  monitor.count_exact();
  bool result = cell_inside_[cell.index];
  const auto [u, v] = reference(cell.column, cell.row);
  const Point2 r = Point2::from_doubles(u, v);
  for (std::uint32_t i = cell_begin_[cell.index]; i < cell_begin_[cell.index + 1]; ++i) {
    const std::uint32_t e = cell_edges_[i];
    const Point2& c = *edges_[e].from;
    const Point2& d = *edges_[e].to;
    const int side = image.side(c, d);
    if (side == 0) {
      if (between_ends(image, e) != Side::kOutside) return Side::kBoundary;
      continue;
    }
    if (side == orientation(c, d, r, monitor)) continue;
    if ((image.side(r, c) >= 0) != (image.side(r, d) >= 0)) result = !result;
  }
  return result ? Side::kInside : Side::kOutside;
}

std::optional<bool> EdgeView::between(const Seen& p, std::uint32_t edge) const {
  const auto& [c, d] = ends_[edge - first_];
  const bool steep = std::abs(d.v - c.v) > std::abs(d.u - c.u);
  const double a = steep ? c.v : c.u;
  const double b = steep ? d.v : d.u;
  const double x = steep ? p.v : p.u;
  const double error = 1.0001 * (p.error + std::max(c.error, d.error));
  const double low = std::min(a, b);
  const double high = std::max(a, b);
  if (x - error > low && x + error < high) return true;
  if (x + error < low || x - error > high) return false;
  return std::nullopt;
}

Side EdgeView::between(const ExactPoint& point, std::uint32_t edge, const nef::Monitor& monitor) const {
  monitor.count_exact();
  return between_ends(SpaceImage(planes_, point), edge);
}

// By lines through the ends along the other axis.
template <typename Image>
Side EdgeView::between_ends(const Image& image, std::uint32_t edge) const {
  const Point2& c = *edges_[edge].from;
  const Point2& d = *edges_[edge].to;
  const auto& a = c.approximate;
  const auto& b = d.approximate;
  const bool steep = std::abs(b[1] - a[1]) > std::abs(b[0] - a[0]);
  const auto along = [&](const Point2& p) { return steep ? Point2(p.x() + 1, p.y()) : Point2(p.x(), p.y() + 1); };
  const int from = image.side(c, along(c));
  const int to = image.side(d, along(d));
  if (from == 0 || to == 0) return Side::kBoundary;
  return from != to ? Side::kInside : Side::kOutside;
}

bool EdgeView::edges_at(const Seen& p, const ExactPoint& point, std::vector<std::uint32_t>& edges) const {
  if (!(p.error < margin_)) return false;
  const std::optional<Cell> cell = cell_at(p.u, p.v);
  if (!cell) return true;
  const SpaceImage image(planes_, point);
  for (std::uint32_t i = cell_begin_[cell->index]; i < cell_begin_[cell->index + 1]; ++i) {
    const std::uint32_t e = cell_edges_[i];
    if (image.side(*edges_[e].from, *edges_[e].to) == 0 && between_ends(image, e) != Side::kOutside) edges.push_back(e);
  }
  return true;
}

std::array<Integer, 4> EdgeView::plane(std::uint32_t edge) const {
  return planes_.through(*edges_[edge].from, *edges_[edge].to);
}

}  // namespace nef::visual_hull
