// SPDX-License-Identifier: Apache-2.0
//
// Video: hulls frame by frame, from memory and from files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "apps/visual_hull/command/frames.h"
#include "apps/visual_hull/stream.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/export/to_mesh.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;

// The example in stream.h, as it is printed there (tests/docs/check_snippets.py compares them).
struct Grabber {
  bool grab(std::vector<cv::Mat>& masks) const { return left > masks.size(); }
  std::size_t left = 0;
};
[[maybe_unused]] void example(const nef::visual_hull::Options& options, const Grabber& camera,
                              std::vector<cv::Mat>& masks) {
  const nef::visual_hull::HullStream stream(nef::visual_hull::read_scene("rig.json"), options);
  while (camera.grab(masks)) nef::Mesh mesh = nef::to_mesh(stream.frame(masks).hull).mesh;
}

fs::path elk() { return fs::path(source_folder()) / "data/visual_hull/elk"; }

// Frame k of a film: the elk's masks without the pixels of the first 8 k columns.
std::vector<cv::Mat> film_frame(const Scene& scene, int k) {
  std::vector<cv::Mat> masks;
  for (const View& view : scene.views) {
    cv::Mat mask = cv::imread((elk() / view.image).string(), cv::IMREAD_GRAYSCALE) > 127;
    mask.colRange(0, std::min(130 + 8 * k, mask.cols)).setTo(0);
    masks.push_back(mask);
  }
  return masks;
}

void write_frame(const fs::path& folder, const Scene& scene, int k) {
  fs::create_directories(folder);
  const std::vector<cv::Mat> masks = film_frame(scene, k);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    cv::imwrite((folder / scene.views[i].image).string(), masks[i]);
  }
}

TEST_CASE("A stream gives the hull that each frame has by itself, on any number of threads", "[threads]") {
  const Scene scene = read_scene(elk() / "elk.json");
  Options options;
  options.silhouette.simplify.tolerance = 1;
  const HullStream stream(scene, options);
  constexpr std::size_t kFrames = 4;
  std::vector<nef::Polyhedron> hulls(kFrames);
  nef::parallel_for(kFrames, nef::Monitor().on_threads(3), [&](std::size_t k, const nef::Monitor&) {
    const std::vector<cv::Mat> masks = film_frame(scene, static_cast<int>(k));
    hulls[k] = stream.frame(masks).hull;
  });
  for (std::size_t k = 0; k < kFrames; ++k) {
    const Scratch s;
    write_frame(s.folder(), scene, static_cast<int>(k));
    const Result alone = compute(scene, s.folder(), options);
    CHECK(nef::equal(hulls[k], alone.hull));
    CHECK_FALSE(alone.hull.is_empty());
  }
  CHECK_FALSE(nef::equal(hulls[0], hulls[3]));

  std::vector<cv::Mat> masks = film_frame(scene, 0);
  const cv::Mat before = masks[0].clone();
  static_cast<void>(stream.frame(masks));
  CHECK(cv::countNonZero(masks[0] != before) == 0);  // only read
  masks[2] = cv::Mat(240, 320, CV_8U, cv::Scalar(0));
  CHECK_THROWS_WITH(stream.frame(masks), Contains("elk_02.png") && Contains("empty"));
  masks[2] = cv::Mat(240, 320, CV_32F, cv::Scalar(1));
  CHECK_THROWS_WITH(stream.frame(masks), Contains("elk_02.png") && Contains("8 bits"));
  masks.pop_back();
  CHECK_THROWS_WITH(stream.frame(masks), Contains("12, not 11"));
}

