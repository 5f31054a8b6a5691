// SPDX-License-Identifier: Apache-2.0
//
// One camera in every format: a focal length of 100 pixels, the principal point (100, 50), at (0, 0, 5) with the head
// up
// (+y), looking at the origin. So (1, 0, 0) is seen 20 pixels to the right, (0, 1, 0) 20 pixels above.
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/formats/turntable.h"
#include "apps/visual_hull/scene/axes.h"
#include "apps/visual_hull/scene/understanding.h"
#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scene/mat_file.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::mat_array;
using testing::mat_element;
using testing::mat_header;
using testing::put;
using testing::Scratch;

std::array<double, 3> seen(const Camera& camera, const Rational3& point) {
  const Projection p = camera.project(point);
  const double depth = nef::nearest_double(p.depth);
  return {nef::nearest_double(p.x) / depth, nef::nearest_double(p.y) / depth, depth};
}

void check_camera(const Camera& camera) {
  const auto expect = [&](const Rational3& point, double u, double v) {
    const auto [x, y, depth] = seen(camera, point);
    CHECK(x == Approx(u).margin(1e-6));
    CHECK(y == Approx(v).margin(1e-6));
    CHECK(depth > 0);
  };
  expect({0, 0, 0}, 100, 50);
  expect({1, 0, 0}, 120, 50);
  expect({0, 1, 0}, 100, 30);
  expect({0, 0, 1}, 100, 50);
  CHECK(sgn(camera.depth({0, 0, 6})) < 0);
  CHECK(nef::nearest_double(camera.centre()[2]) == Approx(5));
  CHECK(camera.handedness() > 0);
}

std::string refusal(const std::filesystem::path& file, const ReadOptions& options = {}) {
  try {
    read_scene(file, options);
  } catch (const nef::Error& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kFrame = R"("transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]])";

