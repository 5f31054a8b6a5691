// SPDX-License-Identifier: Apache-2.0
//
// Colours of a scene whose colours are known: coloured boxes, seen by rays that this test follows itself.
#include "apps/visual_hull/color/vertex_colors.h"

#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_writer.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"
#include "tests/visual_hull/texture/painted.h"

namespace nef::visual_hull {
namespace {

using testing::kSix;
using testing::PaintedBox;
using testing::Rig;
using testing::Vec;

/// Places on the sides of boxes, in a grid, with the colours that they should have.
struct Painted {
  nef::Mesh mesh;
  std::vector<Color> truth;
};

Painted grid_on(const std::vector<PaintedBox>& boxes) {
  constexpr std::uint32_t kCells = 14;
  Painted painted;
  for (const PaintedBox& box : boxes) {
    for (std::size_t side = 0; side < 6; ++side) {
      const std::size_t axis = side / 2;
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const auto base = static_cast<std::uint32_t>(painted.mesh.vertices.size());
      for (std::uint32_t i = 0; i <= kCells; ++i) {
        for (std::uint32_t j = 0; j <= kCells; ++j) {
          nef::Rational3 p;
          p[axis] = side % 2 == 0 ? box.low[axis] : box.high[axis];
          p[u] = box.low[u] + (box.high[u] - box.low[u]) * i / kCells;
          p[v] = box.low[v] + (box.high[v] - box.low[v]) * j / kCells;
          painted.mesh.vertices.push_back(p);
          painted.truth.push_back(box.sides[side]);
          if (i == kCells || j == kCells) continue;
          const std::uint32_t at = base + i * (kCells + 1) + j;
          painted.mesh.push_face(std::array{at, at + kCells + 1, at + kCells + 2, at + 1});
        }
      }
    }
  }
  return painted;
}

TEST_CASE("A box of six colours, and one that hides a part of another") {
  const PaintedBox six{{-1, -0.8, -0.9}, {1, 0.8, 0.9}, kSix};
  PaintedBox white{{-1.6, -1.5, -1.6}, {1.6, 1.5, -1.3}, {}};
  white.sides.fill({250, 250, 250});
  for (const auto& boxes : {std::vector<PaintedBox>{six}, {six, white}}) {
    const testing::Scratch scratch;
    const std::filesystem::path file = testing::render(testing::tracer_of(boxes), Rig(), scratch);
    Options options;
    options.silhouette.simplify.tolerance = 1;
    const Result result = compute(read_scene(file), scratch.folder(), options);
    const Painted painted = grid_on(boxes);
    const VertexColors one = vertex_colors(painted.mesh, result.views, result.origin, {});
    REQUIRE(one.colors.size() == painted.truth.size());
    std::size_t seen = 0;
    std::size_t right = 0;
    for (std::size_t v = 0; v < one.colors.size(); ++v) {
      const nef::Rational3& p = painted.mesh.vertices[v];
      const Vec place{nef::nearest_double(p[0]), nef::nearest_double(p[1]), nef::nearest_double(p[2])};
      if (Rig().views_that_see(testing::tracer_of(boxes), place) < 3) continue;
      ++seen;
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c) same = same && std::abs(one.colors[v][c] - painted.truth[v][c]) <= 10;
      if (same) ++right;
    }
    CHECK(seen > painted.truth.size() / 2);
    // On the edges of the boxes pixels of two sides are mixed; they are a quarter of the places.
    CHECK(right >= seen * 72 / 100);
    CHECK(vertex_colors(painted.mesh, result.views, result.origin, nef::Monitor().on_threads(3)).colors == one.colors);
  }
}

TEST_CASE("Colours are written to PLY, GLB and 3MF, and nowhere else (--color)") {
  const testing::Scratch scratch;
  const std::filesystem::path file =
      testing::render(testing::tracer_of({{{-1, -0.8, -0.9}, {1, 0.8, 0.9}, kSix}}), Rig(), scratch);
  const std::string ply = (scratch.folder() / "hull.ply").string();
  const std::string glb = (scratch.folder() / "hull.glb").string();
  const std::string threemf = (scratch.folder() / "hull.3mf").string();
  for (const std::string& name : {ply, glb, threemf}) {
    const testing::Outcome outcome = testing::run(file.string() + " --simplify 2 --color -o " + name);
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
  }
  const std::string text = nef::read_file(ply);
  CHECK(text.find("property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face") !=
        std::string::npos);
  CHECK(nef::read_file(glb).find("\"COLOR_0\"") != std::string::npos);
  const testing::Outcome refused = testing::run(file.string() + " --color -o " + (scratch.folder() / "h.off").string());
  CHECK(refused.code == 2);
  CHECK(refused.output.find("PLY, GLB and 3MF") != std::string::npos);
}

TEST_CASE("The photograph of a mask lies in the folder images beside it") {
  const testing::Scratch scratch;
  std::filesystem::create_directories(scratch.folder() / "masks");
  std::filesystem::create_directories(scratch.folder() / "images");
  const auto mask = scratch.write("masks/a.png", "");
  CHECK(photograph_of(mask) == mask);
  const auto photograph = scratch.write("images/a.jpg", "");
  CHECK(photograph_of(mask) == photograph);
  CHECK(photograph_of(photograph) == photograph);
}

}  // namespace
}  // namespace nef::visual_hull
