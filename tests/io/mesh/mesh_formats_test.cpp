// SPDX-License-Identifier: Apache-2.0
//
// What the table of mesh formats says, against the files that are written and against the table of the documentation.
#include "nef/io/mesh/mesh_formats.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/number/number.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace nef::test {
namespace {

// Two pyramids with a square base each, which meet in the corner 0; `apart`: each has a vertex of its own there.
Mesh two_pyramids(bool apart) {
  Mesh mesh;
  for (const int side : {1, -1}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    std::vector<std::uint32_t> v;
    for (const auto& p : {Rational3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}) {
      if (side < 0 && v.empty() && !apart) {
        v.push_back(0);
        continue;
      }
      v.push_back(first + static_cast<std::uint32_t>(v.size()) - (side < 0 && !apart ? 1 : 0));
      mesh.vertices.push_back({p[0] * side, p[1] * side, p[2] * side});
    }
    // A reflection in a point turns orientation over.
    const bool turned = side < 0;
    const std::vector<std::vector<std::uint32_t>> faces{
        {v[0], v[3], v[2], v[1]}, {v[0], v[1], v[4]}, {v[1], v[2], v[4]}, {v[2], v[3], v[4]}, {v[3], v[0], v[4]}};
    for (std::vector<std::uint32_t> face : faces) {
      if (turned) std::reverse(face.begin(), face.end());
      mesh.push_face(face);
    }
  }
  return mesh;
}

// A tenth, as a file of such numbers has it.
Rational tenth(FileNumbers numbers) {
  if (numbers == FileNumbers::kFloats) return exact_rational(0.1F);
  return numbers == FileNumbers::kDoubles ? exact_rational(0.1) : Rational(1, 10);
}

// The forms of a format: as text and as binary, or whatever its only one is.
std::vector<MeshWriteOptions> forms(const MeshFormat& format) {
  std::vector<MeshWriteOptions> all(format.has_two_forms() ? 2 : 1);
  if (format.has_two_forms()) all[1].binary = true;
  return all;
}

std::string yes(bool holds) { return holds ? "yes" : "–"; }

std::string spelled(FileNumbers numbers) {
  switch (numbers) {
    case FileNumbers::kFloats:
      return "floats";
    case FileNumbers::kDoubles:
      return "doubles";
    case FileNumbers::kDecimals:
      return "decimals";
    case FileNumbers::kNone:
      break;
  }
  return "–";
}

}  // namespace

TEST_CASE("Files hold coordinates and faces as the table of formats says") {
  Mesh mesh = two_pyramids(false);
  mesh.vertices[4][2] = Rational(1, 10);
  for (const MeshFormat& format : mesh_formats()) {
    for (const MeshWriteOptions& form : forms(format)) {
      CAPTURE(format.name, form.binary);
      const FileNumbers numbers = format.numbers(form.binary);
      const Mesh back = format.read(format.write(mesh, form), "file", nullptr);
      CHECK(back.face_count() == (format.has(kPolygons) ? 10 : 12));
      CHECK(back.vertices.size() == mesh.vertices.size());
      const bool there = std::any_of(back.vertices.begin(), back.vertices.end(), [&](const Rational3& p) {
        return p == Rational3{0, 0, tenth(numbers)};
      });
      CHECK(there);
    }
  }
}

