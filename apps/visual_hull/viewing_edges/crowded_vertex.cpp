// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/crowded_vertex.h"

#include <algorithm>

#include "apps/visual_hull/viewing_edges/corners.h"

namespace nef::visual_hull {

CrowdedPyramids::CrowdedPyramids(std::span<const ViewingEdge> edges, const nef::PlaneTable& planes,
                                 const nef::Monitor& monitor, std::function<nef::PlaneId(std::uint32_t)> plane)
    : edges_(edges),
      planes_(planes),
      monitor_(monitor),
      plane_(std::move(plane)),
      both_(2, 2, [](nef::LabelId a, nef::LabelId b) { return static_cast<nef::LabelId>(a & b); }),
      either_(2, 2, [](nef::LabelId a, nef::LabelId b) { return static_cast<nef::LabelId>(a | b); }) {}

nef::SphereMapView CrowdedPyramids::at(const CrowdedVertex& vertex) {
  all_.assign_trivial(1);
  const std::span<const std::uint32_t> shown = vertex.edges;
  nef::SphereMapBuffer of_view;
  for (std::size_t begin = 0; begin < shown.size();) {
    std::size_t end = begin;
    while (end < shown.size() && edges_[shown[end]].view == edges_[shown[begin]].view) ++end;
    add_view(shown.subspan(begin, end - begin), of_view);
    combine(all_, of_view, both_);
    begin = end;
  }
  return all_.view();
}

// A half-space where the point is seen inside of an edge, and where edges meet what lies between those that leave and
// those that arrive.
void CrowdedPyramids::add_view(std::span<const std::uint32_t> edges, nef::SphereMapBuffer& result) {
  if (edges.size() == 1) {
    result.assign_circle(plane_(edges[0]), 1, 1, 0);
    return;
  }
  std::vector<std::uint32_t> incoming;
  std::vector<std::uint32_t> outgoing;
  for (const std::uint32_t out : edges) {
    const std::uint32_t in = edges_[out].previous;
    if (!std::binary_search(edges.begin(), edges.end(), in)) continue;
    outgoing.push_back(out);
    incoming.push_back(in);
  }
  result.assign_trivial(0);
  nef::SphereMapBuffer sector;
  for (const std::uint32_t out : outgoing) {
    add_sector(next_incoming(out, incoming, edges_, monitor_), out, sector);
    combine(result, sector, either_);
  }
}

void CrowdedPyramids::add_sector(std::uint32_t in, std::uint32_t out, nef::SphereMapBuffer& result) {
  result.assign_circle(plane_(out), 1, 1, 0);
  const int turn = orientation(*edges_[in].from, *edges_[out].from, *edges_[out].to, monitor_);
  if (turn == 0) return;
  nef::SphereMapBuffer other;
  other.assign_circle(plane_(in), 1, 1, 0);
  combine(result, other, turn > 0 ? both_ : either_);
}

void CrowdedPyramids::combine(nef::SphereMapBuffer& result, const nef::SphereMapBuffer& other,
                              const nef::LabelFunction& function) {
  overlay_.overlay(planes_, result.view(), other.view(), function, scratch_, monitor_);
  std::swap(result, scratch_);
}

}  // namespace nef::visual_hull
