// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/search/occupancy_grid.h"

#include <cmath>

#include "nef/base/fast_path.h"

namespace nef {

OccupancyGrid::OccupancyGrid(const Box& region, std::size_t boxes) : region_(region) {
  const double wanted = std::sqrt(static_cast<double>(boxes)) / 2;
  const auto cells = static_cast<std::uint32_t>(std::min(64.0, std::max(1.0, wanted)));
  last_ = {63, cells - 1, cells - 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = region.high[axis] - region.low[axis];
    const double scale = (last_[axis] + 1.0) / extent;
    // A flat or unbounded region has one cell along that axis.
    scale_[axis] = extent > 0 && scale < HUGE_VAL && std::fabs(region.low[axis]) < HUGE_VAL ? scale : 0;
  }
  rows_.assign(static_cast<std::size_t>(cells) * cells, 0);
}

std::uint32_t OccupancyGrid::cell(std::size_t axis, double x) const {
  if (scale_[axis] == 0) return 0;
  // Rounded subtraction and multiplication are monotone.
  const double c = (x - region_.low[axis]) * scale_[axis];
  if (!(c > 0)) return 0;
  return c < last_[axis] ? static_cast<std::uint32_t>(c) : last_[axis];
}

CellRange OccupancyGrid::range(const Box& box) const {
  CellRange result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t first = box.low[axis] <= region_.high[axis] ? cell(axis, box.low[axis]) + 1 : last_[axis] + 2;
    const std::uint32_t last = box.high[axis] >= region_.low[axis] ? cell(axis, box.high[axis]) + 1 : 0;
    result.first[axis] = static_cast<std::uint8_t>(first);
    result.last[axis] = static_cast<std::uint8_t>(last);
  }
  return result;
}

namespace {

// The cells of a range along x.
std::uint64_t bits(const CellRange& box) {
  return (~std::uint64_t{0} << (box.first[0] - 1U)) & (~std::uint64_t{0} >> (64U - box.last[0]));
}

}  // namespace

void OccupancyGrid::mark(const CellRange& box) {
  const std::uint64_t cells = bits(box);
  const std::size_t width = last_[1] + 1U;
  for (std::size_t z = box.first[2] - 1U; z < box.last[2]; ++z) {
    for (std::size_t y = box.first[1] - 1U; y < box.last[1]; ++y) rows_[z * width + y] |= cells;
  }
}

bool OccupancyGrid::touches(const CellRange& box) const {
  if (!kFastPaths) return true;
  const std::uint64_t cells = bits(box);
  const std::size_t width = last_[1] + 1U;
  for (std::size_t z = box.first[2] - 1U; z < box.last[2]; ++z) {
    for (std::size_t y = box.first[1] - 1U; y < box.last[1]; ++y) {
      if ((rows_[z * width + y] & cells) != 0) return true;
    }
  }
  return false;
}

}  // namespace nef
