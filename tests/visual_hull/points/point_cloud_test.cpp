// SPDX-License-Identifier: Apache-2.0
//
// Points of a hull's surface, and masks of the hull, for other programs.
#include "apps/visual_hull/points/point_cloud.h"

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "apps/visual_hull/command/hull_masks.h"
#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/texture/painted.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Rig;
using testing::Scratch;

const Rig kPointRig{8, 120, 90, 220};

TEST_CASE("Points are spread over a surface by area, with outward normals") {
  const nef::Mesh mesh = nef::to_mesh(nef::make_box({0, 0, 0}, {4, 2, 1})).mesh;  // sides of 8, 4, 2
  const std::vector<SurfacePoint> points = sample_surface(mesh, 2800);
  REQUIRE(points.size() == 2800);
  std::array<std::array<int, 2>, 3> count{};
  double left = 0;
  for (const SurfacePoint& point : points) {
    std::size_t axis = 0;
    while (std::abs(point.normal[axis]) < 0.5) ++axis;
    const bool high = point.normal[axis] > 0;
    ++count[axis][high ? 1 : 0];
    CHECK(std::abs(point.normal[axis]) == Approx(1));
    CHECK(point.position[axis] == Approx(high ? std::array{4.0, 2.0, 1.0}[axis] : 0).margin(1e-12));
    left += point.position[0] < 2 ? 1 : 0;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    CHECK(std::abs(count[0][side] - 200) <= 1);
    CHECK(std::abs(count[1][side] - 400) <= 1);
    CHECK(std::abs(count[2][side] - 800) <= 1);
  }
  CHECK(left == Approx(1400).margin(30));
  CHECK(sample_surface(nef::Mesh(), 10).empty());
}

TEST_CASE("Points have the colours of the photographs, and go to PLY and COLMAP's text (--points)") {
  const Scratch scratch;
  const testing::Tracer trace = testing::ellipsoid({1.3, 0.9, 1.1});
  const std::string scene = testing::render(trace, kPointRig, scratch).string() + " --simplify 1 ";
  const std::string text = (scratch.folder() / "points3D.txt").string();
  const std::string ply = (scratch.folder() / "points.ply").string();
  REQUIRE(testing::run(scene + "--samples 300 --points " + text).code == 0);
  REQUIRE(testing::run(scene + "--samples 300 --points " + ply).code == 0);
  std::istringstream lines(nef::read_file(text));
  std::string line;
  std::size_t number = 0;
  double off = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::size_t id = 0;
    testing::Vec p{};
    std::array<int, 3> rgb{};
    int error = 0;
    words >> id >> p[0] >> p[1] >> p[2] >> rgb[0] >> rgb[1] >> rgb[2] >> error;
    REQUIRE(words);
    CHECK(id == ++number);
    CHECK(error == -1);
    const Color truth = testing::smooth_color(p);
    for (std::size_t c = 0; c < 3; ++c) off += std::abs(rgb[c] - truth[c]);
  }
  CHECK(number == 300);
  CHECK(off / 900 < 12);
  const std::string bytes = nef::read_file(ply);
  CHECK_THAT(bytes, Contains("element vertex 300\n") && Contains("property float nz\n") &&
                        Contains("property uchar blue\nend_header\n"));
  CHECK(bytes.size() == bytes.find("end_header\n") + 11 + 300 * 27);
  const testing::Outcome refused = testing::run(scene + "--points " + scratch.folder().string() + "/points.obj");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("the extension must be .ply or .txt"));
}

TEST_CASE("Polygons have no colours: points are grey, and a note says so") {
  const Scratch scratch;
  const std::string ply = (scratch.folder() / "points.ply").string();
  const testing::Outcome outcome =
      testing::run(source_folder() + "/data/visual_hull/letters/mpi.vsh --samples 5 --points " + ply);
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.output, Contains("the points are grey, because the views have no images"));
}

TEST_CASE("Masks of the hull contain it and little else, and a box bounds it (--hull-masks)") {
  const Scratch scratch;
  const auto scene = testing::render(testing::ellipsoid({1.3, 0.9, 1.1}), kPointRig, scratch);
  const std::filesystem::path folder = scratch.folder() / "hull";
  Options options;
  options.silhouette.simplify.tolerance = 1;
  const Result result = compute(read_scene(scene), scratch.folder(), options);
  write_hull_masks(result, folder);
  for (std::size_t view = 0; view < kPointRig.views; ++view) {
    const cv::Mat mask = cv::imread((folder / (testing::name_of_view(view) + ".png")).string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat image = cv::imread((scratch.folder() / testing::name_of_view(view)).string(), cv::IMREAD_UNCHANGED);
    REQUIRE(mask.size() == image.size());
    cv::Mat alpha;
    cv::extractChannel(image, alpha, 3);
    CHECK(cv::countNonZero(mask != alpha) < 0.08 * cv::countNonZero(alpha));
    CHECK(cv::countNonZero(mask == 255) + cv::countNonZero(mask == 0) == mask.rows * mask.cols);
  }
  std::istringstream box(nef::read_file((folder / "bounding_box.txt").string()));
  const auto bounds = nef::bounding_box(result.hull);
  for (std::size_t i = 0; i < 6; ++i) {
    double number = 0;
    box >> number;
    const nef::Rational& side = (*bounds)[i / 3][i % 3];
    CHECK((i < 3 ? nef::Rational(number) <= side : nef::Rational(number) >= side));
    CHECK(number == Approx(nef::nearest_double(side)));
  }
  CHECK_THROWS_WITH(
      write_hull_masks(compute(read_scene(source_folder() + "/data/visual_hull/letters/mpi.vsh"), {}, {}), folder),
      Contains("--hull-masks needs images"));
}

}  // namespace
}  // namespace nef::visual_hull
