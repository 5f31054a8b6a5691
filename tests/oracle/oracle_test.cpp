// SPDX-License-Identifier: Apache-2.0
//
// Random recipes through CGAL's Nef_polyhedron_3: both libraries keep the unique representation,
// so their counts of vertices, edges, facets and volumes must be the same.
#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <memory>

#include "tests/support/paths.h"
#include "tests/support/random_polyhedra.h"

namespace nef::test {
namespace {

const char* name_of(Shape shape) {
  switch (shape) {
    case Shape::kBox:
      return "box";
    case Shape::kOpenBox:
      return "open_box";
    case Shape::kTetrahedron:
      return "tetrahedron";
    case Shape::kTriangle:
      return "triangle";
    case Shape::kSegment:
      return "segment";
    default:
      return "point";
  }
}

// CGAL's constructors want simplices of full dimension.
bool degenerate(const Primitive& p) {
  std::array<Rational3, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = {Rational(p.n[3 * i]), Rational(p.n[3 * i + 1]), Rational(p.n[3 * i + 2])};
  const Rational3 a = detail::minus(v[1], v[0]);
  const Rational3 n = detail::cross(a, detail::minus(v[2], v[0]));
  if (p.shape == Shape::kTetrahedron) return detail::dot(n, detail::minus(v[3], v[0])) == 0;
  if (p.shape == Shape::kTriangle) return detail::dot(n, n) == 0;
  return p.shape == Shape::kSegment && detail::dot(a, a) == 0;
}

std::string counts_by_cgal(const Recipe& recipe) {
  std::string command = program_folder() + "/oracle_peer";
  for (const Step& step : recipe.steps) {
    command += std::string(" '") + step.op + "' " + (step.complemented ? "1 " : "0 ") + name_of(step.primitive.shape);
    for (const int n : step.primitive.n) command += " " + std::to_string(n);
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 256> line{};
  if (!pipe || std::fgets(line.data(), line.size(), pipe.get()) == nullptr) return "CGAL failed: " + command;
  std::string result = line.data();
  while (!result.empty() && result.back() == '\n') result.pop_back();
  return result;
}

}  // namespace

TEST_CASE("counts are CGAL's on random recipes") {
  CHECK(rc::check("counts", [] {
    const Recipe recipe = *recipes(true, 4);
    for (const Step& step : recipe.steps) RC_PRE(!degenerate(step.primitive));
    const std::string expected = counts_by_cgal(recipe);
    const std::string ours = count_text(recipe.make());
    if (ours != expected) RC_FAIL("ours " + ours + ", CGAL's " + expected);
  }));
}

}  // namespace nef::test
