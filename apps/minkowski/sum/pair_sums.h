// SPDX-License-Identifier: Apache-2.0
//
// All sums of pairs of cells of two operands, streamed into a union.
#pragma once

#include <span>
#include <vector>

#include "apps/minkowski/convex/normal_diagram.h"
#include "apps/minkowski/minkowski.h"

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

/// All pairs of a cell of `a` and a cell of `b`.
struct Product {
  const Operand& a;
  const Operand& b;
};

/// The union of the sums of all pairs of some products. In blocks, so that memory does not grow with the pairs. Adds to
/// the report.
Polyhedron union_of_pair_sums(std::span<const Product> products, const MinkowskiOptions& options,
                              MinkowskiReport& report);

}  // namespace nef::minkowski
