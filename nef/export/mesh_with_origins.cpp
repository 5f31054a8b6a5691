// SPDX-License-Identifier: Apache-2.0
#include "nef/export/mesh_with_origins.h"

#include <utility>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef {

Membership membership(std::string_view operation) {
  if (operation == "union") return [](const InputSet& inputs, std::size_t) { return !inputs.empty(); };
  if (operation == "intersection") return [](const InputSet& inputs, std::size_t n) { return inputs.size() == n; };
  if (operation == "difference") return [](const InputSet& inputs, std::size_t) { return inputs == InputSet{0}; };
  if (operation == "symdiff") return [](const InputSet& inputs, std::size_t) { return inputs.size() % 2 == 1; };
  throw InputError("the operation is " + in_quotes(operation) + "; write union, intersection, difference or symdiff");
}

MeshWithOrigins mesh_with_origins(std::span<const Polyhedron> inputs, Membership belongs,
                                  const MeshExportOptions& options, const Monitor& monitor) {
  const LabeledPolyhedron<InputSet> labeled = label_inputs(inputs, monitor);
  MeshExportOptions how = options;
  how.face_marks = true;
  how.selected = [&](LabelId mark) {
    return mark < labeled.labels().size() && belongs(labeled.label(mark), inputs.size());
  };
  MeshExport made = to_mesh(labeled.polyhedron(), how, monitor);
  MeshWithOrigins result{.mesh = std::move(made.mesh), .origins = {}, .lost = std::move(made.lost)};
  result.origins.reserve(made.face_marks.size());
  for (const auto& [inside, outside, facet] : made.face_marks) {
    result.origins.push_back(origins(labeled.label(inside), labeled.label(outside)));
  }
  return result;
}

}  // namespace nef
