// SPDX-License-Identifier: Apache-2.0
//
// A grid of cells over the set. The cell of a coordinate is a monotone function of it (a difference, a product and a
// truncation, each rounded monotonically), so the points of a cell are those of a box; and an item within a box enters
// only cells between those of the box's corners. Where no item enters a cell, all of it lies in one volume; so do
// neighbouring cells that no item enters, since what parts them would have to enter one of them. One point location
// settles such a region.
#include "nef/query/locate_many.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/complex/item_boxes.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/location/facet_search.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class CellGrid {
 public:
  CellGrid(const Complex& complex, std::size_t points) : c_(complex) {
    // About as many cells as points, and a border of cells around everything.
    const double wanted = std::cbrt(static_cast<double>(points));
    size_ = static_cast<std::uint32_t>(std::clamp(wanted, 4.0, 96.0));
    Box region;
    for (const VertexId v : c_.vertex_ids()) {
      if (c_.points.finite(point_of(v))) region.add(vertex_box(c_, v));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const bool usable = region.low[i] <= region.high[i] && std::isfinite(region.high[i] - region.low[i]);
      const double extent = usable ? region.high[i] - region.low[i] : 0.0;
      const double step = std::max(extent / (size_ - 2), std::numeric_limits<double>::min());
      low_[i] = usable ? region.low[i] - step : 0.0;
      scale_[i] = std::min(1 / step, std::numeric_limits<double>::max());
    }
    cells_.assign(std::size_t{size_} * size_ * size_, kFree);
    mark_items();
    find_regions();
  }

  [[nodiscard]] LabelId mark(const Polyhedron& a, const std::array<double, 3>& p, const Monitor& own) {
    const std::uint32_t region = cells_[number(index(0, p[0]), index(1, p[1]), index(2, p[2]))];
    if (region != kEntered) {
      const std::uint32_t known = region_marks_[region].load(std::memory_order_relaxed);
      if (known != kUnknown) return static_cast<LabelId>(known);
    }
    const LabelId mark = locate(a, {Rational(p[0]), Rational(p[1]), Rational(p[2])}, own).mark;
    if (region != kEntered) region_marks_[region].store(mark, std::memory_order_relaxed);
    return mark;
  }

 private:
  // A cell holds the number of its region, or one of these.
  static constexpr std::uint32_t kFree = 0xfffffffeU;
  static constexpr std::uint32_t kEntered = 0xffffffffU;
  static constexpr std::uint32_t kUnknown = 0x10000;  // no mark

  void find_regions() {
    std::uint32_t regions = 0;
    std::vector<std::size_t> stack;
    const std::size_t row = size_;
    const std::size_t layer = row * size_;
    for (std::size_t start = 0; start < cells_.size(); ++start) {
      if (cells_[start] != kFree) continue;
      const auto reach = [&](std::size_t cell) {
        if (cells_[cell] != kFree) return;
        cells_[cell] = regions;
        stack.push_back(cell);
      };
      reach(start);
      while (!stack.empty()) {
        const std::size_t cell = stack.back();
        stack.pop_back();
        const std::size_t x = cell % row;
        const std::size_t y = cell / row % row;
        const std::size_t z = cell / layer;
        if (x > 0) reach(cell - 1);
        if (y > 0) reach(cell - row);
        if (z > 0) reach(cell - layer);
        if (x + 1 < row) reach(cell + 1);
        if (y + 1 < row) reach(cell + row);
        if (z + 1 < row) reach(cell + layer);
      }
      ++regions;
    }
    region_marks_ = std::make_unique<std::atomic<std::uint32_t>[]>(regions);
    for (std::uint32_t i = 0; i < regions; ++i) region_marks_[i] = kUnknown;
  }

  [[nodiscard]] std::uint32_t index(std::size_t axis, double x) const {
    const double at = (x - low_[axis]) * scale_[axis];
    if (!(at >= 1)) return 0;
    return at >= size_ - 1 ? size_ - 1 : static_cast<std::uint32_t>(at);
  }
  [[nodiscard]] std::size_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * size_ + y) * size_ + x;
  }

  // Holds all coordinates of a cell along an axis.
  [[nodiscard]] std::array<double, 2> range(std::size_t axis, std::uint32_t cell) const {
    const double margin = (std::fabs(low_[axis]) + size_ / scale_[axis]) * 0x1p-45 + 1e-300;
    return {cell == 0 ? -kInfinity : low_[axis] + cell / scale_[axis] - margin,
            cell == size_ - 1 ? kInfinity : low_[axis] + (cell + 1) / scale_[axis] + margin};
  }

  void mark_items() {
    // What lies on an infimaximal box is nowhere in space.
    for (const FacetId f : c_.facets.ids()) {
      if (is_box_facet(c_, f)) continue;
      const Facet& facet = c_.facets[f];
      Box box;
      for (const SHalfedgeId corner : c_.corners_of(facet)) box.add(vertex_box(c_, c_.shalfedge_vertex(corner)));
      enter(box, &c_.planes.approximate(facet.plane));
    }
    for (const HalfedgeId h : c_.bare_edges()) {
      if (!is_box_edge(c_, h)) enter(edge_box(c_, h), nullptr);
    }
    for (const VertexId v : c_.vertex_ids()) {
      if (!is_box_vertex(c_, v)) enter(vertex_box(c_, v), nullptr);
    }
  }

  // Marks the cells that a box meets; if a plane is given, without those that surely lie on one side of it.
  void enter(const Box& box, const std::array<double, 4>* plane) {
    std::array<std::uint32_t, 3> first{};
    std::array<std::uint32_t, 3> last{};
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = index(i, box.low[i]);
      last[i] = index(i, box.high[i]);
    }
    for (std::uint32_t z = first[2]; z <= last[2]; ++z) {
      for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
        for (std::uint32_t x = first[0]; x <= last[0]; ++x) {
          if (plane == nullptr || may_meet(*plane, {x, y, z})) cells_[number(x, y, z)] = kEntered;
        }
      }
    }
  }

  // The coefficients are within 2^-52 relative of the truth, up to a common factor, and each product and sum adds as
  // much; 2^-46 of the sum of magnitudes covers all. Infinities and what they make prove nothing.
  [[nodiscard]] bool may_meet(const std::array<double, 4>& plane, const std::array<std::uint32_t, 3>& cell) const {
    double low = plane[3];
    double high = plane[3];
    double size = std::fabs(plane[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (plane[i] == 0) continue;
      const auto [from, to] = range(i, cell[i]);
      const double a = plane[i] * from;
      const double b = plane[i] * to;
      low += std::min(a, b);
      high += std::max(a, b);
      size += std::fabs(a) + std::fabs(b);
    }
    const double bound = size * 0x1p-46 + 1e-300;
    return !(low > bound) && !(high < -bound);
  }

  const Complex& c_;
  std::uint32_t size_ = 0;
  std::array<double, 3> low_{};
  std::array<double, 3> scale_{};
  std::vector<std::uint32_t> cells_;
  std::unique_ptr<std::atomic<std::uint32_t>[]> region_marks_;
};

}  // namespace

std::vector<LabelId> locate_many(const Polyhedron& a, std::span<const std::array<double, 3>> points,
                                 const Monitor& monitor) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i][0]) || !std::isfinite(points[i][1]) || !std::isfinite(points[i][2])) {
      throw InputError("a coordinate of point " + std::to_string(i) + " is not a finite number");
    }
  }
  const Complex& complex = a.complex();
  std::vector<LabelId> marks(points.size(), complex.volumes[kOuterVolume].mark);
  if (complex.vertex_count() == 0 || points.empty()) return marks;
  static_cast<void>(a.queries());
  CellGrid grid(complex, points.size());
  constexpr std::size_t kChunk = 4096;
  parallel_for((points.size() + kChunk - 1) / kChunk, monitor, [&](std::size_t chunk, const Monitor& own) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) marks[i] = grid.mark(a, points[i], own);
  });
  return marks;
}

}  // namespace nef
