// SPDX-License-Identifier: Apache-2.0
#include "nef/export/convert_openmesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <catch2/catch.hpp>

#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

struct DoubleTraits : public OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;

TEST_CASE("OpenMesh: a polygon mesh goes there and back") {
  const Polyhedron p = subtract(make_box({0, 0, 0}, {4, 4, 4}), interior(make_box({1, 1, -1}, {2, 2, 5})));
  MeshExportOptions options;
  options.keep_polygons = true;
  const Mesh mesh = to_mesh(closure(p), options).mesh;
  const auto there = mesh_to_openmesh<PolyMesh>(mesh);
  CHECK(there.n_vertices() == 16);
  CHECK(there.n_faces() == mesh.face_count());
  for (const auto edge : there.edges()) CHECK_FALSE(there.is_boundary(edge));
  CHECK(equal(from_mesh(mesh_from_openmesh(there)), closure(p)));
}

TEST_CASE("OpenMesh: deleted elements are left out") {
  auto mesh = mesh_to_openmesh<PolyMesh>(to_mesh(make_box({0, 0, 0}, {1, 1, 1})).mesh);
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_vertex_status();
  const auto lonely = mesh.add_vertex({5, 5, 5});
  mesh.delete_vertex(lonely);
  const Mesh back = mesh_from_openmesh(mesh);
  CHECK(back.vertices.size() == 8);
  CHECK(back.face_count() == 12);
  mesh.delete_face(PolyMesh::FaceHandle(0), false);
  CHECK(mesh_from_openmesh(mesh).face_count() == 11);
}

TEST_CASE("OpenMesh: solids that touch in an edge keep their geometry") {
  const Polyhedron touching = unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 0}, {2, 2, 1}));
  Messages messages;
  const auto mesh = mesh_to_openmesh<FloatMesh>(to_mesh(touching).mesh, &messages);
  CHECK(mesh.n_faces() == 24);
  CHECK(messages.size() == 1);
  CHECK(equal(from_mesh(mesh_from_openmesh(mesh)), touching));
}

TEST_CASE("OpenMesh: a coordinate that is not finite is refused") {
  PolyMesh mesh;
  mesh.add_vertex({0, std::nan(""), 0});
  CHECK_THROWS_AS(mesh_from_openmesh(mesh), InputError);
}

}  // namespace
}  // namespace nef
