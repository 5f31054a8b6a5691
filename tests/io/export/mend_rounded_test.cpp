// SPDX-License-Identifier: Apache-2.0
//
// What is written is strictly legal after rounding, or it is refused.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/mesh/mesh_check.h"
#include "nef/polyhedron.h"
#include "tests/support/shapes/ball.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

bool has(const Messages& messages, const std::string& words) {
  return std::any_of(messages.begin(), messages.end(),
                     [&](const std::string& m) { return m.find(words) != std::string::npos; });
}

std::string why_illegal(const Mesh& mesh) {
  for (const MeshProblem& problem : check_mesh(mesh)) {
    if (!is_strictly_legal(problem)) return problem.text;
  }
  try {
    from_mesh(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Writes to all formats that round, and checks what is read. Returns the notes of all.
Messages check_all_formats(const Polyhedron& set) {
  const TemporaryFolder folder;
  Messages all;
  for (const auto& [name, binary] : {std::pair("a.off", false),
                                     {"a.obj", false},
                                     {"a.ply", false},
                                     {"a.stl", false},
                                     {"b.ply", true},
                                     {"b.stl", true},
                                     {"a.3mf", false},
                                     {"a.glb", false}}) {
    Messages notes;
    PolyhedronWriteOptions options;
    options.binary = binary;
    try {
      write_polyhedron(folder.file(name), set, options, &notes);
      const std::string why = why_illegal(read_mesh(folder.file(name)));
      INFO(name << ": " << why);
      CHECK(why.empty());
    } catch (const UnsupportedError& error) {
      notes.emplace_back(error.what());
    }
    all.insert(all.end(), notes.begin(), notes.end());
  }
  return all;
}

}  // namespace

TEST_CASE("A cube less a ball in doubles is written so that it can be read", "[rounding]") {
  const Polyhedron set = subtract(make_box({-5, -5, -5}, {5, 5, 5}), ball(6, 16, 8));
  const Messages notes = check_all_formats(set);
  CHECK_FALSE(has(notes, "could not be repaired"));
}

TEST_CASE("Random Booleans of turned boxes are written so that they can be read", "[rounding]") {
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int lost = 0;
  for (int round = 0; round < 12; ++round) {
    Polyhedron set = make_box({-4, -4, -4}, {4, 4, 4});
    for (int i = 0; i < 4; ++i) {
      const Polyhedron box =
          make_box({below(4) - 4, below(4) - 4, below(4) - 4}, {1 + below(4), 1 + below(4), 1 + below(4)});
      const Rational3 axis{below(3) - 1, below(3) - 1, 1};
      const Polyhedron turned = transform(box, AffineMap::rotate(axis, below(90), 1e-6));
      set = i % 2 == 0 ? subtract(set, turned) : unite(set, turned);
    }
    lost += has(check_all_formats(regularize(set)), "could not be repaired") ? 1 : 0;
  }
  CHECK(lost <= 1);
}

TEST_CASE("Nearly coplanar cuts are repaired or refused", "[rounding]") {
  // Two balls whose centres are a hair apart: slivers as thin as rounding.
  const Polyhedron a = ball(5, 12, 6);
  const Polyhedron b = transform(a, AffineMap::translate({parse_rational("3e-16"), parse_rational("1e-16"), 0}));
  check_all_formats(unite(a, b));
  check_all_formats(subtract(a, b));
}

TEST_CASE("What is called legal after rounding is legal in every reading", "[rounding]") {
  int legal = 0;
  for (const FileNumbers numbers : {FileNumbers::kDoubles, FileNumbers::kDecimals, FileNumbers::kFloats}) {
    const Rounding rounding = rounding_to(numbers);
    for (int i = 0; i < 6; ++i) {
      const Polyhedron round = ball(5, 14, 9);
      const Polyhedron moved = transform(round, AffineMap::translate({Rational(1, 3 + i), Rational(2, 7), i}));
      const Polyhedron turned = transform(make_box({-4, -3, -9}, {3, 4, 9}), AffineMap::rotate({0, 0, 1}, 9 * i, 1e-6));
      const Mesh exact = to_mesh(i % 2 == 0 ? unite(round, moved) : subtract(round, turned)).mesh;
      const MendedMesh rounded = round_mesh(exact, rounding);
      if (!rounded.legal) continue;  // slivers that floats cannot tell apart
      ++legal;
      for (const auto& reading : rounding.readings) {
        Mesh read = rounded.mesh;
        for (Rational3& p : read.vertices) {
          for (Rational& x : p) x = reading(nearest_double(x));
        }
        CHECK(why_illegal(read).empty());
      }
      CHECK(rounded_problem(rounded.mesh, rounding).empty());
    }
  }
  CHECK(legal > 12);
}

TEST_CASE("A corner that one reading has in the plane of a face is not called legal", "[rounding]") {
  // The decimals .1, .2 and .3 are on one line with the origin, the doubles near them are not.
  Mesh mesh;
  const Rational tenth(1, 10);
  for (const int k : {1, 2, 3}) mesh.vertices.push_back({k * tenth, k * tenth, k * tenth});
  mesh.vertices.push_back({1, 0, 0});
  mesh.vertices.push_back({0, 1, 0});
  for (const std::vector<std::uint32_t>& face :
       {std::vector<std::uint32_t>{0, 2, 3}, {0, 4, 2}, {0, 1, 4}, {0, 3, 1}, {1, 3, 4}, {2, 4, 3}}) {
    mesh.push_face(face);
  }
  CHECK_FALSE(rounded_problem(mesh, rounding_to(FileNumbers::kDecimals)).empty());
}

TEST_CASE("A solid thinner than doubles can tell is not written in silence", "[rounding]") {
  const TemporaryFolder folder;
  const Polyhedron thin = make_box({1, 1, 1}, {2, 2, parse_rational("1.0000000000000000000001")});
  try {
    write_polyhedron(folder.file("a.off"), thin);
    FAIL("it is written");
  } catch (const UnsupportedError& error) {
    for (const char* words : {"could not be repaired", "--exact", ".nef", "--lenient"}) {
      CHECK(has({error.what()}, words));
    }
  }
  CHECK(folder.file_count() == 0);
  CHECK_FALSE(write_polyhedron(folder.file("a.off"), thin, {.lenient = true}).problem.empty());
}

// A tetrahedron whose faces meet in a very sharp edge, and a vertex of one of them so close to the edge that it is
// rounded beyond it nearly always: then both faces cross, and moving corners hardly ever puts it back between them.
TEST_CASE("A vertex that is rounded over a sharp edge is joined to the face beyond it", "[rounding]") {
  std::mt19937 random(20261130);
  const auto near = [&](int x) -> Rational { return Rational(x) + Rational(static_cast<int>(random() % 997), 997); };
  int repaired = 0;
  for (int i = 0; i < 60; ++i) {
    INFO(i);
    const Rational3 a{near(0), near(0), near(0)};
    const Rational3 b{near(6), near(2), near(1)};
    const Rational3 c{near(2), near(4), near(3)};
    const Rational3 d{c[0], c[1] + Rational(1, 100000), c[2] - Rational(1, 30000)};
    const Rational beside = 1 / Rational(Integer("1000000000000000000"));
    Rational3 m;
    for (std::size_t k = 0; k < 3; ++k) m[k] = a[k] + (b[k] - a[k]) * 2 / 5 + beside * (d[k] - a[k]);
    Mesh mesh;
    mesh.vertices = {a, b, c, d, m};
    const bool is_turned = dot(cross(minus(b, a), minus(c, a)), minus(d, a)) > 0;  // a, b, c is seen from inside
    for (std::array<std::uint32_t, 3> face :
         std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 0, 4}, {0, 3, 4}, {3, 1, 4}, {0, 2, 3}, {2, 1, 3}}) {
      if (is_turned) std::swap(face[0], face[1]);
      mesh.push_face(face);
    }
    REQUIRE(why_illegal(mesh).empty());
    const Rounding rounding = rounding_to(FileNumbers::kDoubles);
    if (!rounded_problem(mesh, rounding).empty()) ++repaired;
    const MendedMesh mended = round_mesh(mesh, rounding);
    CHECK(mended.problem.empty());
    CHECK(mended.legal);
    CHECK(mended.moved == 0);
    CHECK(mended.largest_move < 1e-14);
    CHECK(why_illegal(mended.mesh).empty());
  }
  CHECK(repaired > 5);
}

