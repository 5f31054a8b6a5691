// SPDX-License-Identifier: Apache-2.0
//
// Meshes from and to Eigen matrices (vertices n x 3, faces m x 3), and affine maps from and to Eigen transforms. A
// header of templates: the library itself does not need Eigen.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/polyhedron.h"

namespace nef {

/// A triangle mesh from a matrix of vertices (n x 3, any real scalar) and one of faces (m x 3, any integer scalar,
/// counted from 0). Doubles become the rationals that they are. Throws InputError for matrices of another shape, a
/// coordinate that is not finite, or an index out of range. O(n + m).
template <typename Vertices, typename Faces>
Mesh mesh_from_eigen(const Eigen::MatrixBase<Vertices>& vertices, const Eigen::MatrixBase<Faces>& faces) {
  if (vertices.cols() != 3 || faces.cols() != 3) {
    throw InputError("vertices and faces must be matrices with three columns, not " + std::to_string(vertices.cols()) +
                     " and " + std::to_string(faces.cols()));
  }
  Mesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<double>(vertices(v, axis));
      if (!std::isfinite(value)) {
        throw InputError("a coordinate of vertex " + std::to_string(v) + " is not a finite number");
      }
      mesh.vertices[static_cast<std::size_t>(v)][static_cast<std::size_t>(axis)] = value;
    }
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto index = static_cast<long long>(faces(f, i));
      if (index < 0 || index >= vertices.rows()) {
        throw InputError("face " + std::to_string(f) + " names vertex " + std::to_string(index) + ", but there are " +
                         std::to_string(vertices.rows()));
      }
      mesh.corners.push_back(static_cast<std::uint32_t>(index));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

/// The vertices of a mesh as an n x 3 matrix of the nearest doubles.
inline Eigen::MatrixXd vertices_to_eigen(const Mesh& mesh) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(mesh.vertices.size()), 3);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(axis)) = nearest_double(mesh.vertices[v][axis]);
    }
  }
  return result;
}

/// The faces of a triangle mesh as an m x 3 matrix. Throws InputError if a face is no triangle (to_mesh makes
/// triangles).
inline Eigen::MatrixXi faces_to_eigen(const Mesh& mesh) {
  Eigen::MatrixXi result(static_cast<Eigen::Index>(mesh.face_count()), 3);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() != 3) {
      throw InputError("face " + std::to_string(f) + " has " + std::to_string(face.size()) +
                       " corners; only triangles fit into a matrix with three columns");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      result(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(i)) = static_cast<int>(face[i]);
    }
  }
  return result;
}

/// The exact affine map that an Eigen transform is (its doubles taken as rationals; the last row of a projective matrix
/// must be 0 0 0 1). Throws InputError for a NaN, an infinity, or another last row.
template <typename Scalar, int Mode, int Options>
AffineMap affine_from_eigen(const Eigen::Transform<Scalar, 3, Mode, Options>& transform) {
  AffineMap map;
  if constexpr (Mode == Eigen::Projective) {
    if (transform(3, 0) != 0 || transform(3, 1) != 0 || transform(3, 2) != 0 || transform(3, 3) != 1) {
      throw InputError("a projective transform is not affine unless its last row is 0 0 0 1");
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      map.linear[i][j] = exact_rational(static_cast<double>(transform(row, static_cast<Eigen::Index>(j))));
    }
    map.translation[i] = exact_rational(static_cast<double>(transform(row, 3)));
  }
  return map;
}

/// The nearest Eigen transform.
inline Eigen::Affine3d affine_to_eigen(const AffineMap& map) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      result(row, static_cast<Eigen::Index>(j)) = nearest_double(map.linear[i][j]);
    }
    result(row, 3) = nearest_double(map.translation[i]);
  }
  return result;
}

}  // namespace nef
