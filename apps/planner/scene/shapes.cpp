// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/scene/shapes.h"

#include <algorithm>
#include <filesystem>
#include <variant>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/planner/scene/nearly_closed.h"
#include "nef/base/error.h"
#include "nef/import/try_from_mesh.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/program/expression/expression.h"

namespace nef::planner {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// As the solid that it bounds, else as what it means.
Polyhedron from_any_mesh(const Mesh& mesh, const std::string& path, Messages* messages, const Monitor& monitor) {
  if (mesh.face_count() == 0) throw InputError(path + ": the mesh has no faces");
  std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh, {.monitor = monitor}, messages);
  if (auto* solid = std::get_if<Polyhedron>(&made)) return std::move(*solid);
  const std::string& complaint = std::get<MeshRefusal>(made).text;
  MeshMeaning meaning = meaning_of(mesh, monitor);
  if (messages != nullptr) {
    std::string text = path + ": the mesh bounds no solid as it is (" + complaint + "), ";
    if (meaning.duplicate_faces > 0) {
      text += counted(meaning.duplicate_faces, "face occurs", "faces occur") + " twice or has no area, ";
    }
    text += meaning.solid_parts == 0
                ? "taken as a surface"
                : "taken as " + counted(meaning.solid_parts, "solid part", "solid parts") + " by counting its faces";
    if (meaning.solid_parts > 0 && meaning.surface_parts > 0) {
      text += "; " + counted(meaning.surface_parts, "part has", "parts have") + " faces that bound nothing: surfaces";
    }
    messages->push_back(text);
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

Polyhedron read_shape_file(const std::string& path, Messages* messages, Rational3* mean, const Monitor& monitor) {
  if (std::filesystem::is_directory(path)) throw InputError(path + ": is a folder, not a file");
  if (!std::filesystem::is_regular_file(path)) throw InputError(path + ": no such file");
  const std::string extension = lower_extension(path);
  if (extension == "nef" || extension == "nef3") {
    Polyhedron set = read_polyhedron(path, {.monitor = monitor}, messages);
    if (mean != nullptr) *mean = mean_of(vertices_of(set));
    return set;
  }
  if (!is_mesh_extension(extension)) {
    const Mesh mesh = read_with_assimp(path, mean);
    return from_any_mesh(mesh, path, messages, monitor);
  }
  const Mesh mesh = read_mesh(path);
  if (mean != nullptr) *mean = mean_of(mesh.vertices);
  return from_any_mesh(mesh, path, messages, monitor);
}

Polyhedron shape_of_text(const std::string& text, const std::string& folder, Messages* messages,
                         const Monitor& monitor) {
  const std::filesystem::path path = std::filesystem::path(folder) / text;
  std::error_code ignored;
  if (!text.empty() && std::filesystem::exists(path, ignored)) {
    return read_shape_file(path.string(), messages, nullptr, monitor);
  }
  ExpressionOptions options;
  options.load = [&](const std::string& file, const Monitor& own) {
    return read_shape_file((std::filesystem::path(folder) / file).string(), messages, nullptr, own);
  };
  options.minkowski = [](const Polyhedron& a, const Polyhedron& b, const Monitor& own) {
    minkowski::MinkowskiOptions sum;
    sum.monitor = own;
    return minkowski::minkowski_sum(a, b, sum);
  };
  options.ball = minkowski::inner_ball;
  options.hull = minkowski::hull;
  options.monitor = monitor;
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

}  // namespace nef::planner