TEST_CASE("Faces that are written are convex, or polygons if asked", "[rounding]") {
  const TemporaryFolder folder;
  const Polyhedron set = subtract(make_box({0, 0, 0}, {3, 3, 1}), make_box({1, 1, 0}, {2, 3, 1}));
  for (const char* name : {"a.off", "a.obj", "a.ply"}) {
    for (const bool polygons : {false, true}) {
      PolyhedronWriteOptions options;
      options.polygons = polygons;
      write_polyhedron(folder.file(name), regularize(set), options);
      const Mesh mesh = read_mesh(folder.file(name));
      // The area of the fans that other programs cut: each triangle counts, whichever way it turns.
      double area = 0;
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
          const Rational3 n = cross(minus(mesh.vertices[face[i]], mesh.vertices[face[0]]),
                                    minus(mesh.vertices[face[i + 1]], mesh.vertices[face[0]]));
          area += std::sqrt(nearest_double(dot(n, n))) / 2;
        }
      }
      if (!polygons) CHECK(area == Approx(surface_area(set)));
      CHECK((mesh.face_count() == 10) == polygons);
      CHECK(equal(from_mesh(mesh), regularize(set)));
    }
  }
}

TEST_CASE("Surfaces, lines and points leave", "[rounding]") {
  const TemporaryFolder folder;
  const std::vector<std::vector<Rational3>> rings{{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}},
                                                  {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}};
  const Polyhedron sheet = make_polygon(rings);
  MeshOptions surface;
  surface.as_surface = true;
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl", "a.glb", "a.3mf"}) {
    Messages notes;
    write_polyhedron(folder.file(name), sheet, {}, &notes);
    CHECK(notes.empty());
    CHECK(equal(read_polyhedron(folder.file(name), surface), sheet));
  }
  const Polyhedron wires = unite(unite(sheet, make_segment({5, 0, 0}, {5, 1, 0})), make_point({7, 7, 7}));
  Messages notes;
  write_polyhedron(folder.file("w.obj"), wires, {}, &notes);
  CHECK(notes.empty());
  const std::string text = slurp(folder.file("w.obj"));
  CHECK(text.find("\nl ") != std::string::npos);
  CHECK(text.find("\np ") != std::string::npos);
  write_polyhedron(folder.file("w.off"), wires, {}, &notes);
  CHECK(has(notes, "1 line is"));
  CHECK(has(notes, "1 point is"));
  // What is missing at the border of a sheet is told.
  notes.clear();
  write_polyhedron(folder.file("o.off"), subtract(sheet, make_segment({0, 0, 0}, {3, 0, 0})), {}, &notes);
  CHECK(has(notes, "written as closed"));
}

