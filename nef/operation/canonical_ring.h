// SPDX-License-Identifier: Apache-2.0
//
// Vertices whose sphere map is one ring of arcs, which nearly all are: their canonical maps follow from the order of
// their planes, so that few have to be drawn and most are like one that was.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "nef/complex/patterns/pattern_table.h"

namespace nef {

/// The arcs of a pattern that is one ring between two sfaces, with one mark for all arcs and one for all svertices,
/// each of which is named by the planes of its two arcs.
struct RingOfPattern {
  static constexpr std::size_t kMost = 10;  ///< arcs: what is said of so many fits into a word

  /// An svertex and the shalfedge that leaves it along the ring.
  struct Step {
    std::uint8_t shalfedge = 0;
    std::uint8_t svertex = 0;
    bool turned = false;  ///< its direction is opposite to the product of the planes of the last shalfedge and this one
  };

  std::uint8_t size = 0;
  std::array<Step, kMost> steps{};  ///< from shalfedge 0 on
  std::array<LabelId, 5> marks{};   ///< of the centre, svertices, arcs, and the sfaces to their left and to their right

  /// True if all svertices have two planes with these planes of the even shalfedges; then they name their lines. O(1).
  [[nodiscard]] bool names_lines(std::span<const PlaneId> planes) const;
};

/// The rings among the patterns of a table.
class RingsOfPatterns {
 public:
  RingsOfPatterns() = default;
  explicit RingsOfPatterns(const PatternTable& patterns);

  /// Null if the pattern is no ring, or a long one.
  [[nodiscard]] const RingOfPattern* of(PatternId pattern) const {
    const std::uint32_t at = at_[pattern.index()];
    return at == kNone ? nullptr : &rings_[at];
  }

 private:
  std::vector<std::uint32_t> at_;
  std::vector<RingOfPattern> rings_;
};

/// Vertices that have been written, by what their canonical maps follow from. Walk along the ring from the smallest
/// plane, so that this one stays unflipped, and tell of each plane how many are smaller and whether it is flipped, and
/// of each svertex whether it is opposite to the product of its planes in their order: vertices of which this and the
/// marks are the same have the same map but for the planes.
class CanonicalRings {
 public:
  struct Written {
    VertexId vertex;
    std::array<std::uint8_t, RingOfPattern::kMost> svertex{};  ///< new numbers, by steps of that walk
  };

  /// Reads a vertex: plane p of the even shalfedges will be row[p.row()]. False if two of them are the same. O(n^2) for
  /// the few arcs of a ring.
  [[nodiscard]] bool read(const RingOfPattern& ring, std::span<const PlaneId> planes,
                          std::span<const std::uint32_t> row);

  /// One that was learned and is like the one read last, or null.
  [[nodiscard]] const Written* known() const {
    const auto at = written_.find(key_);
    return at == written_.end() ? nullptr : &at->second;
  }

  /// The one read last was written as this vertex; its svertex s has become numbers[s].
  void learn(VertexId vertex, std::span<const std::uint32_t> numbers);

  /// Of the one read last: the planes of its even shalfedges in canonical order, and its svertices by steps.
  [[nodiscard]] std::span<const PlaneId> planes() const { return std::span(planes_).first(size_); }
  [[nodiscard]] std::span<const std::uint8_t> svertices() const { return std::span(svertices_).first(size_); }

 private:
  struct Key {
    std::uint64_t bits = 0;
    std::array<LabelId, 5> marks{};
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  std::size_t size_ = 0;
  std::array<PlaneId, RingOfPattern::kMost> planes_;
  std::array<std::uint8_t, RingOfPattern::kMost> svertices_{};
  Key key_;
  std::unordered_map<Key, Written, Hash> written_;
};

}  // namespace nef
