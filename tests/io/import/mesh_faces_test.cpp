// SPDX-License-Identifier: Apache-2.0
//
// Large meshes become the same sets, item for item, with the same messages, on any number of threads.
#include "nef/import/mesh_faces.h"

#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/native/native_binary.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

// A terrain over so many squares each way, with its walls and floor. Squares are flat here and bent there, and many
// corners lie in plains, where no map is read off the faces. `unit` divides the coordinates.
Mesh terrain(std::uint32_t along, long unit, std::mt19937& random) {
  Mesh mesh;
  const auto vertex = [along](std::uint32_t x, std::uint32_t y, std::uint32_t level) {
    return (level * (along + 1) + y) * (along + 1) + x;
  };
  for (std::uint32_t level = 0; level < 2; ++level) {
    for (std::uint32_t y = 0; y <= along; ++y) {
      for (std::uint32_t x = 0; x <= along; ++x) {
        const bool is_plain = x / 8 % 2 == y / 8 % 2;
        const int height = level == 0 ? 0 : 5 + (is_plain ? 0 : static_cast<int>(random() % 4));
        const Rational size = Rational(1) / unit;
        mesh.vertices.push_back({size * x, size * y, height});
      }
    }
  }
  for (std::uint32_t y = 0; y < along; ++y) {
    for (std::uint32_t x = 0; x < along; ++x) {
      mesh.push_face(std::vector{vertex(x, y, 1), vertex(x + 1, y, 1), vertex(x + 1, y + 1, 1), vertex(x, y + 1, 1)});
      mesh.push_face(std::vector{vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0)});
    }
  }
  for (std::uint32_t i = 0; i < along; ++i) {
    const std::uint32_t n = along;
    mesh.push_face(std::vector{vertex(i, 0, 0), vertex(i + 1, 0, 0), vertex(i + 1, 0, 1), vertex(i, 0, 1)});
    mesh.push_face(std::vector{vertex(i + 1, n, 0), vertex(i, n, 0), vertex(i, n, 1), vertex(i + 1, n, 1)});
    mesh.push_face(std::vector{vertex(0, i + 1, 0), vertex(0, i, 0), vertex(0, i, 1), vertex(0, i + 1, 1)});
    mesh.push_face(std::vector{vertex(n, i, 0), vertex(n, i + 1, 0), vertex(n, i + 1, 1), vertex(n, i, 1)});
  }
  return mesh;
}

MeshOptions on_threads(unsigned threads) {
  MeshOptions options;
  options.monitor = Monitor().on_threads(threads);
  return options;
}

TEST_CASE("A large mesh becomes the same set on any number of threads", "[import][threads]") {
  std::mt19937 random(3);
  const long unit = GENERATE(1L, 3L, 1L << 20, (1L << 60) - 1);  // the last one is beyond integers of one word
  const Mesh mesh = terrain(100, unit, random);
  Messages expected;
  const Polyhedron one = from_mesh(mesh, on_threads(1), &expected);
  REQUIRE(expected.size() > 1000);  // bent squares
  REQUIRE(one.complex().vertex_count() > 4000);
  CHECK(validate(one.complex()).empty());
  for (const unsigned threads : {2U, 5U, 0U}) {
    INFO("threads " << threads);
    Messages messages;
    CHECK(native_binary(from_mesh(mesh, on_threads(threads), &messages)) == native_binary(one));
    CHECK(messages == expected);
  }
}

TEST_CASE("The first bent face is refused, whichever thread finds one", "[import][threads]") {
  std::mt19937 random(4);
  const Mesh mesh = terrain(100, 1L, random);
  const auto refusal = [&](unsigned threads) -> std::string {
    MeshOptions options = on_threads(threads);
    options.strict = true;
    try {
      from_mesh(mesh, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string expected = refusal(1);
  CHECK_THAT(expected, Catch::Matchers::Contains("is not planar"));
  for (int i = 0; i < 5; ++i) CHECK(refusal(3) == expected);
}

}  // namespace
}  // namespace nef::test
