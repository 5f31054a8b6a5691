// SPDX-License-Identifier: Apache-2.0
//
// GLB: damaged numbers are refused rather than taken for others, and no file unfolds without end.
#include "nef/io/mesh/formats/glb_mesh.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef::test {
namespace {

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string chunk(std::uint32_t type, std::string content) {
  content.resize((content.size() + 3) / 4 * 4, ' ');
  return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(content.size()), type}) + content;
}

std::string glb(const std::string& json, const std::string& binary) {
  const std::string chunks = chunk(0x4e4f534a, json) + chunk(0x004e4942, binary);
  return "glTF" + bytes_of<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

// A tetrahedron: 48 bytes of positions, 24 of indices.
std::string numbers() {
  return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         bytes_of<std::uint16_t>({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
}

constexpr const char* kTetrahedron =
    R"({"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"mesh":0,"scale":[1,2,1]}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],)"
    R"("accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":4,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
    R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
    R"("buffers":[{"byteLength":72}]})";

// With the first place of a text changed.
std::string with(const std::string& old, const std::string& fresh) {
  std::string json = kTetrahedron;
  const std::size_t at = json.find(old);
  REQUIRE(at != std::string::npos);
  return json.replace(at, old.size(), fresh);
}

std::string refusal(const std::string& bytes) {
  try {
    read_glb(bytes, "a.glb");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("GLB: a file by the book is read", "[glb]") {
  const Mesh mesh = read_glb(glb(kTetrahedron, numbers()), "a.glb");
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.face_count() == 4);
  CHECK(mesh.vertices[2] == Rational3{0, 0, 2});  // y goes up, twice as far
}

TEST_CASE("GLB: integers that are none are refused by name", "[glb]") {
  for (const char* field : {"scene", "mesh", "POSITION", "indices", "mode", "bufferView", "byteOffset", "componentType",
                            "count", "buffer", "byteLength"}) {
    for (const char* value : {"0.5", "1e300", "18446744073709551616", "-1", "true", "null", "\"0\"", "[0]", "0.0"}) {
      const std::string key = std::string("\"") + field + "\":";
      std::string json = kTetrahedron;
      const std::size_t at = json.find(key) + key.size();
      json.replace(at, json.find_first_of(",}", at) - at, value);
      INFO(json);
      CHECK_THAT(refusal(glb(json, numbers())), Catch::Contains(std::string("'") + field + "'"));
    }
  }
  for (const char* value : {"0.5", "1e300", "18446744073709551616", "-1", "true"}) {
    CHECK_THAT(refusal(glb(with("\"nodes\":[0]", std::string("\"nodes\":[") + value + "]"), numbers())),
               Catch::Contains("'node'"));
    CHECK_THAT(refusal(glb(with("[1]", std::string("[") + value + "]"), numbers())), Catch::Contains("'child'"));
  }
  CHECK_THAT(refusal(glb(with("[1]", "1"), numbers())), Catch::Contains("'children'"));
  CHECK_THAT(refusal(glb(with("[1,2,1]", "[1,true,1]"), numbers())), Catch::Contains("transformation"));
  CHECK_THAT(refusal(glb(with("[1,2,1]", "[1,2,1,1]"), numbers())), Catch::Contains("'scale'"));
  CHECK_THAT(refusal(glb(with("5123", "5126"), numbers())), Catch::Contains("floats") || Catch::Contains("beyond"));
}

TEST_CASE("GLB: lengths that are not those of the file are refused", "[glb]") {
  const std::string good = glb(kTetrahedron, numbers());
  const std::size_t binary = good.size() - 72 - 8;
  for (const std::size_t at : {std::size_t{8}, std::size_t{12}, binary}) {
    for (const std::uint32_t length : {0U, 1U, 0x7fffffffU, 0xffffffffU}) {
      std::string bad = good;
      std::memcpy(bad.data() + at, &length, 4);
      INFO(at << " " << length);
      CHECK(!refusal(bad).empty());
    }
  }
  CHECK_THAT(refusal(good + "more"), Catch::Contains("header says"));
  CHECK_THAT(refusal(good.substr(0, good.size() - 4)), Catch::Contains("truncated"));
  for (const char* length : {"0", "71", "76", "4294967295"})
    CHECK(!refusal(glb(with("72", length), numbers())).empty());
  for (const char* length : {"0", "47", "73", "4294967295"}) {
    CHECK(!refusal(glb(with("48}", std::string(length) + "}"), numbers())).empty());
  }
  // One point read four thousand million times.
  CHECK(!refusal(glb(with("\"byteLength\":48", "\"byteLength\":48,\"byteStride\":0"), numbers())).empty());
}

TEST_CASE("GLB: nodes and meshes that unfold to very many copies are refused", "[glb]") {
  // Each node has the next one twice: 2 to the power of 28 tetrahedra in 1,400 bytes.
  std::string nodes;
  for (int i = 1; i < 28; ++i) {
    nodes += "{\"children\":[" + std::to_string(i) + "," + std::to_string(i) + "]},";
  }
  const std::string old = R"("nodes":[{"children":[1]},{"mesh":0,"scale":[1,2,1]}])";
  CHECK_THAT(refusal(glb(with(old, "\"nodes\":[" + nodes + "{\"mesh\":0}]"), numbers())), Catch::Contains("node "));
  CHECK_THAT(refusal(glb(with("[1]", "[0]"), numbers())), Catch::Contains("named twice"));
  // Two thousand copies of a thousand points.
  const std::size_t points = 1000;
  std::string json = with("\"count\":4", "\"count\":" + std::to_string(points));
  const auto replace = [&json](const std::string& from, const std::string& to) {
    json.replace(json.find(from), from.size(), to);
  };
  std::string primitives;
  for (int i = 0; i < 2000; ++i) primitives += R"({"attributes":{"POSITION":0},"indices":1},)";
  replace(R"({"attributes":{"POSITION":0},"indices":1,"mode":4})", primitives + R"({"attributes":{"POSITION":0}})");
  replace("\"byteOffset\":48", "\"byteOffset\":" + std::to_string(12 * points));
  replace("\"byteLength\":48", "\"byteLength\":" + std::to_string(12 * points));
  replace("\"byteLength\":72", "\"byteLength\":" + std::to_string(12 * points + 24));
  const std::string all = bytes_of(std::vector<float>(3 * points, 1)) + numbers().substr(48);
  CHECK_THAT(refusal(glb(json, all)), Catch::Contains("more than a thousand copies"));
}

}  // namespace nef::test
