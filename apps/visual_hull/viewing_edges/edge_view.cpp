// SPDX-License-Identifier: Apache-2.0
//
// Errors of sums are bounded by 2^-50 times the sum of magnitudes: a few roundings of 2^-53 each, with room.
#include "apps/visual_hull/viewing_edges/edge_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nef/base/predicate_counts.h"

namespace visual_hull {
namespace {

constexpr double kUnit = 0x1p-50;

Vector to_doubles(const Rational3& v) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.at[i] = nef::nearest_double(v[i]);
    result.error = std::max(result.error, std::abs(result.at[i]) * kUnit);
  }
  return result;
}

}  // namespace

std::optional<EdgeView> EdgeView::make(const Camera& camera, const Silhouette& silhouette, std::uint32_t index,
                                       const Vec3& reach, const ExactSpots& exact, std::vector<ViewingEdge>& edges) {
  EdgeView view(camera, reach, exact, edges);
  view.collect_edges(silhouette, index);
  if (!view.join_places() || !view.build_grid()) return std::nullopt;
  return view;
}

EdgeView::EdgeView(const Camera& camera, const Vec3& reach, const ExactSpots& exact, std::vector<ViewingEdge>& edges)
    : camera_(camera), exact_(exact), edges_(edges), first_(static_cast<std::uint32_t>(edges.size())) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix_[i][j] = nef::nearest_double(camera.matrix()[i][j]);
    double size = std::abs(matrix_[i][3]);
    double slope = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      size += std::abs(matrix_[i][j]) * reach[j];
      slope += std::abs(matrix_[i][j]);
    }
    rounding_[i] = size * kUnit;
    slope_[i] = slope * 1.0001;
  }
  centre_ = to_doubles(camera.centre());
  const auto& m = matrix_[2];
  const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  axis_ = {m[0] / length, m[1] / length, m[2] / length};
}

void EdgeView::collect_edges(const Silhouette& silhouette, std::uint32_t index) {
  // ray(u, v) is affine in u and v.
  const auto difference = [](const Rational3& a, const Rational3& b) {
    return Rational3{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const Rational3 origin = camera_.ray(Point2(0, 0));
  const Vector ray0 = to_doubles(origin);
  const Vector ray_u = to_doubles(difference(camera_.ray(Point2(1, 0)), origin));
  const Vector ray_v = to_doubles(difference(camera_.ray(Point2(0, 1)), origin));
  for (const Ring& ring : silhouette.rings) {
    const auto base = static_cast<std::uint32_t>(edges_.size());
    const std::size_t n = ring.size();
    for (std::size_t k = 0; k < n; ++k) {
      ViewingEdge edge;
      edge.from = &ring[k];
      edge.to = &ring[(k + 1) % n];
      edge.view = index;
      edge.next = base + static_cast<std::uint32_t>((k + 1) % n);
      edge.previous = base + static_cast<std::uint32_t>((k + n - 1) % n);
      prepare_edge(edge, ray0, ray_u, ray_v);
      edges_.push_back(edge);
      ends_.push_back({seen(*edge.from), seen(*edge.to)});
    }
  }
  count_ = static_cast<std::uint32_t>(edges_.size()) - first_;
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

void EdgeView::prepare_edge(ViewingEdge& edge, const Vector& ray0, const Vector& ray_u, const Vector& ray_v) const {
  const auto& a = edge.from->approximate;
  const auto& b = edge.to->approximate;
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(b[0]), std::abs(b[1])});
  const std::array<double, 3> line{a[1] - b[1], b[0] - a[0], a[0] * b[1] - a[1] * b[0]};
  const std::array<double, 3> line_error{largest * kUnit, largest * kUnit, 2 * largest * largest * kUnit};
  std::array<double, 4> plane{};
  std::array<double, 4> error{};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      plane[j] += line[i] * matrix_[i][j];
      error[j] += std::abs(line[i] * matrix_[i][j]) * kUnit + std::abs(matrix_[i][j]) * line_error[i];
    }
  }
  edge.normal.at = {plane[0], plane[1], plane[2]};
  edge.normal.error = std::max({error[0], error[1], error[2]});
  edge.offset = plane[3];
  edge.offset_error = error[3];
  for (std::size_t i = 0; i < 3; ++i) {
    edge.ray.at[i] = ray0.at[i] + a[0] * ray_u.at[i] + a[1] * ray_v.at[i];
    const double size = std::abs(ray0.at[i]) + std::abs(a[0] * ray_u.at[i]) + std::abs(a[1] * ray_v.at[i]);
    const double inherited = ray0.error + std::abs(a[0]) * ray_u.error + std::abs(a[1]) * ray_v.error;
    edge.ray.error = std::max(edge.ray.error, size * kUnit + inherited);
  }
  edge.ray_length = std::hypot(edge.ray.at[0], edge.ray.at[1], edge.ray.at[2]);
}

