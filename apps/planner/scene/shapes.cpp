// SPDX-License-Identifier: Apache-2.0
//
// A mesh is read by the rule for crossings first. If that makes nothing of it, or would leave out what is inside out,
// it becomes what it means (meaning_of). A string of a scene is a file if there is one of that name, else an
// expression.
#include "apps/planner/scene/shapes.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/planner/scene/nearly_closed.h"
#include "apps/program/expression/expression.h"
#include "apps/program/reports/exact_json.h"
#include "apps/program/reports/json_reader.h"
#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/import/resolve_mesh.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef::planner {
namespace {

// By the rule for crossings; nothing if that would leave out what is inside out.
std::optional<Polyhedron> by_rule(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  Messages notes;
  Polyhedron solid;
  if (options.crossings == Crossings::kUnion && options.close_percent <= 0) {
    ResolvedMesh resolved = resolve_mesh(mesh, options, &notes, Measure::kNot);
    if (resolved.lowest < 0) return std::nullopt;
    if (std::string decided = note_about(resolved, options.crossings); !decided.empty()) {
      notes.push_back(std::move(decided));
    }
    solid = std::move(resolved.set);
  } else {
    solid = from_mesh(mesh, options, &notes);
  }
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return solid;
}

// What was made of a mesh that bounds no solid, as a message.
std::string meaning_text(const MeshMeaning& meaning) {
  std::string text;
  if (meaning.duplicate_faces > 0) {
    text += counted(meaning.duplicate_faces, "face occurs", "faces occur") + " twice or has no area, ";
  }
  text += meaning.solid_parts == 0
              ? "taken as a surface"
              : "taken as " + counted(meaning.solid_parts, "solid part", "solid parts") + " by counting its faces";
  if (meaning.solid_parts > 0 && meaning.surface_parts > 0) {
    text += "; " + counted(meaning.surface_parts, "part has", "parts have") + " faces that bound nothing: surfaces";
  }
  return text;
}

// As the solid that it bounds, else as what it means.
Polyhedron from_any_mesh(const Mesh& mesh, const std::string& path, const MeshOptions& options, Messages* messages) {
  if (mesh.face_count() == 0) throw InputError(path + ": the mesh has no faces");
  std::string complaint = "parts of it are inside out";
  try {
    if (std::optional<Polyhedron> solid = by_rule(mesh, options, messages)) return *std::move(solid);
  } catch (const InputError& error) {
    if (options.crossings == Crossings::kRefuse) throw InputError(path + ": " + error.what());
    complaint = error.what();
  }
  MeshMeaning meaning = meaning_of(mesh, options.monitor);
  if (messages != nullptr) {
    messages->push_back(path + ": the mesh bounds no solid as it is (" + complaint + "), " + meaning_text(meaning));
  }
  return std::move(meaning.set);
}

Rational3 mean_of(const std::vector<Rational3>& vertices) {
  Rational3 sum;
  for (const Rational3& vertex : vertices) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += vertex[i];
  }
  for (Rational& value : sum) value /= Rational(static_cast<unsigned long>(std::max<std::size_t>(vertices.size(), 1)));
  return sum;
}

std::vector<Rational3> vertices_of(const Polyhedron& set) {
  std::vector<Rational3> result;
  const Complex& complex = set.complex();
  for (const VertexId v : complex.vertex_ids()) result.push_back(complex.points.rational(point_of(v)));
  return result;
}

}  // namespace

Polyhedron read_shape_file(const std::string& path, const MeshOptions& options, Messages* messages, Rational3* mean) {
  const PartPath at = part_path(path);
  if (names_tile_folder(path)) {
    Polyhedron set = read_file_or_tiles(path, options, messages);
    if (mean != nullptr) *mean = mean_of(vertices_of(set));
    return set;
  }
  std::error_code unknown;
  if (std::filesystem::is_directory(at.file, unknown)) throw InputError(path + ": is a folder, not a file");
  if (!std::filesystem::is_regular_file(at.file, unknown)) throw InputError(path + ": no such file");
  const std::string extension = lower_extension(at.file);
  if (is_set_extension(extension)) {
    Polyhedron set = read_polyhedron(path, options, messages);
    if (mean != nullptr) *mean = mean_of(vertices_of(set));
    return set;
  }
  if (find_mesh_format(extension) == nullptr) {
    const Mesh mesh = read_with_assimp(path, mean);
    return from_any_mesh(mesh, path, options, messages);
  }
  const Mesh mesh = read_mesh(path);
  if (mean != nullptr) *mean = mean_of(mesh.vertices);
  return from_any_mesh(mesh, path, options, messages);
}

