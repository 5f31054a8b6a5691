// SPDX-License-Identifier: Apache-2.0
//
// Booleans of solids that are turned and shifted, so that no coordinate is a number of a file format, written in every
// mesh format and read back. What is read must be closed and strictly legal by a check of this file: the rationals of
// every two triangles, without the suite's filters, trees and predicates. A solid that cannot be written is refused,
// and counted.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fuzz/fuzzer.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "tests/support/strict_mesh.h"
#include "tests/support/temporary_folder.h"

namespace nef::fuzz {
namespace {

// A roof of two rectangles over a round body of triangles: a few polygons with common corners among many triangles.
std::vector<Rational3> roofed_body(Choices& choices) {
  const Rational rise = Rational(choices.between(1, 5)) / 3;
  std::vector<Rational3> points{{0, 0, 0}, {0, 2, 0}, {1, 0, rise}, {1, 2, rise}, {2, 0, 0}, {2, 2, 0}};
  const int digits = choices.element(std::array{10, 1000, 1000000});
  for (int i = choices.between(4, 40); i > 0; --i) {
    const double x = choices.between(-1000, 1000);
    const double y = choices.between(-1000, 1000);
    const double z = choices.between(-1000, 700);
    const double length = std::max(1.0, std::hypot(x, y, z));
    const auto decimal = [&](double part) { return Rational(std::lround(2 * digits * part / length)) / digits; };
    points.push_back({decimal(x) + 1, decimal(y) + 1, decimal(z) - 3});
  }
  return points;
}

Polyhedron turned_solid(const Case& the_case, int far) {
  Choices& choices = the_case.choices();
  Polyhedron solid;
  std::string text;
  switch (choices.below(5)) {
    case 0: {
      const int x = choices.between(1, 4);
      const int y = choices.between(1, 4);
      const int z = choices.between(1, 4);
      solid = make_box({-x, -y, -z}, {x, y, z});
      text = "box(" + std::to_string(-x) + "," + std::to_string(-y) + "," + std::to_string(-z) + "," +
             std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + ")";
      break;
    }
    case 1: {
      const int r = choices.between(1, 4);
      const int n = choices.between(4, 10);
      solid = make_sphere(r, static_cast<unsigned>(n));
      text = "sphere(" + std::to_string(r) + "," + std::to_string(n) + ")";
      break;
    }
    case 2: {
      const std::vector<Rational3> points = roofed_body(choices);
      solid = convex_hull(points);
      for (const Rational3& p : points) {
        text += (text.empty() ? "hull((" : ", (") + p[0].get_str() + "," + p[1].get_str() + "," + p[2].get_str() + ")";
      }
      text += ")";
      break;
    }
    default: {
      const int r = choices.between(1, 3);
      const int h = choices.between(1, 6);
      const int n = choices.between(3, 12);
      solid = make_cylinder(h, r, r, static_cast<unsigned>(n));
      text = "cylinder(" + std::to_string(h) + "," + std::to_string(r) + "," + std::to_string(n) + ")";
      break;
    }
  }
  if (!choices.one_in(4)) {
    const Rational3 axis{choices.between(-1, 1), choices.between(-1, 1), 1};
    const int angle = choices.between(1, 179);
    solid = transform(solid, AffineMap::rotate(axis, angle, 1e-6));
    text = "rotate(" + text + "," + axis[0].get_str() + "," + axis[1].get_str() + ",1," + std::to_string(angle) + ")";
  }
  const auto part = [&]() -> Rational { return Rational(choices.between(-6, 6)) / (choices.one_in(2) ? 1 : 3); };
  Rational3 shift{part(), part(), part()};
  for (Rational& x : shift) x += far;
  solid = transform(solid, AffineMap::translate(shift));
  the_case.tell("translate(" + text + "," + shift[0].get_str() + "," + shift[1].get_str() + "," + shift[2].get_str() +
                ")");
  return solid;
}

}  // namespace

void fuzz_written(const Case& the_case) {
  Choices& choices = the_case.choices();
  static constexpr std::array kFar{0, 0, 0, 1000, 70000, 1400000};
  const int far = choices.element(kFar);
  Polyhedron set = turned_solid(the_case, far);
  for (std::uint32_t i = 1 + choices.below(3); i > 0; --i) {
    const bool adds = choices.below(2) == 1;
    the_case.tell(adds ? "united with" : "less");
    const Polyhedron other = turned_solid(the_case, far);
    set = adds ? unite(set, other) : subtract(set, other);
  }
  set = regularize(set);
  const bool recenter = choices.one_in(4);
  const test::TemporaryFolder folder;
  for (const auto& [name, binary] : {std::pair("a.off", false),
                                     {"a.obj", false},
                                     {"a.ply", false},
                                     {"a.stl", false},
                                     {"b.ply", true},
                                     {"b.stl", true},
                                     {"a.3mf", false},
                                     {"a.glb", false}}) {
    PolyhedronWriteOptions options;
    options.binary = binary;
    options.recenter = recenter;
    the_case.count("files");
    try {
      write_polyhedron(folder.file(name), set, options);
    } catch (const UnsupportedError&) {
      the_case.count("refused");
      continue;
    }
    const std::string why = test::not_strictly_legal(read_mesh(folder.file(name)));
    Case::require(why.empty(), "illegal: " + std::string(name) + ": " + why);
  }
}

}  // namespace nef::fuzz
