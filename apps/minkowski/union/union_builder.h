// SPDX-License-Identifier: Apache-2.0
//
// Unites a stream of convex cells in bounded memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// Takes pieces one by one. At any time it holds O(log(pieces)) intermediate unions and a batch of bounded size.
///
/// A batch is united at once within a budget of about what the queue is likely to take for it. If the budget does not
/// suffice, this batch and all that follows go through the queue: so no input takes much more than twice the time of
/// the better of the two.
class UnionBuilder {
 public:
  /// Takes up to `expected` pieces. The monitor is told how much of the sum that they come from is done (kSumPhase),
  /// which is an estimate.
  explicit UnionBuilder(std::size_t expected, const Monitor& monitor);

  void add(ConvexCell cell);
  /// The union of everything added. Call once.
  Polyhedron finish();

  /// Cells that were dropped since another one of their batch holds them.
  [[nodiscard]] std::size_t dropped() const { return dropped_; }
  /// Cells that went into unions of many cells at once, and into unions of two sets.
  [[nodiscard]] std::size_t united_at_once() const { return at_once_; }
  [[nodiscard]] std::size_t united_two_by_two() const { return two_by_two_; }

 private:
  void settle(std::size_t pieces);
  [[nodiscard]] double done(std::size_t more = 0) const;
  void tell() const;
  void add_to_batch(ConvexCell cell);
  void add_queued(Polyhedron piece);
  void add_to_group(const ConvexCell& cell);
  void flush_group();
  void flush();
  void unite_batch_of_solids();

  Monitor monitor_;
  std::size_t expected_;  // pieces
  std::size_t added_ = 0;
  std::size_t settled_ = 0;         // those whose work is done
  std::vector<Polyhedron> levels_;  // level i is empty or the union of 2^i pieces
  std::vector<Polyhedron> group_;   // the next pieces for the queue
  std::size_t group_vertices_ = 0;
  std::vector<ConvexCell> batch_;  // all at once
  std::size_t batch_vertices_ = 0;
  bool gave_up_ = false;  // no more batches
  std::size_t dropped_ = 0;
  std::size_t at_once_ = 0;
  std::size_t two_by_two_ = 0;
};

}  // namespace nef::minkowski
