// SPDX-License-Identifier: Apache-2.0
//
// Flattened OpenSCAD models, against closed forms and against what OpenSCAD 2021.01 makes of the same text.
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/program/expression/openscad.h"
#include "command/process.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

Polyhedron eval_openscad(const std::string& text) { return evaluate_openscad(text); }

double volume_of(const std::string& text) { return nearest_double(*volume(eval_openscad(text))); }

std::string openscad_refusal(const std::string& text) {
  try {
    eval_openscad(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// A regular polygon with the corners on a circle.
double polygon_area(unsigned corners, double radius) {
  return corners / 2.0 * radius * radius * std::sin(2 * M_PI / corners);
}

}  // namespace

TEST_CASE("OpenSCAD's shapes of no size are empty, as there, and a warning says so") {
  const auto warnings_of = [](const std::string& text) {
    std::vector<std::string> warnings;
    ExpressionOptions options;
    options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
    CHECK(equal(evaluate_openscad("cube(1);\n" + text, options), make_box({0, 0, 0}, {1, 1, 1})));
    return warnings;
  };
  using Warnings = std::vector<std::string>;
  CHECK(warnings_of("cube([0, 1, 1]);") == Warnings{"line 2: cube: one of its sizes is 0, so it is empty"});
  CHECK(warnings_of("cube(-2);") == Warnings{"line 2: cube: one of its sizes is -2, so it is empty"});
  CHECK(warnings_of("sphere(r = 0);") == Warnings{"line 2: sphere: its radius is 0, so it is empty"});
  CHECK(warnings_of("cylinder(h = -1, r1 = 1, r2 = 1);") ==
        Warnings{"line 2: cylinder: its height is -1, so it is empty"});
  CHECK(warnings_of("cylinder(h = 1, r1 = -1, r2 = 1);") ==
        Warnings{"line 2: cylinder: one of its radii is -1, so it is empty"});
  CHECK(warnings_of("cylinder(h = 1, r1 = 0, r2 = 0);") ==
        Warnings{"line 2: cylinder: both its radii are 0, so it is empty"});
  CHECK(warnings_of("linear_extrude(height = 0) { square(1); }") ==
        Warnings{"line 2: linear_extrude: its height is 0, so it is empty"});
  CHECK(warnings_of("linear_extrude(height = 1) { square([1, 0]); }") ==
        Warnings{"line 2: square: one of its sizes is 0, so it is empty"});
  CHECK(warnings_of("linear_extrude(height = 1) { circle(r = -1); }") ==
        Warnings{"line 2: circle: its radius is -1, so it is empty"});
  CHECK(warnings_of("cube(1);").empty());
}

TEST_CASE("OpenSCAD: cubes, lists, comments and modifiers", "[openscad]") {
  CHECK(equal(eval_openscad("cube(size = [1, 2, 3], center = false);"), make_box({0, 0, 0}, {1, 2, 3})));
  CHECK(equal(eval_openscad("cube(size=0.2,center=true); // a tenth each side\n"),
              make_box({Rational(-1, 10), Rational(-1, 10), Rational(-1, 10)},
                       {Rational(1, 10), Rational(1, 10), Rational(1, 10)})));
  CHECK(equal(eval_openscad("/* a\nb */ %cube([9,9,9]); *cube(7); #group() { cube(1); }"),
              make_box({0, 0, 0}, {1, 1, 1})));
  CHECK(eval_openscad("").is_empty());
  CHECK(eval_openscad("group();").is_empty());
  CHECK(equal(eval_openscad("multmatrix([[0,-1,0,1.5],[1,0,0,0],[0,0,1,1e-1],[0,0,0,1]]) { cube([1,2,3]); }"),
              make_box({Rational(-1, 2), 0, Rational(1, 10)}, {Rational(3, 2), 1, Rational(31, 10)})));
}

TEST_CASE("OpenSCAD: Booleans are regularized, and nothing is nothing", "[openscad]") {
  const Polyhedron cube = make_box({0, 0, 0}, {1, 1, 1});
  CHECK(equal(eval_openscad(
                  "difference() { cube([2,1,1]); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); } }"),
              cube));
}

TEST_CASE("OpenSCAD: intersections, hulls, differences of nothing", "[openscad]") {
  const Polyhedron cube = make_box({0, 0, 0}, {1, 1, 1});
  const std::string beside = "multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); }";
  CHECK(eval_openscad("intersection() { cube(1); " + beside + " }").is_empty());
  CHECK(equal(eval_openscad("intersection() { cube(3); cube(1); }"), cube));
  CHECK(eval_openscad("intersection() { cube(3); group(); }").is_empty());
  CHECK(eval_openscad("difference() { group(); cube(1); }").is_empty());
  CHECK(equal(eval_openscad("difference() { cube(1); }"), cube));
  CHECK(equal(eval_openscad("hull() { cube(1); multmatrix([[1,0,0,4],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); } }"),
              make_box({0, 0, 0}, {5, 1, 1})));
}

TEST_CASE("OpenSCAD: how many corners circles have", "[openscad]") {
  // $fn wins; 360 / $fa and the circumference / $fs bound the number otherwise; five at least.
  const auto corners = [](const std::string& arguments) {
    return counts(eval_openscad("cylinder(" + arguments + ", h = 1, center = false);")).facets - 2;
  };
  CHECK(corners("$fn = 7, $fa = 12, $fs = 2, r1 = 3, r2 = 3") == 7);
  CHECK(corners("$fn = 2, $fa = 12, $fs = 2, r1 = 3, r2 = 3") == 3);
  CHECK(corners("$fn = 0, $fa = 12, $fs = 2, r1 = 1, r2 = 1") == 5);    // pi < 5
  CHECK(corners("$fn = 0, $fa = 12, $fs = 2, r1 = 3, r2 = 2") == 10);   // 3 pi, rounded up
  CHECK(corners("$fn = 0, $fa = 12, $fs = 2, r1 = 2, r2 = 50") == 30);  // 360 / 12
  CHECK(corners("$fn = 0, $fa = 5, $fs = 0.1, r1 = 50, r2 = 50") == 72);
  CHECK(volume_of("cylinder($fn = 7, h = 4, r1 = 3, r2 = 3);") == Approx(4 * polygon_area(7, 3)).epsilon(1e-14));
  CHECK(volume_of("cylinder($fn = 9, h = 4, r1 = 3, r2 = 0);") == Approx(4 * polygon_area(9, 3) / 3).epsilon(1e-14));
}

TEST_CASE("OpenSCAD: spheres are rings without poles", "[openscad]") {
  for (const unsigned n : {3U, 5U, 8U, 30U}) {
    const unsigned rings = (n + 1) / 2;
    double expected = 0;
    for (unsigned i = 0; i + 1 < rings; ++i) {
      const double a = M_PI * (i + 0.5) / rings;
      const double b = M_PI * (i + 1.5) / rings;
      const double h = 5 * (std::cos(a) - std::cos(b));
      const double r = 5 * std::sin(a);
      const double s = 5 * std::sin(b);
      expected += h / 3 * (polygon_area(n, r) + polygon_area(n, s) + polygon_area(n, 1) * r * s);
    }
    const Polyhedron set = eval_openscad("sphere($fn = " + std::to_string(n) + ", $fa = 12, $fs = 2, r = 5);");
    CHECK(nearest_double(*volume(set)) == Approx(expected).epsilon(1e-13));
    // Planar trapezoids all around, a polygon at each end.
    CHECK(counts(set).facets == (rings - 1) * n + 2);
  }
}

TEST_CASE("OpenSCAD: flat shapes and what is made of them", "[openscad]") {
  CHECK(equal(eval_openscad("square(size = [2, 3], center = true);"),
              make_box({-1, Rational(-3, 2), 0}, {1, Rational(3, 2), 0})));
  const std::string ring =
      "polygon(points = [[0,0],[3,0],[3,3],[0,3],[1,1],[2,1],[2,2],[1,2]], "
      "paths = [[0,1,2,3],[4,5,6,7]], convexity = 1);";
  CHECK(surface_area(eval_openscad(ring)) == Approx(8));
  CHECK(volume(eval_openscad("linear_extrude(height = 5, center = true, scale = [1, 1]) { " + ring + " }")) ==
        Rational(40));
  CHECK(volume(eval_openscad("linear_extrude(height = 3, scale = 0) { " + ring + " }")) == Rational(8));
  CHECK(volume(eval_openscad("linear_extrude(height = 3, scale = [2, 2]) { square(1); }")) == Rational(7));
  // A square turned about z: a ring of trapezoids.
  const std::string turned =
      "rotate_extrude(angle = 360, $fn = 12) { multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],"
      "[0,0,0,1]]) { square(1); } }";
  CHECK(volume_of(turned) == Approx(polygon_area(12, 3) - polygon_area(12, 2)).epsilon(1e-13));
  CHECK(counts(eval_openscad(turned)).volumes == 2);
  CHECK(volume_of("rotate_extrude(angle = 90, $fn = 16) { square([2, 3]); }") ==
        Approx(3 * polygon_area(16, 2) / 4).epsilon(1e-13));
}

TEST_CASE("OpenSCAD: solids from points run clockwise", "[openscad]") {
  CHECK(volume(eval_openscad("polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "
                             "faces = [[0,1,2],[0,3,1],[1,3,2],[0,2,3]], convexity = 1);")) == Rational(1, 6));
}

TEST_CASE("OpenSCAD: what is wrong, and where", "[openscad]") {
  CHECK(openscad_refusal("cube(1)") == "line 1: expected ';', found the end");
  CHECK(openscad_refusal("\n\ngroup() { cube(1);") == "line 3: '{' of line 3 is not closed");
  CHECK(openscad_refusal("cube(1);\ncube(w);").rfind("line 2: 'w' is not a number", 0) == 0);
  CHECK(openscad_refusal("group() {\n text(text = \"a\"); }").rfind("line 2: text: this is not supported", 0) == 0);
  CHECK(openscad_refusal("group() {\n square(1);\n cube(1); }") == "line 1: group: it mixes 2D and 3D objects");
  CHECK(openscad_refusal("minkowski() { cube(1); cube(1); }") ==
        "line 1: minkowski: Minkowski sums cannot be computed here");
  CHECK(openscad_refusal("import(file = \"a.stl\");") == "line 1: import: files cannot be read here");
  CHECK(openscad_refusal("polyhedron(points = [[0,0,0]], faces = [[0,1,2]]);").find("an index does not name a point") !=
        std::string::npos);
  CHECK(openscad_refusal("polygon(points = [[0,0],[1,1],[1,0],[0,1]]);").rfind("line 1: polygon: ", 0) == 0);
  CHECK(openscad_refusal(std::string(100000, '[')).rfind("line 1: ", 0) == 0);
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "group(){";
  CHECK(openscad_refusal(deep).find("nested too deeply") != std::string::npos);
}

TEST_CASE("OpenSCAD: the program reads models and what they import, and sums are computed", "[openscad]") {
  const Workplace here;
  std::filesystem::create_directory(here / "models");
  here.write("models/part.off", cube_off(0, 2));
  here.write("models/a.csg", "difference() { import(file = \"part.off\"); cube(size = [1, 1, 1]); }");
  CHECK(here.nef("eval models/a.csg --json").json()["result"]["volume"] == "7");
  CHECK(here.nef("eval -f models/a.csg --json").json()["result"]["volume"] == "7");
  here.write("m.csg", "minkowski(convexity = 0) { cube(1); cube([1,2,3]); }");
  CHECK(here.nef("eval m.csg --json").json()["result"]["volume"] == "24");
  here.write("flat.csg", "linear_extrude(height=1) { minkowski() { square(1); square([1,2]); } }");
  CHECK(here.nef("eval flat.csg --json").json()["result"]["volume"] == "6");
  check_refused(here.nef("eval missing.csg"), "missing.csg");
  here.write("bad.csg", "cube(1);\ntext(\"a\");");
  check_refused(here.nef("eval bad.csg"), "bad.csg: line 2: text");
  here.write("script.txt", "h = 2; # twice\na = minkowski(box(0,0,0,1,1,h), point(5,5,5));\na - translate(a, [0,0,1])");
  CHECK(here.nef("eval -f script.txt --json").json()["result"]["volume"] == "1");
  check_refused(here.nef("eval -f script.txt nothing"), "-f");
  check_refused(here.nef("eval"), "expression");
}

}  // namespace nef::test
