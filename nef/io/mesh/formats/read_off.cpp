// SPDX-License-Identifier: Apache-2.0
//
// OFF: counts, vertices, faces. The header word may carry ST, C and N for what follows the coordinates of a vertex;
// it may be missing, and comments may come before it.
#include <algorithm>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/text_cursor.h"

namespace nef {
namespace {

struct OffHeader {
  bool attributes = false;  // colours, normals or texture coordinates follow each vertex in its line
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

std::size_t read_count(TextCursor& cursor, std::string_view word, const char* what) {
  const std::int64_t count = word.empty() ? cursor.integer(what) : cursor.parse_integer(word, what);
  if (count < 0 || count > 0x7fffffff) {
    cursor.fail(FileProblem::kWrongCount, "the " + std::string(what) + " is " + std::to_string(count));
  }
  return static_cast<std::size_t>(count);
}

OffHeader read_off_header(TextCursor& cursor) {
  OffHeader header;
  std::string_view word = cursor.word();
  const std::size_t off = word.find("OFF");
  if (off != std::string_view::npos && off + 3 == word.size()) {
    const std::string_view prefix = word.substr(0, off);
    if (prefix.find_first_not_of("STCN") != std::string_view::npos) {
      cursor.fail(FileProblem::kUnsupported,
                  "the header " + in_quotes(word) + " is not three-dimensional; OFF, COFF, NOFF and STOFF are read");
    }
    header.attributes = !prefix.empty();
    word = cursor.word();
    if (word == "BINARY") {
      cursor.fail(FileProblem::kUnsupported, "binary OFF is not read; convert the file to text");
    }
  } else if (word.empty() || word.find_first_not_of("0123456789") != std::string_view::npos) {
    cursor.fail(FileProblem::kSyntax, "an OFF file begins with the word OFF, and this one does not");
  }
  header.vertices = read_count(cursor, word, "number of vertices");
  header.faces = read_count(cursor, {}, "number of faces");
  // The number of edges is never right in the wild and may be missing.
  if (!cursor.line_done()) cursor.word_in_line();
  return header;
}

// A plain OFF may still carry colours: then the first vertex line has more than three words and there is a line for
// every item. Without a line for every item the words are a free stream.
bool has_hidden_attributes(TextCursor cursor, const OffHeader& header) {
  if (header.vertices == 0 || cursor.at_end()) return false;
  std::size_t words = 0;
  TextCursor first = cursor;
  while (!first.word_in_line().empty()) ++words;
  if (words <= 3) return false;
  std::size_t lines = 0;
  for (; lines < header.vertices + header.faces && !cursor.at_end(); ++lines) cursor.skip_line();
  return lines == header.vertices + header.faces;
}

void read_vertices(TextCursor& cursor, const OffHeader& header, Mesh& mesh) {
  mesh.vertices.reserve(std::min(header.vertices, cursor.rest().size() / 6 + 1));
  const bool attributes = header.attributes || has_hidden_attributes(cursor, header);
  for (std::size_t v = 0; v < header.vertices; ++v) {
    Rational3& point = mesh.vertices.emplace_back();
    for (Rational& x : point) cursor.number(x, "coordinate of vertex", v, FileElement::vertex(v));
    if (attributes) cursor.skip_line();
  }
}

void read_faces(TextCursor& cursor, const OffHeader& header, Mesh& mesh) {
  mesh.face_begin.reserve(std::min(header.faces, cursor.rest().size() / 8 + 1) + 1);
  mesh.corners.reserve(mesh.face_begin.capacity() * 3);
  for (std::size_t f = 0; f < header.faces; ++f) {
    if (cursor.at_end()) {
      cursor.fail(FileProblem::kWrongCount, "the header announces " + std::to_string(header.faces) +
                                                " faces, but the file ends after " + std::to_string(f));
    }
    const std::int64_t size = cursor.integer("number of corners of a face");
    if (size < 3) {
      cursor.fail(FileProblem::kSyntax, "face " + std::to_string(f) + " has " + std::to_string(size) +
                                            " corners; a face needs at least three");
    }
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t index = cursor.integer("corner of a face");
      if (index < 0 || index >= static_cast<std::int64_t>(header.vertices)) {
        cursor.fail(FileProblem::kBadIndex,
                    "face " + std::to_string(f) + " names vertex " + std::to_string(index) +
                        ", but vertices are 0 to " + std::to_string(static_cast<std::int64_t>(header.vertices) - 1),
                    FileElement::face(f));
      }
      mesh.corners.push_back(static_cast<std::uint32_t>(index));
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    cursor.skip_line();  // a colour may follow
  }
}

}  // namespace

bool is_off(std::string_view bytes) {
  const std::string no_path;
  return !is_binary_stl(bytes) && TextCursor(bytes, no_path).word().ends_with("OFF");
}

Mesh read_off(std::string_view bytes, const std::string& path) {
  TextCursor cursor(bytes, path);
  const OffHeader header = read_off_header(cursor);
  Mesh mesh;
  read_vertices(cursor, header, mesh);
  read_faces(cursor, header, mesh);
  if (!cursor.at_end()) {
    cursor.fail(FileProblem::kWrongCount, "there is more than the " + std::to_string(header.vertices) +
                                              " vertices and " + std::to_string(header.faces) +
                                              " faces that the header announces");
  }
  return mesh;
}

}  // namespace nef
