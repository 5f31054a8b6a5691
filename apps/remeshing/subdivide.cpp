// SPDX-License-Identifier: Apache-2.0
#include "apps/remeshing/subdivide.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "apps/remeshing/sheets.h"
#include "apps/remeshing/triangle_mesh.h"
#include "nef/base/error.h"
#include "nef/export/convert_openmesh.h"
#include "nef/mesh/edge_order.h"

namespace nef {
namespace {

Mesh halved_edges(const Mesh& mesh) {
  Mesh result;
  result.vertices = mesh.vertices;
  result.vertices.reserve(mesh.vertices.size() + mesh.corners.size() / 2);
  result.corners.reserve(4 * mesh.corners.size());
  result.face_begin.reserve(4 * mesh.face_count() + 1);
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  middles.reserve(mesh.corners.size());
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [found, added] = middles.try_emplace(pair_key(a, b), static_cast<std::uint32_t>(result.vertices.size()));
    if (added) {
      Rational3 point;
      for (std::size_t i = 0; i < 3; ++i) point[i] = (mesh.vertices[a][i] + mesh.vertices[b][i]) / 2;
      result.vertices.push_back(std::move(point));
    }
    return found->second;
  };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::span<const std::uint32_t> v = mesh.face(f);
    const std::array<std::uint32_t, 3> m{middle(v[0], v[1]), middle(v[1], v[2]), middle(v[2], v[0])};
    result.push_face(std::array{v[0], m[0], m[2]});
    result.push_face(std::array{v[1], m[1], m[0]});
    result.push_face(std::array{v[2], m[2], m[1]});
    result.push_face(m);
  }
  return result;
}

Mesh smoothed(const Mesh& mesh, unsigned times) {
  std::vector<std::uint32_t> sources = sheets_of(mesh).original;
  std::sort(sources.begin(), sources.end());
  if (std::adjacent_find(sources.begin(), sources.end()) != sources.end()) {
    throw InputError(
        "Loop's scheme is for surfaces of one sheet; here several of them meet in an edge or a vertex. The midpoint "
        "scheme "
        "takes any mesh");
  }
  auto work = mesh_to_openmesh<TriangleMesh>(mesh);
  OpenMesh::Subdivider::Uniform::LoopT<TriangleMesh, double> loop;
  // It has a table of weights by valence and does not look at its end.
  std::size_t valence = 0;
  for (const auto v : work.vertices()) valence = std::max<std::size_t>(valence, work.valence(v));
  loop.init_weights(valence + 1);
  loop.attach(work);
  loop(times);
  loop.detach();
  return mesh_from_openmesh(work);
}

}  // namespace

Mesh subdivide(const Mesh& triangles, SubdivisionScheme scheme, unsigned times) {
  for (std::size_t f = 0; f < triangles.face_count(); ++f) {
    if (triangles.face(f).size() != 3) {
      throw InputError("face " + std::to_string(f) + " has " + std::to_string(triangles.face(f).size()) +
                       " corners: only triangles can be subdivided");
    }
  }
  if (times == 0) return triangles;
  if (scheme == SubdivisionScheme::kLoop) return smoothed(triangles, times);
  Mesh result = halved_edges(triangles);
  for (unsigned i = 1; i < times; ++i) result = halved_edges(result);
  return result;
}

}  // namespace nef
