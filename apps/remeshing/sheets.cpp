// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/sheets.h"

#include <unordered_map>

#include "nef/base/union_find.h"
#include "nef/mesh/edge_order.h"

namespace nef {

Sheets sheets_of(const Mesh& mesh) {
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> sides;  // by direction: the corners where they begin
  const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  const auto corners = static_cast<std::uint32_t>(mesh.corners.size());
  for (std::uint32_t c = 0; c < corners; ++c) {
    sides[pair_key(mesh.corners[c], mesh.corners[next(c)])].push_back(c);
  }
  UnionFind sheets(corners);
  for (std::uint32_t c = 0; c < corners; ++c) {
    const auto back = sides.find(pair_key(mesh.corners[next(c)], mesh.corners[c]));
    if (back == sides.end() || back->second.size() != 1) continue;
    if (sides.at(pair_key(mesh.corners[c], mesh.corners[next(c)])).size() != 1) continue;
    sheets.unite(c, next(back->second[0]));
    sheets.unite(next(c), back->second[0]);
  }
  Sheets result;
  std::vector<std::uint32_t> number(corners, static_cast<std::uint32_t>(-1));
  for (std::uint32_t c = 0; c < corners; ++c) {
    std::uint32_t& vertex = number[sheets.find(c)];
    if (vertex == static_cast<std::uint32_t>(-1)) {
      vertex = static_cast<std::uint32_t>(result.original.size());
      result.original.push_back(mesh.corners[c]);
      result.mesh.vertices.push_back(mesh.vertices[mesh.corners[c]]);
    }
    result.mesh.corners.push_back(vertex);
    if (c % 3 == 2) result.mesh.face_begin.push_back(c + 1);
  }
  return result;
}

}  // namespace nef
