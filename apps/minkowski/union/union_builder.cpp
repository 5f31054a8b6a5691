// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/union_builder.h"

#include <algorithm>
#include <utility>

#include "apps/minkowski/union/containment.h"
#include "apps/minkowski/union/solid_union.h"

namespace nef::minkowski {
namespace {

// Sizes that keep a batch within some ten megabytes.
constexpr std::size_t kBatchCells = 4096;
constexpr std::size_t kBatchVertices = 80000;
constexpr std::size_t kHeapPieces = 512;
// unite_solids compares all faces of cells that overlap: for cells with more vertices than this (a fine ball and
// something simple), unions two by two are faster.
constexpr std::size_t kLargeCell = 128;

bool larger(const Polyhedron& a, const Polyhedron& b) {
  return a.complex().vertex_count() > b.complex().vertex_count();
}

}  // namespace

void UnionBuilder::add(ConvexCell cell) {
  switch (strategy_) {
    case UnionStrategy::kTrivial:
      result_ = unite(result_, to_polyhedron(cell));
      return;
    case UnionStrategy::kQueue:
      add_queued(to_polyhedron(cell));
      return;
    case UnionStrategy::kPriority:
      add_ranked(to_polyhedron(cell));
      return;
    case UnionStrategy::kNary:
      batch_vertices_ += cell.mesh.vertices.size();
      batch_.push_back(std::move(cell));
      if (batch_.size() >= kBatchCells || batch_vertices_ >= kBatchVertices) flush();
      return;
  }
}

// The queue of [Hachenberger 2009] takes the two oldest sets and appends their union, so it pairs neighbours,
// then pairs of pairs, and so on. A counter in binary does the same without holding all pieces.
void UnionBuilder::add_queued(Polyhedron piece) {
  std::size_t level = 0;
  for (; level < levels_.size() && !levels_[level].is_empty(); ++level) {
    if (poll_) poll_();
    piece = unite(levels_[level], piece);
    levels_[level] = Polyhedron();
  }
  if (level == levels_.size()) levels_.emplace_back();
  levels_[level] = std::move(piece);
}

void UnionBuilder::add_ranked(Polyhedron piece) {
  ranked_.push_back(std::move(piece));
  std::push_heap(ranked_.begin(), ranked_.end(), larger);
  if (ranked_.size() > kHeapPieces) merge_smallest();
}

void UnionBuilder::merge_smallest() {
  if (poll_) poll_();
  std::pop_heap(ranked_.begin(), ranked_.end(), larger);
  const Polyhedron a = std::move(ranked_.back());
  ranked_.pop_back();
  std::pop_heap(ranked_.begin(), ranked_.end(), larger);
  ranked_.back() = unite(a, ranked_.back());
  std::push_heap(ranked_.begin(), ranked_.end(), larger);
}

void UnionBuilder::flush() {
  if (batch_.empty()) return;
  const auto first_flat =
      std::stable_partition(batch_.begin(), batch_.end(), [](const ConvexCell& cell) { return cell.dimension == 3; });
  std::vector<Polyhedron> pieces;
  if (first_flat != batch_.end()) {
    const std::vector<std::uint8_t> held = held_by_others(batch_);
    for (auto i = static_cast<std::size_t>(first_flat - batch_.begin()); i < batch_.size(); ++i) {
      if (held[i] != 0) {
        ++dropped_;
      } else {
        pieces.push_back(to_polyhedron(batch_[i]));
      }
    }
  }
  batch_.erase(first_flat, batch_.end());
  if (batch_vertices_ > kLargeCell * batch_.size()) {
    for (const ConvexCell& cell : batch_) pieces.push_back(to_polyhedron(cell));
  } else if (!batch_.empty()) {
    pieces.push_back(unite_solids(batch_, &dropped_, threads_, poll_));
  }
  batch_.clear();
  batch_vertices_ = 0;
  add_queued(unite_all(pieces, threads_));
}

Polyhedron UnionBuilder::finish() {
  flush();
  while (ranked_.size() > 1) merge_smallest();
  if (!ranked_.empty()) result_ = std::move(ranked_[0]);
  if (strategy_ == UnionStrategy::kNary) return unite_all(levels_, threads_);
  // Oldest last: the sets at higher levels were there first.
  for (const Polyhedron& level : levels_) result_ = unite(result_, level);
  return std::move(result_);
}

}  // namespace nef::minkowski
