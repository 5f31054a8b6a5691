// SPDX-License-Identifier: Apache-2.0
//
// STL, text and binary: a list of triangles, each with its own coordinates. Normals are skipped: the order of the
// corners tells them.
#include <cmath>

#include "nef/io/binary_cursor.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/text_cursor.h"
#include "nef/mesh/vertex_merger.h"

namespace nef {
namespace {

constexpr std::size_t kHeader = 84;    // 80 bytes of anything and the number of triangles
constexpr std::size_t kTriangle = 50;  // normal, three corners, two bytes of anything

std::size_t binary_count(std::string_view bytes) {
  const std::string no_path;
  return BinaryCursor(bytes, no_path, 80, std::endian::little).take<std::uint32_t>("number of triangles");
}

// Many binary files begin with "solid" too, so their length decides first.
bool is_text(std::string_view bytes) {
  if (is_binary_stl(bytes)) return false;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  return bytes.substr(first).starts_with("solid") && bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

Mesh read_binary(std::string_view bytes, const std::string& path) {
  if (bytes.size() < kHeader) {
    throw FileError(FileProblem::kTruncated, path + ": byte " + std::to_string(bytes.size()) +
                                                 ": the file ends before the number of triangles; it is truncated, or "
                                                 "it is a text STL that does not begin with the word solid");
  }
  const std::size_t count = binary_count(bytes);
  const std::size_t have = (bytes.size() - kHeader) / kTriangle;
  if (bytes.size() != kHeader + kTriangle * count) {
    throw FileError(have < count ? FileProblem::kTruncated : FileProblem::kWrongCount,
                    path + ": byte " + std::to_string(bytes.size()) + ": the header announces " +
                        std::to_string(count) + " triangles, but the file has bytes for " + std::to_string(have) +
                        (bytes.size() == kHeader + kTriangle * have ? "" : " and a part of one"));
  }
  Mesh mesh;
  VertexMerger merger(mesh.vertices);
  BinaryCursor cursor(bytes, path, kHeader, std::endian::little);
  mesh.corners.reserve(3 * count);
  mesh.face_begin.reserve(count + 1);
  Rational3 point;
  for (std::size_t t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) cursor.take<float>("normal");
    for (int i = 0; i < 3; ++i) {
      for (Rational& x : point) {
        const auto value = cursor.take<float>("corner");
        if (!std::isfinite(value)) {
          cursor.fail(FileProblem::kNotANumber,
                      "a coordinate of triangle " + std::to_string(t) + " is not a finite number",
                      FileElement::face(t));
        }
        x = static_cast<double>(value);
      }
      mesh.corners.push_back(merger.add(point));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    cursor.take<std::uint16_t>("attribute");
  }
  return mesh;
}

void expect(TextCursor& cursor, std::string_view keyword) {
  const std::string_view word = cursor.word();
  if (word == keyword) return;
  cursor.fail(word.empty() ? FileProblem::kTruncated : FileProblem::kSyntax,
              "the word '" + std::string(keyword) + "' should be here, not " +
                  (word.empty() ? "the end of the file; it is truncated" : in_quotes(word)));
}

// A facet after its first word.
void read_facet(TextCursor& cursor, Mesh& mesh, VertexMerger& merger, Rational3& point) {
  expect(cursor, "normal");
  for (int i = 0; i < 3; ++i) cursor.word();  // often nan, never needed
  expect(cursor, "outer");
  expect(cursor, "loop");
  const std::size_t first = mesh.corners.size();
  std::string_view word = cursor.word();
  for (; word == "vertex"; word = cursor.word()) {
    for (Rational& x : point)
      cursor.number(x, "coordinate of a corner of facet", mesh.face_count(), FileElement::face(mesh.face_count()));
    mesh.corners.push_back(merger.add(point));
  }
  if (word != "endloop") {
    cursor.fail(word.empty() ? FileProblem::kTruncated : FileProblem::kSyntax,
                word.empty() ? "the file ends in the middle of a facet; it is truncated"
                             : "the word 'vertex' or 'endloop' should be here, not " + in_quotes(word));
  }
  if (mesh.corners.size() - first < 3) {
    cursor.fail(FileProblem::kSyntax, "facet " + std::to_string(mesh.face_count()) + " has " +
                                          std::to_string(mesh.corners.size() - first) +
                                          " corners; a facet needs three");
  }
  expect(cursor, "endfacet");
  mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

Mesh read_text(std::string_view bytes, const std::string& path) {
  Mesh mesh;
  VertexMerger merger(mesh.vertices);
  TextCursor cursor(bytes, path);
  Rational3 point;
  while (!cursor.at_end()) {
    expect(cursor, "solid");
    cursor.skip_line();  // its name
    std::string_view word = cursor.word();
    for (; word == "facet"; word = cursor.word()) read_facet(cursor, mesh, merger, point);
    if (word != "endsolid") {
      cursor.fail(word.empty() ? FileProblem::kTruncated : FileProblem::kSyntax,
                  word.empty() ? "the file ends without 'endsolid'; it is truncated"
                               : "the word 'facet' or 'endsolid' should be here, not " + in_quotes(word));
    }
    cursor.skip_line();
  }
  return mesh;
}

}  // namespace

bool is_stl(std::string_view bytes) { return bytes.starts_with("solid") || is_binary_stl(bytes); }

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * binary_count(bytes);
}

Mesh read_stl(std::string_view bytes, const std::string& path) {
  return is_text(bytes) ? read_text(bytes, path) : read_binary(bytes, path);
}

}  // namespace nef
