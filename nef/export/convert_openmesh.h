// SPDX-License-Identifier: Apache-2.0
//
// Meshes from and to OpenMesh's polygon meshes (and triangle meshes). A header of templates: the library itself does
// not need OpenMesh.
#pragma once

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/export/nearest_float.h"

namespace nef {

/// The mesh that an OpenMesh mesh is; its coordinates become the rationals that they are. Deleted elements are left
/// out; vertices keep their order. Throws InputError for a coordinate that is not finite. O(n).
template <typename OpenMeshType>
Mesh mesh_from_openmesh(const OpenMeshType& source) {
  Mesh mesh;
  std::vector<std::uint32_t> number(source.n_vertices());
  for (auto v = source.vertices_sbegin(); v != source.vertices_end(); ++v) {
    number[static_cast<std::size_t>(v->idx())] = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto& point = source.point(*v);
    Rational3& target = mesh.vertices.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<double>(point[axis]);
      if (!std::isfinite(value)) {
        throw InputError("a coordinate of vertex " + std::to_string(v->idx()) + " is not a finite number");
      }
      target[static_cast<std::size_t>(axis)] = value;
    }
  }
  for (auto f = source.faces_sbegin(); f != source.faces_end(); ++f) {
    for (auto v = source.cfv_iter(*f); v.is_valid(); ++v) {
      mesh.corners.push_back(number[static_cast<std::size_t>(v->idx())]);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

namespace detail {

/// True if OpenMesh can take the face: its edges are free on this side and its vertices still have a gap.
template <typename OpenMeshType>
bool openmesh_takes(const OpenMeshType& mesh, const std::vector<typename OpenMeshType::VertexHandle>& face) {
  for (std::size_t i = 0; i < face.size(); ++i) {
    if (!mesh.is_boundary(face[i])) return false;
    const auto halfedge = mesh.find_halfedge(face[i], face[(i + 1) % face.size()]);
    if (halfedge.is_valid() && !mesh.is_boundary(halfedge)) return false;
  }
  return true;
}

}  // namespace detail

/// An OpenMesh mesh with the nearest coordinates of its scalar type. OpenMesh holds two-manifolds only: a face that
/// would break that gets vertices of its own (where solids touch in an edge, say), with a line in `messages`. O(n).
template <typename OpenMeshType>
OpenMeshType mesh_to_openmesh(const Mesh& mesh, Messages* messages = nullptr) {
  using Point = typename OpenMeshType::Point;
  using Scalar = typename OpenMeshType::Scalar;
  OpenMeshType target;
  const auto add_vertex = [&](std::uint32_t v) {
    Point point;
    for (int axis = 0; axis < 3; ++axis) {
      const Rational& x = mesh.vertices[v][static_cast<std::size_t>(axis)];
      if constexpr (std::is_same_v<Scalar, float>) {
        point[axis] = nearest_float(x);
      } else {
        point[axis] = static_cast<Scalar>(nearest_double(x));
      }
    }
    return target.add_vertex(point);
  };
  std::vector<typename OpenMeshType::VertexHandle> handles;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) handles.push_back(add_vertex(v));
  std::size_t separate = 0;
  std::vector<typename OpenMeshType::VertexHandle> face;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    face.clear();
    for (const std::uint32_t v : mesh.face(f)) face.push_back(handles[v]);
    if (detail::openmesh_takes(target, face) && target.add_face(face).is_valid()) continue;
    face.clear();
    for (const std::uint32_t v : mesh.face(f)) face.push_back(add_vertex(v));
    target.add_face(face);
    ++separate;
  }
  if (separate > 0 && messages != nullptr) {
    messages->push_back(std::to_string(separate) +
                        " faces got their own vertices, because OpenMesh stores two-manifolds only");
  }
  return target;
}

}  // namespace nef
