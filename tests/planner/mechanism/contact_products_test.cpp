// SPDX-License-Identifier: Apache-2.0
//
// Products of contact in doubles against the exact ones, where the error is worst.
#include "apps/planner/mechanism/contact_products.h"

#include <catch2/catch.hpp>
#include <span>

#include "nef/geometry/vectors.h"
#include "tests/support/numbers/worst_error.h"

namespace nef::planner::test::contact_products {
namespace {

using nef::test::Genes;
using nef::test::part_of;
using nef::test::point_of_genes;
using nef::test::worst;

using Triangle = std::array<Rational3, 3>;

RigidPose pose_of_genes(const Genes& g, std::size_t first) {
  RigidPose result;
  result.position = point_of_genes(g, first, 32);
  for (std::size_t k = 0; k < 4; ++k) result.quaternion[k] = g[first + 3 + k];
  return result;
}

// The corners of a piece. In half of the cases far away and near to each other: differences have lost digits.
Triangle triangle_of_genes(const Genes& g, std::size_t first) {
  Triangle result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = point_of_genes(g, first + 3 * k, 32);
  const Rational part = g[33] % 2 == 0 ? Rational(1) : Rational(1, 1 << 20);
  for (std::size_t k = 1; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) result[k][c] = result[0][c] + part * (result[k][c] - result[0][c]);
  }
  return result;
}

double reach_of(const Triangle& triangle) {
  double result = 0;
  for (const Rational3& p : triangle) result = std::max(result, to_vector(p).lpNorm<1>());
  return result;
}

Rational3 scaled(const Rational& factor, const Rational3& v) { return {factor * v[0], factor * v[1], factor * v[2]}; }

// The vector with length 1, within 2^-100: the inverse root in doubles, and a step of Newton's method.
Rational3 of_length_one(const Rational3& v) {
  const Rational square = dot(v, v);
  const Rational root = exact_rational(1 / std::sqrt(nearest_double(square)));
  return scaled(root * (3 - square * root * root) / 2, v);
}

// A normal in doubles as RigidBody has it, and the true one.
struct Normal {
  explicit Normal(const Triangle& t) : exact(of_length_one(cross(minus(t[1], t[0]), minus(t[2], t[0])))) {
    for (std::size_t k = 0; k < 3; ++k) rounded[static_cast<Eigen::Index>(k)] = nearest_double(exact[k]);
  }
  Rational3 exact;
  Vector3d rounded;
};

// The largest error of a product in a part of a motion, as a part of its bound.
struct WorstProducts {
  double vertex = 0;
  double face = 0;
  double edge = 0;
};

WorstProducts products_of(const Genes& g) {
  const RigidMotion motion(pose_of_genes(g, 0), pose_of_genes(g, 7));
  const MotionCells cells(motion);
  const MotionCell cell = cells.part(0.25, 0.75);
  const Triangle moving = triangle_of_genes(g, 14);
  const Triangle fixed = triangle_of_genes(g, 23);
  WorstProducts result;
  if (cell.wide || is_zero(cross(minus(moving[1], moving[0]), minus(moving[2], moving[0]))) ||
      is_zero(cross(minus(fixed[1], fixed[0]), minus(fixed[2], fixed[0])))) {
    return result;
  }
  const double reach = reach_of(moving) + reach_of(fixed) + cell.position_reach;
  const Normal of_moving(moving);
  const Normal of_fixed(fixed);
  const auto edge_of = [](const Triangle& t) { return RoughEdge{to_vector(t[0]), to_vector(t[1]) - to_vector(t[0])}; };
  const RoughEdge e = edge_of(moving);
  const RoughEdge f = edge_of(fixed);
  const Rational3 along = minus(moving[1], moving[0]);
  const Rational3 way = minus(fixed[1], fixed[0]);
  // For each matrix M and position t: t, and M v + t for the others.
  const std::array<Rational3, 5> points{Rational3{0, 0, 0}, moving[0], of_moving.exact, along, cross(moving[0], along)};
  const std::vector<Rational3> images = cells.exact_images(0.25, 0.75, points);
  const std::size_t count = images.size() / points.size();
  REQUIRE(count == cell.turn_count * cell.position_count);
  const double at = of_moving.rounded.dot(to_vector(moving[0]));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& m = cell.turns[i / cell.position_count];
    const Vector3d& t = cell.positions[i % cell.position_count];
    const auto image = [&](std::size_t k) { return images[k * count + i]; };
    const auto turned = [&](std::size_t k) { return minus(image(k), image(0)); };
    const auto take = [](double& largest, double rounded, const Rational& exact, double bound) {
      largest = std::max(largest, part_of(exact_rational(rounded) - exact, bound));
    };
    take(result.vertex, vertex_product(of_fixed.rounded, f.from, m, t, e.from),
         dot(of_fixed.exact, minus(image(1), fixed[0])), product_error(reach));
    take(result.face, face_product(of_moving.rounded, at, m, t, f.from),
         dot(turned(2), minus(fixed[0], image(0))) - dot(of_moving.exact, moving[0]), product_error(reach));
    take(result.edge, edge_product(e, f, m, t),
         dot(way, turned(4)) + dot(turned(3), cross(way, minus(image(0), fixed[0]))), edge_product_error(reach, e, f));
  }
  return result;
}

TEST_CASE("Products of contact: the bounds hold where the error is worst", "[mechanism][bounds]") {
  const auto search = [](double WorstProducts::*member) {
    return worst(
        7, 34, 54, [&](const Genes& g) { return products_of(g).*member; }, 6);
  };
  const double vertex = search(&WorstProducts::vertex);
  const double face = search(&WorstProducts::face);
  const double edge = search(&WorstProducts::edge);
  INFO(vertex << ' ' << face << ' ' << edge);
  CHECK(vertex <= 1);
  CHECK(face <= 1);
  CHECK(edge <= 1);
  CHECK(vertex > 1.0 / 1024);
  CHECK(face > 1.0 / 1024);
  CHECK(edge > 1.0 / 1024);
}

}  // namespace
}  // namespace nef::planner::test::contact_products