TEST_CASE("NeRF's transforms: camera to world, OpenGL's axes, corners of pixels") {
  const Scratch s;
  const auto file =
      s.write("transforms.json", std::string(R"({"fl_x": 100, "w": 200, "h": 100, "k1": 0.1, "aabb_scale": 4,
      "frames": [{"file_path": "./images/a", )") +
                                     kFrame + R"(},
                 {"file_path": "images/b.png", "mask_path": "m/b.png", "fl_y": 100, "cx": 100, "cy": 50, "k1": 0, )" +
                                     kFrame + "}]}");
  const Scene scene = read_scene(file);
  REQUIRE(scene.views.size() == 2);
  for (const View& view : scene.views) check_camera(view.camera);
  CHECK(scene.origin == PixelOrigin::kCorner);
  CHECK(scene.views[0].distortion.coefficients == std::vector<double>{0.1, 0, 0, 0, 0});
  CHECK(scene.views[1].distortion.coefficients.empty());
  CHECK(scene.views[0].image == "./images/a");
  CHECK(scene.views[1].image == "m/b.png");
  CHECK(scene.views[0].size->width == 200);
  CHECK(read_scene(s.folder()).views.size() == 2);  // the folder is enough

  // An angle of view needs the image's size: tan(angle / 2) = 1 for f = w / 2.
  cv::imwrite((s.folder() / "c.png").string(), cv::Mat(100, 200, CV_8U, cv::Scalar(255)));
  const auto blender =
      s.write("blender.json", R"({"camera_angle_x": 1.5707963267948966, "frames": [{"file_path": "./c", )" +
                                  std::string(kFrame) + "}]}");
  check_camera(read_scene(blender).views[0].camera);
  const auto lost =
      s.write("lost.json", R"({"camera_angle_x": 1.5, "frames": [{"file_path": "./d", )" + std::string(kFrame) + "}]}");
  CHECK_THAT(refusal(lost), Contains("give 'w' and 'h'"));
  const auto fish =
      s.write("fish.json", R"({"camera_model": "OPENCV_FISHEYE", "fl_x": 1, "w": 2, "h": 2, "frames": [{)" +
                               std::string(kFrame) + "}]}");
  CHECK_THAT(refusal(fish), Contains("fisheye"));
  const auto blind = s.write("blind.json", R"({"w": 2, "h": 2, "frames": [{)" + std::string(kFrame) + "}]}");
  CHECK_THAT(refusal(blind), Contains("focal length is missing"));
  CHECK_THAT(refusal(s.write("none.json", R"({"frames": []})")), Contains("'frames' is empty"));
  CHECK_THAT(refusal(s.write("pose.json", R"({"fl_x": 1, "w": 2, "h": 2, "frames": [{}]})")),
             Contains("'transform_matrix' is missing"));
}

// Half a turn about x: from y up and z back to y down and z ahead; then five ahead.
constexpr std::array<double, 7> kMotion{0, 1, 0, 0, 0, 0, 5};

TEST_CASE("COLMAP models, text and binary") {
  const Scratch s;
  const std::filesystem::path sparse = s.folder() / "sparse/0";
  std::filesystem::create_directories(sparse);
  s.write("sparse/0/cameras.txt",
          "# Camera list\n1 PINHOLE 200 100 100 100 100 50\n7 SIMPLE_RADIAL 200 100 100 100 50 0.25\n"
          "8 RADIAL 200 100 100 100 50 0.25 0.5\n9 OPENCV 200 100 100 100 100 50 1 2 3 4\n"
          "10 FULL_OPENCV 200 100 100 100 100 50 1 2 3 4 5 6 7 8\n");
  // The points of an image may be none: an empty line.
  s.write("sparse/0/images.txt",
          "# Image list\n1 0 1 0 0 0 0 5 1 b name.png\n\n2 0 2 0 0 0 0 5 7 a.png\n1 2 3 4 5 6\n"
          "3 0 1 0 0 0 0 5 8 c.png\n\n4 0 1 0 0 0 0 5 9 d.png\n\n5 0 1 0 0 0 0 5 10 e.png\n1 2 -1\n");
  const Scene text = read_scene(s.folder());
  REQUIRE(text.views.size() == 5);
  for (const View& view : text.views) check_camera(view.camera);
  CHECK(text.origin == PixelOrigin::kCorner);
  CHECK(text.views[0].name == "a.png");  // in the order of names
  CHECK(text.views[1].name == "b name.png");
  CHECK(text.views[0].distortion.coefficients == std::vector<double>{0.25, 0, 0, 0});
  CHECK(text.views[1].distortion.coefficients.empty());
  CHECK(text.views[2].distortion.coefficients == std::vector<double>{0.25, 0.5, 0, 0});
  CHECK(text.views[3].distortion.coefficients == std::vector<double>{1, 2, 3, 4});
  CHECK(text.views[4].distortion.coefficients == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(text.views[0].size->height == 100);
  CHECK(read_scene(sparse / "images.txt").views.size() == 5);  // a file of it stands for the model
  // Images lie beside the folder sparse.
  std::filesystem::create_directories(s.folder() / "masks");
  for (const char* name : {"a", "b name", "c", "d", "e"}) s.write(std::string("masks/") + name + ".png", "x");
  CHECK(images_of(text, sparse, std::nullopt)[0] == s.folder() / "masks/a.png");

  std::string cameras;
  put<std::uint64_t>(cameras, 1);
  put<std::uint32_t>(cameras, 3);
  put<std::int32_t>(cameras, 1);
  put<std::uint64_t>(cameras, 200);
  put<std::uint64_t>(cameras, 100);
  for (const double p : {100, 100, 100, 50}) put<double>(cameras, p);
  std::string images;
  put<std::uint64_t>(images, 1);
  put<std::uint32_t>(images, 1);
  for (const double p : kMotion) put<double>(images, p);
  put<std::uint32_t>(images, 3);
  images.append("x.png", 6);  // with the zero at its end
  put<std::uint64_t>(images, 1);
  put<double>(images, 1);
  put<double>(images, 2);
  put<std::uint64_t>(images, 3);
  std::filesystem::create_directories(s.folder() / "binary");
  s.write("binary/cameras.bin", cameras);
  s.write("binary/images.bin", images);
  const Scene binary = read_scene(s.folder() / "binary");
  REQUIRE(binary.views.size() == 1);
  check_camera(binary.views[0].camera);
  CHECK(binary.views[0].image == "x.png");

  s.write("binary/images.bin", images.substr(0, images.size() - 9));
  CHECK_THAT(refusal(s.folder() / "binary"), Contains("ends in the middle"));
  s.write("binary/cameras.bin", "\xff\xff\xff\xff\xff\xff\xff\xff");
  CHECK_THAT(refusal(s.folder() / "binary"), Contains("items cannot follow"));
  s.write("sparse/0/cameras.txt", "1 FOV 200 100 1 2 3 4 5\n");
  CHECK_THAT(refusal(s.folder()), Contains("image_undistorter"));
  s.write("sparse/0/cameras.txt", "1 PINHOLE 200 100 100 100\n");
  CHECK_THAT(refusal(s.folder()), Contains("line 1: the parameters of the camera is missing"));
}

TEST_CASE("OpenCV's FileStorage: the calibration sample, lists, numbered nodes, matrices of other names") {
  const Scratch s;
  const std::string k =
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 100., 0., 100., 0., 100., 50., 0., 0., 1. ]\n";
  const std::string twelve = "[ 100., 0., -100., 500., 0., -100., -50., 250., 0., 0., -1., 5. ]";
  const auto sample =
      s.write("out.yml", "%YAML:1.0\n---\nimage_width: 200\nimage_height: 100\n" + k +
                             "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
                             "   data: [ 1., 2., 3., 4., 5. ]\n"
                             "extrinsic_parameters: !!opencv-matrix\n   rows: 2\n   cols: 6\n   dt: d\n"
                             "   data: [ 3.14159265358979, 0., 0., 0., 0., 5., "
                             "3.14159265358979, 0., 0., 0., 0., 5. ]\n");
  const Scene scene = read_scene(sample);
  REQUIRE(scene.views.size() == 2);
  for (const View& view : scene.views) check_camera(view.camera);
  CHECK(scene.origin == PixelOrigin::kCenter);
  CHECK(scene.views[1].distortion.coefficients == std::vector<double>{1, 2, 3, 4, 5});
  CHECK(scene.views[1].size->width == 200);

  const auto list =
      s.write("list.yml", "%YAML:1.0\n---\n" + k +
                              "views:\n   - { image: \"a.png\", R: [1., 0., 0., 0., -1., 0., 0., 0., -1.], "
                              "t: [0., 0., 5.] }\n   - { name: \"two\", P: " +
                              twelve + " }\n");
  const Scene listed = read_scene(list);
  REQUIRE(listed.views.size() == 2);
  for (const View& view : listed.views) check_camera(view.camera);
  CHECK(listed.views[0].image == "a.png");
  CHECK(listed.views[1].name == "two");

  const auto xml = s.write("n.xml",
                           "<?xml version=\"1.0\"?>\n<opencv_storage>\n<K type_id=\"opencv-matrix\"><rows>3</rows>"
                           "<cols>3</cols><dt>d</dt><data>100. 0. 100. 0. 100. 50. 0. 0. 1.</data></K>\n"
                           "<rvec_0 type_id=\"opencv-matrix\"><rows>3</rows><cols>1</cols><dt>d</dt>"
                           "<data>3.14159265358979 0. 0.</data></rvec_0>\n"
                           "<tvec_0 type_id=\"opencv-matrix\"><rows>3</rows><cols>1</cols><dt>d</dt>"
                           "<data>0. 0. 5.</data></tvec_0>\n</opencv_storage>\n");
  const Scene numbered = read_scene(xml);
  REQUIRE(numbered.views.size() == 1);
  check_camera(numbered.views[0].camera);

  // Names of OpenCV's tutorials; what may be a lens by another name is refused.
  const std::string view0 =
      "mtx0: [100., 0., 100., 0., 100., 50., 0., 0., 1.]\nrvec0: [3.14159265358979, 0., 0.]\n"
      "tvec0: [0., 0., 5.]\n";
  const Scene lens = read_scene(s.write("lens.yml", "%YAML:1.0\n---\n" + view0 + "dist0: [1., 2., 3., 4.]\n"));
  REQUIRE(lens.views.size() == 1);
  check_camera(lens.views[0].camera);
  CHECK(lens.views[0].distortion.coefficients == std::vector<double>{1, 2, 3, 4});
  CHECK_THAT(understood(lens), Contains("lens distortion is undone"));
  CHECK_THAT(refusal(s.write("lenses.yml", "%YAML:1.0\n---\n" + view0 + "distorsion_0: [1., 2., 3., 4.]\n")),
             Contains("'distorsion_0' is not understood; lens distortion is called"));

  const std::string named = "world_mat_10: " + twelve + "\nworld_mat_9: " + twelve + "\nscale: 3.\n";
  const auto other = s.write("other.yml", "%YAML:1.0\n---\n" + named);
  CHECK_THAT(refusal(other), Contains("--matrices"));
  const Scene chosen = read_scene(other, {"world_mat_*"});
  REQUIRE(chosen.views.size() == 2);
  CHECK(chosen.views[0].name == "9");
  check_camera(chosen.views[1].camera);

  // One word with a number in it; not if there are two of them, and not poses.
  const auto matrix = [](const std::string& name, const std::string& data) {
    return name + ": !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n   data: " + data + "\n";
  };
  const std::string viff = matrix("viff010_matrix", twelve) + matrix("viff009_matrix", twelve);
  const Scene counted = read_scene(s.write("viff.yml", "%YAML:1.0\n---\n" + viff));
  REQUIRE(counted.views.size() == 2);
  CHECK(counted.views[0].name == "009");
  check_camera(counted.views[1].camera);
  CHECK_THAT(refusal(s.write("two.yml", "%YAML:1.0\n---\n" + viff + matrix("other1_matrix", twelve))),
             Contains("--matrices"));
  CHECK_THAT(refusal(s.write("pose.yml", "%YAML:1.0\n---\n" + matrix("view1_matrix",
                                                                     "[1., 0., 0., 5., 0., 1., 0., 5., "
                                                                     "0., 0., 1., 5.]"))),
             Contains("--matrices"));

  CHECK_THAT(refusal(s.write("bad.yml", "%YAML:1.0\n---\na: [1, 2\nb: }\n")), Contains("bad.yml"));
  CHECK_THAT(refusal(s.write("few.yml", "%YAML:1.0\n---\nP0: [1., 2.]\n")), Contains("12 or 16 numbers are needed"));
}

// Columns first.
std::string numbers(std::size_t times) {
  std::string data;
  for (std::size_t i = 0; i < times; ++i) {
    for (const double x : {100, 0, 0, 0, -100, 0, -100, -50, -1, 500, 250, 5}) put<double>(data, x);
  }
  return mat_element(9, data);
}

TEST_CASE("MATLAB files of version 5: a cell array, a stack of matrices, single variables") {
  const Scratch s;
  const std::string one = mat_array(testing::kMatDouble, {3, 4}, "", numbers(1));
  const std::string cell = mat_array(testing::kMatCell, {1, 2}, "P", one + one);
  const std::string stack = mat_array(testing::kMatDouble, {3, 4, 3}, "Q", numbers(3));
  const std::string unit = mat_array(testing::kMatDouble, {1, 1}, "x", mat_element(9, std::string(8, '\0')));
  const auto check = [&](const std::string& name, const std::string& content, std::size_t views,
                         const std::string& variable = "") {
    const Scene scene = read_scene(s.write(name, mat_header() + content), {variable});
    REQUIRE(scene.views.size() == views);
    for (const View& view : scene.views) check_camera(view.camera);
  };
  check("cell.mat", unit + cell, 2);
  check("stack.mat", stack, 3);
  check("both.mat", cell + stack, 3, "Q");
  check("single.mat",
        mat_array(testing::kMatDouble, {3, 4}, "P10", numbers(1)) +
            mat_array(testing::kMatDouble, {3, 4}, "P9", numbers(1)),
        2);
  CHECK_THAT(refusal(s.folder() / "both.mat"), Contains("name one with --matrices"));
  CHECK_THAT(refusal(s.write("none.mat", mat_header() + unit)), Contains("there are no 3x4 matrices"));
  CHECK_THAT(refusal(s.write("cut.mat", (mat_header() + cell).substr(0, 200))), Contains("there are no 3x4 matrices"));
}

TEST_CASE("A folder of PMVS") {
  const Scratch s;
  std::filesystem::create_directories(s.folder() / "txt");
  std::filesystem::create_directories(s.folder() / "silhouettes");
  for (const char* name : {"00000001", "00000000"}) {
    s.write(std::string("txt/") + name + ".txt", "CONTOUR\n100 0 -100 500\n0 -100 -50 250\n0 0 -1 5\n");
    s.write(std::string("silhouettes/") + name + ".pgm", "x");
  }
  s.write("txt/readme.txt", "Not a camera\n");
  const Scene scene = read_scene(s.folder());
  REQUIRE(scene.views.size() == 2);
  for (const View& view : scene.views) check_camera(view.camera);
  CHECK(images_of(scene, s.folder(), std::nullopt)[1] == s.folder() / "silhouettes/00000001.pgm");
}

TEST_CASE("A turntable: upright cameras around the z axis, the object turning counterclockwise") {
  const Scene scene = make_turntable({4, {100, 100, 50}, 3, 4});
  REQUIRE(scene.views.size() == 4);
  for (const View& view : scene.views) {
    const auto [u, v, depth] = seen(view.camera, {0, 0, 0});
    CHECK(u == Approx(100));
    CHECK(v == Approx(50));
    CHECK(depth == Approx(5));
    CHECK(seen(view.camera, {0, 0, 1})[1] < 50);
    CHECK(view.camera.handedness() > 0);
  }
  // From +x one sees +y on the right.
  CHECK(nef::nearest_double(scene.views[0].camera.centre()[0]) == Approx(3));
  CHECK(seen(scene.views[0].camera, {0, 1, 0})[0] > 100);
  // A quarter turn later what was at the right has come round to the back: the camera stands at -y.
  CHECK(nef::nearest_double(scene.views[1].camera.centre()[1]) == Approx(-3));
  const Scene back = make_turntable({-4, {100, 100, 100, 50}, 3, 4});
  CHECK(nef::nearest_double(back.views[1].camera.centre()[1]) == Approx(3));
  CHECK_THROWS_AS(make_turntable({4, {100}, 3, 4}), nef::InputError);
  CHECK_THROWS_AS(make_turntable({1, {100, 100, 50}, 3, 4}), nef::InputError);
  CHECK_THROWS_AS(make_turntable({4, {100, 100, 50}, 0, 4}), nef::InputError);
}

TEST_CASE("What is understood is said, and what looks wrong, too") {
  const Scene table = make_turntable({4, {100, 100, 50}, 3, 4});
  CHECK_THAT(understood(table), Contains("4 views from a turntable"));
  CHECK_THAT(understood(table), Contains("focal length 100 pixels"));
  CHECK_THAT(understood(table), Contains("look at (0, 0, 0) from 5 away"));
  CHECK_THAT(understood(table), Contains("centre of a pixel"));
  CHECK(view_lines(table, {}).size() == 4);
  Scene away = table;
  for (View& view : away.views) {
    Matrix34 m = view.camera.matrix();
    for (auto& row : m) {
      for (Rational& x : row) x = -x;
    }
    view.camera = Camera(view.name, m);
  }
  CHECK_THAT(understood(away), Contains("4 of them look AWAY"));
  CHECK_THAT(understood(away), Contains("mirrored"));
}

TEST_CASE("Quarter turns bring any axis up, exactly") {
  for (const std::string up : {"x", "y", "z", "-x", "-y", "-z"}) {
    Scene scene = make_turntable({3, {100, 100, 50}, 3, 4});
    scene.box = WorldBox{{-1, -2, -3}, {4, 5, 6}};
    const Scene before = scene;
    turn_up(scene, up);
    const std::size_t axis = static_cast<std::size_t>(up.back() - 'x');
    const int sign = up[0] == '-' ? -1 : 1;
    // A point one up in the old space is one up in the new one, and is seen in the same place.
    Rational3 point;
    point[axis] = sign;
    CHECK(seen(scene.views[1].camera, {0, 0, 1}) == seen(before.views[1].camera, point));
    CHECK(scene.views[1].camera.handedness() > 0);
    CHECK(scene.box->high[2] == (sign > 0 ? before.box->high[axis] : Rational(-before.box->low[axis])));
    CHECK_NOTHROW(check_box(*scene.box, "box"));
  }
  Scene scene = make_turntable({3, {100, 100, 50}, 3, 4});
  CHECK_THROWS_AS(turn_up(scene, "w"), nef::InputError);
  CHECK_THROWS_AS(turn_up(scene, "--x"), nef::InputError);
}

}  // namespace
}  // namespace nef::visual_hull
