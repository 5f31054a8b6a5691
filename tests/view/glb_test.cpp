// SPDX-License-Identifier: Apache-2.0
//
// glTF files: by their specification, and read by assimp where it is installed.
#include "apps/view/glb.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "view/sets.h"
#ifdef NEF_TEST_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace nef::view {
namespace {

using Json = nlohmann::json;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::vector<Layer> moving_cubes() {
  std::vector<Layer> layers{layer_of("obstacle", unite(cube(0, 1), make_point({3, 3, 3}))),
                            layer_of("robot", cube(5, 6))};
  layers[1].motion = {{0, 1, 3}, {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}};
  layers[1].lines.push_back({"path", {{5, 5, 5}, {6, 5, 5}, {6, 7, 5}}});
  return layers;
}

TEST_CASE("a layer that is not visible is in the second scene only") {
  std::vector<Layer> layers = moving_cubes();
  layers[0].visible = false;
  const std::string bytes = glb_bytes(layers);
  const Json json = Json::parse(bytes.substr(20, word(bytes, 12)));
  const auto names_in = [&json](std::size_t scene) {
    std::vector<std::string> names;
    std::vector<std::size_t> open = json["scenes"][scene]["nodes"];
    while (!open.empty()) {
      const Json& node = json["nodes"][open.back()];
      open.pop_back();
      names.push_back(node["name"]);
      for (const Json& child : node.value("children", Json::array())) open.push_back(child.get<std::size_t>());
    }
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::count(names.begin(), names.end(), name) == 1;
  };
  CHECK(json["scene"] == 0);
  CHECK(has(names_in(0), "robot"));
  CHECK_FALSE(has(names_in(0), "obstacle"));
  CHECK(has(names_in(1), "robot"));
  CHECK(has(names_in(1), "obstacle"));
  CHECK(names_in(1).size() == json["nodes"].size());
  const std::string all = glb_bytes(moving_cubes());
  CHECK(Json::parse(all.substr(20, word(all, 12)))["scenes"].size() == 1);
}

TEST_CASE("a glTF file has the chunks, nodes and arrays that the specification asks for") {
  const std::string bytes = glb_bytes(moving_cubes());
  REQUIRE(bytes.substr(0, 4) == "glTF");
  CHECK(word(bytes, 4) == 2);
  CHECK(word(bytes, 8) == bytes.size());
  const std::size_t json_size = word(bytes, 12);
  REQUIRE(bytes.substr(16, 4) == "JSON");
  REQUIRE(json_size % 4 == 0);
  const Json json = Json::parse(bytes.substr(20, json_size));
  const std::size_t binary = 20 + json_size;
  REQUIRE(bytes.substr(binary + 4, 4) == std::string("BIN\0", 4));
  REQUIRE(binary + 8 + word(bytes, binary) == bytes.size());
  REQUIRE(json["buffers"][0]["byteLength"] == word(bytes, binary));
  for (const Json& accessor : json["accessors"]) {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t width = accessor["type"] == "VEC3" ? 3 : 1;
    CHECK(accessor["count"].get<std::size_t>() * width * 4 == view["byteLength"].get<std::size_t>());
    CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <= word(bytes, binary));
  }
  std::vector<std::string> names;
  for (const Json& node : json["nodes"]) names.push_back(node["name"]);
  for (const char* name : {"obstacle", "robot", "volume 1", "edges", "isolated vertices", "path"}) {
    CHECK(std::count(names.begin(), names.end(), name) >= 1);
  }
  const Json& animation = json["animations"][0];
  const std::size_t target = animation["channels"][0]["target"]["node"];
  CHECK(json["nodes"][target]["name"] == "robot");
  CHECK(animation["channels"][0]["target"]["path"] == "translation");
  const Json& times = json["accessors"][animation["samplers"][0]["input"].get<std::size_t>()];
  CHECK(times["min"][0] == 0);
  CHECK(times["max"][0] == 3);
}

TEST_CASE("an empty scene is a legal file") {
  const std::string bytes = glb_bytes({layer_of("nothing", Polyhedron())});
  CHECK(word(bytes, 8) == bytes.size());
  const Json json = Json::parse(bytes.substr(20, word(bytes, 12)));
  CHECK_FALSE(json.contains("buffers"));
  CHECK_FALSE(json.contains("meshes"));
}

#ifdef NEF_TEST_ASSIMP
TEST_CASE("assimp reads the same volumes and motion") {
  const std::string bytes = glb_bytes(moving_cubes());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_PreTransformVertices, "glb");
  REQUIRE(scene != nullptr);
  // World coordinates: z of the layers is y of glTF, y is -z.
  double volume = 0;
  std::size_t triangles = 0;
  aiVector3D low(1e9F, 1e9F, 1e9F);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) continue;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      REQUIRE(face.mNumIndices == 3);
      ++triangles;
      const aiVector3D& a = mesh.mVertices[face.mIndices[0]];
      const aiVector3D& b = mesh.mVertices[face.mIndices[1]];
      const aiVector3D& c = mesh.mVertices[face.mIndices[2]];
      volume += static_cast<double>(a * (b ^ c)) / 6;
      low.y = std::min({low.y, a.y, b.y, c.y});
    }
  }
  CHECK(triangles == 24);
  CHECK(volume == Approx(2));
  CHECK(low.y == Approx(0).margin(1e-5));

  Assimp::Importer animated;
  const aiScene* moving = animated.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  REQUIRE(moving != nullptr);
  REQUIRE(moving->mNumAnimations == 1);
  const aiNodeAnim& channel = *moving->mAnimations[0]->mChannels[0];
  CHECK(std::string(channel.mNodeName.C_Str()) == "robot");
  REQUIRE(channel.mNumPositionKeys == 3);
  CHECK(channel.mPositionKeys[2].mValue.y == Approx(2));
}
#endif

}  // namespace
}  // namespace nef::view
