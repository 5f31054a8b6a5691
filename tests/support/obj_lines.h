// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "nef/mesh/mesh.h"

namespace nef::test {

/// A mesh as lines of an OBJ file whose vertices count from `first`: 1 for the first mesh of a file.
inline std::string obj_lines(const Mesh& mesh, std::size_t first) {
  std::string text;
  for (const Rational3& v : mesh.vertices) {
    text += "v " + to_string(v[0]) + " " + to_string(v[1]) + " " + to_string(v[2]) + "\n";
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    text += "f";
    for (const std::uint32_t v : mesh.face(f)) text += " " + std::to_string(v + first);
    text += "\n";
  }
  return text;
}

}  // namespace nef::test
