// SPDX-License-Identifier: Apache-2.0
//
// Rectangles in rows (shelves): sorted by height, each row as high as its first. The width is the one that makes the
// atlas about square.
#include "apps/visual_hull/texture/packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

constexpr int kPadding = 2;

// Sizes of the rectangles at a scale; places them; false if they need more than `largest` texels a side.
bool place_all(Atlas& atlas, double scale, int largest) {
  double area = 0;
  int widest = 1;
  for (Chart& chart : atlas.charts) {
    chart.width = static_cast<int>(std::ceil(scale * (chart.high[0] - chart.low[0]))) + 1 + 2 * kPadding;
    chart.height = static_cast<int>(std::ceil(scale * (chart.high[1] - chart.low[1]))) + 1 + 2 * kPadding;
    area += static_cast<double>(chart.width) * chart.height;
    widest = std::max(widest, chart.width);
  }
  if (widest > largest || area > static_cast<double>(largest) * largest) return false;
  atlas.width = std::min(largest, std::max(widest, static_cast<int>(std::ceil(std::sqrt(1.05 * area)))));
  std::vector<std::size_t> order(atlas.charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return atlas.charts[a].height > atlas.charts[b].height; });
  int x = 0;
  int y = 0;
  int row = 0;
  for (const std::size_t i : order) {
    Chart& chart = atlas.charts[i];
    if (x + chart.width > atlas.width) {
      x = 0;
      y += row;
      row = 0;
    }
    chart.x = x;
    chart.y = y;
    x += chart.width;
    row = std::max(row, chart.height);
    if (y + row > largest) return false;
  }
  atlas.height = std::max(1, y + row);
  return true;
}

}  // namespace

void pack(Atlas& atlas, int largest) {
  double scale = 1;
  while (!place_all(atlas, scale, largest)) {
    scale *= 0.9;
    if (scale < 0.02) {
      throw nef::InputError("the texture would have " + std::to_string(atlas.charts.size()) +
                            " pieces, which do not fit into an image of " + std::to_string(largest) +
                            " pixels a side: use --simplify or --decimate");
    }
  }
  for (std::size_t t = 0; t < atlas.places.size(); ++t) {
    const Chart& chart = atlas.charts[atlas.chart_of[t]];
    for (Place2& place : atlas.places[t]) {
      place[0] = scale * (place[0] - chart.low[0]) + chart.x + kPadding;
      place[1] = scale * (place[1] - chart.low[1]) + chart.y + kPadding;
    }
  }
}

}  // namespace nef::visual_hull
