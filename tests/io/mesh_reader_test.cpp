// SPDX-License-Identifier: Apache-2.0
//
// Well-formed files of every format mean what they say, exactly.
#include <catch2/catch.hpp>

#include <bit>
#include <cstring>
#include <optional>
#include <random>
#include <string>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/text_cursor.h"
#include "nef/number/number.h"
#include "nef/polyhedron.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace nef {
namespace {

using Face = std::vector<std::uint32_t>;

std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<Face> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  return faces;
}

Rational3 point(const char* x, const char* y, const char* z) { return {Rational(x), Rational(y), Rational(z)}; }

template <typename T>
std::string bytes_of(T value, bool big = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST_CASE("OFF: numbers mean the rationals that they spell") {
  const Mesh mesh = read_off(
      "OFF\n3 1 0\n0.1 1/3 -2.50e1\n+7 .5 5.\n123456789012345678901234567890.5 1e-30 0.000000000000000000001\n3 0 1 "
      "2\n",
      "a.off");
  REQUIRE(mesh.vertices.size() == 3);
  CHECK(mesh.vertices[0] == point("1/10", "1/3", "-25"));
  CHECK(mesh.vertices[1] == point("7", "1/2", "5"));
  Rational large("246913578024691357802469135781/2");
  CHECK(mesh.vertices[2][0] == large);
  CHECK(mesh.vertices[2][1] == Rational("1/1000000000000000000000000000000"));
  CHECK(mesh.vertices[2][2] == Rational("1/1000000000000000000000"));
}

TEST_CASE("A byte order mark is skipped") {
  CHECK(read_off("\xef\xbb\xbfOFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").face_count() == 1);
  CHECK(read_obj("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").face_count() == 1);
}

TEST_CASE("OFF: short decimals are in lowest terms") {
  const Mesh mesh = read_off("OFF 3 1 0\n0.50 0.125 1.20\n-0.0 100 2.5e3\n12e-1 0.75e+1 0\n3 0 1 2\n", "a.off");
  CHECK(mesh.vertices[0] == point("1/2", "1/8", "6/5"));
  CHECK(mesh.vertices[1] == point("0", "100", "2500"));
  CHECK(mesh.vertices[2] == point("6/5", "15/2", "0"));
  for (const Rational3& p : mesh.vertices) {
    for (Rational x : p) {
      const Rational original = x;
      x.canonicalize();
      CHECK(mpz_cmp(x.get_den_mpz_t(), original.get_den_mpz_t()) == 0);
    }
  }
}

TEST_CASE("short decimals are the same numbers as by long division") {
  std::mt19937_64 random(3);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto digits = [&](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += static_cast<char>('0' + (below(3) != 0 ? below(10) : 0));
    return text;
  };
  for (int round = 0; round < 20000; ++round) {
    const char* const signs[] = {"-", "+", "", ""};
    std::string text = signs[below(4)] + std::string(below(4) == 0 ? below(12) : 0, '0') + digits(below(22));
    if (below(4) != 0) text += "." + std::string(below(3) == 0 ? below(14) : 0, '0') + digits(below(22));
    const char* const exponents[] = {"e", "e-", "E+"};
    if (below(3) == 0) text += exponents[below(3)] + std::to_string(below(40));
    Rational value;
    const bool is_number = parse_number(text, value);
    const std::optional<Rational> expected = try_parse_rational(text);
    INFO(text);
    REQUIRE(is_number == expected.has_value());
    if (!expected) continue;
    REQUIRE(value == *expected);
    REQUIRE(value.get_den() == expected->get_den());
  }
}

TEST_CASE("decimals at the limit of a machine word are the same numbers as by long division") {
  // 2^64 is 0 modulo a word, and so are its multiples of 20 digits: none of them may pass for a short number.
  for (const std::string digits :
       {"999999999999999999", "1000000000000000000", "9223372036854775807", "9223372036854775808",
        "9999999999999999999", "10000000000000000000", "19999999999999999999", "20000000000000000000",
        "28446744073709551616", "18446744073709551615", "18446744073709551616", "36893488147419103232",
        "92233720368547758080", "184467440737095516160", "18446744073709551616000"}) {
    for (const std::string& text :
         {digits, "-" + digits, "0." + digits, "-." + digits, "000" + digits,
          digits.substr(0, 1) + "." + digits.substr(1), digits + ".0", digits + "e1", digits + "e-19", "0.000" + digits,
          digits.substr(0, 1) + "e18", digits.substr(0, 1) + "e19", "1" + digits.substr(1) + "E+0"}) {
      Rational value;
      INFO(text);
      REQUIRE(parse_number(text, value));
      const std::optional<Rational> expected = try_parse_rational(text);
      REQUIRE(expected.has_value());
      CHECK(value == *expected);
      CHECK(value.get_den() == expected->get_den());
    }
  }
}

TEST_CASE("OFF: variants of the header and of the lines") {
  const std::vector<Face> expected{{0, 1, 2}, {0, 2, 3, 1}};
  const auto check = [&](const std::string& text) {
    INFO(text);
    const Mesh mesh = read_off(text, "a.off");
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[3] == point("0", "0", "1"));
    CHECK(faces_of(mesh) == expected);
  };
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n4 0 2 3 1\n";
  check("OFF\n4 2 5\n" + body);
  check("OFF 4 2 5\n" + body);
  check("OFF 4 2\n" + body);
  check("4 2 5\n" + body);
  check("# by hand\n\n  # again\nOFF # here\n# and here\n4 2 5 # counts\n\n" + body + "\n# the end");
  check("OFF\r\n4 2 5\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n3 0 1 2\r\n4 0 2 3 1\r\n");
  check("OFF\n4 2 5\n0 0 0 1 0 0\n0 1 0 0 0 1\n3 0 1 2\n4 0 2 3 1");
  check("OFF\n4 2 5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0 0\n4 0 2 3 1 0.5 0.5 0.5 1\n");
  check("COFF\n4 2 5\n0 0 0 9 9 9 255\n1 0 0 9 9 9 255\n0 1 0 9 9 9 255\n0 0 1 9 9 9 255\n3 0 1 2\n4 0 2 3 1\n");
  check("NOFF\n4 2 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n3 0 1 2\n4 0 2 3 1\n");
  check("STCNOFF\n4 2 5\n0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n0 0 1 1 2\n3 0 1 2\n4 0 2 3 1\n");
  // Colours that the header does not announce.
  check("OFF\n4 2 5\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n0 0 1 255 0 0\n3 0 1 2\n4 0 2 3 1\n");
}

