// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/mesh_parts.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/geometry/ids.h"
#include "nef/mesh/mesh_piece.h"

namespace nef {
namespace {

std::string names_of(const MeshParts& parts) {
  constexpr std::size_t kMost = 20;
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const MeshPart& part : parts) {
    if (known.insert(part.name).second) names.push_back(part.name);
  }
  if (names.empty())
    return "it has no named parts (groups and objects of OBJ, nodes of GLB and objects of 3MF are parts)";
  std::string text = "its parts are ";
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i > 0 ? ", " : "") + in_quotes(names[i]);
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace

PartPath part_path(const std::string& path) {
  if (path.find('#') == std::string::npos || is_file(path)) return {path, ""};
  for (std::size_t at = path.find('#'); at != std::string::npos; at = path.find('#', at + 1)) {
    if (is_file(path.substr(0, at))) return {path.substr(0, at), path.substr(at + 1)};
  }
  return {path, ""};
}

Mesh faces_of_part(const Mesh& mesh, const MeshParts& parts, const PartPath& wanted) {
  std::set<std::uint32_t> faces;
  bool found = false;
  for (const MeshPart& part : parts) {
    if (part.name != wanted.part) continue;
    found = true;
    for (std::uint32_t f = part.first; f < part.last; ++f) faces.insert(faces.end(), f);
  }
  if (!found) {
    throw InputError(wanted.file + ": there is no part " + in_quotes(wanted.part) + "; " + names_of(parts));
  }
  MeshPiece piece(mesh.vertices);
  for (const std::uint32_t f : faces) piece.push(mesh.face(f));
  return piece.take();
}

FaceGroups groups_of_parts(const Mesh& mesh, const MeshParts& parts) {
  // The largest first, so that the smallest has the last word.
  std::vector<std::uint32_t> order(parts.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return parts[a].last - parts[a].first > parts[b].last - parts[b].first;
  });
  std::vector<std::uint32_t> part_of(mesh.face_count(), kNone);
  for (const std::uint32_t i : order) {
    std::fill(part_of.begin() + parts[i].first, part_of.begin() + parts[i].last, i);
  }
  FaceGroups result;
  result.of_face.reserve(mesh.face_count());
  std::map<std::string, std::uint32_t> number;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::string& name = part_of[f] == kNone ? std::string() : parts[part_of[f]].name;
    const auto [at, is_new] = number.emplace(name, static_cast<std::uint32_t>(result.names.size()));
    if (is_new) result.names.push_back(name);
    result.of_face.push_back(at->second);
  }
  return result;
}

std::vector<NamedMesh> split_into_parts(const Mesh& mesh, const MeshParts& parts) {
  const FaceGroups groups = groups_of_parts(mesh, parts);
  std::vector<MeshPiece> pieces(groups.names.size(), MeshPiece(mesh.vertices));
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) pieces[groups.of_face[f]].push(mesh.face(f));
  std::vector<NamedMesh> result;
  for (std::size_t i = 0; i < pieces.size(); ++i) result.push_back({groups.names[i], pieces[i].take()});
  return result;
}

}  // namespace nef
