// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/shapes.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "nef/base/error.h"
#include "nef/command/expression.h"
#include "nef/io/mesh_reader.h"
#include "nef/io/polyhedron_file.h"

namespace nef::planner {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// As a solid if it bounds one, else as a surface.
Polyhedron from_any_mesh(const Mesh& mesh, const std::string& path, Messages* messages) {
  MeshOptions options;
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    if (messages != nullptr) {
      messages->push_back(path + ": taken as a surface, since it bounds no solid (" + error.what() + ")");
    }
  }
  options.as_surface = true;
  return from_mesh(mesh, options, messages);
}

Rational3 mean_of(const Mesh& mesh) {
  Rational3 sum;
  for (const Rational3& vertex : mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += vertex[i];
  }
  for (Rational& value : sum)
    value /= Rational(static_cast<unsigned long>(std::max<std::size_t>(mesh.vertices.size(), 1)));
  return sum;
}

}  // namespace

Polyhedron read_shape_file(const std::string& path, Messages* messages, Rational3* mean) {
  if (!std::filesystem::is_regular_file(path)) throw InputError(path + ": no such file");
  const std::string extension = extension_of(path);
  if (extension == "nef" || extension == "nef3") return read_polyhedron(path, {}, messages);
  if (!is_mesh_extension(extension)) {
    const Mesh mesh = read_with_assimp(path, mean);
    return from_any_mesh(mesh, path, messages);
  }
  const Mesh mesh = read_mesh(path);
  if (mean != nullptr) *mean = mean_of(mesh);
  return from_any_mesh(mesh, path, messages);
}

Polyhedron shape_of_text(const std::string& text, const std::string& folder, Messages* messages) {
  const std::filesystem::path path = std::filesystem::path(folder) / text;
  std::error_code ignored;
  if (text.find('\n') == std::string::npos && std::filesystem::is_regular_file(path, ignored)) {
    return read_shape_file(path.string(), messages);
  }
  ExpressionOptions options;
  options.load = [&](const std::string& file) {
    return read_shape_file((std::filesystem::path(folder) / file).string(), messages);
  };
  try {
    return evaluate_expression(text, options);
  } catch (const ExpressionError& error) {
    // What looks like a file name is more likely a missing file than a wrong expression.
    const bool file_like = text.find('(') == std::string::npos && path.has_extension();
    if (file_like) throw InputError(path.string() + ": no such file");
    throw InputError("expression '" + text + "': " + error.what());
  }
}

}  // namespace nef::planner
