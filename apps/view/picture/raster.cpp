// SPDX-License-Identifier: Apache-2.0
//
// A triangle is filled row by row between the crossings of the row with its sides, which are computed in the same way
// for both neighbours of a side, so that no cracks open. The depth buffer holds inverse depths, which are linear on the
// picture. See-through triangles leave fragments, which are sorted by depth and blended at the end. Lines and dots
// compare with a small allowance of depth and ignore the facets that hold them.
#include "apps/view/picture/raster.h"

#include <algorithm>
#include <cmath>

namespace nef::view {
namespace {

constexpr std::uint32_t kNoFacet = 0xffffffffU;
constexpr double kAhead = 1.0005;  // how much nearer a thing must be to hide a line, as a ratio of depths

Color mix(const Color& a, const Color& b, double share) {
  Color result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * share));
  }
  return result;
}

double remainder_of(double x, double period) { return x - std::floor(x / period) * period; }

// The columns (centres of samples) in [low, high], within [0, width).
std::array<std::uint32_t, 2> columns(double low, double high, std::uint32_t width) {
  const double first = std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(width));
  const double last = std::clamp(std::floor(high - 0.5) + 1, 0.0, static_cast<double>(width));
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::max(first, last))};
}

}  // namespace

Raster::Raster(std::uint32_t width, std::uint32_t first_row, std::uint32_t rows, double pattern)
    : width_(width),
      first_row_(first_row),
      rows_(rows),
      pattern_(pattern),
      color_(std::size_t{width} * rows, Color{255, 255, 255}),
      depth_(color_.size(), 0.0F),
      mark_depth_(color_.size(), 0.0F),
      facet_(color_.size(), kNoFacet) {}

Color Raster::filled(const PaintTriangle& triangle, double x, double y) const {
  const double px = x / pattern_;
  const double py = y / pattern_;
  switch (triangle.fill) {
    case Fill::kSolid:
      break;
    case Fill::kStriped:
      return mix(triangle.color, {252, 247, 240}, remainder_of(px - py, 9) < 5 ? 0.9 : 0.12);
    case Fill::kFaded: {
      const Color faded = mix(triangle.color, {255, 255, 255}, 0.62);
      const bool speck = std::hypot(remainder_of(px, 7) - 3.5, remainder_of(py, 7) - 3.5) < 1.3;
      return speck ? mix(faded, {0, 0, 0}, 0.18) : faded;
    }
    case Fill::kCut:
      return mix(triangle.color, {255, 255, 255}, remainder_of(px + py, 7) < 1.4 ? 0.15 : 0.5);
  }
  return triangle.color;
}