TEST_CASE("Paths with a place for a number") {
  CHECK(NumberedPath("a/f_%04d/x", "-o").of(12) == "a/f_0012/x");
  CHECK(NumberedPath("%d", "-o").of(0) == "0");
  CHECK(NumberedPath("f%02d", "-o").of(123) == "f123");
  for (const char* bad : {"", "a", "%", "%s", "%4d", "%d%d", "%d%", "%0000d", "%n", "a%04"}) {
    INFO(bad);
    CHECK_THROWS_AS(NumberedPath(bad, "-o"), nef::InputError);
  }
  const Scratch s;
  for (const char* name : {"f_1", "f_02", "f_003", "f_10", "f_100", "g_04", "f_x"}) {
    fs::create_directories(s.folder() / name / "in");
  }
  CHECK(NumberedPath((s.folder() / "f_%02d").string(), "-o").existing() == std::vector<std::size_t>{2, 10, 100});
  CHECK(NumberedPath((s.folder() / "f_%d/in").string(), "-o").existing() == std::vector<std::size_t>{1, 10, 100});
  CHECK(NumberedPath((s.folder() / "f_%d/out").string(), "-o").existing().empty());
}

std::vector<nlohmann::json> lines_of(const fs::path& file) {
  std::istringstream stream(nef::read_file(file.string()));
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

TEST_CASE("Frames from files: a hull each, a manifest, and only what is new the next time") {
  const Scratch s;
  const Scene scene = read_scene(elk() / "elk.json");
  for (const int k : {0, 1, 2}) write_frame(s.folder() / ("frame_000" + std::to_string(k)), scene, k);
  const std::string command = (elk() / "elk.json").string() + " --simplify 2 --threads 2 --frames '" +
                              (s.folder() / "frame_%04d/").string() + "' -o '" +
                              (s.folder() / "hull_%04d.nef").string() + "'";
  const Outcome first = run(command);
  INFO(first.output);
  REQUIRE(first.code == 0);
  const fs::path manifest = s.folder() / "hull_manifest.jsonl";
  std::vector<nlohmann::json> lines = lines_of(manifest);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0]["settings"]["simplify"] == 2);
  Options options;
  options.silhouette.simplify.tolerance = 2;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(lines[k + 1]["frame"] == k);
    CHECK(lines[k + 1]["state"] == "done");
    const Result alone = compute(scene, s.folder() / ("frame_000" + std::to_string(k)), options);
    CHECK(nef::equal(nef::read_polyhedron((s.folder() / ("hull_000" + std::to_string(k) + ".nef")).string()),
                     alone.hull));
    CHECK(lines[k + 1]["vertices"] == nef::counts(alone.hull).vertices);
  }

  // Stopped: a hull and the end of the manifest are missing. One frame has new images, and one is new and lacks one.
  fs::remove(s.folder() / "hull_0000.nef");
  const std::string text = nef::read_file(manifest.string());
  s.write("hull_manifest.jsonl", text.substr(0, text.size() - 30));
  const auto untouched = fs::last_write_time(s.folder() / "hull_0001.nef");
  write_frame(s.folder() / "frame_0003", scene, 3);
  fs::remove(s.folder() / "frame_0003/elk_05.png");
  const Outcome second = run(command);
  INFO(second.output);
  CHECK(second.code == 2);
  CHECK_THAT(second.output,
             Contains("frame 3: ") && Contains("elk_05.png") && Contains("4 frames, 1 of them made before"));
  CHECK(fs::last_write_time(s.folder() / "hull_0001.nef") == untouched);
  CHECK(fs::exists(s.folder() / "hull_0000.nef"));
  CHECK_FALSE(fs::exists(s.folder() / "hull_0003.nef"));
  lines = lines_of(manifest);
  REQUIRE(lines.size() == 5);
  CHECK(lines[4]["state"] == "failed");

  write_frame(s.folder() / "frame_0003", scene, 3);
  write_frame(s.folder() / "frame_0001", scene, 0);  // as frame 0
  const Outcome third = run(command);
  CHECK(third.code == 0);
  CHECK_THAT(third.output, Contains("4 frames, 2 of them made before"));
  // Other settings make all of them anew.
  CHECK_THAT(run(command + " --outer").output, Contains("4 frames, 0 of them made before"));
  CHECK_THAT(run(command + " --json").output, Contains("--json is for one hull"));
  CHECK_THAT(run((elk() / "elk.json").string() + " --frames 'nowhere_%d' -o 'x_%d.off'").output,
             Contains("there is no such folder"));
}

}  // namespace
}  // namespace nef::visual_hull
