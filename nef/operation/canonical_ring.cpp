// SPDX-License-Identifier: Apache-2.0
#include "nef/operation/canonical_ring.h"

#include <utility>

namespace nef {
namespace {

// Nothing if the pattern is no ring.
std::optional<RingOfPattern> ring_of(const PatternTable& patterns, PatternId id) {
  const std::span<const SVertex> svertices = patterns.svertices(id);
  const std::span<const SHalfedge> halves = patterns.shalfedges(id);
  const std::span<const SFace> sfaces = patterns.sfaces(id);
  const std::size_t n = svertices.size();
  if (n < 3 || n > RingOfPattern::kMost || halves.size() != 2 * n || sfaces.size() != 2 ||
      patterns.entries(id).size() != 2) {
    return std::nullopt;
  }
  RingOfPattern ring;
  ring.size = static_cast<std::uint8_t>(n);
  ring.marks = {patterns.mark(id), svertices[0].mark, halves[0].mark, sfaces[halves[0].sface].mark,
                sfaces[halves[1].sface].mark};
  std::uint32_t e = 0;
  std::uint32_t before = halves[0].prev;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && e == 0) return std::nullopt;
    const SVertex& s = svertices[halves[e].source];
    if (s.mark != ring.marks[1] || halves[e].mark != ring.marks[2] || halves[e ^ 1U].mark != ring.marks[2]) {
      return std::nullopt;
    }
    // At the end of an arc that hangs in an sface, both would be the same, which name no direction.
    // Planes by their places are those of even shalfedges, and flipped where the shalfedge is odd.
    const PlaneId first{before};
    const PlaneId second{e};
    const bool in_order = s.p.row() == first.row() && s.q.row() == second.row();
    if (!in_order && (s.p.row() != second.row() || s.q.row() != first.row())) return std::nullopt;
    const bool flips = (s.p.flipped() != s.q.flipped()) != (first.flipped() != second.flipped());
    ring.steps[i] = {static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(halves[e].source), flips == in_order};
    before = e;
    e = halves[e].next;
  }
  if (e != 0) return std::nullopt;
  return ring;
}

}  // namespace

bool RingOfPattern::names_lines(std::span<const PlaneId> planes) const {
  std::uint32_t before = planes[steps[size - 1U].shalfedge >> 1U].row();
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t row = planes[steps[i].shalfedge >> 1U].row();
    if (row == before) return false;
    before = row;
  }
  return true;
}

RingsOfPatterns::RingsOfPatterns(const PatternTable& patterns) : at_(patterns.size(), kNone) {
  for (std::uint32_t i = 0; i < patterns.size(); ++i) {
    const std::optional<RingOfPattern> ring = ring_of(patterns, PatternId{i});
    if (!ring) continue;
    if (rings_.empty()) rings_.reserve(patterns.size() - i);
    at_[i] = static_cast<std::uint32_t>(rings_.size());
    rings_.push_back(*ring);
  }
}

bool CanonicalRings::read(const RingOfPattern& ring, std::span<const PlaneId> planes,
                          std::span<const std::uint32_t> row) {
  const std::size_t n = ring.size;
  size_ = n;
  std::array<std::uint32_t, RingOfPattern::kMost> rows{};
  std::array<bool, RingOfPattern::kMost> flipped{};
  std::array<std::uint64_t, RingOfPattern::kMost> sorted{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t shalfedge = ring.steps[i].shalfedge;
    const PlaneId plane = planes[shalfedge >> 1U];
    rows[i] = row[plane.row()];
    flipped[i] = plane.flipped() != ((shalfedge & 1U) != 0);
    const std::uint64_t item = std::uint64_t{rows[i]} << 4U | i;
    std::size_t at = i;
    for (; at > 0 && item < sorted[at - 1]; --at) sorted[at] = sorted[at - 1];
    sorted[at] = item;
  }
  std::array<std::uint8_t, RingOfPattern::kMost> rank{};
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(sorted[k] & 15U);
    if (k > 0 && planes_[k - 1].row() == rows[i]) return false;
    planes_[k] = PlaneId::of_row(rows[i]);
    rank[i] = static_cast<std::uint8_t>(k);
  }
  const auto first = static_cast<std::size_t>(sorted[0] & 15U);
  const bool backward = flipped[first];
  key_.marks = ring.marks;
  if (backward) std::swap(key_.marks[3], key_.marks[4]);
  key_.bits = 1;  // ends the bits of any number of steps
  std::size_t i = first;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = i + 1 == n ? 0 : i + 1;
    const std::size_t source = backward ? next : i;  // step of the svertex that is left
    const std::size_t before = source == 0 ? n - 1 : source - 1;
    const bool turned =
        (ring.steps[source].turned != (flipped[before] != flipped[source])) != (rows[source] < rows[before]);
    svertices_[k] = ring.steps[source].svertex;
    key_.bits =
        key_.bits << 6U | std::uint64_t{rank[i]} << 2U | (flipped[i] != backward ? 2U : 0U) | (turned ? 1U : 0U);
    i = backward ? (i == 0 ? n - 1 : i - 1) : next;
  }
  return true;
}

void CanonicalRings::learn(VertexId vertex, std::span<const std::uint32_t> numbers) {
  Written written;
  written.vertex = vertex;
  for (std::size_t k = 0; k < size_; ++k) written.svertex[k] = static_cast<std::uint8_t>(numbers[svertices_[k]]);
  written_.emplace(key_, written);
}

std::size_t CanonicalRings::Hash::operator()(const Key& key) const {
  std::uint64_t h = key.bits * 0x9e3779b97f4a7c15ULL;
  for (const LabelId mark : key.marks) h = (h ^ h >> 29U ^ mark) * 0x9e3779b97f4a7c15ULL;
  return h ^ h >> 32U;
}

}  // namespace nef
