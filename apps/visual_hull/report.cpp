// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "nef/program/report.h"

namespace visual_hull {
namespace {

using json = nlohmann::ordered_json;

json box_json(const WorldBox& box) {
  json list = json::array();
  for (const Rational3* corner : {&box.low, &box.high}) {
    for (const Rational& c : *corner) list.push_back(nef::to_string(c));
  }
  return list;
}

json view_json(const ViewResult& view) {
  const ViewSilhouette& s = view.silhouette;
  json entry{{"name", view.name},
             {"image", view.image.string()},
             {"contours", s.contours},
             {"holes", s.holes},
             {"contour_vertices", s.contour_vertices},
             {"polygon_vertices", s.region.vertex_count()},
             {"cone_facets", view.cone_facets},
             {"cut_by_frame", s.cut_by_frame},
             {"keeps_unseen", s.background}};
  if (s.image_size.area() > 0) entry["image_size"] = {s.image_size.width, s.image_size.height};
  return entry;
}

json verify_json(const Result& result) {
  json list = json::array();
  for (const ViewResult& view : result.views) {
    if (!view.verification) continue;
    const Verification& v = *view.verification;
    json entry{{"view", view.name}, {"inside", v.inside}};
    if (!v.problem.empty()) entry["problem"] = v.problem;
    entry["symmetric_difference_px"] = v.area_known ? json(v.difference_area) : json(nullptr);
    entry["silhouette_px"] = v.area_known ? json(v.silhouette_area) : json(nullptr);
    list.push_back(entry);
  }
  return list;
}

}  // namespace

double approximate_volume(const nef::Polyhedron& hull) {
  using Vec = std::array<double, 3>;
  const nef::Complex& c = hull.complex();
  const auto at = [&c](std::uint32_t vertex) { return c.points.approximate(nef::PointId(vertex)); };
  const auto cross = [](const Vec& a, const Vec& b) {
    return Vec{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  if (c.vertex_count() == 0) return 0;
  // Relative to a point of the hull: little is lost by cancellation.
  const Vec origin{at(0)[0], at(0)[1], at(0)[2]};
  const auto from_origin = [&](std::uint32_t vertex) {
    const auto& p = at(vertex);
    return Vec{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
  };
  double sum = 0;
  for (const nef::Facet& facet : c.facets) {
    const bool above = c.volumes[facet.volume_above].mark != 0;
    const bool below = c.volumes[facet.volume_below].mark != 0;
    if (above == below) continue;
    Vec area{};  // twice the facet's area vector
    Vec place{};
    for (std::uint32_t k = 0; k < facet.cycle_count; ++k) {
      const auto corners = c.cycle(facet.first_cycle + k);
      for (const std::uint32_t corner : corners) {
        place = from_origin(c.shalfedge_owner[corner]);
        const Vec part = cross(place, from_origin(c.target(c.corner_halfedge(corner))));
        for (std::size_t i = 0; i < 3; ++i) area[i] += part[i];
      }
    }
    const std::array<double, 4>& n = c.planes.approximate(facet.plane);
    const bool upward = (area[0] * n[0] + area[1] * n[1] + area[2] * n[2] > 0) != facet.plane.flipped();
    const double sign = upward == below ? 1 : -1;
    sum += sign * dot(place, area);
  }
  return sum / 6;
}

nlohmann::ordered_json make_report(const Result& result, const nef::Messages& messages) {
  json report;
  report["views"] = json::array();
  for (const ViewResult& view : result.views) report["views"].push_back(view_json(view));
  report["box"] = box_json(result.box);
  report["box_found"] = result.box_found;
  report["direct"] = result.direct;
  nef::PredicateCounts total;
  bool verified = false;
  for (const ViewResult& view : result.views) verified = verified || view.verification.has_value();
  for (std::size_t i = 0; i < kPhaseCount; ++i) {
    const PhaseReport& phase = result.phases[i];
    if (static_cast<Phase>(i) == Phase::kVerify && !verified) continue;
    report["phases"][phase_name(static_cast<Phase>(i))] = {{"seconds", phase.seconds},
                                                           {"predicates", nef::predicates_json(phase.predicates)}};
    total.identity += phase.predicates.identity;
    total.filter += phase.predicates.filter;
    total.exact += phase.predicates.exact;
  }
  report["predicates"] = nef::predicates_json(total);
  report["result"] = nef::info_json(result.hull);
  if (result.vanished) report["vanished"] = {{"view", result.vanished->view}, {"reason", result.vanished->reason}};
  if (verified) report["verify"] = verify_json(result);
  report["peak_memory_bytes"] = nef::peak_memory_bytes();
  if (!messages.empty()) report["messages"] = messages;
  return report;
}

std::string summary(const Result& result) {
  const nef::Counts counts = nef::counts(result.hull);
  double seconds = 0;
  for (const PhaseReport& phase : result.phases) seconds += phase.seconds;
  std::size_t vertices = 0;
  for (const ViewResult& view : result.views) vertices += view.silhouette.region.vertex_count();
  return fmt::format(
      "{} views, {} polygon vertices -> hull with {} vertices, {} edges, {} facets, volume {:.6g} ({:.3g} s)",
      result.views.size(), vertices, counts.vertices, counts.edges, counts.facets, approximate_volume(result.hull),
      seconds);
}

}  // namespace visual_hull
