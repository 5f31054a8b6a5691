// SPDX-License-Identifier: Apache-2.0
//
// The constructor numbers the cells, finds which of them touch, and takes connected components of this graph by
// union-find. T and J between two cells are the largest k for which a search over cells of local dimension k or more,
// or of dimension k or more, still connects them: at most six searches. The partition, the tree of items and the grid
// are made when first asked for, once, behind a lock.
#include "apps/planner/free_space/free_space.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/union_find.h"

namespace nef::planner {
FreeSpace::FreeSpace(Polyhedron free) : free_(std::move(free)), cells_(free_.complex()) {
  if (complex().has_box()) {
    throw UnsupportedError("the free space is bounded by infinitely long edges or facets: give the scene a box");
  }
  std::vector<bool> free_cells(cells_.size());
  for (CellId cell = 0; cell < cells_.size(); ++cell) free_cells[cell] = cells_.mark(cell) != 0;
  incidences_ = Incidences(complex(), cells_, free_cells);
  find_components(free_cells);
  find_passages();
  find_touching_volumes();
}

FreeSpace::Partition::Partition(const FreeSpace& free, const Monitor& monitor)
    : tree(free.complex(), free.cells(), monitor),
      roadmap(free.complex(), free.cells(), tree, monitor, [&free](CellId cell) { return free.is_free(cell); }),
      seconds(watch.seconds()) {}

const FreeSpace::Partition& FreeSpace::partition(const Monitor& monitor) const {
  if (const Partition* ready = ready_.load(std::memory_order_acquire)) return *ready;
  const std::lock_guard<std::mutex> lock(building_);
  if (!partition_) {
    partition_ = std::make_unique<const Partition>(*this, monitor);
    ready_.store(partition_.get(), std::memory_order_release);
  }
  return *partition_;
}

const ItemTree& FreeSpace::items() const {
  std::call_once(items_once_, [this] { items_ = std::make_unique<const ItemTree>(complex()); });
  return *items_;
}

const EmptyGrid& FreeSpace::grid(const Monitor& monitor) const {
  std::call_once(grid_once_, [&] { grid_ = std::make_unique<const EmptyGrid>(complex(), monitor); });
  return *grid_;
}

CellId FreeSpace::locate(const ExactPoint& point) const {
  if (const Partition* ready = ready_.load(std::memory_order_acquire)) return ready->tree.locate(point);
  const Location at = nef::locate(free_, point.rational());
  switch (at.kind) {
    case Location::Kind::kVertex:
      return cells_.vertex(at.vertex());
    case Location::Kind::kEdge:
      return cells_.edge(at.halfedge());
    case Location::Kind::kFacet:
      return cells_.facet(at.facet());
    default:
      return cells_.volume(at.volume());
  }
}

void FreeSpace::find_components(const std::vector<bool>& free_cells) {
  UnionFind sets(cells_.size());
  local_dimension_.assign(cells_.size(), -1);
  for (CellId cell = 0; cell < cells_.size(); ++cell) {
    if (!free_cells[cell]) continue;
    local_dimension_[cell] = cells_.dimension(cell);
    const std::span<const CellId> larger = incidences_.larger(cell);
    for (const CellId other : larger) sets.unite(cell, other);
    if (!larger.empty()) local_dimension_[cell] = cells_.dimension(larger.back());
  }
  component_.assign(cells_.size(), kNoComponent);
  std::vector<std::uint32_t> index(cells_.size(), kNoComponent);
  for (CellId cell = 0; cell < cells_.size(); ++cell) {
    if (!free_cells[cell]) continue;
    std::uint32_t& number = index[sets.find(cell)];
    if (number == kNoComponent) {
      number = static_cast<std::uint32_t>(components_.size());
      components_.emplace_back();
    }
    component_[cell] = number;
    Component& component = components_[number];
    ++component.cells;
    component.dimension = std::max(component.dimension, cells_.dimension(cell));
    // Without an infimaximal box only the outer volume is unbounded.
    if (cell == cells_.volume(kOuterVolume)) component.bounded = false;
  }
}

std::optional<std::uint32_t> FreeSpace::passage_of(CellId cell) const {
  if (passage_[cell] == kNoComponent) return std::nullopt;
  return passage_[cell];
}

template <typename Allowed>
bool FreeSpace::connected(CellId start, CellId goal, const Allowed& allowed) const {
  std::vector<bool> seen(cells_.size(), false);
  std::vector<CellId> stack{start};
  seen[start] = true;
  while (!stack.empty()) {
    const CellId cell = stack.back();
    stack.pop_back();
    if (cell == goal) return true;
    for (const CellId other : neighbours(cell)) {
      if (seen[other] || !(other == goal || allowed(other))) continue;
      seen[other] = true;
      stack.push_back(other);
    }
  }
  return false;
}

std::optional<Thinness> FreeSpace::thinness(CellId start, CellId goal) const {
  if (!is_free(start) || !is_free(goal) || component_[start] != component_[goal]) return std::nullopt;
  if (start == goal && cells_.dimension(start) == 3) return Thinness{3, 3};
  Thinness result;
  for (int k = std::min(local_dimension_[start], local_dimension_[goal]); k > 0; --k) {
    if (connected(start, goal, [&](CellId cell) { return local_dimension_[cell] >= k; })) {
      result.piece = k;
      break;
    }
  }
  for (int j = 3; j > 0; --j) {
    if (connected(start, goal, [&](CellId cell) { return cells_.dimension(cell) >= j; })) {
      result.junction = j;
      break;
    }
  }
  return result;
}

std::vector<Rational3> FreeSpace::vertices(CellId cell) const {
  const Complex& c = complex();
  const std::uint32_t i = cells_.index(cell);
  std::vector<Rational3> result;
  switch (cells_.dimension(cell)) {
    case 0:
      result.push_back(c.points.rational(point_of(VertexId{i})));
      break;
    case 1: {
      const HalfedgeId h = cells_.halfedge(cell);
      result.push_back(c.points.rational(point_of(c.source(h))));
      result.push_back(c.points.rational(point_of(c.target(h))));
      break;
    }
    case 2:
      for (const SHalfedgeId corner : c.corners_of(c.facets[FacetId{i}].first_cycle)) {
        result.push_back(c.points.rational(point_of(c.shalfedge_vertex(corner))));
      }
      break;
    default:
      break;
  }
  return result;
}

Rational3 FreeSpace::point_in(CellId cell, const Monitor& monitor) const {
  if (complex().vertex_count() == 0) return {};  // all of space
  if (cells_.dimension(cell) == 0) return vertices(cell).front();
  build_roadmap(monitor);
  return roadmap().interior_point(roadmap().zone_in(cell));
}

std::string FreeSpace::name(CellId cell) const {
  static constexpr std::array<const char*, 4> kKinds{"vertex", "edge", "facet", "volume"};
  return std::string(kKinds[static_cast<std::size_t>(cells_.dimension(cell))]) + " " +
         std::to_string(cells_.index(cell));
}

}  // namespace nef::planner
