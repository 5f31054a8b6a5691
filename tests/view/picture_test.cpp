// SPDX-License-Identifier: Apache-2.0
//
// Pictures: what must be seen where, and what must be hidden.
#include <png.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "apps/view/picture.h"
#include "nef/base/error.h"
#include "view/sets.h"

namespace nef::view {
namespace {

constexpr Color kInk{31, 58, 90};
constexpr Color kOrange{217, 102, 43};

bool near(const Color& a, const Color& b, int tolerance = 40) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(int{a[i]} - int{b[i]}) > tolerance) return false;
  }
  return true;
}

Color pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::size_t at = 3 * (std::size_t{y} * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

std::size_t count(const Image& image, const Color& color, int tolerance = 25) {
  std::size_t n = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) n += near(pixel(image, x, y), color, tolerance) ? 1 : 0;
  }
  return n;
}

Image draw(const Polyhedron& set, const Point& from, const SceneOptions& scene = {}) {
  PictureOptions options;
  options.from = from;
  options.width = 900;
  options.height = 900;
  return draw_picture({layer_of("set", set, scene)}, options);
}

TEST_CASE("a cube from the front shows one facet in the middle, and no edge behind it") {
  const Image image = draw(cube(0, 2), {0, -1, 0});
  CHECK(near(pixel(image, 0, 0), {255, 255, 255}, 0));
  const Color front = pixel(image, 450, 450);
  CHECK_FALSE(near(front, {255, 255, 255}));
  // The far facet is smaller in perspective: its edges would be inside the near one.
  std::size_t differ = 0;
  for (std::uint32_t y = 100; y < 800; ++y) {
    for (std::uint32_t x = 100; x < 800; ++x) differ += pixel(image, x, y) == front ? 0 : 1;
  }
  CHECK(differ == 0);
  CHECK(count(image, kInk) > 300);
}

// Left half red, right half blue, by the place of each corner in the image.
SurfaceColors halves(const Scene& scene) {
  SurfaceColors surface;
  surface.image = {2, 1, {255, 0, 0, 0, 0, 255}};
  for (const auto& triangle : scene.triangles) {
    for (const std::uint32_t v : triangle) {
      surface.places.push_back({static_cast<float>(scene.vertices[v].position[0] / 2), 0.5F});
    }
  }
  return surface;
}

TEST_CASE("colours of a surface are drawn as they are, without edges") {
  Layer layer = layer_of("cube", cube(0, 2));
  PictureOptions options;
  options.from = Point{0, -1, 0};
  options.width = options.height = 300;
  layer.surface = halves(layer.scene);
  const Image image = draw_picture({layer}, options);
  CHECK(near(pixel(image, 100, 150), {255, 0, 0}, 1));
  CHECK(near(pixel(image, 200, 150), {0, 0, 255}, 1));
  CHECK(count(image, kInk) == 0);

  layer.surface = {};
  for (const SceneVertex& vertex : layer.scene.vertices) {
    layer.surface.vertices.push_back(vertex.position[2] > 1 ? Color{0, 250, 0} : Color{0, 50, 0});
  }
  const Image shaded = draw_picture({layer}, options);
  CHECK(near(pixel(shaded, 150, 150), {0, 150, 0}, 3));
  CHECK(pixel(shaded, 150, 80)[1] > pixel(shaded, 150, 220)[1] + 60);
}

TEST_CASE("edges of the complex are drawn, those of the triangulation are not") {
  // Seen along the hole: the triangulation of the upper facet would leave lines from the outer square to the inner.
  const Image image = draw(frame(), {0, 0, 1});
  CHECK(near(pixel(image, 450, 450), {255, 255, 255}, 0));
  const Color top = pixel(image, 450, 120);
  std::size_t changes = 0;
  for (std::uint32_t x = 100; x < 800; ++x) changes += near(pixel(image, x, 120), top, 6) ? 0 : 1;
  CHECK(changes == 0);
}

