// SPDX-License-Identifier: Apache-2.0
//
// The items of sphere maps, and ranges of them. Items name planes by their rows, or, in patterns, by their places among
// the planes of a vertex: then `LocalPlanes` leads from a place to the plane, and `MapItems` makes items with planes as
// they are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "nef/geometry/ids.h"

namespace nef {

/// A point of the sphere: an edge of the complex as it leaves a vertex.
struct SVertex {
  PlaneId p, q;                 ///< direction n_p x n_q
  std::uint32_t out = kNone;    ///< a shalfedge that starts here; kNone if isolated
  std::uint32_t sface = kNone;  ///< the sface around it, if isolated
  LabelId mark = 0;
  bool operator==(const SVertex&) const = default;
};

/// One side of an arc of a great circle: the corner of a facet at a vertex.
struct SHalfedge {
  PlaneId plane;                 ///< positive side = the side of its sface
  std::uint32_t source = kNone;  ///< svertex; the target is the source of the twin
  std::uint32_t next = kNone;    ///< next on the boundary of its sface, which lies to the left
  std::uint32_t prev = kNone;
  std::uint32_t sface = kNone;
  LabelId mark = 0;  ///< the same on both twins
  bool operator==(const SHalfedge&) const = default;
};

/// One side of a whole great circle without svertices: a vertex inside a facet.
struct SLoop {
  PlaneId plane;
  std::uint32_t sface = kNone;
  LabelId mark = 0;
  bool operator==(const SLoop&) const = default;
};

/// One entry into the boundary of an sface.
struct SFaceEntry {
  enum class Kind : std::uint8_t { kCycle, kIsolatedVertex, kLoop };
  Kind kind = Kind::kCycle;
  std::uint32_t index = kNone;  ///< a shalfedge, svertex or sloop
  bool operator==(const SFaceEntry&) const = default;
};

/// A connected open region of the sphere: a volume of the complex as seen from a vertex.
struct SFace {
  std::uint32_t entries = 0;      ///< first of its entries
  std::uint32_t entry_count = 0;  ///< none for the whole sphere
  LabelId mark = 0;
  bool operator==(const SFace&) const = default;
};

/// The planes of one sphere map, where its items name them by their places: those of the even shalfedges, pair after
/// pair, then others. What items name is such a place in place of a row, and whether to flip what stands there.
class LocalPlanes {
 public:
  /// Names are planes.
  LocalPlanes() = default;
  LocalPlanes(const PlaneId* of_pairs, std::uint32_t pairs, const PlaneId* others)
      : of_pairs_(of_pairs), others_(others), pairs_(pairs) {}

  [[nodiscard]] PlaneId operator[](PlaneId name) const {
    if (pairs_ == kNone) return name;
    const std::uint32_t place = name.row();
    const PlaneId plane = place < pairs_ ? of_pairs_[place] : others_[place - pairs_];
    return plane.opposite_if(name.flipped());
  }

 private:
  const PlaneId* of_pairs_ = nullptr;
  const PlaneId* others_ = nullptr;
  std::uint32_t pairs_ = kNone;
};

inline SVertex with_planes(SVertex item, const LocalPlanes& planes) {
  item.p = planes[item.p];
  item.q = planes[item.q];
  return item;
}
inline SHalfedge with_planes(SHalfedge item, const LocalPlanes& planes) {
  item.plane = planes[item.plane];
  return item;
}

/// The svertices or the shalfedges of a sphere map, by value. A view.
template <typename Item>
class MapItems {
 public:
  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = Item;
    using difference_type = std::ptrdiff_t;
    using pointer = const Item*;
    using reference = Item;

    Iterator() = default;
    Iterator(const Item* at, const LocalPlanes& planes) : at_(at), planes_(planes) {}
    Item operator*() const { return with_planes(*at_, planes_); }
    Item operator[](difference_type n) const { return with_planes(at_[n], planes_); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++at_;
      return before;
    }
    Iterator& operator--() {
      --at_;
      return *this;
    }
    Iterator& operator+=(difference_type n) {
      at_ += n;
      return *this;
    }
    friend Iterator operator+(Iterator i, difference_type n) { return i += n; }
    friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.at_ - b.at_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.at_ != b.at_; }
    friend bool operator<(const Iterator& a, const Iterator& b) { return a.at_ < b.at_; }

   private:
    const Item* at_ = nullptr;
    LocalPlanes planes_;
  };

  MapItems() = default;
  MapItems(std::span<const Item> items, const LocalPlanes& planes = {}) : items_(items), planes_(planes) {}  // NOLINT
  MapItems(const std::vector<Item>& items) : items_(items) {}  // NOLINT: implicit, as std::span is

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  Item operator[](std::size_t i) const { return with_planes(items_[i], planes_); }
  [[nodiscard]] Iterator begin() const { return {items_.data(), planes_}; }
  [[nodiscard]] Iterator end() const { return {items_.data() + items_.size(), planes_}; }

 private:
  std::span<const Item> items_;
  LocalPlanes planes_;
};

}  // namespace nef
