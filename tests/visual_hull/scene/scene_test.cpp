// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/scene.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "apps/visual_hull/formats/scene_json.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using Catch::EndsWith;
using testing::Scratch;

std::string refusal_of_scene(const Scratch& scratch, const std::string& name, const std::string& text) {
  try {
    read_scene(scratch.write(name, text));
  } catch (const nef::Error& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST_CASE("Matrices in text mean the rationals that they spell") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("P.txt",
                                               "# a comment\n"
                                               "left 0.1 0 0 1/3   0 1e-2 0 0   0 0 1 0 # another\n"
                                               "\n"
                                               "right.001 1 0 0 0 0 1 0 0 0 0 1 -2\n"));
  REQUIRE(scene.views.size() == 2);
  CHECK(scene.views[0].name == "left");
  CHECK(scene.views[0].camera.matrix()[0][0] == Rational(1, 10));
  CHECK(scene.views[0].camera.matrix()[0][3] == Rational(1, 3));
  CHECK(scene.views[0].camera.matrix()[1][1] == Rational(1, 100));
  CHECK(scene.views[0].camera.centre() == Rational3{Rational(-10, 3), 0, 0});
  CHECK(scene.views[1].camera.centre() == Rational3{0, 0, 2});
  CHECK(scene.views[1].image == "right.001");
}

TEST_CASE("Matrices in three rows, with the punctuation of other programs") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("rows.txt",
                                               "P0 = [1 0 0 5;\n 0 1 0 6;\n 0 0 1 7];\n"
                                               "second\n1 0 0 1\n0 1 0 2\n0 0 1 3\n"
                                               "1, 0, 0, 9\n0, 2, 0, 2\n0, 0, 1, 3\n"));
  REQUIRE(scene.views.size() == 3);
  CHECK(scene.views[0].name == "P0");
  CHECK(scene.views[0].camera.centre() == Rational3{-5, -6, -7});
  CHECK(scene.views[1].name == "second");
  CHECK(scene.views[2].name == "3");
  CHECK(scene.views[2].camera.centre() == Rational3{-9, -1, -3});
}

TEST_CASE("Middlebury parameters are K [R | t]") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("x_par.txt",
                                               "1\n"
                                               "a.png 2 0 10 0 3 20 0 0 1  1 0 0 0 1 0 0 0 1  0.5 0 4\n"));
  REQUIRE(scene.views.size() == 1);
  const Matrix34 expected{{{2, 0, 10, 41}, {0, 3, 20, 80}, {0, 0, 1, 4}}};
  CHECK(scene.views[0].camera.matrix() == expected);
  CHECK(scene.views[0].camera.centre() == Rational3{Rational(-1, 2), 0, -4});
}

TEST_CASE("Listings of other programs: a call at the end is no matrix") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("m.txt",
                                               "P0 = [1 0 0 5;\n 0 1 0 6;\n 0 0 1 7];\n \n"
                                               "P_all = cat(3, P0, ...\n     P0);\n"));
  REQUIRE(scene.views.size() == 1);
  CHECK(scene.views[0].camera.centre() == Rational3{-5, -6, -7});
}

TEST_CASE("Blocks of intrinsic and extrinsic parameters are K [R | t]") {
  const Scratch scratch;
  const std::string head = "A file by somebody\n\n#Intrinsic parameter\n2 0 10\n0 3 20\n0 0 1\n\n";
  const Scene scene =
      read_scene(scratch.write("c.txt", head + "#Extrinsic parameter for a.bmp\n1 0 0 0.5\n0 1 0 0\n0 0 1 4\n"
                                               "# extrinsic\n\n1 0 0 1\n0 1 0 2\n0 0 1 3\n"));
  REQUIRE(scene.views.size() == 2);
  CHECK(scene.views[0].name == "a.bmp");
  CHECK(scene.views[0].image == "a.bmp");
  const Matrix34 expected{{{2, 0, 10, 41}, {0, 3, 20, 80}, {0, 0, 1, 4}}};
  CHECK(scene.views[0].camera.matrix() == expected);
  CHECK(scene.views[1].name == "2");
  CHECK(scene.views[1].camera.centre() == Rational3{-1, -2, -3});
  CHECK_THAT(refusal_of_scene(scratch, "d.txt", head + "#Extrinsic\n1 0 0 0.5\n0 1 0 0\n"),
             Contains("ends inside a matrix"));
  CHECK_THAT(refusal_of_scene(scratch, "e.txt", head + "#Extrinsic\n1 0 0\n"), Contains("line 9: a row of 4 numbers"));
  CHECK_THAT(refusal_of_scene(scratch, "f.txt", "#Extrinsic\n1 0 0 1\n"), Contains("intrinsic parameters are missing"));
  CHECK_THAT(refusal_of_scene(scratch, "g.txt", head + "#Extrinsic\n1 0 0 x\n"), Contains("'x' is not a number"));
}

