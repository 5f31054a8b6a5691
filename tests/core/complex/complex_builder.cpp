// SPDX-License-Identifier: Apache-2.0
//
// The builder returns what does not fit together, whatever the assertions do, and calls it a bug where nobody's data
// may be wrong.
#include "nef/synthesis/complex_builder.h"

#include <catch2/catch.hpp>

#include "nef/base/error.h"
#include "nef/construct/solid.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

// The coordinate planes, and x = 1.
struct BuilderPlanes {
  PlaneTable table;
  PlaneId x = table.intern(1, 0, 0, 0);
  PlaneId y = table.intern(0, 1, 0, 0);
  PlaneId z = table.intern(0, 0, 1, 0);
  PlaneId x1 = table.intern(1, 0, 0, -1);

  // Along p x q.
  [[nodiscard]] Arrangement::Node toward(PlaneId p, PlaneId q) const {
    Arrangement::Node node;
    node.direction = Direction::cross(table, p, q);
    node.mark = 1;
    return node;
  }
};

std::string defect_of(ComplexBuilder& builder) {
  const std::variant<Complex, Defect> made = builder.try_finish(0);
  const Defect* defect = std::get_if<Defect>(&made);
  return defect == nullptr ? "" : defect->text();
}

// An end of an edge along +x at the origin.
Arrangement end_of_edge(const BuilderPlanes& planes) {
  Arrangement drawing;
  drawing.centre = 1;
  drawing.nodes.push_back(planes.toward(planes.y, planes.z));
  return drawing;
}

// A corner of a polygon in z = 0 at (1, 0, 0), with edges along -x and +y.
Arrangement corner_of_polygon(const BuilderPlanes& planes) {
  Arrangement drawing;
  drawing.centre = 1;
  drawing.nodes.push_back(planes.toward(planes.z, planes.y));
  drawing.nodes.push_back(planes.toward(planes.z, planes.x1));
  drawing.arcs.push_back({planes.z, 1, 0, 1, 0, 0});
  return drawing;
}

// A box with corners at +-size, with its faces turned inward or outward.
void add_box(SolidFaces& faces, int size, bool inward) {
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto first = static_cast<std::uint32_t>(faces.points.size());
  for (int i = 0; i < 8; ++i) {
    faces.points.push({(i & 1) != 0 ? size : -size, (i & 2) != 0 ? size : -size, (i & 4) != 0 ? size : -size});
  }
  for (std::size_t i = 0; i < 6; ++i) {
    Integer3 n;
    n[i / 2] = i % 2 == 0 ? -1 : 1;
    const PlaneId plane = faces.planes.intern(n[0], n[1], n[2], -size);
    faces.plane.push_back(inward ? plane.opposite() : plane);
    for (std::size_t k = 0; k < 4; ++k) faces.corners.push_back(first + kSides[i][inward ? 3 - k : k]);
    faces.begin.push_back(static_cast<std::uint32_t>(faces.corners.size()));
  }
}

SolidFaces boxes(std::initializer_list<std::pair<int, bool>> sizes) {
  SolidFaces faces;
  for (const auto& [size, inward] : sizes) add_box(faces, size, inward);
  return faces;
}

}  // namespace

TEST_CASE("An edge without its other end is a defect") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement drawing = end_of_edge(planes);
  CHECK(builder.add({0, 0, 0}, drawing));
  CHECK(defect_of(builder) == "an edge has two ends, halfedge 0");
}

TEST_CASE("Where nobody's data may be wrong a defect is a bug, and no error of the user's") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement drawing = end_of_edge(planes);
  builder.add({0, 0, 0}, drawing);
  CHECK_THROWS_WITH(builder.finish(0), Catch::Contains("internal error"));
  static_assert(!std::is_base_of_v<Error, nef::detail::BrokenInvariant>);
}

// This used to be read from outside of the arrays.
TEST_CASE("An edge with a facet at one end only is a defect") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement bare = end_of_edge(planes);
  Arrangement corner = corner_of_polygon(planes);
  CHECK(builder.add({0, 0, 0}, bare));
  CHECK(builder.add({1, 0, 0}, corner));
  CHECK(defect_of(builder) == "an edge has facets at both ends or at none, halfedge 0, halfedge 1");
}

TEST_CASE("An edge from a vertex to itself is a defect") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement drawing = end_of_edge(planes);
  drawing.nodes.push_back(planes.toward(planes.z, planes.y));
  drawing.centre = 0;
  CHECK(builder.add({0, 0, 0}, drawing));
  CHECK(defect_of(builder) == "an edge joins two vertices, halfedge 0, halfedge 1");
}

