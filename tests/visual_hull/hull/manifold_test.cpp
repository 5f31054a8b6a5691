// SPDX-License-Identifier: Apache-2.0
//
// --manifold: each edge of the mesh, named by its vertices, has two faces.
#include <opencv2/imgcodecs.hpp>

#include "nef/io/mesh/mesh_reader.h"
#include "tests/support/paths.h"
#include "tests/support/shapes/two_manifold.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using nef::test::not_two_manifold;

std::string problem_of(const std::string& arguments, const std::string& file) {
  const testing::Outcome outcome = testing::run(arguments + " -o " + file);
  INFO(outcome.output);
  REQUIRE(outcome.code == 0);
  return not_two_manifold(nef::read_mesh(file));
}

TEST_CASE("Real views with diagonal pixels: pinched edges, and none with --manifold") {
  const testing::Scratch scratch;
  for (const std::string scene : {"elk/elk.json", "eight/eight.json"}) {
    const std::string file = (scratch.folder() / "hull.ply").string();
    CHECK(problem_of(source_folder() + "/data/visual_hull/" + scene + " --manifold", file) == "");
    CHECK(problem_of(source_folder() + "/data/visual_hull/" + scene + " --simplify 1 --manifold", file) == "");
  }
}

TEST_CASE("Noise of diagonal pixels, seen from three sides") {
  const testing::Scratch scratch;
  std::string scene = R"({"cameras": [)";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const cv::Mat mask = testing::random_mask(9, 9, 0, 7 + axis);
    const std::string name = "mask" + std::to_string(axis) + ".png";
    REQUIRE(cv::imwrite((scratch.folder() / name).string(), mask));
    // 20 away, seen at half a pixel a unit.
    std::string matrix = "[";
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t row = 0; row < 3; ++row) {
      std::array<double, 4> m{};
      if (row == 0) m[u] = 40;
      if (row == 1) m[v] = 40;
      m[axis] = row < 2 ? 4 : 1;
      m[3] = row < 2 ? 80 + 3.0 * static_cast<double>(axis) : 20;
      matrix += (row > 0 ? ",[" : "[");
      for (std::size_t k = 0; k < 4; ++k) matrix += (k > 0 ? "," : "") + std::to_string(m[k]);
      matrix += "]";
    }
    scene += (axis > 0 ? "," : "") + std::string(R"({"image": ")") + name + R"(", "P": )" + matrix + "]}";
  }
  const auto file = scratch.write("scene.json", scene + R"(], "box": [-5, -5, -5, 5, 5, 5]})");
  const std::string plain = (scratch.folder() / "plain.off").string();
  CHECK(problem_of(file.string(), plain) != "");
  for (const char* extension : {"off", "obj", "ply"}) {
    const std::string split = (scratch.folder() / "split.").string() + extension;
    CHECK(problem_of(file.string() + " --manifold", split) == "");
  }
  const testing::Outcome refused =
      testing::run(file.string() + " --manifold -o " + (scratch.folder() / "h.stl").string());
  CHECK(refused.code == 2);
}

}  // namespace
}  // namespace nef::visual_hull
