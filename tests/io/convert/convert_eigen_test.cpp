// SPDX-License-Identifier: Apache-2.0
#include "nef/export/convert_eigen.h"
#include "nef/polyhedron.h"

#include <catch2/catch.hpp>

namespace nef {
namespace {

TEST_CASE("Eigen: matrices of a tetrahedron become its solid and come back") {
  Eigen::MatrixXd v(4, 3);
  v << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1;
  Eigen::MatrixXi f(4, 3);
  f << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  const Polyhedron p = from_mesh(mesh_from_eigen(v, f));
  CHECK(*volume(p) == Rational(0.1) / 6);
  const Mesh back = to_mesh(p).mesh;
  const Eigen::MatrixXd v2 = vertices_to_eigen(back);
  const Eigen::MatrixXi f2 = faces_to_eigen(back);
  CHECK(v2.rows() == 4);
  CHECK(f2.rows() == 4);
  CHECK(equal(from_mesh(mesh_from_eigen(v2, f2)), p));
  // Fixed sizes and other scalars do as well.
  Eigen::Matrix<float, 4, 3> vf = v.cast<float>();
  Eigen::Matrix<std::int64_t, 4, 3> fl = f.cast<std::int64_t>();
  CHECK(*volume(from_mesh(mesh_from_eigen(vf, fl))) == exact_rational(static_cast<double>(0.1F)) / 6);
}

TEST_CASE("Eigen: bad matrices are refused") {
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(3, 3);
  Eigen::MatrixXi f(1, 3);
  f << 0, 1, 3;
  CHECK_THROWS_AS(mesh_from_eigen(v, f), InputError);
  f << 0, -1, 2;
  CHECK_THROWS_AS(mesh_from_eigen(v, f), InputError);
  f << 0, 1, 2;
  v(1, 1) = std::nan("");
  CHECK_THROWS_AS(mesh_from_eigen(v, f), InputError);
  CHECK_THROWS_AS(mesh_from_eigen(Eigen::MatrixXd::Zero(3, 2), f), InputError);
  MeshExportOptions polygons;
  polygons.keep_polygons = true;
  CHECK_THROWS_AS(faces_to_eigen(to_mesh(make_box({0, 0, 0}, {1, 1, 1}), polygons).mesh), InputError);
}

TEST_CASE("Eigen: affine transforms are taken exactly") {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  t.linear() << 0, -1, 0, 0.1, 0, 0, 0, 0, 2;
  t.translation() << 0.5, 0.25, 1e-30;
  const AffineMap map = affine_from_eigen(t);
  const Rational3 image = map({1, 2, 3});
  CHECK(image[0] == Rational(-3, 2));
  CHECK(image[1] == Rational(0.1) + Rational(1, 4));
  CHECK(image[2] == 6 + Rational(1e-30));
  CHECK(affine_to_eigen(map).matrix() == t.matrix());
  CHECK(equal(
      transform(make_box({0, 0, 0}, {1, 1, 1}), affine_from_eigen(Eigen::Affine3d(Eigen::Translation3d(1, 2, 3)))),
      make_box({1, 2, 3}, {2, 3, 4})));
  t.linear()(0, 0) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(affine_from_eigen(t), InputError);
  Eigen::Projective3d bent = Eigen::Projective3d::Identity();
  CHECK(affine_from_eigen(bent).determinant() == 1);
  bent(3, 0) = 1;
  CHECK_THROWS_AS(affine_from_eigen(bent), InputError);
}

}  // namespace
}  // namespace nef
