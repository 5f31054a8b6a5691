// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/fill.h"

#include <vector>

#include "nef/base/error.h"

namespace nef {
namespace {

// The mark of each volume: breadth first through the facets.
std::vector<LabelId> parities(const Complex& c) {
  std::vector<std::vector<std::uint32_t>> beyond(c.volumes.size());
  for (const Facet& facet : c.facets) {
    beyond[facet.volume_above].push_back(facet.volume_below);
    beyond[facet.volume_below].push_back(facet.volume_above);
  }
  constexpr LabelId kUnknown = 2;
  std::vector<LabelId> mark(c.volumes.size(), kUnknown);
  mark[0] = 0;
  std::vector<std::uint32_t> queue{0};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const LabelId other = mark[queue[i]] == 0 ? 1 : 0;
    for (const std::uint32_t volume : beyond[queue[i]]) {
      if (mark[volume] == kUnknown) {
        mark[volume] = other;
        queue.push_back(volume);
      } else if (mark[volume] != other) {
        throw InputError("the mesh has a face with the same side of it on both sides: it separates nothing there");
      }
    }
  }
  NEF_ASSERT(queue.size() == c.volumes.size());  // only facets separate volumes
  return mark;
}

}  // namespace

Complex fill_by_parity(Complex surface) {
  const std::vector<LabelId> mark = parities(surface);
  // Every facet has different marks on its sides now, so everything that was needed still is: no
  // simplification.
  for (std::uint32_t s = 0; s < surface.sfaces.size(); ++s) surface.sfaces[s].mark = mark[surface.sface_volume(s)];
  for (std::uint32_t v = 0; v < surface.volumes.size(); ++v) surface.volumes[v].mark = mark[v];
  return surface;
}

}  // namespace nef
