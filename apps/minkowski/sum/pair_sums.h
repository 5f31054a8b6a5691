// SPDX-License-Identifier: Apache-2.0
//
// All sums of pairs of cells of two operands, streamed into a union.
#pragma once

#include <span>
#include <vector>

#include "apps/minkowski/convex/normal_diagram.h"
#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/union/union_builder.h"
#include "nef/base/phase_timer.h"

namespace nef::minkowski {

/// The cells of an operand with their normal diagrams.
class Operand {
 public:
  Operand() = default;
  explicit Operand(std::vector<ConvexCell> cells);
  // The diagrams point into the cells, which moving a vector does not move; copying would.
  Operand(Operand&&) = default;
  Operand& operator=(Operand&&) = default;

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] const ConvexCell& cell(std::size_t i) const { return cells_[i]; }
  /// Only for cells of dimension 3.
  [[nodiscard]] const NormalDiagram& diagram(std::size_t i) const { return diagrams_[i]; }

 private:
  std::vector<ConvexCell> cells_;
  std::vector<NormalDiagram> diagrams_;  // of the first cells; solids come first
};

/// Unites the sums of all pairs of several products of operands.
class PairSums {
 public:
  PairSums(const MinkowskiOptions& options, MinkowskiReport& report) : options_(options), report_(report) {}

  /// The pairs of a and b are to be summed. Both must live until run() returns.
  void add_product(const Operand& a, const Operand& b);

  /// Sums and unites. Throws Cancelled if the progress function says so.
  Polyhedron run();

 private:
  const MinkowskiOptions& options_;
  MinkowskiReport& report_;
  std::vector<std::pair<const Operand*, const Operand*>> products_;
};

}  // namespace nef::minkowski
