// SPDX-License-Identifier: Apache-2.0
//
// Unites a stream of sets in bounded memory, by one of several strategies with the same result.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// Takes pieces one by one. At any time it holds O(log(pieces)) intermediate unions and, for the
/// strategies that need several pieces at once, a batch of bounded size.
class UnionBuilder {
 public:
  /// `poll`, if given, is called now and then while pieces are united, and may throw.
  explicit UnionBuilder(UnionStrategy strategy, unsigned threads = 1, std::function<void()> poll = {})
      : strategy_(strategy), threads_(threads), poll_(std::move(poll)) {}

  void add(ConvexCell cell);
  /// The union of everything added. Call once.
  Polyhedron finish();

  /// Cells that were dropped since another one of their batch holds them.
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  void add_queued(Polyhedron piece);
  void add_ranked(Polyhedron piece);
  void flush();
  void merge_smallest();

  UnionStrategy strategy_;
  unsigned threads_;
  std::function<void()> poll_;
  Polyhedron result_;               // trivial
  std::vector<Polyhedron> levels_;  // queue: level i is empty or the union of 2^i pieces
  std::vector<Polyhedron> ranked_;  // priority: a heap, the smallest on top
  std::vector<ConvexCell> batch_;   // n-ary
  std::size_t batch_vertices_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace nef::minkowski
