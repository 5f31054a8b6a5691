// SPDX-License-Identifier: Apache-2.0
//
// Polyhedra survive their files: the native format and nef3 exactly, mesh formats up to one rounding.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "nef/export/nearest_float.h"
#include "nef/export/to_mesh.h"
#include "nef/io/cgal/cgal_nef3.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/native/native_format.h"
#include "nef/io/polyhedron_file.h"
#include "tests/support/paths.h"
#include "tests/support/shapes/random_polyhedra.h"
#include "tests/support/temporary_folder.h"

namespace nef {
namespace {

using test::set;

TEST_CASE("Native files give every random set back, bounded or not") {
  CHECK(rc::check("native round trip", [] {
    const test::Recipe recipe = *test::recipes(false, 4);
    const Polyhedron a = recipe.make();
    const Polyhedron b = read_native(native_text(a), "text");
    RC_ASSERT(equal(a, b));
    // Unique representations are written alike.
    RC_ASSERT(native_text(read_native(native_text(b), "text")) == native_text(b));
  }));
}

TEST_CASE("Native files keep marks other than 0 and 1") {
  const Polyhedron a = set("box(0,0,0,2,2,2)");
  const Polyhedron b = set("box(1,1,1,3,3,3)");
  const Polyhedron labelled = overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x + 2 * y); });
  const Polyhedron back = read_native(native_text(labelled), "text");
  CHECK(equal(labelled, back));
  CHECK(locate(back, {Rational(3, 2), Rational(3, 2), Rational(3, 2)}).mark == 3);
  Messages messages;
  CHECK_FALSE(nef3_text(labelled, &messages).empty());
  CHECK(messages.size() == 1);
}

TEST_CASE("nef3 gives every random set back that needs no box") {
  CHECK(rc::check("nef3 round trip", [] {
    const test::Recipe recipe = *test::recipes(*rc::gen::element(true, true, false), 4);
    const Polyhedron a = recipe.make();
    if (a.complex().has_box()) {
      RC_ASSERT_THROWS_AS(nef3_text(a), UnsupportedError);
      return;
    }
    RC_ASSERT(equal(a, read_nef3(nef3_text(a), "text")));
  }));
}

TEST_CASE("CGAL's example files mean what CGAL counts") {
  const Polyhedron mixed = read_polyhedron(source_folder() + "/data/nef3/Nef_3_nefIO.cin");
  const Counts n = counts(mixed);
  CHECK(n.vertices == 37);
  CHECK(n.edges == 48);
  CHECK(n.facets == 15);
  CHECK(n.volumes == 2);
  CHECK_FALSE(contains(mixed, {-8, 8, 0}));
  CHECK(contains(mixed, {0, 0, 0}));
  CHECK(contains(mixed, {0, 0, -8}));
  CHECK_FALSE(contains(mixed, {0, 0, 8}));
  CHECK(equal(read_polyhedron(source_folder() + "/data/nef3/Minkowski_sum_3_cube.nef3"),
              make_box({-1, -1, -1}, {1, 1, 1})));
}

// False, with a warning, where CGAL is not installed and the peer was not built.
bool have_peer() {
  if (std::filesystem::exists(program_folder() + "/nef3_peer")) return true;
  WARN("nef3_peer was not built (it needs CGAL); skipped");
  return false;
}

int peer(const std::string& arguments) {
  const std::string command = program_folder() + "/nef3_peer " + arguments + " >/dev/null 2>&1";
  return WEXITSTATUS(std::system(command.c_str()));
}

