// SPDX-License-Identifier: Apache-2.0
//
// Colours of a scene whose colours are known: coloured boxes, seen by rays that this test follows itself.
#include "apps/visual_hull/color/vertex_colors.h"

#include <opencv2/imgcodecs.hpp>

#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_writer.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Vec = std::array<double, 3>;

struct PaintedBox {
  Vec low, high;
  std::array<Color, 6> sides;  // -x, +x, -y, +y, -z, +z
};

const std::array<Color, 6> kSix{{{200, 0, 0}, {0, 200, 0}, {0, 0, 200}, {200, 200, 0}, {200, 0, 200}, {0, 200, 200}}};

// Where a ray meets something first, and the colour there.
std::pair<double, Color> first_along(const std::vector<PaintedBox>& boxes, const Vec& from, const Vec& direction) {
  std::pair<double, Color> nearest{INFINITY, {}};
  for (const PaintedBox& box : boxes) {
    double enter = -INFINITY;
    double leave = INFINITY;
    std::size_t side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double a = (box.low[k] - from[k]) / direction[k];
      double b = (box.high[k] - from[k]) / direction[k];
      const bool back = a > b;
      if (back) std::swap(a, b);
      if (a > enter) {
        enter = a;
        side = 2 * k + (back ? 1 : 0);
      }
      leave = std::min(leave, b);
    }
    if (enter < leave && enter < nearest.first) nearest = {enter, box.sides[side]};
  }
  return nearest;
}

double distance_along(const std::vector<PaintedBox>& boxes, const Vec& from, const Vec& direction) {
  return first_along(boxes, from, direction).first;
}

constexpr int kSize = 240;
constexpr double kFocal = 500;

// From 10 away, a little off every axis.
Vec direction_of(std::size_t view) {
  const double z = 1 - (2 * static_cast<double>(view) + 1) / 26;
  const double angle = 2.399963 * static_cast<double>(view) + 0.3;
  return {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
}

std::array<Vec, 3> axes_of(const Vec& back) {
  const double length = std::hypot(back[0], back[1]);
  const Vec right{-back[1] / length, back[0] / length, 0};
  const Vec ahead{-back[0], -back[1], -back[2]};
  const Vec down{ahead[1] * right[2] - ahead[2] * right[1], ahead[2] * right[0] - ahead[0] * right[2],
                 ahead[0] * right[1] - ahead[1] * right[0]};
  return {right, down, ahead};
}

// Images with alpha, and the cameras in a text file of matrices. Returns the scene's file.
std::filesystem::path render(const std::vector<PaintedBox>& boxes, const testing::Scratch& scratch) {
  std::string cameras;
  for (std::size_t view = 0; view < 26; ++view) {
    const Vec back = direction_of(view);
    const Vec from{10 * back[0], 10 * back[1], 10 * back[2]};
    const std::array<Vec, 3> axes = axes_of(back);
    cv::Mat image(kSize, kSize, CV_8UC4, cv::Scalar(90, 90, 90, 0));
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double u = (x - kSize / 2.0) / kFocal;
        const double v = (y - kSize / 2.0) / kFocal;
        Vec ray{};
        for (std::size_t k = 0; k < 3; ++k) ray[k] = u * axes[0][k] + v * axes[1][k] + axes[2][k];
        const auto [distance, color] = first_along(boxes, from, ray);
        if (std::isfinite(distance)) image.at<cv::Vec4b>(y, x) = {color[2], color[1], color[0], 255};
      }
    }
    const std::string name = "view" + std::to_string(10 + view) + ".png";
    REQUIRE(cv::imwrite((scratch.folder() / name).string(), image));
    cameras += name;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec row = axes[i];
      if (i < 2) {
        for (std::size_t k = 0; k < 3; ++k) row[k] = kFocal * axes[i][k] + kSize / 2.0 * axes[2][k];
      }
      const double offset = -(row[0] * from[0] + row[1] * from[1] + row[2] * from[2]);
      for (const double number : {row[0], row[1], row[2], offset}) cameras += " " + std::to_string(number);
    }
    cameras += "\n";
  }
  return scratch.write("cameras.txt", cameras);
}

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

// In how many views nothing comes before a place, by the test's own rays.
std::size_t views_that_see(const std::vector<PaintedBox>& boxes, const nef::Rational3& place) {
  std::size_t count = 0;
  for (std::size_t view = 0; view < 26; ++view) {
    const Vec back = direction_of(view);
    Vec from{};
    Vec ray{};
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = 10 * back[k];
      ray[k] = 0.999 * (nef::nearest_double(place[k]) - from[k]);
    }
    if (distance_along(boxes, from, ray) > 1) ++count;
  }
  return count;
}

TEST_CASE("A box of six colours, and one that hides a part of another") {
  const PaintedBox six{{-1, -0.8, -0.9}, {1, 0.8, 0.9}, kSix};
  PaintedBox white{{-1.6, -1.5, -1.6}, {1.6, 1.5, -1.3}, {}};
  white.sides.fill({250, 250, 250});
  for (const auto& boxes : {std::vector<PaintedBox>{six}, {six, white}}) {
    const testing::Scratch scratch;
    const std::filesystem::path file = render(boxes, scratch);
    Options options;
    options.silhouette.simplify.tolerance = 1;
    const Result result = compute(read_scene(file), scratch.folder(), options);
    const Painted painted = grid_on(boxes);
    const VertexColors one = vertex_colors(painted.mesh, result.views, result.origin, {});
    REQUIRE(one.colors.size() == painted.truth.size());
    std::size_t seen = 0;
    std::size_t right = 0;
    for (std::size_t v = 0; v < one.colors.size(); ++v) {
      if (views_that_see(boxes, painted.mesh.vertices[v]) < 3) continue;
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

TEST_CASE("Colours are written to PLY and GLB, and nowhere else (--color)") {
  const testing::Scratch scratch;
  const std::filesystem::path file = render({{{-1, -0.8, -0.9}, {1, 0.8, 0.9}, kSix}}, scratch);
  const std::string ply = (scratch.folder() / "hull.ply").string();
  const std::string glb = (scratch.folder() / "hull.glb").string();
  for (const std::string& name : {ply, glb}) {
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
  CHECK(refused.output.find("PLY and GLB") != std::string::npos);
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
