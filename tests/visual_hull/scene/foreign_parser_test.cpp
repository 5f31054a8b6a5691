// SPDX-License-Identifier: Apache-2.0
//
// Files that make the libraries which parse them crash or grow: refused in a line, within bounds.
#include "apps/visual_hull/formats/foreign_parser.h"

#include <algorithm>
#include <csignal>

#include "nef/base/error.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scene/mat_file.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST_CASE("OpenCV's storage nested without end, and MATLAB's arrays without data, are refused in a line") {
  const Scratch s;
  constexpr int kDeep = 100000;
  const auto check = [&](const std::filesystem::path& file) {
    const Outcome outcome = run(file.string() + " --check");
    INFO(file << ": " << outcome.output.substr(0, 500));
    CHECK(outcome.code == 2);
    CHECK(std::count(outcome.output.begin(), outcome.output.end(), '\n') == 1);
    CHECK_THAT(outcome.output, Catch::StartsWith("visual_hull: ") && Contains(file.filename().string()));
  };
  check(s.write("brackets.yml", "%YAML:1.0\n---\nP0: " + repeated("[", kDeep)));
  check(s.write("closed.yml", "%YAML:1.0\n---\nP0: " + repeated("[", kDeep) + repeated("]", kDeep) + "\n"));
  check(s.write("maps.yml", "%YAML:1.0\n---\nP0: " + repeated("{a: ", kDeep)));
  check(s.write("dashes.yml", "%YAML:1.0\n---\nP0: " + repeated("- ", kDeep)));
  check(s.write("tags.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n" + repeated("<a>", kDeep)));
  check(s.write("closed.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n" + repeated("<a>", kDeep) +
                                  repeated("</a>", kDeep) + "</opencv_storage>\n"));
  check(s.write("brackets.json", "{\"cameras\": " + repeated("[", kDeep)));
  check(s.write("objects.json", "{\"cameras\": " + repeated("{\"a\": ", kDeep)));
  // Sixty-five million cells, or numbers, of which none is there.
  check(s.write("cells.mat", testing::mat_header() + testing::mat_array(testing::kMatCell, {65536, 1000}, "P", "")));
  check(s.write("numbers.mat",
                testing::mat_header() + testing::mat_array(testing::kMatDouble, {3, 4, 100000000}, "P", "")));
}

TEST_CASE("A scene comes through the process with limits as it is") {
  Scene scene;
  scene.format = "by hand";
  scene.origin = PixelOrigin::kCorner;
  scene.ignored = {"this", "caf\xe9"};  // no UTF-8
  View view;
  view.name = "\xff";
  view.image = "a\xff.png";
  view.camera = Camera("other", {{{Rational(1, 3), 0, 0, 1}, {0, 2, 0, 2}, {0, 0, 1, nef::exact_rational(0.1)}}});
  view.distortion.coefficients = {-0.28, 1e-300, 0.1, 3};
  view.distortion.intrinsics = {{{500, 0, Rational(1, 7)}, {0, 501, 2}, {0, 0, 1}}};
  view.size = ImageSize{640, 480};
  scene.views = {view, View{}};
  const Scene read = read_with_limits("file", "a parser", 0, [&] { return scene; });
  CHECK(read.format == scene.format);
  CHECK(read.origin == scene.origin);
  CHECK(read.ignored == scene.ignored);
  REQUIRE(read.views.size() == 2);
  const View& got = read.views[0];
  CHECK(got.name == view.name);
  CHECK(got.image == view.image);
  CHECK(got.camera.name() == "other");
  CHECK(got.camera.matrix() == view.camera.matrix());
  CHECK(got.distortion.coefficients == view.distortion.coefficients);
  CHECK(got.distortion.intrinsics == view.distortion.intrinsics);
  REQUIRE(got.size);
  CHECK(got.size->width == 640);
  CHECK(got.size->height == 480);
  CHECK_FALSE(read.views[1].size);

  CHECK_THROWS_WITH(read_with_limits("file", "a parser", 0, []() -> Scene { throw nef::InputError("no cameras"); }),
                    "no cameras");
  CHECK_THROWS_WITH(read_with_limits("file", "a parser", 0,
                                     []() -> Scene {
                                       static_cast<void>(raise(SIGKILL));
                                       return {};
                                     }),
                    Contains("file: a parser could not read the file within 512 MB"));
}

}  // namespace
}  // namespace nef::visual_hull
