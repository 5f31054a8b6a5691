// SPDX-License-Identifier: Apache-2.0
//
// Takes sphere maps apart into patterns and planes.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "nef/complex/patterns/pattern_table.h"

namespace nef {

/// The patterns of a table that one writer fills, by their contents.
class PatternInterner {
 public:
  /// The pattern of a sphere map, which need not be a legal one, but for the planes of twins. Appends the planes of its
  /// even shalfedges, and those that no shalfedge has and an svertex names. Expected O(items) where svertices name
  /// planes of their own arcs.
  PatternId intern(PatternTable& table, const SphereMapView& map, std::vector<PlaneId>& of_pairs,
                   std::vector<PlaneId>& others);

  /// A pattern of another table, with marks other than kOutside replaced by marks[mark] unless `marks` is empty.
  PatternId intern(PatternTable& table, const PatternTable& from, PatternId pattern, std::span<const LabelId> marks);

  /// Forgets the table: the next one asked about is another one, with whatever patterns it has.
  void reset();

 private:
  PlaneId name_of(PlaneId plane, std::uint32_t guess);
  PatternId find_or_push(PatternTable& table);
  void catch_up(const PatternTable& table);
  void insert(std::uint64_t hash, PatternId id);

  static std::uint64_t hash(const SphereMapView& map);

  // The planes of the map at hand: those of its pairs from first_pair_ on, and its others.
  std::vector<PlaneId>* of_pairs_ = nullptr;
  std::vector<PlaneId>* others_ = nullptr;
  std::size_t first_pair_ = 0;
  std::size_t first_other_ = 0;
  std::vector<std::pair<PlaneId, std::uint32_t>> sorted_;  // unflipped planes and places; where there are many

  SphereMapBuffer scratch_;
  std::vector<std::uint32_t> slots_;  // patterns, by hash
  std::vector<std::uint64_t> hashes_;
};

}  // namespace nef
