// SPDX-License-Identifier: Apache-2.0
//
// The incidence graph of the free cells, read off the sphere maps: what a sphere map shows around
// a vertex (an edge) is what touches it.
#include "apps/planner/free_space/free_space.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/union_find.h"

namespace nef::planner {
namespace {

using CellPairs = std::vector<std::pair<CellId, CellId>>;

// Everything around vertex v: pairs (vertex, larger cell), and per svertex pairs (edge, larger cell).
void append_incidences(const Complex& complex, const CellNumbering& cells, std::uint32_t v, CellPairs& pairs) {
  const SphereMapView map = complex.sphere_map(v);
  const VertexRecord& record = complex.vertices[v];
  const auto volume = [&](std::uint32_t sface) { return cells.volume(complex.sface_volume(record.sfaces + sface)); };
  const CellId vertex = cells.vertex(v);
  for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
    const CellId edge = cells.edge(record.svertices + s);
    pairs.emplace_back(vertex, edge);
    if (map.svertices[s].out == kNone) pairs.emplace_back(edge, volume(map.svertices[s].sface));
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    const CellId facet = cells.facet(facet_of(complex.shalfedge_facet[record.shalfedges + e]));
    const CellId edge = cells.edge(record.svertices + map.shalfedges[e].source);
    pairs.emplace_back(vertex, facet);
    pairs.emplace_back(edge, facet);
    pairs.emplace_back(edge, volume(map.shalfedges[e].sface));
  }
  for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
    pairs.emplace_back(vertex, cells.facet(facet_of(complex.sloop_facet[record.sloops + l])));
  }
  for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) pairs.emplace_back(vertex, volume(f));
}

}  // namespace

FreeSpace::FreeSpace(Polyhedron free) : free_(std::move(free)), cells_(free_.complex()) {
  if (complex().has_box()) {
    throw UnsupportedError("the free space is bounded by infinitely long edges or facets: give the scene a box");
  }
  connect();
  find_components();
  find_passages();
  find_touching_rooms();
}

FreeSpace::Partition::Partition(const FreeSpace& free)
    : tree(free.complex(), free.cells()),
      zones(free.complex(), free.cells(), tree, [&free](CellId cell) { return free.is_free(cell); }),
      seconds(watch.seconds()) {}

const FreeSpace::Partition& FreeSpace::partition(const std::function<bool()>& stop) const {
  if (const Partition* ready = ready_.load(std::memory_order_acquire)) return *ready;
  const std::lock_guard<std::mutex> lock(building_);
  if (!partition_) {
    const Interruptible interruptible(stop);
    partition_ = std::make_unique<const Partition>(*this);
    ready_.store(partition_.get(), std::memory_order_release);
  }
  return *partition_;
}

const ItemTree& FreeSpace::items() const {
  std::call_once(items_once_, [this] { items_ = std::make_unique<const ItemTree>(complex()); });
  return *items_;
}

const EmptyGrid& FreeSpace::grid() const {
  std::call_once(grid_once_, [this] { grid_ = std::make_unique<const EmptyGrid>(complex()); });
  return *grid_;
}

CellId FreeSpace::locate(const ExactPoint& point) const {
  if (const Partition* ready = ready_.load(std::memory_order_acquire)) return ready->tree.locate(point);
  const Location at = nef::locate(free_, point.rational());
  switch (at.kind) {
    case Location::Kind::kVertex:
      return cells_.vertex(at.index);
    case Location::Kind::kEdge:
      return cells_.edge(at.index);
    case Location::Kind::kFacet:
      return cells_.facet(at.facet());
    default:
      return cells_.volume(at.volume());
  }
}

void FreeSpace::connect() {
  const Complex& c = complex();
  CellPairs pairs;
  for (std::uint32_t v = 0; v < c.vertex_count(); ++v) append_incidences(c, cells_, v, pairs);
  for (const FacetId f : c.facets.ids()) {
    pairs.emplace_back(cells_.facet(f), cells_.volume(c.facets[f].volume_above));
    pairs.emplace_back(cells_.facet(f), cells_.volume(c.facets[f].volume_below));
  }
  std::erase_if(pairs, [&](const auto& pair) { return cells_.mark(pair.first) == 0 || cells_.mark(pair.second) == 0; });
  list_neighbours(pairs);
}

void FreeSpace::list_neighbours(const CellPairs& pairs) {
  neighbour_begin_.assign(cells_.size() + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++neighbour_begin_[a + 1];
    ++neighbour_begin_[b + 1];
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) neighbour_begin_[i + 1] += neighbour_begin_[i];
  neighbours_.resize(2 * pairs.size());
  std::vector<std::uint32_t> next(neighbour_begin_.begin(), neighbour_begin_.end() - 1);
  for (const auto& [a, b] : pairs) {
    neighbours_[next[a]++] = b;
    neighbours_[next[b]++] = a;
  }
  // Many pairs are seen from several vertices. The lists are short, so sorting each is cheap.
  auto end = neighbours_.begin();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto first = neighbours_.begin() + neighbour_begin_[i];
    const auto last = neighbours_.begin() + neighbour_begin_[i + 1];
    neighbour_begin_[i] = static_cast<std::uint32_t>(end - neighbours_.begin());
    std::sort(first, last);
    end = std::copy(first, std::unique(first, last), end);
  }
  neighbour_begin_[cells_.size()] = static_cast<std::uint32_t>(end - neighbours_.begin());
  neighbours_.erase(end, neighbours_.end());
}

void FreeSpace::find_components() {
  UnionFind sets(cells_.size());
  local_dimension_.assign(cells_.size(), -1);
  for (CellId cell = 0; cell < cells_.size(); ++cell) {
    if (cells_.mark(cell) == 0) continue;
    local_dimension_[cell] = cells_.dimension(cell);
    for (const CellId other : neighbours(cell)) {
      sets.unite(cell, other);
      local_dimension_[cell] = std::max(local_dimension_[cell], cells_.dimension(other));
    }
  }
  component_.assign(cells_.size(), kNoComponent);
  std::vector<std::uint32_t> index(cells_.size(), kNoComponent);
  for (CellId cell = 0; cell < cells_.size(); ++cell) {
    if (cells_.mark(cell) == 0) continue;
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
      result.push_back(c.points.rational(PointId{i}));
      break;
    case 1: {
      const std::uint32_t h = cells_.halfedge(cell);
      result.push_back(c.points.rational(PointId{c.svertex_owner[h]}));
      result.push_back(c.points.rational(PointId{c.target(h)}));
      break;
    }
    case 2:
      for (const std::uint32_t corner : c.corners_of(c.facets[FacetId{i}].first_cycle)) {
        result.push_back(c.points.rational(PointId{c.shalfedge_owner[corner]}));
      }
      break;
    default:
      break;
  }
  return result;
}

std::string FreeSpace::name(CellId cell) const {
  static constexpr std::array<const char*, 4> kKinds{"vertex", "edge", "facet", "volume"};
  return std::string(kKinds[static_cast<std::size_t>(cells_.dimension(cell))]) + " " +
         std::to_string(cells_.index(cell));
}

}  // namespace nef::planner
