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
  const long index = PyNumber_AsSsize_t(number.ptr(), PyExc_IndexError);
  if (index == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  return index;
}

void push_array(const py::array& faces, Mesh& mesh) {
  if (faces.ndim() != 2) throw py::value_error("faces must be an array of shape (M, K) or a list of lists of indices");
  const char kind = faces.dtype().kind();
  if (kind != 'i' && kind != 'u') throw py::type_error("faces must be integers");
  using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const Indices indices = Indices::ensure(faces);
  const auto rows = indices.unchecked<2>();
  mesh.corners.reserve(static_cast<std::size_t>(indices.size()));
  mesh.face_begin.reserve(static_cast<std::size_t>(rows.shape(0)) + 1);
  for (py::ssize_t f = 0; f < rows.shape(0); ++f) {
    for (py::ssize_t k = 0; k < rows.shape(1); ++k) {
      mesh.corners.push_back(vertex_number(rows(f, k), static_cast<std::size_t>(f), mesh.vertices.size()));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
}

py::array_t<std::int64_t> index_array(std::span<const std::uint32_t> indices, std::vector<py::ssize_t> shape) {
  py::array_t<std::int64_t> result(std::move(shape));
  std::copy(indices.begin(), indices.end(), result.mutable_data());
  return result;
}

}  // namespace

Mesh mesh_from_arrays(py::handle vertices, py::handle faces) {
  Mesh mesh;
  mesh.vertices = to_points(vertices, "vertices");
  if (py::isinstance<py::array>(faces) && py::reinterpret_borrow<py::array>(faces).dtype().kind() != 'O') {
    push_array(py::reinterpret_borrow<py::array>(faces), mesh);
    return mesh;
  }
  for (const py::handle face : py::reinterpret_borrow<py::object>(faces)) {
    for (const py::handle index : py::reinterpret_borrow<py::object>(face)) {
      mesh.corners.push_back(vertex_number(index_of(index), mesh.face_count(), mesh.vertices.size()));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

py::tuple mesh_to_arrays(const Mesh& mesh, bool triangles, bool exact) {
  const py::array vertices = from_points(mesh.vertices, exact);
  if (triangles) {
    return py::make_tuple(vertices, index_array(mesh.corners, {static_cast<py::ssize_t>(mesh.face_count()), 3}));
  }
  py::list faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    faces.append(index_array(mesh.face(f), {static_cast<py::ssize_t>(mesh.face(f).size())}));
  }
  return py::make_tuple(vertices, faces);
}

}  // namespace nef::python
