// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/boolean/pyramid_overlay.h"
#include "nef/boolean/result/copied_links.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {

/// Gathers the vertices of a result and puts its arrays together, each allocated once in its final size. Copies are
/// noted only, so that their arrays are copied in long runs, and their links with them.
class ResultAssembly {
 public:
  /// Both must outlive the assembly. Planes and points of the result are those of `tables`.
  ResultAssembly(const std::array<Operand, 2>& operands, const CommonTables& tables)
      : operands_(operands), tables_(tables) {}

  /// Appends a copy of vertex v of operand x. Its marks are changed to marks[mark] unless `marks` is null; the array
  /// must outlive the assembly. Copies of one operand must come in its order.
  void copy(std::size_t x, VertexId v, const std::vector<LabelId>* marks);

  /// Appends a vertex with planes by common names, if there is one; its complex must outlive the assembly.
  void add(const VertexOf& made);

  /// Appends a new vertex at a point of the tables.
  void add(PointId point, const SphereMapView& map);

  /// True if the vertices are those of operand 0, all of them and unchanged.
  [[nodiscard]] bool is_first_operand() const;

  /// True if most vertices are copies: then links that the operands know are worth bringing along.
  [[nodiscard]] bool is_mostly_copies() const;

  /// Writes all vertices. Of the planes of the tables, which `result` must have been made with, those that nothing uses
  /// are dropped. On the threads of `monitor`.
  void write(PlaneTable& planes, ComplexBuilder& result, const Monitor& monitor) const;

  /// Where its vertices come from.
  [[nodiscard]] std::vector<VertexRun> origins() const;

 private:
  struct Run {
    VertexRun vertices;
    const Complex* from;
    const std::vector<LabelId>* marks = nullptr;
  };

  [[nodiscard]] std::vector<std::uint8_t> used_planes(std::size_t planes) const;
  struct FinalRows {
    // Of each plane of an origin, in the names of that origin: its row in the result, kNone for one that is not used.
    // Empty: the same.
    std::array<std::vector<std::uint32_t>, 3> of_origin;
    std::vector<std::uint8_t> used;  // not zero for planes that are, by common name; empty: all
  };
  [[nodiscard]] FinalRows final_rows(std::size_t planes) const;
  void reserve(ComplexBuilder& result) const;
  void append(const Run& run);

  const std::array<Operand, 2>& operands_;
  const CommonTables& tables_;
  std::vector<Run> runs_;
  PlaneTable none_;
  ComplexBuilder new_{none_, {}};  // the new vertices that this made itself; only appends
};

}  // namespace nef
