// SPDX-License-Identifier: Apache-2.0
//
// render_silhouettes, by the hull of what it draws: the solid less its rim of pixels lies in it, and it lies near the
// solid.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "nef/construct/construct.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

int render(const std::string& arguments) {
  const std::string command = program_folder() + "/render_silhouettes " + arguments + " 2> /dev/null";
  return WEXITSTATUS(std::system(command.c_str()));
}

nef::Polyhedron half_cube(const nef::Rational& half) {
  return nef::make_box({-half, -half, -half}, {half, half, half});
}

TEST_CASE("the hull of rendered silhouettes is the solid but for pixels", "[tools]") {
  const testing::Scratch scratch;
  const std::string folder = scratch.folder().string();
  nef::write_polyhedron(folder + "/cube.off", half_cube(1));
  REQUIRE(render(folder + "/cube.off -o " + folder + "/views --views 24 --up z") == 0);
  std::size_t images = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/views")) {
    images += entry.path().extension() == ".png" ? 1 : 0;
  }
  CHECK(images == 24);
  const testing::Outcome made = testing::run(folder + "/views/cube.json -q -o " + folder + "/hull.nef");
  INFO(made.output);
  REQUIRE(made.code == 0);
  const nef::Polyhedron hull = nef::read_polyhedron(folder + "/hull.nef");
  // A pixel is some hundredth of the cube.
  CHECK(nef::subtract(half_cube(nef::Rational(19, 20)), hull).is_empty());
  CHECK(nef::subtract(hull, half_cube(nef::Rational(3, 2))).is_empty());
}

TEST_CASE("rendering refuses what is no mesh, and what it cannot draw", "[tools]") {
  const testing::Scratch scratch;
  const std::string folder = scratch.folder().string();
  CHECK(render(folder + "/missing.off -o " + folder + "/views") == 2);
  const std::string points = scratch.write("empty.off", "OFF\n0 0 0\n").string();
  CHECK(render(points + " -o " + folder + "/views") == 2);
  CHECK(render(points + " -o " + folder + "/views --views 0") == 2);
}

}  // namespace
}  // namespace nef::visual_hull