TEST_CASE("points behind a solid are hidden, points before it are seen") {
  const Polyhedron before = unite(cube(0, 2), make_point({1, -1, 1}));
  const Polyhedron behind = unite(cube(0, 2), make_point({1, 3, 1}));
  const auto dots = [](const Image& image) {
    std::size_t n = 0;
    for (std::uint32_t y = 300; y < 600; ++y) {
      for (std::uint32_t x = 300; x < 600; ++x) n += near(pixel(image, x, y), kInk, 12) ? 1 : 0;
    }
    return n;
  };
  CHECK(dots(draw(before, {0, -1, 0})) > 4);
  CHECK(dots(draw(behind, {0, -1, 0})) == 0);
}

TEST_CASE("what is not selected looks different") {
  const Image closed = draw(cube(0, 2), {0, -1, 0});
  const Image open = draw(interior(cube(0, 2)), {0, -1, 0});
  CHECK(count(closed, kOrange) == 0);
  CHECK(count(open, kOrange) > 200);
  CHECK(count(open, kInk) == 0);
  // Stripes: both light and dark pixels inside.
  CHECK(count(open, {252, 247, 240}, 40) > 1000);
  CHECK(count(open, pixel(closed, 450, 450), 40) > 1000);
}

TEST_CASE("lower-dimensional parts are visible") {
  const Image segment = draw(make_segment({0, 0, 0}, {1, 0, 1}), {0, -1, 0});
  CHECK(count(segment, kInk) > 200);
  const Image point = draw(make_point({5, 5, 5}), {0, -1, 0});
  CHECK(count(point, kInk) > 4);
  CHECK(near(pixel(point, 450, 450), kInk, 4));
  const std::vector<std::vector<Rational3>> sheet{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}};
  for (const double side : {-1.0, 1.0}) {
    CHECK_FALSE(near(pixel(draw(make_polygon(sheet), {0.1, side, 0}), 450, 450), {255, 255, 255}));
  }
}

TEST_CASE("a section opens a cavity") {
  const Polyhedron hollow = subtract(cube(0, 6), interior(cube(2, 4)));
  SceneOptions section;
  section.section = {0, -1, 0, 3};  // y >= 3 stays
  const Image whole = draw(hollow, {0, -1, 0});
  const Image cut = draw(hollow, {0, -1, 0}, section);
  CHECK(near(pixel(whole, 450, 450), pixel(whole, 180, 450), 4));
  // The wall of the cavity is seen straight on, dark; the cut around it is light.
  const Color wall = pixel(cut, 450, 450);
  const Color rim = pixel(cut, 180, 450);
  CHECK(rim[0] > wall[0] + 20);
}

TEST_CASE("see-through layers let others shine through in order of depth") {
  std::vector<Layer> layers{layer_of("front", make_box({0, 0, 0}, {2, 1, 2})),
                            layer_of("back", make_box({0, 3, 0}, {2, 4, 2}))};
  layers[0].color = Color{255, 0, 0};
  layers[1].color = Color{0, 0, 255};
  PictureOptions options;
  options.from = Point{0, -1, 0};
  options.width = options.height = 200;
  const Color opaque = pixel(draw_picture(layers, options), 100, 100);
  CHECK(opaque[2] == 0);
  layers[0].opacity = 0.5;
  const Color mixed = pixel(draw_picture(layers, options), 100, 100);
  CHECK(mixed[0] > 100);
  CHECK(mixed[2] > 30);
  layers[0].visible = false;
  CHECK(pixel(draw_picture(layers, options), 100, 100)[0] == 0);
}

TEST_CASE("a PNG file holds the picture") {
  PictureOptions options;
  options.width = 64;
  options.height = 48;
  const Image image = draw_picture({layer_of("cube", cube(0, 1))}, options);
  const std::string bytes = png_bytes(image);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0);
  CHECK(header.width == 64);
  CHECK(header.height == 48);
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(header));
  REQUIRE(png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr) != 0);
  CHECK(rgb == image.rgb);
}

TEST_CASE("impossible pictures are refused in one line") {
  PictureOptions options;
  options.width = 0;
  CHECK_THROWS_AS(draw_picture({}, options), InputError);
  options = {};
  options.from = Point{0, 0, 0};
  CHECK_THROWS_AS(draw_picture({}, options), InputError);
}

}  // namespace
}  // namespace nef::view
