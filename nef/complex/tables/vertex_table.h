// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nef/base/item_iterator.h"
#include "nef/complex/ids.h"

namespace nef {

/// Where the items of the sphere map of a vertex begin; they end where the next vertex's begin.
struct VertexRecord {
  HalfedgeId svertices{0};
  SHalfedgeId shalfedges{0};
  std::uint32_t sloops = 0;
  SFaceId sfaces{0};
  std::uint32_t other_planes = 0;
  PatternId pattern;

  /// Moves on by the items of vertices that begin at one record and end where another one begins.
  void advance(const VertexRecord& begin, const VertexRecord& end) {
    svertices += end.svertices - begin.svertices;
    shalfedges += end.shalfedges - begin.shalfedges;
    sloops += end.sloops - begin.sloops;
    sfaces += end.sfaces - begin.sfaces;
    other_planes += end.other_planes - begin.other_planes;
  }
};

/// The records of the vertices of a complex, and one more, which ends the last one. Given away by value: columns that
/// say nothing are not held. Where every svertex has two arcs, as in all sets whose boundary is a manifold, a vertex
/// has twice as many shalfedges as svertices; few sets have sloops, or svertices that lie on no arc.
class VertexTable {
 public:
  using value_type = VertexRecord;
  using Iterator = ItemIterator<VertexTable>;

  /// The one that ends the last one included.
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  // Whoever reads one field of a record must not pay for the others, so all of this is inlined.
  [[gnu::always_inline]] VertexRecord operator[](VertexId id) const { return item(id.index()); }
  [[gnu::always_inline, nodiscard]] VertexRecord item(std::size_t i) const {
    VertexRecord record;
    record.svertices = rows_[i].svertices;
    record.shalfedges = shalfedges(i);
    record.sloops = sloops_.empty() ? 0 : sloops_[i];
    record.sfaces = rows_[i].sfaces;
    record.other_planes = other_planes(i);
    record.pattern = rows_[i].pattern;
    return record;
  }
  [[nodiscard]] HalfedgeId svertices(VertexId id) const { return rows_[id.index()].svertices; }
  [[nodiscard]] SHalfedgeId shalfedges(VertexId id) const { return shalfedges(std::size_t{id.index()}); }
  [[nodiscard]] SFaceId sfaces(VertexId id) const { return rows_[id.index()].sfaces; }
  [[nodiscard]] std::uint32_t other_planes(VertexId id) const { return other_planes(std::size_t{id.index()}); }
  [[nodiscard]] PatternId pattern(VertexId id) const { return rows_[id.index()].pattern; }
  [[nodiscard]] VertexRecord front() const { return item(0); }
  [[nodiscard]] VertexRecord back() const { return item(size() - 1); }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

  /// True if every vertex has twice as many shalfedges as svertices.
  [[nodiscard]] bool has_two_shalfedges_per_svertex() const { return shalfedges_.empty(); }

  /// Adds a vertex whose items begin at back(), and end where `end` says.
  void add(PatternId pattern, const VertexRecord& end) {
    rows_.back().pattern = pattern;
    rows_.emplace_back();
    if (!shalfedges_.empty()) shalfedges_.emplace_back();
    if (!sloops_.empty()) sloops_.emplace_back();
    if (!other_planes_.empty()) other_planes_.emplace_back();
    set(VertexId{rows_.size() - 1}, end);
  }

  void set_pattern(VertexId id, PatternId pattern) { rows_[id.index()].pattern = pattern; }
  void set_other_planes(VertexId id, std::uint32_t begin) {
    if (!other_planes_.empty() || begin != 0) set_in(other_planes_, id.index(), begin);
  }

  /// Changes one record.
  void set(VertexId id, const VertexRecord& record) {
    const std::size_t i = id.index();
    rows_[i] = {record.svertices, record.sfaces, record.pattern};
    if (!shalfedges_.empty() || record.shalfedges.index() != 2 * record.svertices.index())
      set_shalfedges(i, record.shalfedges);
    if (!sloops_.empty() || record.sloops != 0) set_in(sloops_, i, record.sloops);
    set_other_planes(id, record.other_planes);
  }

  void reserve(std::size_t size) { rows_.reserve(size); }
  void trim();
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Row {
    HalfedgeId svertices{0};
    SFaceId sfaces{0};
    PatternId pattern;
  };

  [[nodiscard]] SHalfedgeId shalfedges(std::size_t i) const {
    return shalfedges_.empty() ? SHalfedgeId{2 * rows_[i].svertices.index()} : shalfedges_[i];
  }
  [[nodiscard]] std::uint32_t other_planes(std::size_t i) const { return other_planes_.empty() ? 0 : other_planes_[i]; }
  void set_in(std::vector<std::uint32_t>& column, std::size_t i, std::uint32_t value) {
    if (column.empty()) column.resize(size());
    column[i] = value;
  }
  void set_shalfedges(std::size_t i, SHalfedgeId value);

  std::vector<Row> rows_{Row{}};
  // Of each row, or none: see above.
  std::vector<SHalfedgeId> shalfedges_;
  std::vector<std::uint32_t> sloops_, other_planes_;
};

}  // namespace nef