TEST_CASE("CGAL reads what we write and finds it equal to what it wrote") {
  if (!have_peer()) return;
  const test::TemporaryFolder folder;
  for (const char* name : {"empty", "full", "cube", "open", "shell", "touching", "mixed", "wire", "fractions"}) {
    INFO(name);
    const std::string theirs = folder.file(std::string(name) + ".nef3");
    const std::string ours = folder.file(std::string(name) + "_ours.nef3");
    REQUIRE(peer("make " + std::string(name) + " " + theirs) == 0);
    const Polyhedron p = read_polyhedron(theirs);
    write_polyhedron(ours, p);
    CHECK(peer("same " + theirs + " " + ours) == 0);
    write_polyhedron(ours, complement(p));
    CHECK(peer("same " + theirs + " " + ours) == 1);
  }
}

TEST_CASE("CGAL's shapes are ours") {
  if (!have_peer()) return;
  const test::TemporaryFolder folder;
  const auto check = [&](const char* name, const char* text) {
    INFO(name);
    const std::string path = folder.file("shape.nef3");
    REQUIRE(peer("make " + std::string(name) + " " + path) == 0);
    CHECK(equal(read_polyhedron(path), set(text)));
  };
  check("empty", "nothing");
  check("full", "everything");
  check("cube", "box(0,0,0,1,1,1)");
  check("open", "interior(box(0,0,0,1,1,1))");
  check("shell", "box(0,0,0,3,3,3) - box(1,1,1,2,2,2)");
  check("touching", "box(0,0,0,1,1,1) + box(1,1,1,2,2,2)");
  check("mixed", "!(box(0,0,0,2,2,2) - box(1,1,1,3,3,3) + boundary(box(5,5,5,6,6,6)))");
  check("wire", "segment(0,0,0,1,0,0) + segment(1,0,0,0,1,0.5) + box(2,2,2,3,3,3)");
}
TEST_CASE("Decimal coordinates survive every mesh format exactly") {
  const test::TemporaryFolder folder;
  // 0.1 is a tenth in text; binary formats get what floats hold.
  const Polyhedron decimal = set("box(0.1,0.2,0.3,1.7,1.9,2.3) - interior(box(0.4,0.4,0,0.9,0.9,3))");
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl"}) {
    INFO(name);
    Messages messages;
    write_polyhedron(folder.file(name), decimal, {}, &messages);
    CHECK(messages.empty());
    CHECK(equal(read_polyhedron(folder.file(name)), decimal));
  }
  const Polyhedron dyadic = set("box(0.25,0.5,0,1.75,1.5,3) + box(3,3,3,4,4,4)");
  for (const char* name : {"b.ply", "b.stl"}) {
    PolyhedronWriteOptions options;
    options.binary = true;
    write_polyhedron(folder.file(name), dyadic, options);
    CHECK(equal(read_polyhedron(folder.file(name)), dyadic));
  }
}

TEST_CASE("Exact mesh files hold any rational") {
  const test::TemporaryFolder folder;
  const Polyhedron p =
      transform(set("box(0,0,0,1,1,1) - interior(box(-1,-1,-1,0.5,0.5,2))"), AffineMap::rotate({0, 0, 1}, 10, 1e-6));
  PolyhedronWriteOptions exact;
  exact.exact = true;
  for (const char* name : {"a.off", "a.obj", "a.ply"}) {
    write_polyhedron(folder.file(name), p, exact);
    CHECK(equal(read_polyhedron(folder.file(name)), p));
  }
  CHECK_THROWS_AS(write_polyhedron(folder.file("a.stl"), p, exact), FileError);
  // Rounded, it is written as triangles, which stay planar, and each coordinate is the nearest double.
  write_polyhedron(folder.file("b.off"), p);
  const Mesh rounded = read_mesh(folder.file("b.off"));
  const Mesh triangles = to_mesh(p).mesh;
  REQUIRE(rounded.vertices.size() == triangles.vertices.size());
  for (std::size_t v = 0; v < rounded.vertices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(nearest_double(rounded.vertices[v][axis]) == nearest_double(triangles.vertices[v][axis]));
    }
  }
  for (std::size_t f = 0; f < rounded.face_count(); ++f) CHECK(rounded.face(f).size() == 3);
}

