// SPDX-License-Identifier: Apache-2.0
//
// Pages read back as the viewer reads them: base64, zlib, JSON and arrays.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/view/page.h"
#include "apps/view/page/byte_text.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "view/sets.h"

namespace nef::view {
namespace {

using Json = nlohmann::json;

struct ParsedScene {
  Json json;
  std::string blobs;

  template <typename T>
  [[nodiscard]] std::vector<T> array(const Json& reference) const {
    std::vector<T> values(reference[2].get<std::size_t>());
    const std::size_t offset = reference[1];
    REQUIRE(offset % 4 == 0);
    REQUIRE(offset + values.size() * sizeof(T) <= blobs.size());
    std::memcpy(values.data(), blobs.data() + offset, values.size() * sizeof(T));
    return values;
  }
  [[nodiscard]] std::vector<std::string> lines(const Json& reference) const {
    const std::vector<char> text = array<char>(reference);
    std::vector<std::string> result{""};
    for (const char c : text) {
      if (c == '\n') {
        result.emplace_back();
      } else {
        result.back() += c;
      }
    }
    return result;
  }
};

ParsedScene parse(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), 4);
  return {Json::parse(bytes.substr(4, length)), bytes.substr((4 + length + 3) / 4 * 4)};
}

std::string inflated(const std::string& bytes) {
  std::string result(std::size_t{8} << 20U, '\0');
  uLongf size = result.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                     bytes.size()) == Z_OK);
  result.resize(size);
  return result;
}

std::string from_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6U | static_cast<std::uint32_t>(kDigits.find(c));
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>(word >> static_cast<unsigned>(bits) & 255U);
    }
  }
  return bytes;
}

TEST_CASE("base64 writes the test vectors of RFC 4648") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\xfe\xfd", 3)) == "//79");
}

TEST_CASE("a page holds exact coordinates and planes of every item") {
  const std::vector<Layer> layers{layer_of("mixture", mixture())};
  const ParsedScene scene = parse(page_scene(layers));
  const Json& layer = scene.json["layers"][0];
  CHECK(layer["name"] == "mixture");
  const Scene& drawn = layers[0].scene;
  const Complex& complex = drawn.source.complex();
  const std::vector<std::string> points = scene.lines(layer["exact"]["points"]);
  REQUIRE(points.size() == drawn.vertices.size() + 1);
  bool found = false;
  for (std::size_t v = 0; v < drawn.vertices.size(); ++v) found = found || points[v] == "10/3 1 5/2";
  CHECK(found);
  const std::vector<std::string> planes = scene.lines(layer["exact"]["planes"]);
  const auto begin = scene.array<std::uint32_t>(layer["facets"]["begin"]);
  const auto corners = scene.array<std::uint32_t>(layer["facets"]["corners"]);
  REQUIRE(begin.size() == drawn.facets.size() + 1);
  for (std::size_t f = 0; f < drawn.facets.size(); ++f) {
    // Each corner satisfies the equation that the page shows.
    std::array<Rational, 4> plane;
    std::istringstream(planes[f]) >> plane[0] >> plane[1] >> plane[2] >> plane[3];
    for (std::uint32_t i = 3 * begin[f]; i < 3 * begin[f + 1]; ++i) {
      Rational3 p;
      std::istringstream(points[corners[i]]) >> p[0] >> p[1] >> p[2];
      CHECK(Rational(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]) == 0);
    }
  }
  const auto marks = scene.array<std::uint16_t>(layer["vertices"]["mark"]);
  const auto indices = scene.array<std::uint32_t>(layer["vertices"]["index"]);
  for (std::size_t v = 0; v < marks.size(); ++v) CHECK(marks[v] == complex.mark(VertexId{indices[v]}));
  const auto spheres = scene.array<std::uint32_t>(layer["spheres"]["begin"]);
  REQUIRE(spheres.size() == 4 * (drawn.vertices.size() + 1));
  CHECK(spheres[spheres.size() - 4] == complex.svertex_count());
  CHECK(2 * spheres[spheres.size() - 3] == complex.shalfedge_count());
  CHECK(spheres[spheres.size() - 1] == complex.sface_count());
}

TEST_CASE("coordinates far from the origin keep their shape, and texts can be left out") {
  const Integer far = Integer(1) << 60;
  const std::vector<Layer> layers{layer_of("far", make_box({far, 0, 0}, {far + 1, 1, 1}))};
  // At 2^60 doubles are 256 apart: the box is flat to the eye, and its exact coordinates are not.
  const ParsedScene scene = parse(page_scene(layers));
  const std::vector<std::string> points = scene.lines(scene.json["layers"][0]["exact"]["points"]);
  CHECK(std::count_if(points.begin(), points.end(), [&far](const std::string& line) {
          return line.starts_with(Integer(far + 1).get_str() + " ");
        }) == 4);
  PageOptions options;
  options.exact_text_limit = 10;
  CHECK_FALSE(parse(page_scene(layers, options)).json["layers"][0].contains("exact"));
}

TEST_CASE("a page holds the colours of a surface, of vertices or as an image") {
  std::vector<Layer> layers{layer_of("cube", cube(0, 2))};
  CHECK_FALSE(parse(page_scene(layers)).json["layers"][0].contains("surface"));
  for (std::size_t v = 0; v < 8; ++v) layers[0].surface.vertices.push_back({static_cast<std::uint8_t>(v), 2, 3});
  const ParsedScene painted = parse(page_scene(layers));
  const auto rgb = painted.array<std::uint8_t>(painted.json["layers"][0]["surface"]["rgb"]);
  REQUIRE(rgb.size() == 24);
  CHECK(rgb[3 * 5] == 5);
  layers[0].surface = {};
  layers[0].surface.image = {1, 1, {9, 8, 7}};
  layers[0].surface.places.assign(36, {0.25F, 0.75F});
  const ParsedScene textured = parse(page_scene(layers));
  const Json& surface = textured.json["layers"][0]["surface"];
  CHECK(textured.array<float>(surface["places"])[71] == 0.75F);
  const std::string url = surface["url"];
  CHECK(url.starts_with("data:image/png;base64,"));
  CHECK(from_base64(url.substr(22)) == png_bytes(layers[0].surface.image));
}

TEST_CASE("a written page is whole and needs no network") {
  if (!has_viewer_bundle()) {
    CHECK_THROWS_AS(write_page({}, "unused.html"), UnsupportedError);
    WARN("skipped: the viewer bundle was not built (no node, npm or network)");
    return;
  }
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "nef_view_page_test.html";
  const std::vector<Layer> layers{layer_of("frame", frame())};
  PageOptions options;
  options.title = "a <b> & c";
  write_page(layers, path.string(), options);
  const std::string page = read_file(path.string());
  std::filesystem::remove(path);
  CHECK(page.find("<title>a &lt;b&gt; &amp; c</title>") != std::string::npos);
  CHECK(page.find("@NEF_") == std::string::npos);
  CHECK(page.find("SPDX-License-Identifier: MIT") != std::string::npos);  // three.js keeps its licence
  for (const char* link : {"<script src", "<link", "<img", "import(", "@import"}) {
    CHECK(page.find(link) == std::string::npos);
  }
  const std::string mark = "id=\"scene-data\">";
  const std::size_t begin = page.find(mark) + mark.size();
  const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
  CHECK(inflated(from_base64(data)) == page_scene(layers, options));
}

}  // namespace
}  // namespace nef::view
