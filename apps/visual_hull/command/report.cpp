// SPDX-License-Identifier: Apache-2.0
//
// Everything that is printed of a result: the JSON report, the summary, the verdict on views, and why a hull vanished.
// No geometry is computed here but the volume and the counts.
#include "apps/visual_hull/command/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "apps/program/set_info.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::visual_hull {
namespace {

using json = nef::Json;

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
             {"cone_facets", view.cone_facets ? json(*view.cone_facets) : json(nullptr)},
             {"cut_by_frame", s.cut_by_frame},
             {"keeps_unseen", s.background}};
  if (s.image_size.area() > 0) entry["image_size"] = {s.image_size.width, s.image_size.height};
  if (view.mask_change) {
    entry["mask_added_px"] = view.mask_change->added;
    entry["mask_removed_px"] = view.mask_change->removed;
  }
  return entry;
}

json measures_json(const ViewConsistency& m) {
  return {
      {"residual", m.residual}, {"fall", m.fall}, {"removed", m.removed}, {"relative", m.relative}, {"score", m.score}};
}

void add_consistency(json& report, const Result& result) {
  if (!result.consistency) return;
  const Consistency& found = *result.consistency;
  for (std::size_t i = 0; i < found.views.size(); ++i) report["views"][i].update(measures_json(found.views[i]));
  report["suspects"] = json::array();
  for (const Dropped& dropped : result.dropped) report["suspects"].push_back(dropped.view);
  if (found.guilty) report["suspects"].push_back(result.views[*found.guilty].name);
  report["dropped"] = json::array();
  for (const Dropped& dropped : result.dropped) {
    json entry{{"view", dropped.view}, {"share", dropped.share}};
    entry.update(measures_json(dropped.measures));
    report["dropped"].push_back(std::move(entry));
  }
}

json refinement_json(const refine::Refinement& r) {
  json views = json::array();
  for (const refine::RefinedView& view : r.views) {
    const char* const fault = view.fault == refine::Fault::kMask ? "mask" : "camera";
    views.push_back({{"view", view.name},
                     {"moved_px", view.moved_px},
                     {"turned_degrees", view.turned_degrees},
                     {"residual_px_before", view.residual_before},
                     {"residual_px_after", view.residual_after},
                     {"fault", view.fault == refine::Fault::kNone ? json(nullptr) : json(fault)}});
  }
  return {{"accepted", r.accepted},
          {"model", refine::model_name(r.model)},
          {"residual_px_before", r.before.mean},
          {"residual_px_after", r.after.mean},
          {"residual_px_before_90", r.before.ninth_decile},
          {"residual_px_after_90", r.after.ninth_decile},
          {"held_out_px_before", r.held_out_before.mean},
          {"held_out_px_after", r.held_out_after.mean},
          {"focal_factor", r.focal_factor},
          {"focal_px", r.focal},
          {"found", r.found},
          {"undetermined", r.undetermined},
          {"views", std::move(views)}};
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

bool is_verified(const Result& result) {
  return std::any_of(result.views.begin(), result.views.end(),
                     [](const ViewResult& view) { return view.verification.has_value(); });
}

// body(phase, its report) for each phase that was gone through.
template <typename Body>
void each_phase(const Result& result, const Body& body) {
  for (std::size_t i = 0; i < kPhaseCount; ++i) {
    const auto phase = static_cast<Phase>(i);
    if (phase == Phase::kVerify && !is_verified(result)) continue;
    if (phase == Phase::kRefine && !result.refinement) continue;
    body(phase, result.phases[i]);
  }
}

}  // namespace

nef::Json make_report(const Result& result, bool exact_volume) {
  json report;
  report["views"] = json::array();
  for (const ViewResult& view : result.views) report["views"].push_back(view_json(view));
  report["box"] = box_json(result.box);
  report["box_found"] = result.box_found;
  report["direct"] = result.direct;
  if (!result.pieces.empty()) report["pieces"] = result.pieces;
  report["result"] = nef::set_info(result.hull, {.exact = exact_volume, .bounds = true});
  if (result.vanished) {
    report["vanished"] = {
        {"view", result.vanished->view}, {"reason", result.vanished->reason}, {"sets", result.vanished->sets}};
  }
  add_consistency(report, result);
  if (result.refinement) report["refine"] = refinement_json(*result.refinement);
  if (is_verified(result)) report["verify"] = verify_json(result);
  each_phase(result, [&](Phase phase, const PhaseReport& spent) {
    report["cpu"][std::string(phase_name(phase)) + "_s"] = spent.cpu_seconds;
  });
  return report;
}

void tell_phases(nef::Session& session, const Result& result) {
  each_phase(result, [&](Phase phase, const PhaseReport& spent) {
    session.spent(phase_name(phase), spent.seconds, spent.predicates);
  });
}

std::string vanished_text(const Result& result) {
  const Vanished& vanished = *result.vanished;
  std::string text = fmt::format("the hull is {}: ", result.hull.is_empty() ? "empty" : "flat");
  if (vanished.sets.empty() || vanished.sets[0].size() == 1) text += "view " + vanished.view + ": ";
  text += vanished.reason;
  for (std::size_t i = 1; i < vanished.sets.size(); ++i) {
    text += (i == 1 ? "; likewise " : ", ") + fmt::format("{}", fmt::join(vanished.sets[i], " + "));
  }
  return text;
}

