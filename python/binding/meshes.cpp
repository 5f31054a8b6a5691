// SPDX-License-Identifier: Apache-2.0
#include "binding/meshes.h"

#include "nef/base/error.h"

namespace nef::python {
namespace {

std::uint32_t vertex_number(std::int64_t index, std::size_t face, std::size_t vertices) {
  if (index < 0 || static_cast<std::size_t>(index) >= vertices) {
    throw InputError("face " + std::to_string(face) + " names vertex " + std::to_string(index) + ", but there are " +
                     std::to_string(vertices));
  }
  return static_cast<std::uint32_t>(index);
}

std::int64_t index_of(py::handle number) {
  if (PyIndex_Check(number.ptr()) == 0) {
    throw py::type_error("faces must be lists of integers, not of " + std::string(py::repr(number)));
  }
  const long index = PyNumber_AsSsize_t(number.ptr(), PyExc_IndexError);
  if (index == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  return index;
}

void push_array(const py::array& faces, Mesh& mesh) {
  if (faces.ndim() != 2) throw InputError("faces must be an array of shape (M, K) or a list of lists of indices");
  const char kind = faces.dtype().kind();
  if (kind != 'i' && kind != 'u') throw py::type_error("faces must be integers");
  using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const Indices indices = Indices::ensure(faces);
  const auto count = static_cast<std::size_t>(indices.shape(0));
  const auto size = static_cast<std::size_t>(indices.shape(1));
  mesh.corners.resize(count * size);
  mesh.face_begin.resize(count + 1);
  const std::int64_t* in = indices.data();
  std::uint32_t* out = mesh.corners.data();
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t k = 0; k < size; ++k) *out++ = vertex_number(*in++, f, mesh.vertices.size());
    mesh.face_begin[f + 1] = static_cast<std::uint32_t>((f + 1) * size);
  }
}

py::array_t<std::int64_t> index_array(std::span<const std::uint32_t> indices, std::vector<py::ssize_t> shape) {
  py::array_t<std::int64_t> result(std::move(shape));
  std::copy(indices.begin(), indices.end(), result.mutable_data());
  return result;
}

// An array of rows that takes the vector over instead of copying it.
py::array array_of(std::vector<std::array<double, 3>>&& rows) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  auto held = std::make_unique<std::vector<std::array<double, 3>>>(std::move(rows));
  const double* data = held->empty() ? nullptr : held->front().data();
  const py::capsule owner(held.get(), [](void* vector) { delete static_cast<decltype(held)::pointer>(vector); });
  static_cast<void>(held.release());
  return py::array_t<double>({count, py::ssize_t{3}}, data, owner);
}

py::object faces_of(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> begin, bool triangles) {
  const std::size_t count = begin.size() - 1;
  if (triangles) return index_array(corners, {static_cast<py::ssize_t>(count), 3});
  py::list faces;
  for (std::size_t f = 0; f < count; ++f) {
    const auto face = corners.subspan(begin[f], begin[f + 1] - begin[f]);
    faces.append(index_array(face, {static_cast<py::ssize_t>(face.size())}));
  }
  return faces;
}

}  // namespace

Mesh mesh_from_arrays(py::handle vertices, py::handle faces) {
  Mesh mesh;
  mesh.vertices = to_points(vertices, "vertices");
  if (py::isinstance<py::array>(faces) && py::reinterpret_borrow<py::array>(faces).dtype().kind() != 'O') {
    push_array(py::reinterpret_borrow<py::array>(faces), mesh);
    return mesh;
  }
  for (const py::handle face : to_items(faces, "faces")) {
    for (const py::handle index : to_items(face, "each face")) {
      mesh.corners.push_back(vertex_number(index_of(index), mesh.face_count(), mesh.vertices.size()));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

RoundedMesh nearest(const Mesh& mesh) {
  RoundedMesh result;
  for (const Rational3& p : mesh.vertices) {
    result.vertices.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
  }
  result.face_begin = mesh.face_begin;
  result.corners = mesh.corners;
  return result;
}

py::tuple mesh_to_arrays(RoundedMesh&& mesh, bool triangles) {
  const py::object faces = faces_of(mesh.corners, mesh.face_begin, triangles);
  return py::make_tuple(array_of(std::move(mesh.vertices)), faces);
}

py::tuple mesh_to_arrays(const Mesh& mesh, bool triangles) {
  return py::make_tuple(from_points(mesh.vertices, true), faces_of(mesh.corners, mesh.face_begin, triangles));
}

}  // namespace nef::python
