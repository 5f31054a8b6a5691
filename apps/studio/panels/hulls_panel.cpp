// SPDX-License-Identifier: Apache-2.0
//
// A scene's outlines come from a cache; the hull is computed anew from those of the views that are switched on.
// Residuals are measured only if they are wanted: they cost more than the hull.
#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/program/set_info.h"
#include "apps/studio/caches/silhouette_cache.h"
#include "apps/studio/panels/panel.h"
#include "apps/view/page/byte_text.h"
#include "apps/visual_hull/command/hull_file.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "apps/visual_hull/command/pictures/pictures.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/number_text.h"

namespace nef::studio {
namespace {

OutlineOptions outline_options(const Json& request) {
  OutlineOptions options;
  options.threshold = text_of(request, "threshold");
  if (request.contains("mask")) options.mask = text_of(request, "mask");
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

// Of all views, and which of them disagrees with the others if they were compared.
void add_views(const visual_hull::Scene& all, const std::vector<bool>& off, const visual_hull::Result& hull,
               Json& report) {
  report["views"] = Json::array();
  report["suspect"] = nullptr;
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    report["views"].push_back(view_json(all.views[i], off[i] ? nullptr : &hull.views[next]));
    if (off[i]) continue;
    if (hull.consistency && next < hull.consistency->views.size()) {
      const double score = hull.consistency->views[next].score;
      if (std::isfinite(score)) report["views"].back()["score"] = score;
      if (hull.consistency->guilty == next) report["suspect"] = i;
    }
    ++next;
  }
}

visual_hull::HullColors colors_of(const Json& request) {
  const std::string name = request.contains("colors") ? text_of(request, "colors") : "plain";
  if (name == "plain") return visual_hull::HullColors::kPlain;
  if (name == "vertices") return visual_hull::HullColors::kVertices;
  if (name == "texture") return visual_hull::HullColors::kTexture;
  throw FieldError("colors", 0, "'" + name + "' is none of plain, vertices, texture");
}

// A hull whose views have their images again, and the numbers of these views in the scene.
struct Shown {
  visual_hull::Result hull;
  std::vector<std::size_t> numbers;
};

Shown with_images(const visual_hull::Result& hull, const TracedScene& traced, const std::vector<bool>& off) {
  Shown shown{hull, {}};
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (off[i]) continue;
    visual_hull::ViewResult& view = shown.hull.views[shown.numbers.size()];
    view.image = traced.images[i];
    view.distortion = traced.distortions[i];
    view.silhouette.image_size = {traced.sizes[i].width, traced.sizes[i].height};
    shown.numbers.push_back(i);
  }
  return shown;
}

// How files of the hull are coloured, by the photographs that are shown.
ColorsOfFile colors_of_file(const std::shared_ptr<const Shown>& shown, visual_hull::HullColors colors) {
  ColorsOfFile result;
  if (colors == visual_hull::HullColors::kVertices) {
    result.vertices = [shown](const Mesh& mesh, const Monitor& monitor, Messages& messages) {
      return visual_hull::colors_of_hull(mesh, shown->hull, monitor, messages);
    };
  }
  if (colors == visual_hull::HullColors::kTexture) {
    result.texture = [shown](const Mesh& mesh, const Monitor& monitor, Messages& messages) {
      return visual_hull::texture_of_hull(mesh, shown->hull, monitor, messages);
    };
  }
  return result;
}

// The image of one view with its outline, the hull over it, and what of the outline the hull does not reach; null if
// none is wanted or it is switched off.
Json overlay_of(const Json& request, const Shown& shown, const Monitor& monitor) {
  const auto wanted = request.find("overlay");
  if (wanted == request.end() || !wanted->is_number_unsigned()) return nullptr;
  const auto found = std::find(shown.numbers.begin(), shown.numbers.end(), wanted->get<std::size_t>());
  if (found == shown.numbers.end()) return nullptr;
  monitor.check_interruption();
  const visual_hull::ViewResult& view = shown.hull.views[static_cast<std::size_t>(found - shown.numbers.begin())];
  const cv::Mat picture = visual_hull::draw_overlay(view, shown.hull.hull, shown.hull.origin);
  return {{"view", *found}, {"url", "data:image/png;base64," + view::base64(visual_hull::png_of(picture))}};
}

}  // namespace

PanelResult hulls_panel(const Json& request, const PanelContext& context) {
  const Stopwatch watch;
  Messages notes;
  const TracedScene traced = context.silhouettes.scene(context.root, text_of(request, "scene"),
                                                       outline_options(request), context.monitor, notes);
  const visual_hull::Scene& all = traced.scene;
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
  options.suspects = options.verify;
  const Stopwatch hull_watch;
  visual_hull::Result hull = visual_hull::compute(scene, context.root.path(), options);
  result.report["op_s"] = hull_watch.seconds();
  result.report["result"] = set_info(hull.hull, {.bounds = true}, context.monitor);
  notes.insert(notes.end(), hull.notes.begin(), hull.notes.end());
  if (hull.vanished) notes.push_back(hull.vanished->view + ": " + hull.vanished->reason);
  result.report["notes"] = notes;
  add_views(all, off, hull, result.report);
  const visual_hull::HullColors colors = colors_of(request);
  const auto shown = std::make_shared<const Shown>(with_images(hull, traced, off));
  result.layers =
      visual_hull::page_layers(hull, hull.origin,
                               visual_hull::hull_layer(colors == visual_hull::HullColors::kPlain ? hull : shown->hull,
                                                       hull.origin, context.monitor, colors));
  result.report["overlay"] = overlay_of(request, *shown, context.monitor);
  result.sets.emplace("result", KeptSet(hull.hull, colors_of_file(shown, colors)));
  return result;
}

}  // namespace nef::studio