TEST_CASE("A folder of cameras has a view for each of its files") {
  const Scratch s;
  s.write("b.pa", "1 0 0 1\n0 1 0 2\n0 0 1 3\n");
  s.write("a.pa", "1 0 0 5\n0 1 0 6\n0 0 1 7\n");
  s.write("notes.txt", "no camera");
  const Scene scene = read_scene(s.folder());
  REQUIRE(scene.views.size() == 2);
  CHECK(scene.views[0].name == "a");
  CHECK(scene.views[0].image == "a");
  CHECK(scene.views[1].camera.centre() == Rational3{-1, -2, -3});
  CHECK(scene_folder(s.folder()) == s.folder());
  CHECK(scene_folder(s.folder() / "scene.json") == s.folder());
  s.write("c.pa", "1 0 0 5\n0 1 0 6\n0 0 1 7\n1 0 0 5\n0 1 0 6\n0 0 1 7\n");
  CHECK_THROWS_WITH(read_scene(s.folder()), Contains("one 3x4 matrix is needed, not 2"));
}

TEST_CASE("JSON numbers and strings are the rationals that they spell") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("scene.json", R"({
    "cameras": [
      {"image": "a.png", "P": [[0.1, 0, 0, "1/3"], [0, 1e-3, 0, 0], [0, 0, 12345678901234567890123, 0]]},
      {"name": "b", "K": [2, 0, 10, 0, 3, 20, 0, 0, 1], "R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "t": [0.5, 0, 4],
       "distortion": [0.1, 0, 0, 0, 0], "polygons": [[[0, 0], ["1/7", 0], [0, 0.3]]]}
    ],
    "box": [-1, -1, -1, 1, 1, 0.1], "threshold": "otsu", "channel": "red", "invert": true})"));
  REQUIRE(scene.views.size() == 2);
  const Matrix34& m = scene.views[0].camera.matrix();
  CHECK(m[0][0] == Rational(1, 10));
  CHECK(m[0][3] == Rational(1, 3));
  CHECK(m[1][1] == Rational(1, 1000));
  CHECK(m[2][2] == Rational("12345678901234567890123"));
  CHECK(scene.views[1].camera.matrix()[0][3] == 41);
  CHECK(scene.views[1].polygons.value()[0][1].x() == Rational(1, 7));
  CHECK(scene.views[1].polygons.value()[0][2].y() == Rational(3, 10));
  CHECK(scene.views[1].distortion.coefficients.size() == 5);
  CHECK(scene.box->high[2] == Rational(1, 10));
  REQUIRE(scene.threshold.has_value());
  CHECK(scene.threshold->kind == ThresholdOptions::Kind::kOtsu);
  CHECK(scene.threshold->invert);
  CHECK(scene.threshold->channel == ThresholdOptions::Channel::kRed);
}

TEST_CASE("A .vsh camera maps the points of its polygon's plane to two of their coordinates") {
  const Scratch scratch;
  const Scene scene = read_scene(scratch.write("t.vsh", "-9 -9 -9 9 9 9 1  1 2 50  1 3  0 0 5  4 0 6  0 4 5.5"));
  REQUIRE(scene.views.size() == 1);
  const Camera& camera = scene.views[0].camera;
  CHECK(camera.centre() == Rational3{1, 2, 50});
  const Projection p = camera.project({4, 0, 6});
  CHECK(sgn(p.depth) > 0);
  CHECK(p.x / p.depth == 4);
  CHECK(p.y / p.depth == 0);
  // A point on the line of sight, twice as far, looks the same; one behind the camera has negative depth.
  const Projection q = camera.project({7, -2, -38});
  CHECK(q.x / q.depth == 4);
  CHECK(q.y / q.depth == 0);
  CHECK(sgn(camera.depth({1, 2, 60})) < 0);
}