std::vector<std::string> verdict_lines(const Result& result) {
  std::vector<std::string> lines;
  for (const Dropped& dropped : result.dropped) {
    lines.push_back(
        fmt::format("view {} disagrees with the others: it is left out, which removes {:.0f} % of the "
                    "inconsistency",
                    dropped.view, 100 * dropped.share));
  }
  if (!result.consistency || result.consistency->residual <= 0) return lines;
  const Consistency& found = *result.consistency;
  if (found.guilty) {
    lines.push_back(
        fmt::format("view {} disagrees with the others: leaving it out removes {:.0f} % of the inconsistency",
                    result.views[*found.guilty].name, 100 * found.share(*found.guilty)));
    return lines;
  }
  const std::vector<std::size_t> order = found.ranked();
  std::vector<std::string> first;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) first.push_back(result.views[order[i]].name);
  lines.push_back(
      fmt::format("no view clearly disagrees with the others; these disagree most: {}", fmt::join(first, ", ")));
  return lines;
}

std::vector<std::string> refinement_lines(const Result& result) {
  if (!result.refinement) return {};
  const refine::Refinement& r = *result.refinement;
  std::vector<std::string> lines;
  if (r.found) {
    lines.push_back(fmt::format(
        "cameras found ({}): focal length {:.1f} px; the outlines are off by {:.3f} px, ninth decile {:.3f}; "
        "the unit of length is the distance of the camera",
        refine::model_name(r.model), r.focal, r.after.mean, r.after.ninth_decile));
  } else if (r.accepted) {
    lines.push_back(fmt::format(
        "cameras refined ({}): the outlines are off by {:.3f} px instead of {:.3f}, where they were not used by {:.3f} "
        "instead of {:.3f}; focal length times {:.4f}",
        refine::model_name(r.model), r.after.mean, r.before.mean, r.held_out_after.mean, r.held_out_before.mean,
        r.focal_factor));
  } else {
    lines.push_back(
        fmt::format("cameras not refined: the silhouettes give no better ones than those given, whose outlines are off "
                    "by {:.3f} px",
                    r.before.mean));
  }
  for (const refine::RefinedView& view : r.views) {
    if (view.fault == refine::Fault::kCamera) {
      lines.push_back(fmt::format("view {}: its camera was {:.1f} px off and was moved", view.name, view.moved_px));
    } else if (view.fault == refine::Fault::kMask) {
      lines.push_back(
          fmt::format("view {}: its mask disagrees with the other views wherever its camera is placed", view.name));
    }
  }
  if (!r.undetermined.empty()) {
    lines.push_back(fmt::format("the silhouettes do not determine: {}", fmt::join(r.undetermined, ", ")));
  }
  return lines;
}

std::vector<std::string> suspects_table(const Result& result) {
  const Consistency& found = *result.consistency;
  std::vector<std::string> lines{
      fmt::format("{:<24} {:>9} {:>9} {:>10} {:>9} {:>7}", "view", "residual", "fall", "removed", "relative", "score")};
  for (const std::size_t i : found.ranked()) {
    const ViewConsistency& v = found.views[i];
    lines.push_back(fmt::format("{:<24} {:>9.5f} {:>9.5f} {:>10.4g} {:>9.4f} {:>7.3f}{}", result.views[i].name,
                                v.residual, v.fall, v.removed, v.relative, v.score,
                                found.guilty == i ? "  disagrees" : ""));
  }
  return lines;
}

std::optional<std::string> cut_note(const Result& result) {
  constexpr std::size_t kTold = 3;
  std::vector<std::string> names;
  for (const ViewResult& view : result.views) {
    if (view.silhouette.cut_by_frame && !view.silhouette.background) names.push_back(view.name);
  }
  if (names.empty()) return std::nullopt;
  const std::size_t told = std::min(names.size(), kTold);
  std::string list =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(told), ", "));
  if (told < names.size()) list += fmt::format(" and {} more", names.size() - told);
  return fmt::format(
      "the image frame cuts the silhouette{} of view{} {}; what lies beyond it is taken as background, unless you give "
      "--border unknown",
      names.size() == 1 ? "" : "s", names.size() == 1 ? "" : "s", list);
}

namespace {

// "; 5 pieces, of volumes 1, 0.2, 0.1, ...", of a hull of several.
std::string pieces_text(const std::vector<double>& volumes) {
  constexpr std::size_t kTold = 3;
  if (volumes.empty()) return "";
  const std::span<const double> told = std::span(volumes).first(std::min(kTold, volumes.size()));
  return fmt::format("; {} pieces, of volumes {:.3g}{}", volumes.size(), fmt::join(told, ", "),
                     told.size() < volumes.size() ? ", ..." : "");
}

}  // namespace

std::string summary(const Result& result, const nef::Monitor& monitor) {
  const nef::Counts counts = nef::counts(result.hull);
  double seconds = 0;
  for (const PhaseReport& phase : result.phases) seconds += phase.seconds;
  std::size_t vertices = 0;
  for (const ViewResult& view : result.views) vertices += view.silhouette.region.vertex_count();
  return fmt::format(
      "{} views, {} polygon vertices -> hull with {} vertices, {} edges, {} facets, volume {:.6g}{} ({:.3g} s)",
      result.views.size(), vertices, counts.vertices, counts.edges, counts.facets,
      nef::approximate_volume(result.hull, monitor).value, pieces_text(result.pieces), seconds);
}

}  // namespace nef::visual_hull