Polyhedron shape_of_text(const std::string& text, const std::string& folder, const MeshOptions& meshes,
                         Messages* messages) {
  const std::filesystem::path path = std::filesystem::path(folder) / text;
  std::error_code ignored;
  if (!text.empty() && std::filesystem::exists(part_path(path.string()).file, ignored)) {
    return read_shape_file(path.string(), meshes, messages);
  }
  ExpressionOptions options;
  options.load = [&](const std::string& file, const Monitor& own) {
    MeshOptions watched = meshes;
    watched.monitor = own;
    return read_shape_file((std::filesystem::path(folder) / file).string(), watched, messages);
  };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& own) {
    minkowski::MinkowskiOptions sum;
    sum.monitor = own;
    return minkowski::minkowski_sum(a, b, sum);
  };
  options.ball = minkowski::inner_ball;
  options.hull = minkowski::hull;
  options.monitor = meshes.monitor;
  try {
    return evaluate_expression(text, options);
  } catch (const ExpressionError& error) {
    // What looks like a file name is more likely a missing file than a wrong expression.
    if (text.find('(') == std::string::npos) {
      if (path.has_extension()) throw InputError(path.string() + ": no such file");
      throw InputError("'" + text + "' is neither a file nor an expression (" + error.what() + ")");
    }
    throw InputError("expression '" + text + "': " + error.what());
  }
}

Polyhedron shape_of(const JsonReader& value, const std::string& folder, const MeshOptions& options,
                    Messages& messages) {
  if (!value.value().is_string()) {
    value.fail("expected a file name or an expression in quotes, not " + in_quotes(spelled(value.value())));
  }
  try {
    return closure(shape_of_text(value.value().get<std::string>(), folder, options, &messages), options.monitor);
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

void require_kind(const JsonReader& root, const char* key) {
  constexpr std::pair<const char*, const char*> kKinds[] = {
      {"robot", "this is a scene of a robot among obstacles, for planner FILE without another option"},
      {"parts", "this is an assembly, for planner --assembly FILE or --verdict FILE"},
      {"moving", "this is a mechanism, for planner --range FILE or --verdict FILE"},
  };
  if (root.has(key)) return;
  for (const auto& [other, text] : kKinds) {
    if (root.has(other)) root.fail(text);
  }
}

Polyhedron solid_of(const JsonReader& value, const std::string& folder, const MeshOptions& options,
                    Messages& messages) {
  Polyhedron set = shape_of(value, folder, options, messages);
  if (set.is_empty() || !set.is_bounded() || !set.is_regular()) {
    value.fail("must be a bounded solid without surfaces, curves or points sticking out");
  }
  return set;
}

Rational3 direction_of(const JsonReader& value) {
  Rational3 direction;
  if (value.value().is_array()) {
    direction = value.point();
  } else {
    constexpr std::array kAxes{"x", "y", "z"};
    const auto axis = std::find(kAxes.begin(), kAxes.end(), value.value());
    if (axis == kAxes.end()) value.fail(R"(must be "x", "y", "z" or a direction such as [1, 2, 2])");
    direction[static_cast<std::size_t>(axis - kAxes.begin())] = 1;
  }
  if (direction == Rational3{}) value.fail("must not be the zero vector");
  return direction;
}

std::array<Rational, 2> range_of(const JsonReader& value, const std::optional<int>& most) {
  std::array<Rational, 2> range = value.exactly<2>(&JsonReader::number_of);
  if (range[0] >= range[1] || (most && range[1] - range[0] > *most)) {
    value.fail("must increase" + (most ? ", by at most " + std::to_string(*most) + " degrees" : ""));
  }
  return range;
}

}  // namespace nef::planner
