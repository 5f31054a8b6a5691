// SPDX-License-Identifier: Apache-2.0
//
// --texture, --picture and --color of pages, as users run them.
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/command/pictures/pictures.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/texture/painted.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Rig;
using testing::Scratch;

const Rig kFew{8, 120, 90, 220};

std::filesystem::path scene_in(const Scratch& scratch) {
  return testing::render(testing::ellipsoid({1.3, 0.9, 1.1}), kFew, scratch);
}

// Colours as the ellipsoid has them, not one.
bool is_colourful(const cv::Mat& image) {
  if (image.empty() || image.channels() != 3) return false;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0] > 15 && deviation[1] > 15 && deviation[2] > 15;
}

// The JSON of a GLB file, and where its binary part begins.
std::pair<nlohmann::json, std::size_t> json_of(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return {nlohmann::json::parse(glb.substr(20, length)), 20 + length + 8};
}

TEST_CASE("Textures are written with OBJ, PLY, GLB and 3MF, whose meshes bound the same solid (--texture)") {
  const Scratch scratch;
  const std::string scene = scene_in(scratch).string() + " --simplify 1 ";
  const auto path = [&](const std::string& name) { return (scratch.folder() / name).string(); };
  REQUIRE(testing::run(scene + "-o " + path("plain.ply")).code == 0);
  const double volume = nef::nearest_double(*nef::volume(nef::read_polyhedron(path("plain.ply"))));
  for (const char* name : {"a b.obj", "hull.ply", "hull.glb", "hull.3mf"}) {
    const testing::Outcome outcome = testing::run(scene + "--texture -o '" + path(name) + "'");
    INFO(outcome.output);
    REQUIRE(outcome.code == 0);
    CHECK(nef::nearest_double(*nef::volume(nef::read_polyhedron(path(name)))) == Approx(volume).epsilon(1e-5));
  }
  const std::string obj = nef::read_file(path("a b.obj"));
  CHECK_THAT(obj, Contains("mtllib a_b.mtl\n") && Contains("\nvt ") && Contains("\nusemtl texture\nf "));
  CHECK_THAT(nef::read_file(path("a_b.mtl")), Contains("newmtl texture\n") && Contains("map_Kd a_b_texture.png\n"));
  CHECK(is_colourful(cv::imread(path("a_b_texture.png"), cv::IMREAD_UNCHANGED)));
  CHECK_THAT(nef::read_file(path("hull.ply")), Contains("comment TextureFile hull_texture.png\n") &&
                                                   Contains("property float texture_u\nproperty float texture_v\n"));
  CHECK(is_colourful(cv::imread(path("hull_texture.png"), cv::IMREAD_UNCHANGED)));

  const std::string glb = nef::read_file(path("hull.glb"));
  const auto [json, binary] = json_of(glb);
  CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 0);
  CHECK(json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].get<std::size_t>()]["type"] ==
        "VEC2");
  const nlohmann::json view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
  const std::string png =
      glb.substr(binary + view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
  CHECK(is_colourful(cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED)));
}

TEST_CASE("A decimated mesh has a texture, and the report says how large it is") {
  const Scratch scratch;
  const std::string scene = scene_in(scratch).string() + " --simplify 1 ";
  const std::string file = (scratch.folder() / "few.obj").string();
  const std::string report = (scratch.folder() / "report.json").string();
  const testing::Outcome outcome = testing::run(scene + "--decimate 60 --texture -o " + file + " --report " + report);
  INFO(outcome.output);
  REQUIRE(outcome.code == 0);
  const nlohmann::json texture = nlohmann::json::parse(nef::read_file(report))["texture"];
  const cv::Mat image = cv::imread((scratch.folder() / "few_texture.png").string());
  CHECK(texture["width"] == image.cols);
  CHECK(texture["height"] == image.rows);
  CHECK(texture["charts"] > 3);
  CHECK(texture["unseen"] < 0.2);
}

TEST_CASE("Textures that cannot be are refused in one line") {
  const Scratch scratch;
  const std::string scene = scene_in(scratch).string() + " --simplify 1 ";
  const auto refusal = [&](const std::string& arguments) {
    const testing::Outcome outcome = testing::run(scene + arguments);
    CHECK(outcome.code == 2);
    CHECK(std::count(outcome.output.begin(), outcome.output.end(), '\n') == 1);
    return outcome.output;
  };
  const std::string folder = scratch.folder().string() + "/";
  for (const char* name : {"h.stl", "h.off", "h.nef"}) {
    CHECK_THAT(refusal("--texture -o " + folder + name), Contains("OBJ, PLY, GLB and 3MF can"));
  }
  CHECK_THAT(refusal("--texture"), Contains("--texture writes a mesh: name its file with -o"));
  CHECK_THAT(refusal("--texture --color -o " + folder + "h.ply"), Contains("exclude each other"));
  CHECK_THAT(refusal("--texture --manifold -o " + folder + "h.ply"), Contains("exclude each other"));
  CHECK_THAT(refusal("--texture --picture h.jpg"), Contains("the extension must be .png"));
  const std::string letters = source_folder() + "/data/visual_hull/letters/mpi.vsh";
  const testing::Outcome outcome = testing::run(letters + " --texture -o " + folder + "h.glb");
  CHECK(outcome.code == 2);
  CHECK_THAT(outcome.output, Contains("--texture needs images; the views are polygons"));
}

TEST_CASE("Pages and pictures show colours and textures") {
  const Scratch scratch;
  const std::string file = (scratch.folder() / "hull.png").string();
  Options options;
  options.silhouette.simplify.tolerance = 1;
  const Result result = compute(read_scene(scene_in(scratch)), scratch.folder(), options);
  const auto layer =
      page_layers(result, result.origin, hull_layer(result, result.origin, {}, HullColors::kVertices))[0];
  CHECK(layer.surface.vertices.size() == layer.scene.vertices.size());
  CHECK_FALSE(layer.surface.has_image());
  const auto textured =
      page_layers(result, result.origin, hull_layer(result, result.origin, {}, HullColors::kTexture))[0];
  CHECK(textured.surface.places.size() == 3 * textured.scene.triangles.size());
  nef::view::write_picture({hull_layer(result, result.origin, {}, HullColors::kTexture)}, file,
                           {.from = {}, .width = 240, .height = 180});
  // The picture shows the ellipsoid's colours in the middle, from where it is taken.
  const cv::Mat picture = cv::imread(file);
  REQUIRE(picture.size() == cv::Size(240, 180));
  const testing::Vec from{5.5, -7.5, 4.2};
  const Color truth = testing::ellipsoid({1.3, 0.9, 1.1})(from, {-from[0], -from[1], -from[2]}).second;
  const cv::Vec3b middle = picture.at<cv::Vec3b>(90, 120);
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(middle[2 - static_cast<int>(c)] - truth[c]) < 25);
}

}  // namespace
}  // namespace nef::visual_hull
