// SPDX-License-Identifier: Apache-2.0
//
// The parts of a texture by themselves: charts, packing, levelling, filling.
#include "apps/visual_hull/texture/charts.h"

#include "apps/visual_hull/color/triangle_pixels.h"
#include "apps/visual_hull/texture/filling.h"
#include "apps/visual_hull/texture/levelling.h"
#include "apps/visual_hull/texture/packing.h"
#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

// A camera 10 above the origin that looks down, 100 pixels for a unit at depth 10.
ViewResult from_above() {
  ViewResult view;
  Matrix34 m;
  m[0] = {1000, 0, -100, 1000};
  m[1] = {0, -1000, -100, 1000};
  m[2] = {0, 0, -1, 10};
  view.camera = Camera("above", m);
  view.silhouette.image_size = {200, 200};
  return view;
}

// A strip of squares of side 1/2 along a path in the plane of x and z.
nef::Mesh strip(const std::vector<std::array<double, 2>>& path) {
  nef::Mesh mesh;
  for (const auto& [x, z] : path) {
    for (const double y : {-0.25, 0.25}) {
      mesh.vertices.push_back({nef::exact_rational(x), nef::exact_rational(y), nef::exact_rational(z)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < path.size(); ++i) {
    mesh.push_face(std::array{2 * i, 2 * i + 2, 2 * i + 3});
    mesh.push_face(std::array{2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

TEST_CASE("A part that lies above another part of its chart in the image becomes a chart of its own") {
  const ViewResult view = from_above();
  const std::vector<const ViewResult*> views{&view};
  const Surface flat(strip({{-0.5, 0}, {0, 0}, {0.5, 0}}));
  const Atlas one = make_charts(flat, std::vector<std::uint32_t>(flat.size(), 0), views, PixelOrigin::kCenter);
  CHECK(one.charts.size() == 1);
  CHECK(one.charts[0].triangles.size() == 4);
  const Surface folded(strip({{-0.5, 0}, {0.5, 0}, {-0.4, 0.5}}));
  const Atlas two = make_charts(folded, std::vector<std::uint32_t>(folded.size(), 0), views, PixelOrigin::kCenter);
  CHECK(two.charts.size() == 2);
  for (const Chart& chart : two.charts) CHECK(chart.triangles.size() == 2);
}

TEST_CASE("What no view sees is a chart, too") {
  const ViewResult view = from_above();
  const Surface surface(strip({{-0.5, 0}, {0, 0}, {0.5, 0}, {0.5, -1}}));
  std::vector<std::uint32_t> choice(surface.size(), kNoView);
  choice[0] = choice[1] = 0;
  const Atlas atlas = make_charts(surface, choice, {&view}, PixelOrigin::kCenter);
  REQUIRE(atlas.charts.size() == 3);
  CHECK(atlas.charts[0].view == 0);
  CHECK(atlas.charts[1].view == kNoView);
  // At a quarter of the resolution: squares of 50 pixels become squares of 12 or so.
  CHECK(std::abs(doubled_area(atlas.places[2])) == Approx(std::abs(doubled_area(atlas.places[0])) / 16).epsilon(0.01));
}

Atlas rectangles(std::size_t count, double largest) {
  Atlas atlas;
  for (std::size_t i = 0; i < count; ++i) {
    Chart chart;
    chart.low = {-7, 3};
    chart.high = {-7 + std::floor(largest * (1 + static_cast<double>(i * 37 % 11)) / 11),
                  3 + std::floor(largest * (1 + static_cast<double>(i * 53 % 13)) / 13)};
    chart.triangles = {static_cast<std::uint32_t>(i)};
    atlas.chart_of.push_back(static_cast<std::uint32_t>(i));
    atlas.places.push_back({{chart.low, {chart.high[0], chart.low[1]}, chart.high}});
    atlas.charts.push_back(chart);
  }
  return atlas;
}

TEST_CASE("Charts are packed side by side, and scaled down where they do not fit") {
  for (const int largest : {4096, 300}) {
    Atlas atlas = rectangles(60, 70);
    pack(atlas, largest);
    CHECK(atlas.width <= largest);
    CHECK(atlas.height <= largest);
    double used = 0;
    cv::Mat taken(atlas.height, atlas.width, CV_8U, cv::Scalar(0));
    for (const Chart& chart : atlas.charts) {
      const cv::Rect place(chart.x, chart.y, chart.width, chart.height);
      REQUIRE((place & cv::Rect(0, 0, atlas.width, atlas.height)) == place);
      CHECK(cv::countNonZero(taken(place)) == 0);
      taken(place).setTo(1);
      used += place.area();
      for (const Place2& p : atlas.places[chart.triangles[0]]) {
        CHECK(p[0] >= chart.x + 2);
        CHECK(p[1] >= chart.y + 2);
        CHECK(p[0] <= chart.x + chart.width - 3);
        CHECK(p[1] <= chart.y + chart.height - 3);
      }
    }
    CHECK(used > 0.7 * atlas.width * atlas.height);
  }
  Atlas many = rectangles(100, 10);
  CHECK_THROWS_WITH(pack(many, 20), Catch::Contains("100 pieces") && Catch::Contains("--decimate"));
}

// Two squares side by side that are charts of two views, in constant colours.
struct TwoCharts {
  nef::Mesh mesh = strip({{-0.5, 0}, {0, 0}, {0.5, 0}});
  Surface surface{mesh};
  ViewResult view = from_above();
  Atlas atlas;

  TwoCharts() {
    atlas = make_charts(surface, {0, 0, 1, 1}, {&view, &view}, PixelOrigin::kCenter);
    pack(atlas, 4096);
  }

  [[nodiscard]] Texels painted(float left, float right) const {
    Texels texels(atlas);
    for (std::size_t texel = 0; texel < texels.size(); ++texel) {
      if (texels.triangle(texel) == Texels::kFree) continue;
      texels.color[texel].fill(texels.triangle(texel) < 2 ? left : right);
      texels.grade[texel] = TexelGrade::kInside;
    }
    return texels;
  }
};

TEST_CASE("Along a seam both sides come nearer to the middle of their colours, and far from it they stay") {
  const TwoCharts two;
  Texels texels = two.painted(100, 140);
  level_seams(two.surface, two.atlas, texels);
  const auto color_at = [&](std::uint32_t t, std::size_t corner) {
    return texels.color[texels.texel_at(two.atlas.places[t][corner])][0];
  };
  const float left = color_at(0, 1);  // at x = 0
  const float right = color_at(2, 0);
  CHECK(left > 115);
  CHECK(left < 121);
  CHECK(right > 119);
  CHECK(right < 135);
  CHECK(right - left < 16);  // of 40
  CHECK(color_at(0, 0) < left);
  CHECK(color_at(2, 1) > right);
  Texels same = two.painted(100, 100);
  level_seams(two.surface, two.atlas, same);
  CHECK(same.color == two.painted(100, 100).color);
}

TEST_CASE("Holes and what no view sees get the colours of their neighbours, and gaps the nearest colour") {
  const TwoCharts two;
  Texels texels = two.painted(100, 140);
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    const std::uint32_t t = texels.triangle(texel);
    if (t == Texels::kFree) continue;
    // A hole in the left chart, and nothing of the right one.
    const bool hole = std::hypot(texels.weights(texel)[0] - 0.3, texels.weights(texel)[1] - 0.3) < 0.1;
    if (!hole && t < 2) continue;
    texels.grade[texel] = TexelGrade::kNone;
    texels.color[texel] = {};
  }
  fill_unseen(two.mesh, two.surface, two.atlas, texels);
  const cv::Mat image = padded_image(texels);
  CHECK(cv::norm(image, cv::Mat(image.size(), CV_8UC3, cv::Scalar(100, 100, 100)), cv::NORM_INF) == 0);
}

TEST_CASE("The point of a triangle that is nearest to a place") {
  const Triangle2 t{{{0, 0}, {4, 0}, {0, 4}}};
  CHECK(nearest_point(t, 1, 1).squared_distance == 0);
  CHECK(nearest_point(t, 1, 1).weights[0] == Approx(0.5));
  CHECK(nearest_point(t, 1, -2).squared_distance == Approx(4));
  CHECK(nearest_point(t, 4, 4).squared_distance == Approx(8));
  CHECK(nearest_point(t, -3, -4).weights[0] == Approx(1));
  const Triangle2 point{{{2, 2}, {2, 2}, {2, 2}}};
  CHECK(nearest_point(point, 5, 6).squared_distance == Approx(25));
}

TEST_CASE("All pixels near a triangle are visited, and not many others") {
  for (const Triangle2& t :
       {Triangle2{{{1.2, 2.5}, {17.9, 3.1}, {5.5, 14.2}}}, Triangle2{{{-5, 9}, {30, 9.2}, {12, 9.1}}},
        Triangle2{{{3, 3}, {3, 12}, {3, 7}}}, Triangle2{{{4, 4}, {9, 4}, {6, 4}}}}) {
    cv::Mat seen(16, 20, CV_8U, cv::Scalar(0));
    std::size_t visited = 0;
    std::size_t near = 0;
    for_each_pixel_near(t, 1.5, 20, 16, [&](int x, int y) {
      CHECK(seen.at<std::uint8_t>(y, x) == 0);
      seen.at<std::uint8_t>(y, x) = 1;
      ++visited;
    });
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 20; ++x) {
        if (nearest_point(t, x, y).squared_distance > 1.5 * 1.5) continue;
        ++near;
        CHECK(seen.at<std::uint8_t>(y, x) == 1);
      }
    }
    CHECK(visited <= 2 * near + 20);
  }
}

}  // namespace
}  // namespace nef::visual_hull