TEST_CASE("Malformed scenes are refused in one line that says where") {
  const Scratch s;
  CHECK_THAT(refusal_of_scene(s, "e.txt", ""), Contains("the file is empty"));
  CHECK_THAT(refusal_of_scene(s, "c.txt", "# nothing\n"), Contains("there is no camera"));
  CHECK_THAT(refusal_of_scene(s, "w.txt", "a 1 2 3\nb 4 5 6\n"), Contains("w.txt, line 1"));
  CHECK_THAT(refusal_of_scene(s, "n.txt", "a 1 0 0 0 0 1 0 0 0 0 1 nan\n"), Contains("line 1: 'nan' is not a number"));
  CHECK_THAT(refusal_of_scene(s, "s.txt", "flat 1 0 0 0 2 0 0 0 0 0 1 1\n"),
             Contains("view flat: the matrix is singular"));
  CHECK_THAT(refusal_of_scene(s, "m.txt", "3\na 1 0 0 0 0 1 0 0 0 0 1 0\n"),
             Contains("announces 3 views, but there are 1"));
  CHECK_THAT(refusal_of_scene(s, "r.txt", "a\n1 0 0 0\n0 1 0 0\n"), Contains("ends inside the matrix of view 'a'"));
  CHECK_THAT(refusal_of_scene(s, "j.json", "{\"cameras\": [}"), Contains("j.json:1: not valid JSON near"));
  CHECK_THAT(refusal_of_scene(s, "l.json", "{}"), Contains("a scene needs a list 'cameras'"));
  CHECK_THAT(refusal_of_scene(s, "k.json", R"({"cameras": [{"image": "a", "K": [1,0,0,0,1,0,0,0,1]}]})"),
             Contains("'R' is missing"));
  CHECK_THAT(refusal_of_scene(s, "p.json", R"({"cameras": [{"image": "a", "P": [1, 2]}]})"),
             Contains("12 numbers are needed, not 2"));
  CHECK_THAT(refusal_of_scene(s, "x.json", R"({"cameras": [{"P": [1,0,0,0,0,1,0,0,0,0,1,true]}]})"),
             Contains("not 'true'"));
  CHECK_THAT(refusal_of_scene(s, "d.json", R"({"cameras": [{"P": [1,0,0,0,0,1,0,0,0,0,1,0], "distortion": [1]}]})"),
             Contains("needs the intrinsics"));
  const std::string camera = R"({"cameras": [{"K": [1,0,0,0,1,0,0,0,1], "R": [1,0,0,0,1,0,0,0,1], "t": [0,0,1])";
  CHECK_THAT(refusal_of_scene(s, "e.json", camera + R"(, "dist": [0,0,0,0]}]})"),
             Contains("'dist' is not understood; lens distortion is 'distortion'"));
  const Scene noted = read_scene(s.write("n.json", camera + R"(, "fov": 30}], "bocks": [0,0,0,1,1,1]})"));
  CHECK_THAT(understood(noted), EndsWith("; ignored: 'bocks', 'fov'"));
  CHECK_THAT(refusal_of_scene(s, "white.txt", " \n\t\n"), Contains("the file is empty"));
  CHECK_THROWS_WITH(read_scene(s.write("m.json", camera + "}]}"), {"world_mat_*"}),
                    Contains("--matrices") && Contains("is neither an OpenCV FileStorage nor a MATLAB file"));
  CHECK_THAT(refusal_of_scene(s, "b.json", R"({"cameras": [{"P": [1,0,0,0,0,1,0,0,0,0,1,0]}], "box": [0,0,0,1,1,0]})"),
             Contains("flat along z"));
  CHECK_THAT(refusal_of_scene(s, "a.vsh", "0 0 0 1 1"), Contains("ends before the largest corner of the box"));
  CHECK_THAT(refusal_of_scene(s, "b.vsh", "0 0 0 1 1 1 1 5 5 5 1 4 0 0 0 1 0 0 1 1 0 0 1 1"),
             Contains("point 4 of polygon 1 is not in the plane"));
  CHECK_THAT(refusal_of_scene(s, "c.vsh", "0 0 0 1 1 1 1 5 5 0 1 3 0 0 0 1 0 0 1 1 0"),
             Contains("contains the camera's centre"));
  CHECK_THAT(refusal_of_scene(s, "d.vsh", "0 0 0 1 1 1 1 5 5 5 1 2 0 0 0 1 0 0"),
             Contains("'2' is not a number of points"));
  CHECK_THAT(refusal_of_scene(s, "f.vsh", "0 0 0 1 1 1 1 5 5 5 1 3 0 0 0 1 0 0 1 1 0 7"),
             Contains("'7' follows after the last camera"));
  CHECK_THROWS_WITH(read_scene(s.folder()), Contains("is a directory"));
  CHECK_THROWS_WITH(read_scene(s.folder() / "absent"), Contains("no such file"));
  CHECK_THROWS_WITH(parse_box("1,2,3"), Contains("six numbers"));
  CHECK_THROWS_WITH(parse_box("0,0,0,1,x,1"), Contains("'x' in '0,0,0,1,x,1' is not a number"));
  CHECK_THROWS_WITH(parse_threshold("bright"), Contains("neither a number nor otsu"));
}

TEST_CASE("Images are found by name beside the scene") {
  const Scratch s;
  s.write("a.png", "x");
  std::filesystem::create_directories(s.folder() / "masks");
  s.write("masks/view.007.png", "x");
  CHECK(find_image(s.folder(), "a.png") == s.folder() / "a.png");
  CHECK(find_image(s.folder(), "a.jpg") == s.folder() / "a.png");  // the mask of a photograph
  CHECK(find_image(s.folder(), "a") == s.folder() / "a.png");
  CHECK(find_image(s.folder(), "view.007") == s.folder() / "masks/view.007.png");
  CHECK_THROWS_WITH(find_image(s.folder(), "b"), Contains("view b: there is no image"));
  CHECK(list_images(s.folder()).size() == 1);
}

}  // namespace
}  // namespace nef::visual_hull
