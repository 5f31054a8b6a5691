// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/expression_field.h"

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/program/expression/expression.h"
#include "apps/program/expression/functions.h"
#include "nef/io/polyhedron_file.h"

namespace nef::studio {
namespace {

// Notes once each, however often their file is named.
void add_once(const Messages& some, Messages& messages) {
  for (const std::string& line : some) {
    if (std::find(messages.begin(), messages.end(), line) == messages.end()) messages.push_back(line);
  }
}

}  // namespace

std::string text_of(const Json& request, const std::string& member) {
  const auto found = request.find(member);
  if (found == request.end() || !found->is_string()) throw InputError("the request lacks the text '" + member + "'");
  return found->get<std::string>();
}

Polyhedron set_of_field(const Json& request, const std::string& field, const PanelContext& context,
                        Messages& messages) {
  ExpressionOptions options;
  options.load = [&](const std::string& file, const Monitor& monitor) {
    Messages notes;
    const std::string path = context.root.mesh(file);
    Polyhedron set = context.files.load(path, monitor, notes);
    for (std::string& note : notes) {
      if (note.starts_with(path)) note = file + note.substr(path.size());  // as it was named
    }
    add_once(notes, messages);
    return set;
  };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
    return minkowski::minkowski_sum(a, b, {.monitor = monitor});
  };
  options.ball = minkowski::inner_ball;
  options.hull = minkowski::hull;
  options.monitor = context.monitor;
  options.warn = [&messages](const std::string& warning) { add_once({warning}, messages); };
  const std::string text = text_of(request, field);
  if (is_blank_expression(text)) throw FieldError(field, 0, "write a set here, such as box(0,0,0, 1,1,1)");
  try {
    return evaluate_expression(text, options);
  } catch (const ExpressionError& error) {
    throw FieldError(field, error.offset(), error.what());
  }
}

Json language_json() {
  Json functions = Json::array();
  for (const std::string& name : function_names()) {
    functions.push_back({{"name", name}, {"usage", std::string(find_function(name)->usage)}});
  }
  return {{"functions", std::move(functions)}, {"formats", file_extensions()}};
}

}  // namespace nef::studio
