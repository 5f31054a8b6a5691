// SPDX-License-Identifier: Apache-2.0
//
// Random recipes through CGAL's Nef_polyhedron_3: both libraries keep the unique representation,
// so their counts of vertices, edges, facets and volumes must be the same.
#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <optional>

#include "tests/support/paths.h"
#include "tests/support/shapes/random_polyhedra.h"

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

// Nothing if CGAL crashes, as it does with (hull(1,0,0,0,0,0,1,2,1) + box(0,0,0,1,1,1)) * hull(0,0,0,1,2,0,2,0,3): then
// there is nothing to compare with.
std::optional<std::string> counts_by_cgal(const Recipe& recipe) {
  std::string command = program_folder() + "/oracle_peer";
  for (const Step& step : recipe.steps) {
    command += std::string(" '") + step.op + "' " + (step.complemented ? "1 " : "0 ") + name_of(step.primitive.shape);
    for (const int n : step.primitive.n) command += " " + std::to_string(n);
  }
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "no pipe: " + command;
  std::array<char, 256> line{};
  const bool answered = std::fgets(line.data(), line.size(), pipe) != nullptr;
  const int status = pclose(pipe);
  if (!answered) {
    // A shell tells of a signal by a code above 128.
    if (WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) > 128)) return std::nullopt;
    return "CGAL failed: " + command;
  }
  std::string result = line.data();
  while (!result.empty() && result.back() == '\n') result.pop_back();
  return result;
}

}  // namespace

TEST_CASE("counts are CGAL's on random recipes") {
  CHECK(rc::check("counts", [] {
    const Recipe recipe = *recipes(true, 4);
    for (const Step& step : recipe.steps) RC_PRE(!degenerate(step.primitive));
    const std::optional<std::string> expected = counts_by_cgal(recipe);
    RC_PRE(expected.has_value());
    const std::string ours = count_text(recipe.make());
    if (ours != *expected) RC_FAIL("ours " + ours + ", CGAL's " + *expected);
  }));
}

}  // namespace nef::test
