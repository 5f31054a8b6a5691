// SPDX-License-Identifier: Apache-2.0
#pragma once

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <string>
#include <unordered_map>

#include "nef/io/native/binary_columns.h"

namespace nef {

/// Recognizes vertices of a binary file that are like others. The key of a vertex is all that the file says of it but
/// for its planes, and which of these its svertices name. Vertices with the same key have the same pattern, and what
/// was found right of one of them is right of all.
class VertexKeys {
 public:
  /// Reads the key of the vertex whose items begin at `begin` and end before those at `end`, and whose entries follow
  /// the first `entries` of `all_entries`. False if the vertex has sloops, an svertex that is not where the arc of its
  /// number and the one before meet, or more entries than there are.
  template <typename W>
  bool read(const ItemColumns<W>& columns, const VertexRecord& begin, const VertexRecord& end, LabelId mark,
            std::uint64_t entries, std::uint64_t all_entries) {
    const std::uint32_t pair = pair_of(begin.shalfedges);
    const std::uint32_t pairs = pair_of(end.shalfedges) - pair;
    const std::uint32_t first = begin.svertices.index();  // svertex, in the columns
    const std::uint32_t svertices = end.svertices - begin.svertices;
    const std::uint32_t sfaces = end.sfaces - begin.sfaces;
    if (begin.sloops != end.sloops || svertices > pairs) return false;
    key_.clear();
    for (const std::uint32_t count : {svertices, pairs, sfaces, std::uint32_t{mark}}) {
      key_.append(reinterpret_cast<const char*>(&count), sizeof(count));
    }
    for (std::uint32_t i = 0; i < svertices; ++i) {
      const PlaneId here{columns.plane[pair + i]};
      const PlaneId before{columns.plane[pair + (i == 0 ? pairs : i) - 1]};
      const PlaneId p{columns.p[first + i]};
      const PlaneId q{columns.q[first + i]};
      const auto names = [](PlaneId a, PlaneId b) { return a.row() == b.row(); };
      const bool p_here = names(p, here);
      const bool q_here = names(q, here);
      if (p_here == q_here || !names(p_here ? q : p, before)) return false;
      const PlaneId of_p = p_here ? here : before;
      const PlaneId of_q = p_here ? before : here;
      key_ += static_cast<char>((p_here ? 4 : 0) | (p == of_p ? 2 : 0) | (q == of_q ? 1 : 0));
    }
    key_ += columns.out.bytes(first, svertices);
    key_ += columns.sface_around.bytes(first, svertices);
    key_ += columns.svertex_mark.bytes(first, svertices);
    key_ += columns.shalfedge_mark.bytes(pair, pairs);
    key_ += columns.source.bytes(begin.shalfedges.index(), 2 * pairs);
    key_ += columns.next.bytes(begin.shalfedges.index(), 2 * pairs);
    key_ += columns.sface.bytes(begin.shalfedges.index(), 2 * pairs);
    key_ += columns.entry_count.bytes(begin.sfaces.index(), sfaces);
    key_ += columns.sface_mark.bytes(begin.sfaces.index(), sfaces);
    const std::uint64_t own = columns.entries_of(begin, end);
    if (own > all_entries - entries) return false;
    key_ += columns.kind.bytes(entries, own);
    key_ += columns.index.bytes(entries, own);
    return true;
  }

  /// The pattern that was learned for the key that was read, if any.
  [[nodiscard]] PatternId known() const {
    const auto found = patterns_.find(key_);
    return found == patterns_.end() ? PatternId() : found->second;
  }

  /// The pattern of the key that was read.
  void learn(PatternId pattern) { patterns_.emplace(key_, pattern); }

 private:
  struct Hash {
    std::size_t operator()(const std::string& key) const { return XXH3_64bits(key.data(), key.size()); }
  };
  std::string key_;
  std::unordered_map<std::string, PatternId, Hash> patterns_;
};

}  // namespace nef
