// SPDX-License-Identifier: Apache-2.0
//
// What is said of scenes that cannot be read: where, what and how to mend it, and nothing of files that are none.
#include <catch2/catch.hpp>

#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Scratch;

std::string refusal_of_file(const std::filesystem::path& file) {
  try {
    read_scene(file);
  } catch (const nef::Error& error) {
    return error.what();
  }
  return "";
}

TEST_CASE("Numbers beyond all measure are refused at once, with their place and a remedy") {
  const Scratch s;
  const std::string json = R"({"cameras": [{"image": "a.png", "K": [[1,0,0],[0,1,0],[0,0,1]],
    "R": [[1,0,0],[0,1,0],[0,0,1]], "t": [0, 0, )";
  CHECK_THAT(refusal_of_file(s.write("a.json", json + "1e400]}]}")),
             Contains("a.json:2: the number 1e400 is too large for JSON: write it as a string"));
  CHECK_THAT(refusal_of_file(s.write("b.json", json + "\"1e400\"]}]}")),
             Contains("camera 1 (a.png), t") && Contains("too large") && Contains("larger unit of length"));
  CHECK_THAT(refusal_of_file(s.write("c.json", json + "1e61]}]}")), Contains("too large"));
  CHECK(refusal_of_file(s.write("d.json", json + "1e60]}]}")).empty());

  const std::string room = "-1 -1 -1\n1 1 1\n1\n0 9 ";
  CHECK_THAT(refusal_of_file(s.write("a.vsh", room + "1e309\n")),
             Contains("a.vsh:4: '1e309' (centre of camera 1) is too large") && Contains("larger unit of length"));
  CHECK_THAT(refusal_of_file(s.write("b.vsh", "-1e309 -1 -1\n1 1 1\n")),
             Contains("b.vsh:1: a word (smallest corner of the box)"));
  CHECK_THAT(refusal_of_file(s.write("c.vsh", room + "x\n")),
             Contains("c.vsh:4: 'x' is not a number (centre of camera 1)"));
  CHECK_THAT(refusal_of_file(s.write("d.vsh", room)), Contains("d.vsh:4: the file ends before the centre of camera 1"));
  CHECK_THAT(refusal_of_file(s.write("a.txt", "a 1 0 0 0 0 1 0 0 0 0 1 0\nb 1 0 0 0 0 1 0 0 0 0 1 1e309\n")),
             Contains("line 2: '1e309'") && Contains("too large"));
  CHECK_THAT(
      refusal_of_file(s.write("transforms.json", R"({"fl_x": 1e61, "w": 2, "h": 2, "frames": [{"transform_matrix":
    [1,0,0,0,0,1,0,0,0,0,1,0]}]})")),
      Contains("fl_x") && Contains("too large"));
  CHECK_THROWS_WITH(parse_box("0,0,0,1,1,1e309"), Contains("--box") && Contains("too large"));
}

// The words of other files are nobody's business: they may be passwords.
TEST_CASE("Of a file that is not what its name says nothing is told, of others forty characters of a word") {
  const Scratch s;
  const std::string secret = "hunter2:x:0:0:hunter2:/home/hunter2:/bin/sh\nhunter2 again\n";
  for (const char* name : {"a.vsh", "a.json", "a.txt", "a.yml", "a.xml", "a.mat", "par.txt", "images.txt"}) {
    INFO(name);
    const std::string said = refusal_of_file(s.write(name, secret));
    CHECK_FALSE(said.empty());
    CHECK_THAT(said, !Contains("hunter2"));
  }
  std::filesystem::create_directories(s.folder() / "model");
  s.write("model/cameras.txt", secret);
  s.write("model/images.txt", secret);
  CHECK_THAT(refusal_of_file(s.folder() / "model"), !Contains("hunter2") && Contains("line 1"));
  s.write("model/cameras.txt", "1 PINHOLE 200 100 100 100 100 50\n");
  CHECK_THAT(refusal_of_file(s.folder() / "model"), !Contains("hunter2") && Contains("line 1"));
  std::filesystem::create_directories(s.folder() / "par");
  s.write("par/a.pa", secret);
  CHECK_THAT(refusal_of_file(s.folder() / "par"), !Contains("hunter2"));

  const std::string word(1000, 'w');
  const auto brief = [&](const std::string& name, const std::string& text) {
    INFO(name);
    const std::string said = refusal_of_file(s.write(name, text));
    CHECK_THAT(said, Contains("www"));
    CHECK_THAT(said, !Contains(std::string(41, 'w')));
  };
  brief("b.vsh", "-1 -1 -1\n1 1 1\n1\n0 9 " + word);
  brief("c.vsh", "-1 -1 -1\n1 1 1\n" + word);
  brief("b.txt", "a 1 0 0 0 0 1 0 0 0 0 1 0\nb 1 0 0 0 0 1 0 0 0 0 1 " + word + "\n");
  brief("b.json", R"({"cameras": [{"image": "a", "P": [")" + word + R"("]}]})");
  brief("c.json", R"({"cameras": [{"image": [")" + word + R"("]}]})");
  brief("transforms.json", R"({"frames": [{"file_path": [")" + word + R"("]}]})");
  brief("blocks.txt", "# Intrinsic parameters\n1 0 0\n0 1 0\n0 0 " + word + "\n# Extrinsic parameters for IMAGE a\n");
  s.write("model/cameras.txt", "1 " + word + " 200 100\n");
  CHECK_THAT(refusal_of_file(s.folder() / "model"), Contains("www") && !Contains(std::string(41, 'w')));
  CHECK_THROWS_WITH(parse_threshold(word), !Contains(std::string(41, 'w')));
}

TEST_CASE("A scene of any size that its numbers can have is bounded by its cones") {
  for (const char* unit : {"1e-40", "1e29", "1e45", "1e55"}) {
    INFO(unit);
    const Rational scale = nef::parse_rational(unit);
    Scene scene;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rational3 centre;
      centre[axis] = 10 * scale;
      View view;
      view.name = std::to_string(axis);
      view.camera = testing::axis_camera(centre, axis, -1, view.name);
      view.polygons = std::vector<Ring>{testing::rectangle(-0.1, -0.1, 0.1, 0.1)};
      scene.views.push_back(view);
    }
    const Result result = compute(scene, ".", {});
    CHECK(result.box_found);
    CHECK_FALSE(result.hull.is_empty());
    CHECK(result.box.high[0] < 3 * scale);
    CHECK(result.box.low[0] > -20 * scale);
  }
}

}  // namespace
}  // namespace nef::visual_hull
