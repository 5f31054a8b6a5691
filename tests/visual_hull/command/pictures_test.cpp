// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/pictures/pictures.h"

#include <opencv2/imgcodecs.hpp>

#include "apps/view/page.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using testing::Scratch;

std::string hull_data(const std::string& name) { return source_folder() + "/data/visual_hull/" + name; }

Result eight() {
  Options options;
  options.silhouette.simplify.tolerance = 3;
  return compute(read_scene(hull_data("eight/eight.json")), hull_data("eight"), options);
}

// (u, v) of a point of space, in double precision.
std::array<double, 2> seen_at(const Camera& camera, const nef::view::Point& p) {
  const Projection q =
      camera.project({nef::exact_rational(p[0]), nef::exact_rational(p[1]), nef::exact_rational(p[2])});
  return {nef::nearest_double(Rational(q.x / q.depth)), nef::nearest_double(Rational(q.y / q.depth))};
}

TEST_CASE("A page has the hull, and each camera with its image where the camera sees it") {
  const Result result = eight();
  const std::vector<nef::view::Layer> layers =
      page_layers(result, PixelOrigin::kCenter, hull_layer(result, PixelOrigin::kCenter, {}));
  REQUIRE(layers.size() == 2);
  CHECK(layers[0].name == "hull");
  CHECK(layers[0].scene.facets.size() == nef::counts(result.hull).facets);
  REQUIRE(layers[1].photos.size() == 12);
  for (std::size_t i = 0; i < 12; ++i) {
    const nef::view::Photo& photo = layers[1].photos[i];
    const Camera& camera = result.views[i].camera;
    CHECK(photo.name == result.views[i].name);
    CHECK(photo.media_type == "image/png");
    CHECK(photo.bytes == nef::read_file(result.views[i].image.string()));
    const std::vector<std::array<double, 2>> frame{{-0.5, -0.5}, {319.5, -0.5}, {319.5, 239.5}, {-0.5, 239.5}};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = seen_at(camera, photo.corners[k]);
      CHECK(at[0] == Approx(frame[k][0]).margin(1e-6));
      CHECK(at[1] == Approx(frame[k][1]).margin(1e-6));
    }
    REQUIRE(photo.eye.has_value());
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK((*photo.eye)[k] == Approx(nef::nearest_double(camera.centre()[k])).margin(1e-9));
    }
  }
}

TEST_CASE("Views of polygons show their outline and lines of sight, corner origins shift the frame") {
  const Result letters = compute(read_scene(hull_data("letters/mpi.vsh")), {}, {});
  const auto layers = page_layers(letters, PixelOrigin::kCenter, hull_layer(letters, PixelOrigin::kCenter, {}));
  CHECK(layers[1].photos.empty());
  CHECK(layers[1].lines.size() == 4 + 3 * 4);  // four rings, four lines of sight for each camera
  const Result result = eight();
  const auto corner = page_layers(result, PixelOrigin::kCorner, hull_layer(result, PixelOrigin::kCorner, {}));
  const auto at = seen_at(result.views[0].camera, corner[1].photos[0].corners[2]);
  CHECK(at[0] == Approx(320).margin(1e-6));
  CHECK(at[1] == Approx(240).margin(1e-6));
}

TEST_CASE("Images that browsers do not know become PNGs") {
  const Scratch s;
  Result result = eight();
  const cv::Mat image = cv::imread(result.views[0].image.string());
  result.views.resize(1);
  result.views[0].image = s.folder() / "view.bmp";
  cv::imwrite(result.views[0].image.string(), image);
  const auto layers = page_layers(result, PixelOrigin::kCenter, hull_layer(result, PixelOrigin::kCenter, {}));
  REQUIRE(layers[1].photos.size() == 1);
  CHECK(layers[1].photos[0].media_type == "image/png");
  const std::string& bytes = layers[1].photos[0].bytes;
  const cv::Mat back = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  CHECK(cv::norm(back, image, cv::NORM_INF) == 0);
}

TEST_CASE("With the views compared, a page shows what the hull does not cover of a silhouette, in yellow") {
  Result result = eight();
  const auto yellow = [&result] {
    const std::string bytes =
        page_layers(result, PixelOrigin::kCenter, hull_layer(result, PixelOrigin::kCenter, {}))[1].photos[0].bytes;
    const cv::Mat picture = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
    cv::Mat found;
    cv::inRange(picture, cv::Scalar(0, 150, 200), cv::Scalar(160, 255, 255), found);
    return cv::countNonZero(found);
  };
  CHECK(yellow() == 0);
  result.consistency = Consistency{};
  const int before = yellow();
  result.hull = nef::intersect(result.hull, nef::make_box({-100, -100, 0}, {100, 100, 100}));  // the half is gone
  CHECK(yellow() > before + 1000);
}

TEST_CASE("A page is one file with all images in it") {
  if (!nef::view::has_viewer_bundle()) {
    WARN("skipped: the viewer bundle was not built (npm was missing)");
    return;
  }
  const Scratch s;
  const Result result = eight();
  const std::filesystem::path page = s.folder() / "page.html";
  write_page(result, PixelOrigin::kCenter, hull_layer(result, PixelOrigin::kCenter, {}), page);
  const std::string text = nef::read_file(page.string());
  CHECK(text.find("visual hull of 12 views") != std::string::npos);
  CHECK(text.size() > 100000);
}

}  // namespace
}  // namespace nef::visual_hull
