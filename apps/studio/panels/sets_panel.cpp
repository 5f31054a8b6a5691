// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "apps/program/set_info.h"
#include "apps/studio/panels/expression_field.h"
#include "apps/studio/panels/panel.h"
#include "apps/studio/panels/set_questions.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::studio {

namespace {

// Of a set in tiles: what need not be glued for.
Json info_of_tiles(const TiledPolyhedron& set, const DrawnTiles& drawn) {
  Json info{{"volume", nullptr}, {"volume_double", nullptr}};
  if (drawn.volume) {
    info["volume_double"] = drawn.volume->value;
    info["volume_error"] = drawn.volume->error;
  }
  info["triangles"] = drawn.triangles;
  info["tiles"] = set.tile_count();
  return info;
}

// Where the part of the text that somebody looks at is: a box of doubles; null if it is unbounded, empty, or no set.
Json box_of_part(const Json& request, const PanelContext& context) {
  const auto part = request.find("part");
  if (part == request.end() || !part->is_string()) return nullptr;
  try {
    Messages ignored;
    const auto box = bounding_box(set_of_field(request, "part", context, ignored), context.monitor);
    if (!box) return nullptr;
    return {nearest_doubles((*box)[0]), nearest_doubles((*box)[1])};
  } catch (const InputError&) {
    return nullptr;  // what is wrong with the whole text is told already
  }
}

// Answers a question beside the set. What is wrong with it is reported, and the set is there nevertheless.
void answer_question(const char* field, const std::function<void()>& answer, PanelResult& result) {
  const auto report = [&result](const std::string& wrong, const std::string& why) {
    result.report["question_error"] = {{"field", wrong}, {"error", why}};
  };
  try {
    answer();
  } catch (const FieldError& error) {
    report(error.field(), error.what());
  } catch (const InputError& error) {
    report(field, error.what());
  } catch (const UnsupportedError& error) {
    report(field, error.what());
  }
}

}  // namespace

PanelResult sets_panel(const Json& request, const PanelContext& context) {
  const Stopwatch watch;
  Messages notes;
  const bool by_shapes = request.value("shapes", false);
  const ExpressionCache::Result set = set_and_shapes_of_field(request, "text", context, !by_shapes, notes);
  PanelResult result;
  result.report["op_s"] = watch.seconds();
  result.report["notes"] = notes;
  result.report["part"] = box_of_part(request, context);
  if (set.tiled) {
    DrawnTiles drawn = context.tiles.draw(*set.tiled, context.monitor);
    result.report["result"] = info_of_tiles(*set.tiled, drawn);
    result.pieces = std::move(drawn.pieces);
    result.sets.emplace("result", *set.tiled);
  } else {
    result.report["result"] = set_info(*set.whole, {}, context.monitor);
    result.sets.emplace("result", *set.whole);
    if (by_shapes) {
      const auto color = [&] { result.layers = layers_by_shapes(*set.whole, set.shapes, context.monitor); };
      answer_question("shapes", color, result);
    }
    if (result.layers.empty()) {
      view::Layer& layer = result.layers.emplace_back();
      layer.name = "result";
      layer.scene = view::build_scene(*set.whole, {}, context.monitor);
    }
  }
  answer_question(
      "section", [&] { answer_section(request, set, context, result); }, result);
  answer_question(
      "distance", [&] { answer_distance(request, context, result); }, result);
  return result;
}

}  // namespace nef::studio