TEST_CASE("OBJ: faces with texture and normal indices, negative indices, continued lines") {
  const Mesh mesh = read_obj(
      "# comment\nmtllib a.mtl\no thing\nv 0 0 0\nv 1/3 0 0 1.0\nv 0 0.1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
      "g side\nusemtl red\ns off\nf 1/1/1 2//1 3/1\nv 0 0 1\nf -4 -1 \\\n -3\nf 1 3 4 2 # quad\nl 1 2\n",
      "a.obj");
  REQUIRE(mesh.vertices.size() == 4);
  CHECK(mesh.vertices[1] == point("1/3", "0", "0"));
  CHECK(mesh.vertices[2] == point("0", "1/10", "0"));
  CHECK(faces_of(mesh) == std::vector<Face>{{0, 1, 2}, {0, 3, 1}, {0, 2, 3, 1}});
}

TEST_CASE("OBJ: a face may come before its vertices") {
  const Mesh mesh = read_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj");
  CHECK(faces_of(mesh) == std::vector<Face>{{0, 1, 2}});
}

TEST_CASE("STL text: vertices are merged by value, not by spelling") {
  const Mesh mesh = read_stl(
      "solid two words\n facet normal 0 0 nan\n  outer loop\n   vertex 0 0 0\n   vertex 1.0 0 0\n   vertex 0 1e0 0\n"
      "  endloop\n endfacet\nfacet normal 0 0 0 outer loop vertex 0 1 0 vertex 1 0 -0.0 vertex 1/3 1 1 endloop "
      "endfacet\n"
      "endsolid two words\n",
      "a.stl");
  REQUIRE(mesh.vertices.size() == 4);
  CHECK(mesh.vertices[3] == point("1/3", "1", "1"));
  CHECK(faces_of(mesh) == std::vector<Face>{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("STL binary: floats are the rationals that they are, whatever the header says") {
  for (const char* start : {"solid but binary", "anything"}) {
    std::string bytes = start;
    bytes.resize(80, '\0');
    bytes += bytes_of(std::uint32_t{2});
    const std::vector<std::array<float, 9>> triangles{{0, 0, 0, 0.1F, 0, 0, 0, 1, 0},
                                                      {0, 1, -0.0F, 0.1F, 0, 0, 0, 0, 1}};
    for (const auto& t : triangles) {
      for (int i = 0; i < 3; ++i) bytes += bytes_of(0.0F);
      for (const float x : t) bytes += bytes_of(x);
      bytes += bytes_of(std::uint16_t{0});
    }
    const Mesh mesh = read_stl(bytes, "a.stl");
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[1][0] == Rational(13421773, 134217728));  // the float 0.1
    CHECK(faces_of(mesh) == std::vector<Face>{{0, 1, 2}, {2, 1, 3}});
  }
}

TEST_CASE("PLY: triangle strips, restarted and turned around") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  // Around a tetrahedron in one strip.
  const Mesh one = read_ply(head + "6 0 2 1 3 0 2\n", "one.ply");
  CHECK(faces_of(one) == std::vector<Face>{{0, 2, 1}, {1, 2, 3}, {1, 3, 0}, {0, 3, 2}});
  CHECK(volume(from_mesh(one)) == Rational(1, 6));
  // In two strips; a corner that is named twice changes the side.
  const Mesh two = read_ply(head + "12 0 2 1 3 -1 1 3 0 0 0 3 2\n", "two.ply");
  CHECK(faces_of(two) == std::vector<Face>{{0, 2, 1}, {1, 2, 3}, {1, 3, 0}, {0, 3, 2}});
  CHECK_THROWS_WITH(read_ply(head + "3 0 1 -2\n", "bad.ply"), Catch::Contains("vertex -2"));
  CHECK_THROWS_WITH(read_ply(head + "3 0 1 9\n", "bad.ply"), Catch::Contains("vertex 9"));
}

TEST_CASE("PLY text and binary of both byte orders, with properties to skip") {
  const std::string properties =
      "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty uchar red\n"
      "property double z\nelement extra 1\nproperty list uchar short numbers\nelement face 2\n"
      "property uchar flag\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + properties +
                           "0 0 255 0\n1 0 255 0\n0 0.5 255 0\n0 0 255 1/3\n3 7 8 9\n0 3 0 1 2\n0 4 0 2 3 1\n";
  const Mesh ascii = read_ply(text, "a.ply");
  REQUIRE(ascii.vertices.size() == 4);
  CHECK(ascii.vertices[3] == point("0", "0", "1/3"));
  const std::vector<Face> expected{{0, 1, 2}, {0, 2, 3, 1}};
  CHECK(faces_of(ascii) == expected);
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n";
    bytes += properties;
    for (const auto& [x, y, z] : std::vector<std::tuple<float, float, double>>{
             {0.F, 0.F, 0.}, {1.F, 0.F, 0.}, {0.F, 0.5F, 0.}, {0.F, 0.F, 0.1}}) {
      bytes += bytes_of(x, big) + bytes_of(y, big) + bytes_of(std::uint8_t{255}) + bytes_of(z, big);
    }
    bytes += bytes_of(std::uint8_t{2}) + bytes_of(std::int16_t{1}, big) + bytes_of(std::int16_t{2}, big);
    for (const Face& face : expected) {
      bytes += bytes_of(std::uint8_t{0}) + bytes_of(static_cast<std::uint8_t>(face.size()));
      for (const std::uint32_t v : face) bytes += bytes_of(static_cast<std::int32_t>(v), big);
    }
    const Mesh mesh = read_ply(bytes, "a.ply");
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[3][2] == Rational(0.1));
    CHECK(mesh.vertices[2][1] == Rational(1, 2));
    CHECK(faces_of(mesh) == expected);
  }
}

TEST_CASE("The format is chosen by extension, else by content") {
  const test::TemporaryFolder folder;
  const std::string off = "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(read_mesh(folder.write("a.OFF", off)).face_count() == 1);
  CHECK(read_mesh(folder.write("noextension", off)).face_count() == 1);
  CHECK(read_mesh(folder.write("b.dat", "solid x\nendsolid x\n")).face_count() == 0);
  CHECK_THROWS_AS(read_mesh(folder.write("c.dat", "what is this\n")), FileError);
}

TEST_CASE("Real files have the counts that other programs find") {
  const std::string folder = source_folder() + "/data/meshes/";
  const auto check = [&](const char* name, std::size_t vertices, std::size_t faces) {
    INFO(name);
    const Mesh mesh = read_mesh(folder + name);
    CHECK(mesh.vertices.size() == vertices);
    CHECK(mesh.face_count() == faces);
  };
  check("star.off", 14, 24);
  check("cross_quad.off", 40, 38);
  check("corner_poly.off", 12, 8);
  check("hole.off", 20, 28);
  check("sphere.stl", 162, 320);
  check("sphere.ply", 162, 320);
}

}  // namespace
}  // namespace nef
