// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/expression_field.h"

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/program/expression/expression.h"
#include "apps/program/expression/functions.h"
#include "nef/construct/crossings.h"
#include "nef/io/polyhedron_file.h"

namespace nef::studio {
namespace {

// How meshes that cross themselves are read.
Crossings crossings_of(const Json& request) {
  const auto member = request.find("crossings");
  if (member == request.end()) return Crossings::kUnion;
  const auto rule = member->is_string() ? crossings_of_name(member->get<std::string>()) : std::nullopt;
  if (!rule) throw FieldError("crossings", 0, "there is no such rule for faces that cross");
  return *rule;
}

// Those of OMPL: ours are in the list, too.
std::vector<std::string> planner_names() {
  std::vector<std::string> names = planner::ompl_planner_names();
  std::erase(names, "TightPlanner");
  return names;
}

}  // namespace

ExpressionCache::Result set_and_shapes_of_field(const Json& request, const std::string& field,
                                                const PanelContext& context, bool tiles, Messages& messages) {
  ExpressionOptions options;
  Messages told;
  const Crossings crossings = crossings_of(request);
  options.load = [&](const std::string& file, const Monitor& monitor) {
    Messages notes;
    const std::string path = context.root.mesh(file);
    Polyhedron set = context.files.load(path, crossings, monitor, notes);
    for (std::string& note : notes) {
      if (note.starts_with(path)) note = file + note.substr(path.size());  // as it was named
      told.push_back(note);
    }
    return set;
  };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
    return minkowski::minkowski_sum(a, b, {.monitor = monitor});
  };
  options.ball = minkowski::inner_ball;
  options.hull = minkowski::hull;
  options.monitor = context.monitor;
  options.warn = [&told](const std::string& warning) { told.push_back(warning); };
  const std::string text = text_of(request, field);
  if (is_blank_expression(text)) throw FieldError(field, 0, "write a set here, such as box(0,0,0, 1,1,1)");
  const auto state_of_file = [&context](const std::string& file) { return state_of_mesh(context.root.mesh(file)); };
  try {
    return context.expressions.evaluate(text, name(crossings), options, told, state_of_file, tiles, messages);
  } catch (const ExpressionError& error) {
    throw FieldError(field, error.offset(), error.what());
  }
}

std::string text_of(const Json& request, const std::string& member) {
  const auto found = request.find(member);
  if (found == request.end() || !found->is_string()) throw InputError("the request lacks the text '" + member + "'");
  return found->get<std::string>();
}

Polyhedron set_of_field(const Json& request, const std::string& field, const PanelContext& context,
                        Messages& messages) {
  return *set_and_shapes_of_field(request, field, context, false, messages).whole;
}

Json language_json() {
  Json functions = Json::array();
  for (const std::string& name : function_names()) {
    functions.push_back({{"name", name}, {"usage", std::string(find_function(name)->usage)}});
  }
  return {{"functions", std::move(functions)}, {"formats", file_extensions()}, {"planners", planner_names()}};
}

}  // namespace nef::studio
