// SPDX-License-Identifier: Apache-2.0
//
// Parts of files by name: each is the solid that was written under that name.
#include "nef/io/mesh/mesh_parts.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/io/mesh/formats/glb_mesh.h"
#include "nef/io/mesh/formats/threemf_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/polyhedron_file.h"
#include "nef/io/zip_archive.h"
#include "nef/polyhedron.h"
#include "tests/support/obj_lines.h"

namespace nef {
namespace {

Polyhedron cube(long at) { return make_box({at, 0, 0}, {at + 1, 1, 1}); }

// A cube as lines of an OBJ whose vertices count from `first`.
std::string cube_lines(long at, std::size_t first) { return test::obj_lines(to_mesh(cube(at)).mesh, first); }

class PartFile {
 public:
  PartFile(const std::string& name, const std::string& bytes)
      : path_((std::filesystem::temp_directory_path() / ("nef_parts_" + name)).string()) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~PartFile() { std::filesystem::remove(path_); }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Polyhedron part(const std::string& name) const { return read_polyhedron(path_ + "#" + name); }

 private:
  std::string path_;
};

std::string glb(const std::string& json, std::string binary) {
  const auto padded = [](std::string chunk, char with) {
    chunk.resize((chunk.size() + 3) / 4 * 4, with);
    return chunk;
  };
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    return bytes;
  };
  const std::string text = padded(json, ' ');
  binary = padded(std::move(binary), '\0');
  const std::string chunks =
      number(text.size()) + "JSON" + text + number(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

// The corners of a tetrahedron as floats, twelve triangles' worth of indices left to strips of three.
std::string tetrahedron_floats() {
  std::string bytes;
  constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& face : kFaces) {
    for (const int corner : face) bytes.append(reinterpret_cast<const char*>(kCorners[corner]), 12);
  }
  return bytes;
}

}  // namespace

TEST_CASE("Groups and objects of OBJ are parts", "[parts]") {
  const PartFile file("a.obj", "o first body\n" + cube_lines(0, 1) + "o second\ng lid shared\n" + cube_lines(2, 9) +
                                   "g base shared\n" + cube_lines(4, 17));
  CHECK(equal(file.part("first body"), cube(0)));
  CHECK(equal(file.part("second"), unite(cube(2), cube(4))));
  CHECK(equal(file.part("lid"), cube(2)));
  CHECK(equal(file.part("base"), cube(4)));
  CHECK(equal(file.part("shared"), unite(cube(2), cube(4))));
  CHECK_THROWS_WITH(file.part("top"), Catch::EndsWith("there is no part 'top'; its parts are 'first body', 'lid', "
                                                      "'shared', 'second', 'base'"));
  // The whole file is what it was, and a file of the whole name is that file.
  CHECK(equal(read_polyhedron(file.path()), unite(unite(cube(0), cube(2)), cube(4))));
  const PartFile odd("b#lid.obj", cube_lines(7, 1));
  CHECK(equal(read_polyhedron(odd.path()), cube(7)));
  // Faces belong to the smallest part.
  MeshParts parts;
  const Mesh whole =
      read_obj("g a\n" + cube_lines(0, 1) + "g\n" + cube_lines(2, 9) + "g a\n" + cube_lines(4, 17), "c.obj", &parts);
  const std::vector<NamedMesh> split = split_into_parts(whole, parts);
  REQUIRE(split.size() == 2);
  CHECK(split[0].name == "a");
  CHECK(equal(from_mesh(split[0].mesh), unite(cube(0), cube(4))));
  CHECK(split[1].name.empty());
  CHECK(equal(from_mesh(split[1].mesh), cube(2)));
}

TEST_CASE("Nodes, meshes and materials of GLB are parts", "[parts]") {
  const std::string json =
      R"J({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
      "nodes": [{"name": "arm", "mesh": 0, "children": [1]}, {"name": "hand", "mesh": 0, "translation": [2, 0, 0]},
                {"name": "", "mesh": 1, "translation": [4, 0, 0]}],
      "meshes": [{"name": "bone", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                 {"primitives": [{"attributes": {"POSITION": 0}, "material": 7}]}],
      "materials": [{"name": "white"}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 144}], "buffers": [{"byteLength": 144}]})J";
  const PartFile file("a.glb", glb(json, tetrahedron_floats()));
  const Rational3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  const Polyhedron tetrahedron = convex_hull(corners);
  const auto at = [&](long x) { return transform(tetrahedron, AffineMap::translate({x, 0, 0})); };
  CHECK(equal(file.part("hand"), at(2)));
  CHECK(equal(file.part("arm"), unite(at(0), at(2))));
  CHECK(equal(file.part("bone"), unite(at(0), at(2))));
  CHECK(equal(file.part("white"), unite(at(0), at(2))));
  CHECK(equal(read_polyhedron(file.path()), unite(unite(at(0), at(2)), at(4))));
  CHECK_THROWS_AS(file.part("foot"), InputError);
}

TEST_CASE("Objects of 3MF are parts, by name or by number", "[parts]") {
  const auto object = [](const std::string& attributes) {
    return "<object " + attributes +
           "><mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
           "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/>"
           "<triangle v1='0' v2='1' v3='3'/><triangle v1='1' v2='2' v3='3'/><triangle v1='0' v2='3' v3='2'/>"
           "</triangles></mesh></object>";
  };
  const std::string model =
      "<model xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02'><resources>" +
      object("id='1' name='bolt'") + object("id='2'") +
      "<object id='3' name='both'><components><component objectid='1' transform='1 0 0 0 1 0 0 0 1 5 0 0'/>"
      "<component objectid='2'/></components></object></resources><build><item objectid='3'/>"
      "<item objectid='1' transform='1 0 0 0 1 0 0 0 1 9 0 0'/></build></model>";
  const PartFile file("a.3mf", zip_bytes({{"3D/3dmodel.model", model}}));
  const Rational3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Polyhedron tetrahedron = convex_hull(corners);
  const auto at = [&](long x) { return transform(tetrahedron, AffineMap::translate({x, 0, 0})); };
  CHECK(equal(file.part("2"), at(0)));
  CHECK(equal(file.part("bolt"), unite(at(5), at(9))));
  CHECK(equal(file.part("both"), unite(at(0), at(5))));
  CHECK_THROWS_WITH(file.part("nut"), Catch::EndsWith("its parts are 'bolt', '2', 'both'"));
  // Formats without names have no parts.
  const PartFile plain("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK_THROWS_WITH(plain.part("lid"), Catch::Contains("it has no named parts"));
}

}  // namespace nef