TEST_CASE("What the table says that a format cannot hold is refused or not in its files, all else is") {
  const TemporaryFolder folder;
  const Mesh mesh = two_pyramids(false);
  Mesh third = mesh;
  third.vertices[4][2] = Rational(1, 3);
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.name);
    const std::string path = folder.file("mesh." + std::string(format.extension));
    const auto bytes = [&](const MeshWriteOptions& options) { return format.write(mesh, options); };

    MeshWriteOptions exact;
    exact.exact = true;
    if (format.has(kFractions)) {
      write_mesh(path, third, exact);
      CHECK(read_mesh(path).vertices[4][2] == Rational(1, 3));
    } else {
      CHECK_THROWS_AS(write_mesh(path, third, exact), FileError);
    }
    MeshWriteOptions binary;
    binary.binary = true;
    if (format.has_two_forms()) {
      CHECK(bytes(binary) != bytes({}));
    } else {
      CHECK_THROWS_AS(write_mesh(path, mesh, binary), FileError);
    }
    MeshWriteOptions colors;
    colors.vertex_colors.assign(mesh.vertices.size(), {10, 20, 30});
    if (format.has(kVertexColors)) {
      CHECK(bytes(colors) != bytes({}));
    } else {
      CHECK_THROWS_AS(write_mesh(path, mesh, colors), FileError);
    }
    MeshWriteOptions wires;
    wires.lines = {{1, 6}};
    wires.points = {2};
    CHECK((bytes(wires) != bytes({})) == format.has(kWires));
    MeshWriteOptions groups;
    groups.groups.names = {"one", "two"};
    groups.groups.of_face = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    CHECK((bytes(groups) != bytes({})) == format.has(kFaceGroups));
    MeshParts parts;  // 3MF has objects as parts, one in each of our files
    CHECK(format.read(bytes(groups), "file", &parts).face_count() > 0);
    CHECK(!parts.empty() == format.has(kNamedParts));
    CHECK((format.write(two_pyramids(true), {}) != bytes({})) == format.has(kNamedVertices));
  }
}

TEST_CASE("A file of any format and form is recognized by that format alone") {
  Mesh moved = two_pyramids(false);
  for (Rational3& p : moved.vertices) p[0] += Rational(1000000, 3);
  for (const Mesh& mesh : {two_pyramids(false), moved, Mesh()}) {
    for (const MeshFormat& format : mesh_formats()) {
      for (const MeshWriteOptions& form : forms(format)) {
        const std::string bytes = format.write(mesh, form);
        for (const MeshFormat& other : mesh_formats()) {
          CAPTURE(format.name, form.binary, other.name);
          // An OBJ without vertices holds comments only.
          const bool silent = mesh.vertices.empty() && format.extension == "obj";
          CHECK(other.recognizes(bytes) == (!silent && other.extension == format.extension));
        }
        if (!mesh.vertices.empty()) {
          CHECK(read_mesh(bytes, "no extension").vertices == format.read(bytes, "file", nullptr).vertices);
        }
      }
    }
  }
}

TEST_CASE("Formats are found by extension, what is none is refused with all of them") {
  for (const MeshFormat& format : mesh_formats()) {
    CHECK(find_mesh_format(format.extension) == &format);
    CHECK(&mesh_format_of("folder.x/NAME." + std::string(format.name)) == &format);
    CHECK(&mesh_format_of("a.nef", std::string(format.extension)) == &format);
  }
  CHECK(find_mesh_format("nef") == nullptr);
  CHECK(find_mesh_format("") == nullptr);
  CHECK_THROWS_WITH(mesh_format_of("a.xyz"), Catch::Contains("use off, obj, stl, ply, glb"));
  CHECK(mesh_format_names(kWires) == "OBJ");
  CHECK(mesh_format_names(kVertexColors, "and") == "PLY, GLB and 3MF");
}

TEST_CASE("The documentation has the table of formats") {
  const std::string page = read_file(source_folder() + "/docs/nef.md");
  for (const MeshFormat& format : mesh_formats()) {
    std::string row = "| `." + std::string(format.extension) + "` | " + spelled(format.numbers(false)) + " | " +
                      spelled(format.has_two_forms() ? format.binary : FileNumbers::kNone);
    for (const MeshTrait trait :
         {kFractions, kPolygons, kNamedVertices, kWires, kFaceGroups, kVertexColors, kNamedParts, kTexture}) {
      row += " | " + yes(format.has(trait));
    }
    CAPTURE(row);
    CHECK(page.find(row + " |\n") != std::string::npos);
  }
}

}  // namespace nef::test
