// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/occupancy_grid.h"

#include <cmath>

namespace nef {

OccupancyGrid::OccupancyGrid(const Box& region, std::size_t boxes) : low_(region.low) {
  const double wanted = std::sqrt(static_cast<double>(boxes)) / 2;
  const auto cells = static_cast<std::uint32_t>(std::min(64.0, std::max(1.0, wanted)));
  last_ = {63, cells - 1, cells - 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = region.high[axis] - region.low[axis];
    const double scale = (last_[axis] + 1.0) / extent;
    // A flat or unbounded region has one cell along that axis.
    scale_[axis] = extent > 0 && scale < HUGE_VAL && std::fabs(low_[axis]) < HUGE_VAL ? scale : 0;
  }
  rows_.assign(static_cast<std::size_t>(cells) * cells, 0);
}

std::uint32_t OccupancyGrid::cell(std::size_t axis, double x) const {
  if (scale_[axis] == 0) return 0;
  // Rounded subtraction and multiplication are monotone.
  const double c = (x - low_[axis]) * scale_[axis];
  if (!(c > 0)) return 0;
  return c < last_[axis] ? static_cast<std::uint32_t>(c) : last_[axis];
}

OccupancyGrid::Range OccupancyGrid::range(const Box& box) const {
  const std::uint32_t x0 = cell(0, box.low[0]);
  const std::uint32_t x1 = cell(0, box.high[0]);
  const std::uint64_t bits = (~std::uint64_t{0} << x0) & (~std::uint64_t{0} >> (63U - x1));
  return {bits, cell(1, box.low[1]), cell(1, box.high[1]), cell(2, box.low[2]), cell(2, box.high[2])};
}

void OccupancyGrid::mark(const Box& box) {
  const Range r = range(box);
  const std::size_t width = last_[1] + 1U;
  for (std::uint32_t z = r.z0; z <= r.z1; ++z) {
    for (std::uint32_t y = r.y0; y <= r.y1; ++y) rows_[z * width + y] |= r.bits;
  }
}

bool OccupancyGrid::touches(const Box& box) const {
  const Range r = range(box);
  const std::size_t width = last_[1] + 1U;
  for (std::uint32_t z = r.z0; z <= r.z1; ++z) {
    for (std::uint32_t y = r.y0; y <= r.y1; ++y) {
      if ((rows_[z * width + y] & r.bits) != 0) return true;
    }
  }
  return false;
}

}  // namespace nef
