// SPDX-License-Identifier: Apache-2.0
//
// Tight passages, their mouths and bottlenecks, and volumes that only touch. A passage is a connected set of free cells
// that no free volume touches. Its bottleneck is found by searching it from volume to volume with cells of local
// dimension (T) or dimension (J) k or more, for k = 2 and 1. Touching volumes are connected sets of edges and vertices
// with two volumes around each. Linear in the incidences, times the logarithm of sorting.
#include <algorithm>

#include "apps/planner/free_space/free_space.h"
#include "nef/base/union_find.h"

namespace nef::planner {
namespace {

void make_unique(std::vector<CellId>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// The connected sets of some free cells, each in ascending order.
template <typename Wanted>
std::vector<std::vector<CellId>> connected_sets(const FreeSpace& free, const Wanted& wanted) {
  const auto count = static_cast<CellId>(free.cells().size());
  UnionFind sets(count);
  for (CellId cell = 0; cell < count; ++cell) {
    if (!wanted(cell)) continue;
    for (const CellId other : free.neighbours(cell)) {
      if (wanted(other)) sets.unite(cell, other);
    }
  }
  std::vector<std::vector<CellId>> result;
  std::vector<std::size_t> index(count, 0);
  for (CellId cell = 0; cell < count; ++cell) {
    if (!wanted(cell)) continue;
    const CellId root = sets.find(cell);
    if (root == cell) {
      index[root] = result.size();
      result.emplace_back();
    }
    result[index[root]].push_back(cell);
  }
  return result;
}

}  // namespace

// closure(interior(F)) is the union of the closures of the free volumes: the interior differs from
// the volumes by cells of smaller dimension that they surround. So a free cell lies outside iff no
// free volume touches it.
void FreeSpace::find_passages() {
  passage_.assign(cells_.size(), kNoComponent);
  const auto tight = [&](CellId cell) { return is_free(cell) && local_dimension_[cell] < 3; };
  for (std::vector<CellId>& cells : connected_sets(*this, tight)) {
    TightPassage& passage = passages_.emplace_back();
    passage.component = component_[cells.front()];
    for (const CellId cell : cells) {
      passage_[cell] = static_cast<std::uint32_t>(passages_.size() - 1);
      passage.dimension = std::max(passage.dimension, cells_.dimension(cell));
    }
    passage.cells = std::move(cells);
  }
  for (TightPassage& passage : passages_) {
    find_mouths(passage);
    passage.bottleneck = bottleneck(passage);
  }
}

void FreeSpace::find_mouths(TightPassage& passage) const {
  for (const CellId cell : passage.cells) {
    for (const CellId other : neighbours(cell)) {
      if (local_dimension_[other] == 3) passage.mouths.push_back(other);
    }
  }
  make_unique(passage.mouths);
  for (const CellId mouth : passage.mouths) {
    for (const CellId other : neighbours(mouth)) {
      if (cells_.dimension(other) == 3) passage.volumes.push_back(other);
    }
  }
  make_unique(passage.volumes);
}

// True if a way leads from one volume to another through allowed cells of the passage and allowed mouths.
template <typename Allowed>
bool FreeSpace::joins_volumes(const TightPassage& passage, const Allowed& allowed) const {
  const std::vector<CellId>& cells = passage.cells;  // ascending
  std::vector<bool> seen(cells.size(), false);
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (seen[first] || !allowed(cells[first])) continue;
    std::vector<CellId> volumes;
    std::vector<std::size_t> queue{first};
    seen[first] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (const CellId other : neighbours(cells[queue[next]])) {
        if (!allowed(other)) continue;
        const auto at = std::lower_bound(cells.begin(), cells.end(), other);
        if (at == cells.end() || *at != other) {
          for (const CellId volume : neighbours(other)) {
            if (cells_.dimension(volume) == 3) volumes.push_back(volume);
          }
        } else if (const auto index = static_cast<std::size_t>(at - cells.begin()); !seen[index]) {
          seen[index] = true;
          queue.push_back(index);
        }
      }
    }
    make_unique(volumes);
    if (volumes.size() > 1) return true;
  }
  return false;
}

std::optional<Thinness> FreeSpace::bottleneck(const TightPassage& passage) const {
  if (passage.volumes.size() < 2) return std::nullopt;
  Thinness result;
  for (int k = 2; k > 0 && result.piece == 0; --k) {
    if (joins_volumes(passage, [&](CellId cell) { return local_dimension_[cell] >= k; })) result.piece = k;
  }
  for (int k = 2; k > 0 && result.junction == 0; --k) {
    if (joins_volumes(passage, [&](CellId cell) { return cells_.dimension(cell) >= k; })) result.junction = k;
  }
  return result;
}

// Volumes are connected open sets, so different ones around an edge or vertex meet there only.
void FreeSpace::find_touching_volumes() {
  const auto volumes_of = [&](CellId cell) {
    std::vector<CellId> volumes;
    for (const CellId other : neighbours(cell)) {
      if (cells_.dimension(other) == 3) volumes.push_back(other);
    }
    make_unique(volumes);
    return volumes;
  };
  const auto wanted = [&](CellId cell) {
    if (!is_free(cell) || cells_.dimension(cell) > 1) return false;
    CellId first = kNoCell;  // most have no second one
    for (const CellId other : neighbours(cell)) {
      if (cells_.dimension(other) != 3) continue;
      if (first != kNoCell && other != first) return true;
      first = other;
    }
    return false;
  };
  std::vector<char> touching(cells_.size(), 0);
  for (CellId cell = 0; cell < cells_.size(); ++cell) touching[cell] = wanted(cell) ? 1 : 0;
  for (std::vector<CellId>& cells : connected_sets(*this, [&](CellId cell) { return touching[cell] != 0; })) {
    TouchingVolumes& touching = touching_.emplace_back();
    touching.component = component_[cells.front()];
    for (const CellId cell : cells) {
      touching.dimension = std::max(touching.dimension, cells_.dimension(cell));
      const std::vector<CellId> volumes = volumes_of(cell);
      touching.volumes.insert(touching.volumes.end(), volumes.begin(), volumes.end());
    }
    make_unique(touching.volumes);
    touching.cells = std::move(cells);
  }
}

}  // namespace nef::planner
