// SPDX-License-Identifier: Apache-2.0
//
// Sections and nearest points are shown as pieces of their own, so that the set itself stays as it is drawn.
#include "apps/studio/panels/set_questions.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/program/expression/expression.h"
#include "apps/program/reports/exact_json.h"
#include "apps/studio/panels/expression_field.h"
#include "apps/view/page.h"
#include "apps/view/section_drawing.h"
#include "nef/base/error.h"
#include "nef/distance/distance.h"
#include "nef/io/number_text.h"
#include "nef/operation/label_inputs.h"
#include "nef/parts/section.h"

namespace nef::studio {
namespace {

constexpr view::Color kCut{200, 30, 110};

// Shown as one layer, which the page has not had before.
void add_piece(const std::string& name, const Polyhedron& set, std::vector<view::Polyline> lines,
               const PanelContext& context, PanelResult& result) {
  std::vector<view::Layer> layers(1);
  layers[0].name = name;
  layers[0].scene = view::build_scene(set, {}, context.monitor);
  layers[0].color = kCut;
  layers[0].lines = std::move(lines);
  Piece piece;
  piece.id = context.piece_numbers.next();
  piece.source = set;
  piece.scene = std::make_shared<const std::string>(view::page_scene(layers, {.details = false}));
  result.pieces.push_back(std::move(piece));
}

// The rings of a section's polygons, closed.
std::vector<view::Polyline> rings_of(const Section& section) {
  std::vector<view::Polyline> lines;
  const auto add = [&lines](const std::vector<Rational3>& ring) {
    view::Polyline& line = lines.emplace_back(view::Polyline{"section", {}, kCut});
    for (const Rational3& corner : ring) line.points.push_back(nearest_doubles(corner));
    line.points.push_back(line.points.front());
  };
  for (const SectionPolygon& polygon : section.polygons) {
    add(polygon.outer);
    for (const std::vector<Rational3>& hole : polygon.holes) add(hole);
  }
  return lines;
}

// An expression that may be left out.
std::optional<Polyhedron> optional_set(const Json& request, const std::string& field, const PanelContext& context) {
  if (!request.contains(field) || !request[field].is_string()) return std::nullopt;
  if (is_blank_expression(request[field].get<std::string>())) return std::nullopt;
  Messages ignored;
  return set_of_field(request, field, context, ignored);
}

std::string name_of(const InputSet& shapes) {
  if (shapes.empty()) return "in no shape";
  std::string text = shapes.size() == 1 ? "shape " : "shapes ";
  for (std::size_t i = 0; i < shapes.size(); ++i) text += (i == 0 ? "" : " and ") + std::to_string(shapes[i] + 1);
  return text;
}

}  // namespace

void answer_section(const Json& request, const ExpressionCache::Result& set, const PanelContext& context,
                    PanelResult& result) {
  const auto asked = request.find("section");
  if (asked == request.end() || !asked->is_object()) return;
  const Json axis = asked->value("axis", Json());
  if (!axis.is_number_unsigned() || axis.get<unsigned>() > 2) throw FieldError("section", 0, "the axis is 0, 1 or 2");
  const std::string text = text_of(*asked, "offset");
  const std::optional<Rational> offset = try_parse_rational(text);
  if (!offset) throw FieldError("section", 0, "'" + text + "' is not a number such as 0.5 or 1/3");
  Rational3 normal;
  normal[axis.get<unsigned>()] = 1;
  const Rational at = -*offset;
  const Section cut =
      set.tiled ? section(*set.tiled, normal, at, context.monitor) : section(*set.whole, normal, at, context.monitor);
  result.report["section"] = {{"area", view::section_area(cut)}, {"polygons", cut.polygons.size()},
                              {"segments", cut.segments.size()}, {"points", cut.points.size()},
                              {"unbounded", cut.unbounded},      {"svg", view::section_svg(cut, normal)}};
  result.sets.emplace("section", cut.set);
  if (!cut.set.is_empty()) add_piece("section", cut.set, rings_of(cut), context, result);
}

void answer_distance(const Json& request, const PanelContext& context, PanelResult& result) {
  const std::optional<Polyhedron> from = optional_set(request, "from", context);
  const std::optional<Polyhedron> to = optional_set(request, "to", context);
  if (!from || !to) return;
  const std::optional<Distance> found = distance(*from, *to, context.monitor);
  if (!found) throw FieldError(from->is_empty() ? "from" : "to", 0, "the empty set has no distance from others");
  result.report["distance"] = {{"contact", std::string(contact_name(found->contact))},
                               {"squared", to_string(found->squared)},
                               {"length", found->value()},
                               {"from", exact_json(found->on_a)},
                               {"to", exact_json(found->on_b)}};
  const bool apart = found->squared != 0;
  const Polyhedron between = apart ? make_segment(found->on_a, found->on_b) : make_point(found->on_a);
  std::vector<view::Polyline> lines;
  if (apart) lines.push_back({"distance", {nearest_doubles(found->on_a), nearest_doubles(found->on_b)}, kCut});
  add_piece("nearest points", between, std::move(lines), context, result);
}

std::vector<view::Layer> layers_by_shapes(const Polyhedron& set, const std::vector<Polyhedron>& shapes,
                                          const Monitor& monitor) {
  if (shapes.size() > kMostShapes) {
    throw UnsupportedError("colours: at most " + std::to_string(kMostShapes) + " shapes; this text has " +
                           std::to_string(shapes.size()));
  }
  const LabeledPolyhedron<InputSet> labeled = label_inputs(shapes, monitor);
  std::vector<Polyhedron> all{set};
  view::SceneOptions options;
  options.box = view::visible_box(all);
  std::vector<view::Layer> layers;
  for (const InputSet& inputs : labeled.labels()) {
    const auto is_this = [&inputs](const InputSet& label) { return label == inputs; };
    const Polyhedron part = intersect(labeled.where(is_this, monitor), set, monitor);
    if (part.is_empty()) continue;
    view::Layer& layer = layers.emplace_back();
    layer.name = name_of(inputs);
    layer.scene = view::build_scene(part, options, monitor);
  }
  return layers;
}

}  // namespace nef::studio
