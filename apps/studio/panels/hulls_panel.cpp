// SPDX-License-Identifier: Apache-2.0
//
// A scene's outlines come from a cache; the hull is computed anew from those of the views that are switched on.
// Residuals are measured only if they are wanted: they cost more than the hull.
#include <algorithm>
#include <cmath>

#include "apps/program/set_info.h"
#include "apps/studio/panels/panel.h"
#include "apps/studio/panels/silhouette_cache.h"
#include "apps/visual_hull/command/pictures/pictures.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/number_text.h"

namespace nef::studio {
namespace {

OutlineOptions outline_options(const Json& request) {
  OutlineOptions options;
  options.threshold = text_of(request, "threshold");
  const std::string text = text_of(request, "simplify");
  const std::optional<Rational> simplify = try_parse_rational(text.empty() ? "0" : text);
  if (!simplify || *simplify < 0 || *simplify > 1000) {
    throw FieldError("simplify", 0, "'" + text + "' is not a number of pixels from 0 to 1000");
  }
  options.simplify = nearest_double(*simplify);
  return options;
}

// The numbers of the views that are switched off.
std::vector<bool> switched_off(const Json& request, std::size_t count) {
  std::vector<bool> off(count, false);
  const auto list = request.find("off");
  if (list == request.end() || !list->is_array()) return off;
  for (const Json& number : *list) {
    if (!number.is_number_unsigned() || number.get<std::size_t>() >= count) {
      throw InputError("the scene has no view " + number.dump());
    }
    off[number.get<std::size_t>()] = true;
  }
  return off;
}

Json view_json(const visual_hull::View& view, const visual_hull::ViewResult* result) {
  Json json{{"name", view.name}, {"on", result != nullptr}};
  if (result == nullptr) return json;
  json["vertices"] = result->silhouette.region.vertex_count();
  if (result->verification) {
    const visual_hull::Verification& found = *result->verification;
    json["inside"] = found.inside;
    if (found.area_known && found.silhouette_area > 0) json["residual"] = found.difference_area / found.silhouette_area;
  }
  return json;
}

}  // namespace

PanelResult hulls_panel(const Json& request, const PanelContext& context) {
  const Stopwatch watch;
  Messages notes;
  const visual_hull::Scene all = context.silhouettes.scene(context.root, text_of(request, "scene"),
                                                           outline_options(request), context.monitor, notes);
  PanelResult result;
  result.report["outlines_s"] = watch.seconds();
  const std::vector<bool> off = switched_off(request, all.views.size());
  visual_hull::Scene scene = all;
  scene.views.clear();
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    if (!off[i]) scene.views.push_back(all.views[i]);
  }
  if (scene.views.empty()) throw InputError("switch a view on: without any there is no hull");
  visual_hull::Options options;
  options.monitor = context.monitor;
  options.verify = request.value("residuals", false);
  const Stopwatch hull_watch;
  const visual_hull::Result hull = visual_hull::compute(scene, context.root.path(), options);
  result.report["op_s"] = hull_watch.seconds();
  result.report["result"] = set_info(hull.hull, {.bounds = true}, context.monitor);
  notes.insert(notes.end(), hull.notes.begin(), hull.notes.end());
  if (hull.vanished) notes.push_back(hull.vanished->view + ": " + hull.vanished->reason);
  result.report["notes"] = notes;
  result.report["views"] = Json::array();
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    result.report["views"].push_back(view_json(all.views[i], off[i] ? nullptr : &hull.views[next++]));
  }
  result.layers =
      visual_hull::page_layers(hull, hull.origin, visual_hull::hull_layer(hull, hull.origin, context.monitor));
  result.sets = {{"result", hull.hull}};
  return result;
}

}  // namespace nef::studio
