// SPDX-License-Identifier: Apache-2.0
#include "nef/boolean/pyramid_overlay.h"

#include "nef/base/threads/parallel.h"
#include "nef/complex/local_pyramid.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {

const SphereMapBuffer& PyramidOverlay::at(const std::array<ItemRef, 2>& items, LabelId label) {
  const SphereMapView a = operands_[0].pyramid(items[0], label, scratch_[0]);
  const SphereMapView b = operands_[1].pyramid(items[1], label, scratch_[1]);
  overlay_.overlay(tables_.planes, a, b, f_, out_, monitor_);
  return out_;
}

OverlaidMeetings::OverlaidMeetings(const std::array<Operand, 2>& operands, const CommonTables& tables,
                                   const LabelFunction& f, std::span<const Meeting> meetings, const Monitor& monitor)
    : made_((meetings.size() + kTogether - 1) / kTogether), vertex_(meetings.size()) {
  const auto make = [&](std::size_t part, const Monitor& own) {
    PyramidOverlay overlay(operands, tables, f, own);
    PlaneTable none;
    ComplexBuilder vertices(none, own);
    const std::size_t first = part * kTogether;
    for (std::size_t k = first; k < std::min(meetings.size(), first + kTogether); ++k) {
      const SphereMapBuffer& map = overlay.at(meetings[k].items, 0);
      if (!is_vertex(tables.planes, map.view(), own)) continue;
      vertex_[k] = VertexId{vertices.so_far().vertex_count()};
      vertices.append(tables.points, meetings[k].point, map.view());
    }
    made_[part] = vertices.take_so_far();
  };
  // Only the calling thread tells of its progress, between parts.
  constexpr std::size_t kAtOnce = 16;
  for (std::size_t begin = 0; begin < made_.size(); begin += kAtOnce) {
    monitor.tell_progress("sphere maps", begin * kTogether, meetings.size());
    parallel_for(std::min(kAtOnce, made_.size() - begin), monitor,
                 [&](std::size_t i, const Monitor& own) { make(begin + i, own); });
  }
}

VertexOf OverlaidMeetings::operator[](std::size_t k) const {
  if (!vertex_[k].valid()) return {};
  return {&made_[k / kTogether], vertex_[k]};
}

}  // namespace nef