TEST_CASE("Two directions of one line that do not meet are a defect") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  for (const int at : {0, 1, 2}) {
    Arrangement drawing = end_of_edge(planes);
    builder.add({at, 0, 0}, drawing);
  }
  CHECK(defect_of(builder).substr(0, 24) == "an edge has two ends, ha");
}

TEST_CASE("Boxes in a box that are turned the wrong way contradict it") {
  const auto kind = [](SolidFaces faces) -> std::optional<Defect::Kind> {
    const std::variant<Complex, Defect> made = try_make_solid(std::move(faces), {1, 1, 0}, {});
    if (const Defect* defect = std::get_if<Defect>(&made)) return defect->kind;
    CHECK(validate(std::get<Complex>(made)) == "");
    return std::nullopt;
  };
  CHECK(kind(boxes({{3, false}, {2, true}, {1, false}})) == std::nullopt);
  CHECK(kind(boxes({{3, false}, {2, false}})) == Defect::Kind::kMarks);
  CHECK(kind(boxes({{3, false}, {2, true}, {1, true}})) == Defect::Kind::kMarks);
  CHECK_THROWS_AS(make_solid(boxes({{3, false}, {2, false}}), {1, 1, 0}, {}), nef::detail::BrokenInvariant);
}

TEST_CASE("A point that is no vertex is not added") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement inside_edge = end_of_edge(planes);
  inside_edge.nodes.push_back(planes.toward(planes.z, planes.y));
  CHECK_FALSE(builder.add({0, 0, 0}, inside_edge));
  const Complex c = builder.finish(1);
  CHECK(c.vertex_count() == 0);
  CHECK(c.planes.size() == 0);
  CHECK(c.volumes[kOuterVolume].mark == 1);
}

TEST_CASE("What is wrong first is told") {
  BuilderPlanes planes;
  ComplexBuilder builder(planes.table, {});
  Arrangement contradictory;  // a great circle of two halves with different marks on one side
  contradictory.nodes.push_back(planes.toward(planes.y, planes.z));
  contradictory.nodes.push_back(planes.toward(planes.z, planes.y));
  contradictory.arcs.push_back({planes.z, 0, 1, 1, 0, 1});
  contradictory.arcs.push_back({planes.z, 1, 0, 1, 1, 0});
  contradictory.centre = 1;
  contradictory.nodes[0].mark = contradictory.nodes[1].mark = 0;
  Arrangement drawing = end_of_edge(planes);
  CHECK_FALSE(builder.add({0, 0, 0}, contradictory));
  CHECK_FALSE(builder.add({5, 5, 5}, drawing));
  const std::variant<Complex, Defect> made = builder.try_finish(0);
  REQUIRE(std::holds_alternative<Defect>(made));
  CHECK(std::get<Defect>(made).kind == Defect::Kind::kMarks);
}

TEST_CASE("Integers of any length in one table") {
  IntegerRows rows(2);
  const Integer small = -7;
  const Integer large = -(Integer(1) << 9000);  // 141 limbs
  const auto push = [&rows](const Integer& a, const Integer& b) {
    const std::array<mpz_srcptr, 2> row{a.get_mpz_t(), b.get_mpz_t()};
    return rows.push(row);
  };
  const auto value = [](const IntegerRows& in, std::uint32_t row, std::size_t column) {
    return Integer(in.at(row, column));
  };
  push(small, 0);
  IntegerRows narrow(2);
  narrow.append(rows, 0, 1);
  push(large, 5);
  push(0, small);
  CHECK(value(rows, 0, 0) == small);
  CHECK(value(rows, 1, 0) == large);
  CHECK(value(rows, 1, 1) == 5);
  CHECK(value(rows, 2, 1) == small);
  CHECK(rows.sign(1, 0) == -1);
  CHECK(rows.sign(0, 1) == 0);
  CHECK(rows.equal(0, narrow, 0));
  CHECK(rows.hash(0) == narrow.hash(0));
  CHECK_FALSE(rows.equal(1, narrow, 0));
  narrow.append(rows, 1, 2);
  narrow.push_from(rows, 0);
  CHECK(narrow.size() == 4);
  CHECK(value(narrow, 1, 0) == large);
  CHECK(value(narrow, 2, 1) == small);
  CHECK(narrow.equal(3, rows, 0));
  narrow.pop();
  narrow.pop();
  CHECK(narrow.size() == 2);
  CHECK(value(narrow, 1, 1) == 5);
}

}  // namespace nef::test