TEST_CASE("GLB: what is written is read, and nodes are placed exactly", "[rounding]") {
  const TemporaryFolder folder;
  const Polyhedron set = unite(make_box({0, 0, 0}, {1, 2, 3}), make_box({1, 1, 1}, {4, 5, 6}));
  write_polyhedron(folder.file("a.glb"), set);
  CHECK(equal(read_polyhedron(folder.file("a.glb")), set));
  // The same file with its mesh in two nodes, one moved, one scaled and turned by a quarter about y (z here).
  std::string bytes = slurp(folder.file("a.glb"));
  const std::size_t json_size = static_cast<unsigned char>(bytes[12]) + 256U * static_cast<unsigned char>(bytes[13]);
  std::string json = bytes.substr(20, json_size);
  const std::size_t first = json.find("\"nodes\":[{");
  const std::size_t last = json.find("}]", first);
  REQUIRE(first != std::string::npos);
  json.replace(first, last + 2 - first,
               "\"nodes\":[{\"children\":[1,2],\"matrix\":[1,0,0,0,0,0,-1,0,0,1,0,0,0,0,0,1]},"
               "{\"mesh\":0,\"translation\":[0.5,0,100],\"scale\":[-1,1,1]},"
               "{\"mesh\":0,\"scale\":[2,2,2],\"rotation\":[0,0,1,1]}]");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto number = [](std::size_t value) {
    std::string text;
    for (unsigned i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
    return text;
  };
  const std::string rest = bytes.substr(20 + json_size);
  bytes = bytes.substr(0, 8) + number(20 + json.size() + rest.size()) + number(json.size()) + "JSON" + json + rest;
  // A mirrored node is turned over.
  const Polyhedron moved =
      transform(set, AffineMap::translate({Rational(1, 2), 0, 100}).after(AffineMap::scale({-1, 1, 1})));
  AffineMap quarter = AffineMap::scale({2, 2, 2});
  quarter.linear = {{{0, -2, 0}, {2, 0, 0}, {0, 0, 2}}};
  CHECK(equal(read_polyhedron(folder.write("b.glb", bytes)), unite(moved, transform(set, quarter))));
  // Cut off anywhere, it is refused.
  for (std::size_t size = 0; size < bytes.size(); size += 37) {
    CHECK_THROWS_AS(read_polyhedron(folder.write("c.glb", bytes.substr(0, size))), InputError);
  }
}

}  // namespace nef::test
