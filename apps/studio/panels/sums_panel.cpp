// SPDX-License-Identifier: Apache-2.0
//
// Each kind of question is one call of minkowski/morphology.h. An offset by a round ball has two answers, one inside
// and one around the round one; both are shown.
#include <algorithm>

#include "apps/minkowski/morphology.h"
#include "apps/program/numbers.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/set_info.h"
#include "apps/studio/panels/expression_field.h"
#include "apps/studio/panels/panel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/number_text.h"

namespace nef::studio {
namespace {

constexpr view::Color kA{86, 143, 196};
constexpr view::Color kB{230, 120, 20};
constexpr view::Color kSum{106, 168, 96};
constexpr view::Color kArrow{200, 30, 110};
constexpr view::Color kPositions{120, 190, 230};

struct NamedSet {
  std::string name;
  Polyhedron set;
  view::Color color;
  double opacity = 1;
  bool visible = true;  // at first
};

std::vector<view::Layer> layers_of_sets(const std::vector<NamedSet>& sets, const Monitor& monitor) {
  std::vector<Polyhedron> all;
  for (const NamedSet& named : sets) all.push_back(named.set);
  view::SceneOptions options;
  options.box = view::visible_box(all);
  std::vector<view::Layer> layers;
  for (const NamedSet& named : sets) {
    if (named.set.is_empty()) continue;
    view::Layer& layer = layers.emplace_back();
    layer.name = named.name;
    layer.scene = view::build_scene(named.set, options, monitor);
    layer.color = named.color;
    layer.opacity = named.opacity;
    layer.visible = named.visible;
  }
  return layers;
}

int splits_of(const Json& request) {
  const auto found = request.find("splits");
  const int splits = found != request.end() && found->is_number_integer() ? found->get<int>() : 4;
  if (splits < 1 || splits > 64) throw FieldError("splits", 0, "the ball's edges are split into 1 to 64 parts");
  return splits;
}

Rational radius_of(const Json& request) {
  const std::optional<Rational> radius = try_parse_rational(text_of(request, "radius"));
  if (!radius) throw FieldError("radius", 0, "'" + text_of(request, "radius") + "' is not a number such as 0.1 or 1/3");
  return *radius;
}

// The two answers of an offset.
void offset_both(const Polyhedron& a, const Json& request, const Monitor& monitor, PanelResult& result) {
  const Rational radius = radius_of(request);
  const int splits = splits_of(request);
  const Stopwatch watch;
  const Polyhedron inner = minkowski::offset(a, radius, splits, minkowski::Side::kInner, {.monitor = monitor});
  const Polyhedron outer = minkowski::offset(a, radius, splits, minkowski::Side::kOuter, {.monitor = monitor});
  result.report["op_s"] = watch.seconds();
  if (radius != 0) {
    const Rational error = minkowski::ball_approximation(abs(radius), splits, minkowski::Side::kOuter, monitor).error;
    result.report["error"] = nearest_double(error);
  }
  result.report["result"] = set_info(inner, {}, monitor);
  result.report["outer"] = set_info(outer, {}, monitor);
  result.layers = layers_of_sets(
      {{"A", a, kA, radius > 0 ? 1.0 : 0.3}, {"inner", inner, kSum, radius > 0 ? 0.45 : 1}, {"outer", outer, kB, 0.2}},
      monitor);
  result.sets = {{"result", inner}, {"outer", outer}};
}

// Where the arrow begins: the middle of B's box.
view::Point middle_of(const Polyhedron& set) {
  const auto box = view::visible_box(std::span(&set, 1));
  view::Point middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = nearest_double(Rational((box[0][i] + box[1][i]) / 2));
  return middle;
}

void penetrate(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor, PanelResult& result) {
  const Stopwatch watch;
  const minkowski::Penetration found = minkowski::penetration(a, b, {.monitor = monitor});
  result.report["op_s"] = watch.seconds();
  result.report["kind"] = std::string(contact_name(found.kind));
  result.report["translation"] = exact_json(found.translation);
  result.report["squared_length"] = to_string(found.squared_length);
  const Polyhedron moved = transform(b, AffineMap::translate(found.translation), monitor);
  result.layers = layers_of_sets({{"A", a, kA, 0.6}, {"B", b, kB, 0.6}, {"B in contact", moved, kSum, 0.3}}, monitor);
  const view::Point begin = middle_of(b);
  const view::Point way = nearest_doubles(found.translation);
  result.layers.back().lines.push_back(
      {"translation", {begin, {begin[0] + way[0], begin[1] + way[1], begin[2] + way[2]}}, kArrow});
  result.sets = {{"result", moved}};
}

// Where the tool's path to the part begins; nothing if that is outside of everything.
std::optional<Rational3> from_of(const Json& request) {
  const std::string text = request.contains("from") ? text_of(request, "from") : "";
  if (text.find_first_not_of(' ') == std::string::npos) return std::nullopt;
  try {
    return parse_triple(text, "x,y,z");
  } catch (const InputError&) {
    throw FieldError("from", 0,
                     "'" + text + "' is not a point such as 5,0,1/2; leave the field empty to begin outside");
  }
}

// What B as a tool reaches of the part A.
void reach(const Polyhedron& part, const Polyhedron& tool, const Json& request, const Monitor& monitor,
           PanelResult& result) {
  const Stopwatch watch;
  const minkowski::Reach found = minkowski::reach(tool, part, from_of(request), {.monitor = monitor});
  result.report["op_s"] = watch.seconds();
  for (const auto& [name, set] : {std::pair{"touched", &found.touched}, std::pair{"untouched", &found.untouched}}) {
    result.report[name] = set->is_empty() ? Json() : Json(set_info(*set, {}, monitor));
  }
  result.layers = layers_of_sets({{"touched", found.touched, kSum},
                                  {"untouched", found.untouched, kB},
                                  {"tool", tool, kA, 0.6},
                                  {"positions of the tool", found.positions, kPositions, 0.3, false}},
                                 monitor);
  result.sets = {{"positions", found.positions}, {"touched", found.touched}, {"untouched", found.untouched}};
}

Polyhedron sum_of(const std::string& kind, const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  const minkowski::MinkowskiOptions options{.monitor = monitor};
  if (kind == "sum") return minkowski::minkowski_sum(a, b, options);
  if (kind == "erosion") return minkowski::erode(a, b, options);
  if (kind == "opening") return minkowski::opening(a, b, options);
  if (kind == "closing") return minkowski::closing(a, b, options);
  throw InputError("'" + kind + "' is none of sum, erosion, opening, closing, offset, penetration, reach");
}

}  // namespace

PanelResult sums_panel(const Json& request, const PanelContext& context) {
  const std::string kind = text_of(request, "kind");
  Messages notes;
  PanelResult result;
  const Polyhedron a = set_of_field(request, "a", context, notes);
  if (kind == "offset") {
    offset_both(a, request, context.monitor, result);
  } else {
    const Polyhedron b = set_of_field(request, "b", context, notes);
    if (kind == "penetration") {
      penetrate(a, b, context.monitor, result);
    } else if (kind == "reach") {
      reach(a, b, request, context.monitor, result);
    } else {
      const Stopwatch watch;
      const Polyhedron sum = sum_of(kind, a, b, context.monitor);
      result.report["op_s"] = watch.seconds();
      result.report["result"] = set_info(sum, {}, context.monitor);
      const bool grows = kind == "sum" || kind == "closing";
      result.layers = layers_of_sets(
          {{"result", sum, kSum, grows ? 0.5 : 1}, {"A", a, kA, grows ? 1 : 0.25}, {"B", b, kB}}, context.monitor);
      result.sets = {{"result", sum}};
    }
  }
  result.report["notes"] = notes;
  return result;
}

}  // namespace nef::studio