Color Raster::surface_color(const PaintTriangle& triangle, const std::array<double, 3>& weights) {
  const SurfaceColors& surface = *triangle.surface.surface;
  // Weights in space: those on the picture count by inverse depth.
  std::array<double, 3> w{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += w[i] = weights[i] * triangle.corners[i].inverse_depth;
  for (double& x : w) x = sum > 0 ? x / sum : 1.0 / 3;
  if (!surface.has_image()) {
    std::array<double, 3> color{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Color& corner = surface.vertices[triangle.surface.vertices[i]];
      for (std::size_t k = 0; k < 3; ++k) color[k] += w[i] * corner[k];
    }
    Color result;
    for (std::size_t k = 0; k < 3; ++k)
      result[k] = static_cast<std::uint8_t>(std::lround(std::clamp(color[k], 0.0, 255.0)));
    return result;
  }
  double u = 0;
  double v = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    u += w[i] * static_cast<double>(surface.places[triangle.surface.first_place + i][0]);
    v += w[i] * static_cast<double>(surface.places[triangle.surface.first_place + i][1]);
  }
  // The pixel that holds the place: there are nine samples a pixel of the picture.
  const Image& image = surface.image;
  const double column = std::clamp(std::floor(u * image.width), 0.0, image.width - 1.0);
  const double row = std::clamp(std::floor((1 - v) * image.height), 0.0, image.height - 1.0);
  const std::size_t at = 3 * (static_cast<std::size_t>(row) * image.width + static_cast<std::size_t>(column));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

void Raster::paint(const PaintTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  const double low = std::max(std::min({a.y, b.y, c.y}) - first_row_, 0.0);
  const double high = std::min(std::max({a.y, b.y, c.y}) - first_row_, static_cast<double>(rows_));
  for (auto row = static_cast<std::uint32_t>(low); row < rows_ && row < high; ++row) {
    const double y = first_row_ + row + 0.5;
    // The part of the row inside: between the crossings of the row with the three sides.
    double left = 1e300;
    double right = -1e300;
    const auto cross_side = [&](const Projected& p, const Projected& q) {
      if ((p.y <= y) == (q.y <= y)) return;
      // From the upper end, whichever way the triangle turns: neighbours must round alike, or cracks would open.
      const Projected& upper = p.y < q.y ? p : q;
      const Projected& lower = p.y < q.y ? q : p;
      const double x = upper.x + (lower.x - upper.x) * (y - upper.y) / (lower.y - upper.y);
      left = std::min(left, x);
      right = std::max(right, x);
    };
    cross_side(a, b);
    cross_side(b, c);
    cross_side(c, a);
    if (left > right) continue;
    const auto [first, last] = columns(left, right, width_);
    for (std::uint32_t column = first; column < last; ++column) {
      const double x = column + 0.5;
      const double u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
      const double v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
      const auto inverse = static_cast<float>(a.inverse_depth + u * (b.inverse_depth - a.inverse_depth) +
                                              v * (c.inverse_depth - a.inverse_depth));
      const std::size_t sample = std::size_t{row} * width_ + column;
      if (inverse <= depth_[sample]) continue;
      const Color color =
          triangle.surface.surface != nullptr ? surface_color(triangle, {1 - u - v, u, v}) : filled(triangle, x, y);
      if (triangle.opacity < 1) {
        fragments_.push_back({static_cast<std::uint32_t>(sample), inverse, color, triangle.opacity});
      } else {
        depth_[sample] = inverse;
        facet_[sample] = triangle.facet;
        color_[sample] = color;
      }
    }
  }
}

bool Raster::hidden(std::size_t sample, double inverse_depth, std::span<const std::uint32_t> beside) const {
  if (depth_[sample] <= inverse_depth * kAhead) return false;
  return std::find(beside.begin(), beside.end(), facet_[sample]) == beside.end();
}

void Raster::put_mark(std::size_t sample, double inverse_depth, const Color& color, double before) {
  if (mark_depth_[sample] > inverse_depth * before) return;
  mark_depth_[sample] = std::max(mark_depth_[sample], static_cast<float>(inverse_depth));
  color_[sample] = color;
}

void Raster::paint(const PaintLine& line) {
  const double dx = line.to.x - line.from.x;
  const double dy = line.to.y - line.from.y;
  const double square = dx * dx + dy * dy;
  const double r = line.half_width;
  const double low = std::max(std::min(line.from.y, line.to.y) - r - first_row_, 0.0);
  const double high = std::min(std::max(line.from.y, line.to.y) + r - first_row_, static_cast<double>(rows_));
  for (auto row = static_cast<std::uint32_t>(low); row < rows_ && row < high; ++row) {
    const double y = first_row_ + row + 0.5;
    double left = std::min(line.from.x, line.to.x) - r;
    double right = std::max(line.from.x, line.to.x) + r;
    if (std::abs(dy) > 1e-9) {
      const double x = line.from.x + (y - line.from.y) * dx / dy;
      const double reach = r * std::sqrt(square) / std::abs(dy);
      left = std::max(left, x - reach);
      right = std::min(right, x + reach);
    }
    const auto [first, last] = columns(left, right, width_);
    for (std::uint32_t column = first; column < last; ++column) {
      const double x = column + 0.5;
      const double along = (x - line.from.x) * dx + (y - line.from.y) * dy;
      const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
      if (std::hypot(line.from.x + t * dx - x, line.from.y + t * dy - y) > r) continue;
      const double inverse = line.from.inverse_depth + t * (line.to.inverse_depth - line.from.inverse_depth);
      const std::size_t sample = std::size_t{row} * width_ + column;
      if (!hidden(sample, inverse, line.beside)) put_mark(sample, inverse, line.color, 1);
    }
  }
}

void Raster::paint(const PaintDot& dot) {
  const double low = std::max(dot.at.y - dot.radius - first_row_, 0.0);
  const double high = std::min(dot.at.y + dot.radius - first_row_, static_cast<double>(rows_));
  for (auto row = static_cast<std::uint32_t>(low); row < rows_ && row < high; ++row) {
    const double y = first_row_ + row + 0.5;
    const auto [first, last] = columns(dot.at.x - dot.radius, dot.at.x + dot.radius, width_);
    for (std::uint32_t column = first; column < last; ++column) {
      const double distance = std::hypot(column + 0.5 - dot.at.x, y - dot.at.y);
      if (distance > dot.radius) continue;
      const std::size_t sample = std::size_t{row} * width_ + column;
      if (hidden(sample, dot.at.inverse_depth, dot.beside)) continue;
      // The lines that end in the dot run a little towards the eye, or away from it.
      put_mark(sample, dot.at.inverse_depth, distance > dot.radius - dot.rim_width ? dot.rim : dot.fill, 1.02);
    }
  }
}

void Raster::blend_fragments() {
  std::stable_sort(fragments_.begin(), fragments_.end(), [](const Fragment& a, const Fragment& b) {
    return a.sample != b.sample ? a.sample < b.sample : a.inverse_depth < b.inverse_depth;
  });
  for (const Fragment& fragment : fragments_) {
    // Behind an opaque facet that was painted later, or behind a line or dot.
    if (fragment.inverse_depth <= depth_[fragment.sample]) continue;
    if (fragment.inverse_depth <= static_cast<double>(mark_depth_[fragment.sample]) * kAhead) continue;
    Color& under = color_[fragment.sample];
    under = mix(under, fragment.color, fragment.opacity);
  }
  fragments_.clear();
}

std::vector<std::uint8_t> Raster::resolve(std::uint32_t factor) {
  blend_fragments();
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t y = 0; y + factor <= rows_; y += factor) {
    for (std::uint32_t x = 0; x + factor <= width_; x += factor) {
      std::array<std::uint32_t, 3> sum{};
      for (std::uint32_t i = 0; i < factor; ++i) {
        for (std::uint32_t j = 0; j < factor; ++j) {
          const Color& color = color_[std::size_t{y + i} * width_ + x + j];
          for (std::size_t k = 0; k < 3; ++k) sum[k] += color[k];
        }
      }
      const std::uint32_t count = factor * factor;
      for (const std::uint32_t s : sum) pixels.push_back(static_cast<std::uint8_t>((s + count / 2) / count));
    }
  }
  return pixels;
}

}  // namespace nef::view