double EdgeView::depth(const Spot& spot, double& error) const {
  const auto& m = matrix_[2];
  double value = m[3];
  double size = std::abs(m[3]);
  double slope = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    value += m[j] * spot.at[j];
    size += std::abs(m[j] * spot.at[j]);
    slope += std::abs(m[j]);
  }
  error = size * kUnit + slope * spot.error * 1.0001;
  return value;
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
  seen.spot = &spot;
  return seen;
}

// (x + a) / (z + c) - x / z = (a - (x / z) c) / (z + c).
std::optional<EdgeView::Window> EdgeView::window(const Vec3& middle, const Vec3& half) const {
  std::array<double, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = matrix_[i][0] * middle[0] + matrix_[i][1] * middle[1] + matrix_[i][2] * middle[2] + matrix_[i][3];
  }
  const double reach =
      std::abs(matrix_[2][0]) * half[0] + std::abs(matrix_[2][1]) * half[1] + std::abs(matrix_[2][2]) * half[2];
  const double nearest = x[2] - reach;
  if (!(nearest > 4 * rounding_[2])) return std::nullopt;
  Window result;
  for (std::size_t i = 0; i < 2; ++i) {
    result.middle[i] = x[i] / x[2];
    double spread = 0;
    for (std::size_t j = 0; j < 3; ++j) spread += std::abs(matrix_[i][j] - result.middle[i] * matrix_[2][j]) * half[j];
    // Of the middle, of the quotients and of the sums: far below the margin, or the window tells nothing.
    const double error = 4 * (rounding_[i] + rounding_[2] * std::abs(result.middle[i]) + spread * kUnit) / nearest;
    if (!(error < margin_)) return std::nullopt;
    result.half[i] = spread / nearest + 2 * margin_;
  }
  return result;
}

Seen EdgeView::seen(const Point2& point) {
  const auto& p = point.approximate;
  const double error = point.lattice ? 0 : std::max(std::abs(p[0]), std::abs(p[1])) * 0x1p-52;
  return {p[0], p[1], error, nullptr, &point};
}

std::optional<Point2> EdgeView::exact(const Seen& p) const {
  if (p.point != nullptr) return *p.point;
  if (p.spot == nullptr) return Point2::from_doubles(p.u, p.v);
  const std::optional<Rational3> x = exact_.exact(*p.spot);
  if (!x) return std::nullopt;
  const Projection q = camera_.project(*x);
  return Point2{q.x / q.depth, q.y / q.depth};
}

std::optional<int> EdgeView::orient(const Seen& a, const Seen& b, const Seen& c) const {
  const double bu = b.u - a.u;
  const double bv = b.v - a.v;
  const double cu = c.u - a.u;
  const double cv = c.v - a.v;
  const double left = bu * cv;
  const double right = bv * cu;
  // A difference is off by 2e and its rounding, a product of two by at most 2e(|x| + |y|) + 4e^2 and roundings.
  const double e = std::max({a.error, b.error, c.error});
  const double sum = std::abs(bu) + std::abs(bv) + std::abs(cu) + std::abs(cv);
  const double bound = 3 * e * sum + 9 * e * e + (std::abs(left) + std::abs(right)) * kUnit;
  const double value = left - right;
  if (value > bound || value < -bound) {
    ++nef::predicate_counts().filter;
    return value > 0 ? 1 : -1;
  }
  ++nef::predicate_counts().exact;
  const std::array<std::optional<Point2>, 3> p{exact(a), exact(b), exact(c)};
  if (!p[0] || !p[1] || !p[2]) return std::nullopt;
  const int sign = orientation(*p[0], *p[1], *p[2]);
  if (sign == 0) return std::nullopt;  // degenerate
  return sign;
}

std::optional<bool> EdgeView::left_of(const Seen& p, std::uint32_t edge) const {
  const auto& [c, d] = ends_[edge - first_];
  const std::optional<int> side = orient(c, d, p);
  if (!side) return std::nullopt;
  return *side > 0;
}

