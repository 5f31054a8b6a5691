// SPDX-License-Identifier: Apache-2.0
//
// Cells are collected in batches, each united at once by `try_unite_solids` within a budget of work; if it exceeds the
// budget, this batch and all later cells go through the queue. The queue of [Hachenberger 2009] is a binary counter:
// level i is empty or has the union of 2^i pieces, and a new piece is carried upward, so neighbours are united in a
// balanced tree and only O(log n) unions are held.
#include "apps/minkowski/union/union_builder.h"

#include <algorithm>
#include <utility>

#include "apps/minkowski/part_of_sum.h"
#include "apps/minkowski/union/containment.h"
#include "apps/minkowski/union/solid_union.h"

namespace nef::minkowski {
namespace {

// Sizes that keep a batch within some ten megabytes.
constexpr std::size_t kBatchCells = 4096;
constexpr std::size_t kBatchVertices = 80000;
constexpr std::size_t kGroupCells = 64;
constexpr std::size_t kGroupVertices = 2500;

// Measured, and about time only. The union at once compares all faces of cells that overlap: for cells with more
// vertices than this (a fine ball and something simple), unions two by two are faster.
constexpr std::size_t kLargeCell = 128;
// What the queue takes for a vertex of a cell, in evaluations of a form: 10 to 30 microseconds against 3 nanoseconds.
constexpr std::uint64_t kQueueWorkOfVertex = 4000;

}  // namespace

UnionBuilder::UnionBuilder(std::size_t expected, const Monitor& monitor)
    : monitor_(monitor), expected_(std::max<std::size_t>(expected, 1)) {}

void UnionBuilder::settle(std::size_t pieces) {
  settled_ += pieces;
  tell();
}

// The share of the work that is done when `more` pieces are united. Measured: the union takes about four fifths of the
// time of a sum, and making its pieces one.
double UnionBuilder::done(std::size_t more) const {
  const double made = 0.2 * static_cast<double>(added_) + 0.8 * static_cast<double>(settled_ + more);
  return std::min(1.0, made / static_cast<double>(expected_));
}

void UnionBuilder::tell() const {
  constexpr double kParts = 1e6;
  monitor_.tell_progress(kSumPhase, static_cast<std::size_t>(done() * kParts), static_cast<std::size_t>(kParts));
}

void UnionBuilder::add(ConvexCell cell) {
  ++added_;
  tell();
  if (gave_up_ || cell.mesh.vertices.size() > kLargeCell) {
    add_to_group(cell);
  } else {
    add_to_batch(std::move(cell));
  }
}

void UnionBuilder::add_to_batch(ConvexCell cell) {
  batch_vertices_ += cell.mesh.vertices.size();
  batch_.push_back(std::move(cell));
  if (batch_.size() >= kBatchCells || batch_vertices_ >= kBatchVertices) flush();
}

// Groups give several threads something to do.
void UnionBuilder::add_to_group(const ConvexCell& cell) {
  ++two_by_two_;
  group_vertices_ += cell.mesh.vertices.size();
  group_.push_back(to_polyhedron(cell, monitor_));
  if (group_.size() >= kGroupCells || group_vertices_ >= kGroupVertices) flush_group();
}

void UnionBuilder::flush_group() {
  if (group_.empty()) return;
  add_queued(unite_all(group_, monitor_));
  settle(group_.size());
  group_.clear();
  group_vertices_ = 0;
}

// The queue of [Hachenberger 2009] takes the two oldest sets and appends their union, so it pairs neighbours,
// then pairs of pairs, and so on. A counter in binary does the same without holding all pieces.
void UnionBuilder::add_queued(Polyhedron piece) {
  std::size_t level = 0;
  for (; level < levels_.size() && !levels_[level].is_empty(); ++level) {
    piece = unite(levels_[level], piece, monitor_);
    levels_[level] = Polyhedron();
  }
  if (level == levels_.size()) levels_.emplace_back();
  levels_[level] = std::move(piece);
}

void UnionBuilder::flush() {
  if (batch_.empty()) return;
  const auto first_flat =
      std::stable_partition(batch_.begin(), batch_.end(), [](const ConvexCell& cell) { return cell.dimension == 3; });
  if (first_flat != batch_.end()) {
    const std::vector<std::uint8_t> held = held_by_others(batch_);
    std::vector<Polyhedron> pieces;
    for (auto i = static_cast<std::size_t>(first_flat - batch_.begin()); i < batch_.size(); ++i) {
      if (held[i] == 0) pieces.push_back(to_polyhedron(batch_[i], monitor_));
    }
    dropped_ += static_cast<std::size_t>(batch_.end() - first_flat) - pieces.size();
    two_by_two_ += pieces.size();
    add_queued(unite_all(pieces, monitor_));
    settle(static_cast<std::size_t>(batch_.end() - first_flat));
    batch_.erase(first_flat, batch_.end());
  }
  if (!batch_.empty()) unite_batch_of_solids();
  batch_.clear();
  batch_vertices_ = 0;
}

void UnionBuilder::unite_batch_of_solids() {
  const PartOfSum part(monitor_, done(), done(batch_.size()));
  std::optional<Polyhedron> sum =
      try_unite_solids(batch_, kQueueWorkOfVertex * batch_vertices_, &dropped_, part.monitor());
  if (sum) {
    at_once_ += batch_.size();
    add_queued(*std::move(sum));
    settle(batch_.size());
  } else {
    gave_up_ = true;
    for (const ConvexCell& cell : batch_) add_to_group(cell);
  }
}

Polyhedron UnionBuilder::finish() {
  flush();
  flush_group();
  return unite_all(levels_, monitor_);
}

}  // namespace nef::minkowski