TEST_CASE("Losses and merged vertices are reported") {
  const test::TemporaryFolder folder;
  Messages messages;
  write_polyhedron(folder.file("a.off"), set("interior(box(0,0,0,1,1,1)) + point(3,3,3)"), {}, &messages);
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].find("1 vertex") != std::string::npos);
  messages.clear();
  const Polyhedron thin = make_box({1, 1, 1}, {2, 2, parse_rational("1.0000000000000000000001")});
  CHECK_THROWS_AS(write_polyhedron(folder.file("b.off"), thin), UnsupportedError);
  CHECK(write_polyhedron(folder.file("b.off"), thin, {.lenient = true}, &messages).problem.find("not valid") !=
        std::string::npos);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].find("4 vertices lie where another one does") != std::string::npos);
  // A surface, too: a triangle whose side is shorter than the distance of doubles there.
  const Polyhedron far = set("polygon(1000000000,0,0, 1000000000.00000001,0,0, 1000000000,1,0)");
  CHECK_THROWS_WITH(write_polyhedron(folder.file("d.off"), far),
                    Catch::Contains("1 vertex lies where another one does") && Catch::Contains("--recenter"));
  CHECK_FALSE(std::filesystem::exists(folder.file("d.off")));
  CHECK(write_polyhedron(folder.file("d.off"), far, {.lenient = true}).problem.find("1 vertex lies") !=
        std::string::npos);
  CHECK(write_polyhedron(folder.file("e.off"), far, {.recenter = true}).problem.empty());
  CHECK(write_polyhedron(folder.file("f.off"), far, {.exact = true}).problem.empty());
  CHECK(equal(read_polyhedron(folder.file("f.off"), {.as_surface = true}), far));
  CHECK_THROWS_AS(write_polyhedron(folder.file("c.nef3"), set("halfspace(1,0,0,0)")), UnsupportedError);
  CHECK_THROWS_AS(write_polyhedron(folder.file("c.xyz"), set("nothing")), FileError);
}

TEST_CASE("The empty set goes through every format") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl", "a.nef", "a.nef3"}) {
    INFO(name);
    write_polyhedron(folder.file(name), Polyhedron());
    CHECK(read_polyhedron(folder.file(name)).is_empty());
  }
}

TEST_CASE("A file is replaced as a whole or not at all") {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.off", "old");
  CHECK_THROWS_AS(write_polyhedron(folder.file("no/such/folder/a.off"), set("nothing")), FileError);
  CHECK_THROWS_WITH(write_polyhedron(folder.file("") + ".off/..", set("nothing")), Catch::Contains("extension"));
  write_polyhedron(path, make_box({0, 0, 0}, {1, 1, 1}));
  CHECK(test::slurp(path).find("OFF\n8 6 0\n") == 0);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("Floats are rounded once") {
  // Exactly between the floats 1 and 1 + 2^-23, and a hair above or below: the double in between is the tie itself.
  const Rational tie = Rational(1) + exact_rational(std::ldexp(1.0, -24));
  const Rational hair("1/1000000000000000000000000000000000000000000000000");
  CHECK(nearest_float(tie) == 1.0F);
  CHECK(nearest_float(tie + hair) == std::nextafter(1.0F, 2.0F));
  CHECK(nearest_float(tie - hair) == 1.0F);
  CHECK(nearest_float(-(tie + hair)) == -std::nextafter(1.0F, 2.0F));
  const Rational upper_tie = tie + exact_rational(std::ldexp(1.0, -23));
  CHECK(nearest_float(upper_tie) == 1.0F + std::ldexp(1.0F, -22));
  CHECK(nearest_float(upper_tie - hair) == std::nextafter(1.0F, 2.0F));
  CHECK(nearest_float(Rational("1/3")) == 1.0F / 3.0F);
  CHECK(nearest_float(0) == 0.0F);
  CHECK(std::isinf(nearest_float(parse_rational("1e60"))));
}

}  // namespace
}  // namespace nef