std::optional<bool> EdgeView::crosses(const Seen& a, const Seen& b, std::uint32_t edge) const {
  const auto& [c, d] = ends_[edge - first_];
  const double slack = a.error + b.error + margin_;
  if (std::max(a.u, b.u) + slack < std::min(c.u, d.u) || std::max(c.u, d.u) + slack < std::min(a.u, b.u)) return false;
  if (std::max(a.v, b.v) + slack < std::min(c.v, d.v) || std::max(c.v, d.v) + slack < std::min(a.v, b.v)) return false;
  const std::optional<int> side_a = orient(c, d, a);
  const std::optional<int> side_b = orient(c, d, b);
  if (!side_a || !side_b) return std::nullopt;
  if (*side_a == *side_b) return false;
  const std::optional<int> side_c = orient(a, b, c);
  const std::optional<int> side_d = orient(a, b, d);
  if (!side_c || !side_d) return std::nullopt;
  return *side_c != *side_d;
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
  margin_ = side_ * 1e-3;
  low_u_ -= side_ / 3;
  low_v_ -= side_ / 3;
  width_ = static_cast<std::int64_t>((width + side_) / side_) + 1;
  height_ = static_cast<std::int64_t>((height + side_) / side_) + 1;
  fill_cells();
  sum_cells();
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

void EdgeView::sum_cells() {
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  crossed_cells_.assign((width + 1) * (height + 1), 0);
  for (std::size_t y = 0; y < height; ++y) {
    std::uint32_t row = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t cell = y * width + x;
      if (cell_begin_[cell] != cell_begin_[cell + 1]) ++row;
      crossed_cells_[(y + 1) * (width + 1) + x + 1] = crossed_cells_[y * (width + 1) + x + 1] + row;
    }
  }
}

std::optional<bool> EdgeView::all_inside(const Seen& a, const Seen& b) const {
  const double slack = a.error + b.error;
  if (!(slack < margin_)) return std::nullopt;
  const double left = std::floor((std::min(a.u, b.u) - low_u_) / side_);
  const double right = std::floor((std::max(a.u, b.u) - low_u_) / side_);
  const double top = std::floor((std::min(a.v, b.v) - low_v_) / side_);
  const double bottom = std::floor((std::max(a.v, b.v) - low_v_) / side_);
  const auto width = static_cast<double>(width_);
  const auto height = static_cast<double>(height_);
  if (right < 0 || bottom < 0 || left >= width || top >= height) return false;
  if (!(left >= 0 && top >= 0 && right < width && bottom < height)) return std::nullopt;
  const auto x0 = static_cast<std::size_t>(left);
  const auto x1 = static_cast<std::size_t>(right) + 1;
  const auto y0 = static_cast<std::size_t>(top);
  const auto y1 = static_cast<std::size_t>(bottom) + 1;
  const auto sum = [this](std::size_t x, std::size_t y) {
    return crossed_cells_[y * static_cast<std::size_t>(width_ + 1) + x];
  };
  if (sum(x1, y1) + sum(x0, y0) != sum(x0, y1) + sum(x1, y0)) return std::nullopt;
  return cell_inside_[y0 * static_cast<std::size_t>(width_) + x0];
}

// Whether the reference points are inside: by the crossings of a line through those of a row. False if one is too near
// to an edge, or the line to a vertex.
bool EdgeView::mark_cells() {
  cell_inside_.assign(static_cast<std::size_t>(width_ * height_), false);
  std::vector<double> crossings;
  std::vector<std::uint32_t> edges;
  const double safe = side_ * 1e-9;  // far above rounding
  for (std::int64_t row = 0; row < height_; ++row) {
    const double v = reference(0, row)[1];
    edges.assign(cell_edges_.begin() + cell_begin_[static_cast<std::size_t>(row * width_)],
                 cell_edges_.begin() + cell_begin_[static_cast<std::size_t>((row + 1) * width_)]);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    crossings.clear();
    for (const std::uint32_t e : edges) {
      const auto& a = edges_[e].from->approximate;
      const auto& b = edges_[e].to->approximate;
      if (std::abs(a[1] - v) < safe || std::abs(b[1] - v) < safe) return false;
      if ((a[1] < v) != (b[1] < v)) crossings.push_back(a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
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

std::optional<bool> EdgeView::inside(const Seen& p) const {
  if (!(p.error < margin_)) return std::nullopt;
  const double column = std::floor((p.u - low_u_) / side_);
  const double row = std::floor((p.v - low_v_) / side_);
  if (!(column >= 0 && row >= 0 && column < static_cast<double>(width_) && row < static_cast<double>(height_))) {
    return false;  // the grid is larger than the silhouette by more than the error
  }
  const auto x = static_cast<std::int64_t>(column);
  const auto y = static_cast<std::int64_t>(row);
  const auto cell = static_cast<std::size_t>(y * width_ + x);
  bool result = cell_inside_[cell];
  if (cell_begin_[cell] == cell_begin_[cell + 1]) return result;
  const std::array<double, 2> middle = reference(x, y);
  const Seen reference_point{middle[0], middle[1], 0, nullptr, nullptr};
  for (std::uint32_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i) {
    const std::optional<bool> crossed = crosses(p, reference_point, cell_edges_[i]);
    if (!crossed) return std::nullopt;
    if (*crossed) result = !result;
  }
  return result;
}

}  // namespace visual_hull
