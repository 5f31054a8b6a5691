// SPDX-License-Identifier: Apache-2.0
//
// Four steps, each of which sorts items by names that the steps before have made: svertices by the two smallest planes
// that arrive at them, arcs by their plane and svertices, cycles by their smallest arc, sfaces by their cycles. All
// names come from the canonical order of planes, so the result does not depend on how the map was stored. Lists are
// short, so they are sorted by insertion.
#include "nef/operation/canonical_map.h"

#include <algorithm>

namespace nef {
namespace {

// Keeps the two smallest rows, as unflipped planes.
void take_row(SVertex& svertex, std::uint32_t row) {
  const PlaneId plane = PlaneId::of_row(row);
  if (plane == svertex.p || plane == svertex.q) return;
  if (plane < svertex.p) {
    svertex.q = svertex.p;
    svertex.p = plane;
  } else if (plane < svertex.q) {
    svertex.q = plane;
  }
}

// Maps are small as a rule.
template <typename Item>
void sort_few(std::vector<Item>& items) {
  constexpr std::size_t kFew = 16;
  if (items.size() > kFew) {
    std::sort(items.begin(), items.end());
    return;
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Item item = items[i];
    std::size_t at = i;
    for (; at > 0 && item < items[at - 1]; --at) items[at] = items[at - 1];
    items[at] = item;
  }
}

}  // namespace

SphereMapView CanonicalMapWriter::write(const SphereMapView& map, std::span<const BareLine> lines) {
  out_.clear();
  out_.mark = map.mark;
  old_.assign(map.shalfedges.begin(), map.shalfedges.end());
  for (SHalfedge& half : old_) half.plane = renamed(half.plane);
  write_svertices(map, lines);
  write_shalfedges();
  for (std::size_t l = 0; l < map.sloops.size(); ++l) {
    SLoop loop = map.sloops[l ^ (map.sloops[0].plane.flipped() ? 1U : 0U)];
    loop.plane = renamed(loop.plane);
    out_.sloops.push_back(loop);
  }
  write_sfaces(map);
  return out_.view();
}

void CanonicalMapWriter::write_svertices(const SphereMapView& map, std::span<const BareLine> lines) {
  const auto count = static_cast<std::uint32_t>(map.svertices.size());
  named_.assign(map.svertices.begin(), map.svertices.end());
  for (std::uint32_t s = 0; s < count; ++s) named_[s].p = named_[s].q = PlaneId();
  for (const SHalfedge& half : old_) take_row(named_[half.source], half.plane.row());
  for (const BareLine& line : lines) {
    for (const std::uint32_t row : line.rows) take_row(named_[line.svertex], row_[row]);
  }
  for (std::uint32_t s = 0; s < count; ++s) turn_along(map.svertices[s], named_[s]);
  vertices_.resize(count);
  for (std::uint32_t s = 0; s < count; ++s) vertices_[s] = {named_[s].p, named_[s].q, s};
  sort_few(vertices_);
  svertex_.resize(count);
  for (std::uint32_t s = 0; s < count; ++s) {
    svertex_[vertices_[s].old] = s;
    out_.svertices.push_back(named_[vertices_[s].old]);
  }
}

// Flips the second plane where the planes would name the opposite direction.
void CanonicalMapWriter::turn_along(const SVertex& old, SVertex& svertex) const {
  const PlaneId p = renamed(old.p);
  const PlaneId q = renamed(old.q);
  bool positive = false;
  const bool kept = renamed_[old.p.row()] != kNone && renamed_[old.q.row()] != kNone;
  if (kept && std::min(p.row(), q.row()) == svertex.p.row() && std::max(p.row(), q.row()) == svertex.q.row()) {
    positive = (p.flipped() != q.flipped()) == (p.row() != svertex.p.row());
  } else {
    positive = sign_of_dot(Direction::cross(planes_, common(old.p), common(old.q)),
                           Direction::cross(ordered_, svertex.p, svertex.q), monitor_) > 0;
  }
  if (!positive) svertex.q = svertex.q.opposite();
}

void CanonicalMapWriter::write_shalfedges() {
  const auto count = static_cast<std::uint32_t>(old_.size());
  halfedges_.clear();
  for (std::uint32_t e = 0; e < count; e += 2) {
    const std::uint32_t unflipped = e + (old_[e].plane.flipped() ? 1 : 0);
    const SHalfedge& half = old_[unflipped];
    halfedges_.push_back({half.plane.row(), svertex_[half.source], svertex_[old_[unflipped ^ 1U].source], unflipped});
  }
  sort_few(halfedges_);
  shalfedge_.resize(count);
  for (std::uint32_t k = 0; k < halfedges_.size(); ++k) {
    shalfedge_[halfedges_[k].old] = 2 * k;
    shalfedge_[halfedges_[k].old ^ 1U] = 2 * k + 1;
  }
  for (SVertex& s : out_.svertices) s.out = kNone;
  for (const NamedHalfedge& named : halfedges_) {
    for (const std::uint32_t old : {named.old, named.old ^ 1U}) {
      SHalfedge half = old_[old];
      half.source = svertex_[half.source];
      half.next = shalfedge_[half.next];
      half.prev = shalfedge_[half.prev];
      SVertex& source = out_.svertices[half.source];
      if (source.out == kNone) source.out = shalfedge_[old];
      out_.shalfedges.push_back(half);
    }
  }
}

void CanonicalMapWriter::write_sfaces(const SphereMapView& map) {
  faces_.resize(std::max(faces_.size(), map.sfaces.size()));  // what lists of entries have room for stays
  const std::span<Face> faces(faces_.data(), map.sfaces.size());
  const std::uint32_t swap_loops = !map.sloops.empty() && map.sloops[0].plane.flipped() ? 1 : 0;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    faces[f].old = f;
    faces[f].entries.clear();
    for (const SFaceEntry& entry : map.entries.subspan(map.sfaces[f].entries, map.sfaces[f].entry_count)) {
      std::uint32_t index = entry.index ^ swap_loops;
      if (entry.kind == SFaceEntry::Kind::kCycle) index = smallest_of_cycle(shalfedge_[entry.index]);
      if (entry.kind == SFaceEntry::Kind::kIsolatedVertex) index = svertex_[entry.index];
      faces[f].entries.emplace_back(entry.kind, index);
    }
    std::sort(faces[f].entries.begin(), faces[f].entries.end());
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.entries < b.entries; });
  sface_.resize(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    sface_[faces[f].old] = f;
    out_.sfaces.push_back({static_cast<std::uint32_t>(out_.entries.size()),
                           static_cast<std::uint32_t>(faces[f].entries.size()), map.sfaces[faces[f].old].mark});
    for (const auto& [kind, index] : faces[f].entries) out_.entries.push_back({kind, index});
  }
  const auto rename = [this](std::uint32_t& sface) {
    if (sface != kNone) sface = sface_[sface];
  };
  for (SVertex& s : out_.svertices) rename(s.sface);
  for (SHalfedge& e : out_.shalfedges) rename(e.sface);
  for (SLoop& l : out_.sloops) rename(l.sface);
}

std::uint32_t CanonicalMapWriter::smallest_of_cycle(std::uint32_t first) const {
  std::uint32_t smallest = first;
  for (std::uint32_t e = out_.shalfedges[first].next; e != first; e = out_.shalfedges[e].next) {
    smallest = std::min(smallest, e);
  }
  return smallest;
}

}  // namespace nef
