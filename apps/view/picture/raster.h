// SPDX-License-Identifier: Apache-2.0
//
// A band of samples with depth, into which triangles, lines and dots are painted.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/view/layer.h"
#include "apps/view/picture/picture_camera.h"
#include "nef/geometry/vectors.h"

namespace nef::view {

/// How the surface of a facet is filled.
enum class Fill : std::uint8_t { kSolid, kStriped, kFaded, kCut };

/// What a triangle shows in place of one colour: an image, or the colours of its corners.
struct PaintSurface {
  const SurfaceColors* surface = nullptr;   ///< outlives the triangle
  std::array<std::uint32_t, 3> vertices{};  ///< in surface->vertices
  std::uint32_t first_place = 0;            ///< of the first corner in surface->places
};

struct PaintTriangle {
  std::array<Projected, 3> corners;
  Color color{};
  Fill fill = Fill::kSolid;
  float opacity = 1;
  std::uint32_t facet = 0;  ///< of all layers together
  PaintSurface surface = {};
};

/// `beside` are the facets whose planes hold the line or dot: they never hide it, however the depth is rounded.
struct PaintLine {
  Projected from;
  Projected to;
  double half_width = 1;  ///< in samples
  Color color{};
  std::span<const std::uint32_t> beside;
};

struct PaintDot {
  Projected at;
  double radius = 1;  ///< in samples
  double rim_width = 0;
  Color fill{};
  Color rim{};
  std::span<const std::uint32_t> beside;
};

/// Samples of the rows [first_row, first_row + rows). Paint opaque triangles, then see-through ones, lines and dots in
/// any order, then resolve.
class Raster {
 public:
  /// `pattern` is the size of a pixel of the patterns, in samples.
  Raster(std::uint32_t width, std::uint32_t first_row, std::uint32_t rows, double pattern);

  void paint(const PaintTriangle& triangle);
  void paint(const PaintLine& line);
  void paint(const PaintDot& dot);

  /// Blends what is see-through and averages squares of `factor` x `factor` samples; the result has
  /// (rows / factor) x (width / factor) pixels of three bytes.
  [[nodiscard]] std::vector<std::uint8_t> resolve(std::uint32_t factor);

 private:
  struct Fragment {
    std::uint32_t sample = 0;
    float inverse_depth = 0;
    Color color{};
    float opacity = 0;
  };

  [[nodiscard]] bool hidden(std::size_t sample, double inverse_depth, std::span<const std::uint32_t> beside) const;
  [[nodiscard]] Color filled(const PaintTriangle& triangle, double x, double y) const;
  // The colour at weights of the corners on the picture.
  [[nodiscard]] static Color surface_color(const PaintTriangle& triangle, const std::array<double, 3>& weights);
  void put_mark(std::size_t sample, double inverse_depth, const Color& color, double before);
  void blend_fragments();

  std::uint32_t width_;
  double first_row_;
  std::uint32_t rows_;
  double pattern_;
  std::vector<Color> color_;
  std::vector<float> depth_;       // inverse, of the nearest opaque facet; 0 for none
  std::vector<float> mark_depth_;  // inverse, of the nearest line or dot that is seen
  std::vector<std::uint32_t> facet_;
  std::vector<Fragment> fragments_;
};

}  // namespace nef::view
