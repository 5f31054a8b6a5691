// SPDX-License-Identifier: Apache-2.0
#include "nef/io/native/complete_sphere_map.h"

#include <algorithm>
#include <span>
#include <vector>

namespace nef {
namespace {

bool is_entry_of(const SphereMapBuffer& map, std::uint32_t f, const SFaceEntry& entry) {
  switch (entry.kind) {
    case SFaceEntry::Kind::kCycle:
      return entry.index < map.shalfedges.size() && map.shalfedges[entry.index].sface == f;
    case SFaceEntry::Kind::kIsolatedVertex:
      return entry.index < map.svertices.size() && map.svertices[entry.index].out == kNone &&
             map.svertices[entry.index].sface == f;
    case SFaceEntry::Kind::kLoop:
      return entry.index < map.sloops.size() && map.sloops[entry.index].sface == f;
  }
  return false;
}

bool has_own_entries(const SphereMapBuffer& map, std::uint32_t f) {
  const SFace& face = map.sfaces[f];
  const auto entries = std::span(map.entries).subspan(face.entries, face.entry_count);
  return std::all_of(entries.begin(), entries.end(), [&](const SFaceEntry& e) { return is_entry_of(map, f, e); });
}

}  // namespace

const char* complete_sphere_map(SphereMapBuffer& map) {
  std::vector<SHalfedge>& items = map.shalfedges;
  for (std::uint32_t e = 0; e < items.size(); ++e) {
    if (items[e].source >= map.svertices.size() || items[e].next >= items.size() ||
        items[e].sface >= map.sfaces.size()) {
      return "an item of a shalfedge does not exist";
    }
    SHalfedge& next = items[items[e].next];
    if (next.prev != kNone || next.sface != items[e].sface || next.source != items[e ^ 1U].source) {
      return "the boundary of an sface is broken";
    }
    next.prev = e;
  }
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    const SVertex& s = map.svertices[i];
    const bool is_known =
        s.out == kNone ? s.sface < map.sfaces.size() : s.out < items.size() && items[s.out].source == i;
    if (!is_known) return "an svertex does not know its place";
  }
  for (const SLoop& l : map.sloops) {
    if (l.sface >= map.sfaces.size()) return "an sface does not exist";
  }
  if (map.sloops.size() > 2) return "a vertex has more than one sloop";
  for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
    if (!has_own_entries(map, f)) return "an entry belongs to another sface";
  }
  return nullptr;
}

}  // namespace nef
