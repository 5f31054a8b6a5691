// SPDX-License-Identifier: Apache-2.0
//
// A map is copied with each plane replaced by its place among the planes of this vertex; two vertices have the same
// pattern if these copies are equal. The copy is looked up in a hash table with open addressing, at most half full,
// whose slots are numbers of patterns. Most of the time goes into the places of the planes that svertices name: those
// of the two arcs with the svertex's own number come first, then all planes one by one if they are few, else a sorted
// list.
#include "nef/complex/patterns/pattern_interner.h"

#include <algorithm>

namespace nef {
namespace {

constexpr std::size_t kFew = 32;  // planes are looked through one by one

// Words in, a hash out.
class WordHash {
 public:
  void add(std::uint32_t a, std::uint32_t b) {
    state_ = (state_ ^ (static_cast<std::uint64_t>(a) << 32U | b)) * 0x9e3779b97f4a7c15ULL;
    state_ ^= state_ >> 32U;
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x2545f4914f6cdd1dULL;
};

bool equal(const PatternTable& table, PatternId id, const SphereMapBuffer& map) {
  return table.mark(id) == map.mark && std::ranges::equal(table.shalfedges(id), map.shalfedges) &&
         std::ranges::equal(table.svertices(id), map.svertices) && std::ranges::equal(table.sfaces(id), map.sfaces) &&
         std::ranges::equal(table.entries(id), map.entries);
}

}  // namespace

std::uint64_t PatternInterner::hash(const SphereMapView& map) {
  WordHash h;
  h.add(static_cast<std::uint32_t>(map.svertices.size()), static_cast<std::uint32_t>(map.shalfedges.size()));
  h.add(static_cast<std::uint32_t>(map.sfaces.size()), map.mark);
  for (const SVertex& s : map.svertices) {
    h.add(s.p.value, s.q.value);
    h.add(s.out, s.sface << 16U ^ s.mark);
  }
  // What comes before and on which sface follows from what comes next, in legal maps.
  for (const SHalfedge& e : map.shalfedges) h.add(e.source << 16U ^ e.next, e.sface << 16U ^ e.mark);
  for (const SFace& f : map.sfaces) h.add(f.entry_count, f.mark);
  for (const SFaceEntry& e : map.entries) h.add(static_cast<std::uint32_t>(e.kind), e.index);
  return h.value();
}

// The place of a plane among those of the map at hand, which may get it. The svertices of a ring lie between arcs
// that have about their numbers.
PlaneId PatternInterner::name_of(PlaneId plane, std::uint32_t guess) {
  const std::span<const PlaneId> pairs = std::span(*of_pairs_).subspan(first_pair_);
  const auto named = [plane](std::size_t place, PlaneId there) {
    return PlaneId::of_row(static_cast<std::uint32_t>(place)).opposite_if(there != plane);
  };
  const auto at = [&](std::size_t i) { return pairs[i].row() == plane.row(); };
  const std::size_t count = pairs.size();
  if (guess < count && at(guess)) return named(guess, pairs[guess]);
  if (count > 0 && guess <= count) {
    const std::size_t before = guess == 0 ? count - 1 : guess - 1;
    if (at(before)) return named(before, pairs[before]);
  }
  if (count <= kFew) {
    for (std::size_t i = 0; i < count; ++i) {
      if (at(i)) return named(i, pairs[i]);
    }
  } else {
    if (sorted_.empty()) {
      for (std::uint32_t i = 0; i < count; ++i) sorted_.emplace_back(pairs[i].unflipped(), i);
      std::sort(sorted_.begin(), sorted_.end());
    }
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(plane.unflipped(), 0U));
    if (found != sorted_.end() && found->first.row() == plane.row()) return named(found->second, pairs[found->second]);
  }
  const std::size_t looked_at = std::min(others_->size(), first_other_ + kFew);
  for (std::size_t i = first_other_; i < looked_at; ++i) {
    if ((*others_)[i].row() == plane.row()) return named(count + i - first_other_, (*others_)[i]);
  }
  others_->push_back(plane);
  return named(count + others_->size() - 1 - first_other_, plane);
}

PatternId PatternInterner::intern(PatternTable& table, const SphereMapView& map, std::vector<PlaneId>& of_pairs,
                                  std::vector<PlaneId>& others) {
  of_pairs_ = &of_pairs;
  others_ = &others;
  first_pair_ = of_pairs.size();
  first_other_ = others.size();
  sorted_.clear();
  scratch_.clear();
  scratch_.mark = map.mark;
  scratch_.shalfedges.reserve(map.shalfedges.size());
  scratch_.svertices.reserve(map.svertices.size());
  for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
    SHalfedge half = map.shalfedges[e];
    if (e % 2 == 0) of_pairs.push_back(half.plane);
    half.plane = PlaneId{e};
    scratch_.shalfedges.push_back(half);
  }
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    SVertex s = map.svertices[i];
    s.p = name_of(s.p, i);
    s.q = name_of(s.q, i);
    scratch_.svertices.push_back(s);
  }
  scratch_.sfaces.assign(map.sfaces.begin(), map.sfaces.end());
  scratch_.entries.assign(map.entries.begin(), map.entries.end());
  return find_or_push(table);
}

PatternId PatternInterner::intern(PatternTable& table, const PatternTable& from, PatternId pattern,
                                  std::span<const LabelId> marks) {
  scratch_.assign(from.view(pattern));
  if (!marks.empty()) {
    const auto change = [marks](LabelId& mark) {
      if (mark != kOutside) mark = marks[mark];
    };
    change(scratch_.mark);
    for (SVertex& s : scratch_.svertices) change(s.mark);
    for (SHalfedge& e : scratch_.shalfedges) change(e.mark);
    for (SFace& f : scratch_.sfaces) change(f.mark);
  }
  return find_or_push(table);
}

PatternId PatternInterner::find_or_push(PatternTable& table) {
  catch_up(table);
  const std::uint64_t wanted = hash(scratch_.view());
  if (!slots_.empty()) {
    const std::size_t last = slots_.size() - 1;
    for (std::size_t slot = wanted & last; slots_[slot] != kNone; slot = (slot + 1) & last) {
      const PatternId id{slots_[slot]};
      if (hashes_[id.index()] == wanted && equal(table, id, scratch_)) return id;
    }
  }
  const PatternId id = table.push(scratch_);
  insert(wanted, id);
  return id;
}

void PatternInterner::reset() {
  hashes_.clear();
  slots_.clear();
}

// The table may have had patterns before.
void PatternInterner::catch_up(const PatternTable& table) {
  while (hashes_.size() < table.size()) {
    const PatternId id{hashes_.size()};
    insert(hash(table.view(id)), id);
  }
}

void PatternInterner::insert(std::uint64_t hash, PatternId id) {
  hashes_.push_back(hash);
  const auto put = [this](std::uint32_t pattern) {
    std::size_t slot = hashes_[pattern] & (slots_.size() - 1);
    while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = pattern;
  };
  if (2 * hashes_.size() <= slots_.size()) return put(id.index());
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), kNone);
  hashes_.reserve(slots_.size() / 2);
  for (std::uint32_t i = 0; i < hashes_.size(); ++i) put(i);
}

}  // namespace nef
