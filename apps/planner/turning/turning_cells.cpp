// SPDX-License-Identifier: Apache-2.0
//
// Components of slices are nodes, numbered as slices are made. An inner free space contains the slices at both ends of
// its cell, so one point of each component finds the component around it; an outer one is contained in both slices, and
// each of its components is a bridge between two nodes. A split cell passes its inner free space on to both halves,
// which stays valid for narrower ranges.
#include "apps/planner/turning/turning_cells.h"

#include <algorithm>

#include "apps/planner/free_space/free_positions.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

// For each component of one free space the component of a larger one that holds it.
std::vector<std::uint32_t> holders(const FreeSpace& small, const FreeSpace& large, const Monitor& monitor) {
  std::vector<std::uint32_t> result;
  if (large.components().size() == 1) return std::vector<std::uint32_t>(small.components().size(), 0);
  for (const Rational3& point : points_of_components(small, monitor)) {
    const CellId cell = large.locate(ExactPoint(point));
    NEF_ASSERT(large.is_free(cell));
    result.push_back(large.component(cell));
  }
  return result;
}

// True if one of a few points of a component lies in a component of another free space.
bool has_point_in(const FreeSpace& of, std::uint32_t component, const FreeSpace& in, std::uint32_t other) {
  constexpr std::size_t kPoints = 16;
  std::vector<CellId> cells;  // vertices and edges come first
  for (CellId cell = 0; cell < of.cells().size() && of.cells().dimension(cell) < 2; ++cell) {
    if (of.is_free(cell) && of.component(cell) == component) cells.push_back(cell);
  }
  const std::size_t step = std::max<std::size_t>(1, cells.size() / kPoints);
  for (std::size_t i = 0; i < cells.size(); i += step) {
    const std::vector<Rational3> ends = of.vertices(cells[i]);
    const CellId at = in.locate(ExactPoint(point_between(ends.front(), ends.back(), Rational(1, 2))));
    if (in.is_free(at) && in.component(at) == other) return true;
  }
  return false;
}

}  // namespace

std::vector<Rational3> points_of_components(const FreeSpace& free, const Monitor& monitor) {
  std::vector<Rational3> points(free.components().size());
  std::vector<bool> found(points.size(), false);
  // Vertices come first, so that only open components need the roadmap.
  for (CellId cell = 0; cell < free.cells().size(); ++cell) {
    if (!free.is_free(cell) || found[free.component(cell)]) continue;
    found[free.component(cell)] = true;
    points[free.component(cell)] = free.point_in(cell, monitor);
  }
  return points;
}

TurningCells::TurningCells(const Scene& scene, const TurningQuestion& question, const Monitor& monitor)
    : q_(question),
      robot_(scene.robot, question.axis, monitor),
      obstacles_(fixed_obstacles(scene, monitor)),
      without_robot_(free_space_of({}, monitor)) {}

std::shared_ptr<const FreeSpace> TurningCells::free_space_of(const std::vector<Mesh>& robot,
                                                             const Monitor& monitor) const {
  return std::make_shared<const FreeSpace>(obstacles_.free_positions(robot, monitor));
}

const TurningCells::Slice& TurningCells::slice_at(const Turn& turn, const Monitor& monitor) {
  const auto [place, is_new] = slices_.try_emplace(q_.is_ring() && turn == q_.high ? q_.low : turn);
  Slice& slice = place->second;
  if (is_new) {
    slice.free = free_space_of(robot_.pieces_at(turn), monitor);
    slice.first_node = static_cast<Node>(nodes_.size());
    for (std::uint32_t i = 0; i < slice.free->components().size(); ++i) nodes_.push_back({slice.free.get(), i});
  }
  return slice;
}

Node TurningCells::node_of(const Pose& pose, const Monitor& monitor) {
  const Slice& at = slice_at(pose.turn, monitor);
  const CellId cell = at.free->locate(ExactPoint(pose.position));
  return at.free->is_free(cell) ? at.first_node + at.free->component(cell) : kNoNode;
}

void TurningCells::find_holders(AngleCell& cell, const Monitor& monitor) {
  cell.below = holders(slice(cell.low, monitor), *cell.inner, monitor);
  cell.above = holders(slice(cell.high, monitor), *cell.inner, monitor);
}

void TurningCells::add(const Turn& low, const Turn& high, const Monitor& monitor) {
  ++looked_at_;
  AngleCell& cell = cells_[low];
  cell = {
      .low = low, .high = high, .inner = without_robot_, .inner_low = low, .inner_high = low, .below = {}, .above = {}};
  find_holders(cell, monitor);
}

void TurningCells::split(const Turn& low, const Turn& at, const Monitor& monitor) {
  AngleCell& below = cells_.at(low);
  AngleCell& above = cells_[at];
  above = below;
  below.high = above.low = at;
  for (AngleCell* cell : {&below, &above}) {
    ++looked_at_;
    cell->has_own_inner = cell->has_bridges = false;
    find_holders(*cell, monitor);
  }
}

void TurningCells::find_inner(const Turn& low, const Monitor& monitor) {
  AngleCell& cell = cells_.at(low);
  cell.inner = free_space_of(robot_.inner_pieces(cell.low, cell.high), monitor);
  cell.inner_low = cell.low;
  cell.inner_high = cell.high;
  cell.has_own_inner = true;
  find_holders(cell, monitor);
}

void TurningCells::find_bridges(const Turn& low, const Monitor& monitor) {
  AngleCell& cell = cells_.at(low);
  cell.has_bridges = true;
  const auto outer = free_space_of(robot_.outer_pieces(cell.low, cell.high, monitor), monitor);
  const std::vector<std::uint32_t> at_low = holders(*outer, slice(cell.low, monitor), monitor);
  const std::vector<std::uint32_t> at_high = holders(*outer, slice(cell.high, monitor), monitor);
  const std::vector<Rational3> points = points_of_components(*outer, monitor);
  for (std::size_t i = 0; i < points.size(); ++i) {
    bridges_.push_back({first_node(cell.low, monitor) + at_low[i], first_node(cell.high, monitor) + at_high[i],
                        cell.low, cell.high, points[i], outer});
  }
}

bool TurningCells::surely_meet(Node a, Node b) const {
  const SliceComponent& at_a = nodes_[a];
  const SliceComponent& at_b = nodes_[b];
  if (at_a.free == at_b.free) return false;
  return has_point_in(*at_a.free, at_a.component, *at_b.free, at_b.component) ||
         has_point_in(*at_b.free, at_b.component, *at_a.free, at_a.component);
}

}  // namespace nef::planner
