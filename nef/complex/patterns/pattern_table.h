// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps without their planes and sloops. Nearly all vertices of a set have one of a few patterns: a ring of so
// many arcs with the same marks. So a complex holds each pattern once, and for a vertex only its planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/complex/ids.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// Patterns in flat arrays. The planes that their items name are places among the planes of a vertex (LocalPlanes).
class PatternTable {
 public:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(records_.size() - 1); }

  /// Adds the topology and the marks of a sphere map whose items name planes by their places.
  PatternId push(const SphereMapBuffer& map);

  [[nodiscard]] std::span<const SVertex> svertices(PatternId id) const {
    return range(svertices_, id, &Record::svertices);
  }
  [[nodiscard]] std::span<const SHalfedge> shalfedges(PatternId id) const {
    return range(shalfedges_, id, &Record::shalfedges);
  }
  [[nodiscard]] std::span<const SFace> sfaces(PatternId id) const { return range(sfaces_, id, &Record::sfaces); }
  [[nodiscard]] std::span<const SFaceEntry> entries(PatternId id) const {
    return range(entries_, id, &Record::entries);
  }
  /// The pattern as a sphere map without sloops, whose planes are names.
  [[nodiscard]] SphereMapView view(PatternId id) const {
    return {svertices(id), shalfedges(id), {}, sfaces(id), entries(id), mark(id)};
  }

  /// Of the centre.
  [[nodiscard]] LabelId mark(PatternId id) const { return records_[id.index()].mark; }

  /// One item, without asking for the range.
  [[nodiscard]] const SVertex& svertex(PatternId id, std::uint32_t i) const {
    return svertices_[records_[id.index()].svertices + i];
  }
  [[nodiscard]] const SHalfedge& shalfedge(PatternId id, std::uint32_t i) const {
    return shalfedges_[records_[id.index()].shalfedges + i];
  }

  /// Calls visit(mark) for the mark of every item of every pattern; of a table that may change, marks may be changed.
  template <typename Table, typename Visit>
  static void for_each_mark(Table& table, Visit&& visit) {
    for (std::size_t i = 0; i < table.size(); ++i) visit(table.records_[i].mark);
    for (auto& item : table.svertices_) visit(item.mark);
    for (auto& item : table.shalfedges_) visit(item.mark);
    for (auto& item : table.sfaces_) visit(item.mark);
  }

  /// Room for so many patterns with so many items in all.
  void reserve(std::size_t patterns, std::size_t svertices, std::size_t shalfedges, std::size_t sfaces);

  void trim();

  [[nodiscard]] std::size_t bytes() const;

 private:
  // Where the items of a pattern begin; they end where those of the next one do.
  struct Record {
    std::uint32_t svertices = 0;
    std::uint32_t shalfedges = 0;
    std::uint32_t sfaces = 0;
    std::uint32_t entries = 0;
    LabelId mark = 0;
  };

  template <typename Item>
  [[nodiscard]] std::span<const Item> range(const std::vector<Item>& items, PatternId id,
                                            std::uint32_t Record::*begin) const {
    const Record* const record = records_.data() + id.index();
    return {items.data() + record[0].*begin, record[1].*begin - record[0].*begin};
  }

  std::vector<Record> records_{Record{}};
  std::vector<SVertex> svertices_;
  std::vector<SHalfedge> shalfedges_;
  std::vector<SFace> sfaces_;
  std::vector<SFaceEntry> entries_;
};

}  // namespace nef
