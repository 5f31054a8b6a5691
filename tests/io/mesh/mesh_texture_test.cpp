// SPDX-License-Identifier: Apache-2.0
//
// Textures in files of meshes.
#include "nef/io/mesh/mesh_texture.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/zip_archive.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

using Catch::Contains;

// A tetrahedron.
Mesh four_triangles() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& face :
       {std::array{0U, 2U, 1U}, std::array{0U, 1U, 3U}, std::array{1U, 2U, 3U}, std::array{2U, 0U, 3U}}) {
    mesh.push_face(face);
  }
  return mesh;
}

// Two charts: the last triangle has places of its own.
MeshTexture two_charts() {
  MeshTexture texture;
  texture.png = "not looked at";
  for (const std::uint32_t v : {0, 2, 1, 0, 1, 3, 1, 2, 3}) {
    texture.corners.push_back({static_cast<float>(v) / 8, 0.25F});
  }
  for (const std::uint32_t v : {2, 0, 3}) texture.corners.push_back({static_cast<float>(v) / 8, 0.75F});
  return texture;
}

TEST_CASE("Corners at one vertex with different places in the image are different vertices") {
  const Mesh mesh = four_triangles();
  const MeshTexture texture = two_charts();
  const TexturedVertices textured = textured_vertices(mesh, texture);
  CHECK(textured.vertex == std::vector<std::uint32_t>{0, 2, 1, 3, 2, 0, 3});
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    CHECK(textured.vertex[textured.corners[c]] == mesh.corners[c]);
    CHECK(textured.places[textured.corners[c]] == texture.corners[c]);
  }
}

TEST_CASE("OBJ, PLY, GLB and 3MF have textures, and are read as the same triangles") {
  const TemporaryFolder folder;
  const Mesh mesh = four_triangles();
  MeshWriteOptions options;
  options.texture = two_charts();
  for (const bool binary : {false, true}) {
    for (const MeshFormat& format : mesh_formats()) {
      if (binary && !format.has_two_forms()) continue;
      CAPTURE(format.name, binary);
      const std::string path = folder.file("my mesh." + std::string(format.extension));
      options.binary = binary;
      if (!format.has(kTexture)) {
        CHECK_THROWS_WITH(write_mesh(path, mesh, options), Contains("no textures; write OBJ, PLY, GLB or 3MF"));
        continue;
      }
      write_mesh(path, mesh, options);
      const Mesh back = read_mesh(path);
      REQUIRE(back.face_count() == 4);
      for (std::size_t c = 0; c < 12; ++c) CHECK(back.vertices[back.corners[c]] == mesh.vertices[mesh.corners[c]]);
    }
  }
  CHECK(read_file(folder.file("my_mesh_texture.png")) == "not looked at");
  CHECK_THAT(read_file(folder.file("my_mesh.mtl")), Contains("map_Kd my_mesh_texture.png"));
  CHECK_THAT(read_file(folder.file("my mesh.obj")),
             Contains("mtllib my_mesh.mtl") && Contains("\nf 1/1 3/2 2/3\n") && Contains("\nvt 0.375 0.75\n"));
  CHECK_THAT(read_file(folder.file("my mesh.ply")), Contains("comment TextureFile my_mesh_texture.png\n"));
}

TEST_CASE("Textures that a file cannot hold are refused") {
  const TemporaryFolder folder;
  MeshWriteOptions options;
  options.texture = two_charts();
  Mesh mesh = four_triangles();
  options.format = "obj";
  CHECK_THROWS_WITH(write_mesh("-", mesh, options), Contains("name a file, or write GLB or 3MF"));
  options.format = "";
  options.vertex_colors.assign(4, {});
  CHECK_THROWS_WITH(write_mesh(folder.file("a.ply"), mesh, options), Contains("excludes colours"));
  options.vertex_colors.clear();
  options.texture.corners.pop_back();
  CHECK_THROWS_WITH(write_mesh(folder.file("a.ply"), mesh, options), Contains("needs triangles"));
  options.texture = two_charts();
  mesh.corners.push_back(1);
  mesh.face_begin.back() += 1;
  options.texture.corners.push_back({});
  CHECK_THROWS_WITH(write_mesh(folder.file("a.ply"), mesh, options), Contains("needs triangles"));
  CHECK(std::filesystem::is_empty(std::filesystem::path(folder.file("a.ply")).parent_path()));
}

// What a zip archive holds under a name.
std::string unpacked(const std::string& path, const std::string& name) {
  const std::string bytes = read_file(path);
  ZipArchive archive(bytes, path);
  std::string content;
  archive.read(name, [&content](std::string_view piece) { content += piece; });
  return content;
}

TEST_CASE("3MF contains its image, and each corner names its place or its colour") {
  const TemporaryFolder folder;
  const Mesh mesh = four_triangles();
  MeshWriteOptions options;
  options.texture = two_charts();
  const std::string path = folder.file("solid.3mf");
  write_mesh(path, mesh, options);
  CHECK(unpacked(path, "3D/Textures/texture.png") == "not looked at");
  CHECK_THAT(unpacked(path, "3D/_rels/3dmodel.model.rels"), Contains("Target=\"/3D/Textures/texture.png\""));
  CHECK_THAT(unpacked(path, "[Content_Types].xml"), Contains("image/png"));
  const std::string model = unpacked(path, "3D/3dmodel.model");
  // The places in the order of textured_vertices: the vertices 0, 2, 1, 3 in one chart, then 2, 0, 3 in the other.
  CHECK_THAT(model, Contains("<m:texture2dgroup id=\"2\" texid=\"3\">\n   <m:tex2coord u=\"0\" v=\"0.25\"/>\n"
                             "   <m:tex2coord u=\"0.25\" v=\"0.25\"/>\n"));
  CHECK_THAT(model, Contains("<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"2\" p1=\"0\" p2=\"1\" p3=\"2\"/>") &&
                        Contains("<triangle v1=\"2\" v2=\"0\" v3=\"3\" pid=\"2\" p1=\"4\" p2=\"5\" p3=\"6\"/>"));
  MeshWriteOptions colored;
  colored.vertex_colors = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {18, 52, 86}};
  write_mesh(path, mesh, colored);
  const std::string colors = unpacked(path, "3D/3dmodel.model");
  CHECK_THAT(colors, Contains("<m:color color=\"#FF0000\"/>") && Contains("<m:color color=\"#123456\"/>") &&
                         Contains("v3=\"3\" pid=\"2\" p1=\"0\" p2=\"1\" p3=\"3\"/>"));
  CHECK(read_mesh(path).face_count() == 4);
}

}  // namespace
}  // namespace nef::test
