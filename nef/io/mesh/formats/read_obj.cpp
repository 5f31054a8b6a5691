// SPDX-License-Identifier: Apache-2.0
//
// Wavefront OBJ: the lines v and f, and o and g for the names of parts. Indices count from one, or back from the last
// vertex if they are negative.
#include <algorithm>
#include <array>
#include <cstring>

#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/text_cursor.h"

namespace nef {
namespace {

// What an OBJ may hold besides v and f, none of which matters to a solid.
bool is_other_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 44> kWords{
      "vt",    "vn",    "vp",   "g",    "o",    "s",      "mg",       "usemtl",   "mtllib", "usemap",     "maplib",
      "l",     "p",     "deg",  "bmat", "step", "cstype", "curv",     "curv2",    "surf",   "parm",       "trim",
      "hole",  "scrv",  "sp",   "end",  "con",  "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj",
      "ctech", "stech", "call", "csh",  "bzp",  "bsp",    "cdc",      "cdp",      "res",    "scmp",       "vc"};
  for (const std::string_view known : kWords) {
    if (word == known) return true;
  }
  return false;
}

// The words of one logical line: a backslash at the end joins the next line.
std::string_view next_word(TextCursor& cursor) {
  for (;;) {
    const std::string_view word = cursor.word_in_line();
    if (word != "\\") return word;
    cursor.skip_line();
  }
}

// The lines that begin with the word v, but at most as many as the shortest lines of vertices would fill the file. Room
// for so many vertices is made at once, as numbers of any length are not moved for nothing when there is more to come.
std::size_t count_vertices(std::string_view bytes) {
  constexpr std::size_t kShortest = 8;  // bytes of "v 0 0 0" and the end of the line
  std::size_t count = 0;
  const char* const end = bytes.data() + bytes.size();
  for (const char* line = bytes.data(); end - line > 1;) {
    if (line[0] == 'v' && (line[1] == ' ' || line[1] == '\t')) ++count;
    const void* const stop = std::memchr(line, '\n', static_cast<std::size_t>(end - line));
    if (stop == nullptr) break;
    line = static_cast<const char*>(stop) + 1;
  }
  return std::min(count, bytes.size() / kShortest);
}

void read_vertex(TextCursor& cursor, Mesh& mesh) {
  const std::size_t v = mesh.vertices.size() + 1;
  Rational3& point = mesh.vertices.emplace_back();
  for (Rational& x : point) {
    const std::string_view word = next_word(cursor);
    if (word.empty()) {
      cursor.fail(FileProblem::kTruncated, "vertex " + std::to_string(v) + " has fewer than three coordinates");
    }
    cursor.parse(word, x, "coordinate of vertex", v, FileElement::vertex(v - 1));
  }
}

void read_face(TextCursor& cursor, Mesh& mesh, std::vector<std::size_t>& lines) {
  const std::size_t face = mesh.face_count() + 1;
  const std::size_t first = mesh.corners.size();
  for (std::string_view word = next_word(cursor); !word.empty(); word = next_word(cursor)) {
    const std::int64_t index = cursor.parse_integer(word.substr(0, word.find('/')), "corner of a face");
    const auto count = static_cast<std::int64_t>(mesh.vertices.size());
    const std::int64_t absolute = index < 0 ? count + index : index - 1;
    // A face may come before its vertices; only the sign and zero can be judged now.
    if (index == 0 || absolute < 0 || absolute > 0x7fffffff) {
      cursor.fail(FileProblem::kBadIndex,
                  "face " + std::to_string(face) + " names vertex " + std::to_string(index) + ", but " +
                      std::to_string(count) + " vertices came before it (OBJ counts from 1)",
                  FileElement::face(face - 1));
    }
    mesh.corners.push_back(static_cast<std::uint32_t>(absolute));
  }
  if (mesh.corners.size() - first < 3) {
    cursor.fail(FileProblem::kSyntax, "face " + std::to_string(face) + " has " +
                                          std::to_string(mesh.corners.size() - first) +
                                          " corners; a face needs at least three");
  }
  mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  lines.push_back(cursor.line());
}

void check_indices(const TextCursor& cursor, const Mesh& mesh, const std::vector<std::size_t>& lines) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t v : mesh.face(f)) {
      if (v < mesh.vertices.size()) continue;
      throw FileError(FileProblem::kBadIndex,
                      cursor.path() + ":" + std::to_string(lines[f]) + ": face " + std::to_string(f + 1) +
                          " names vertex " + std::to_string(v + 1) + ", but there are " +
                          std::to_string(mesh.vertices.size()),
                      FileElement::face(f));
    }
  }
}

// The current object and groups, which are parts from one line o or g to the next.
class NamedRuns {
 public:
  explicit NamedRuns(MeshParts* parts) : parts_(parts) {}

  // Behind the word o, which takes the whole line, or g, which takes words.
  void read(TextCursor& cursor, bool is_object, std::uint32_t face) {
    MeshParts& open = is_object ? object_ : groups_;
    end(open, face);
    std::string name;
    for (std::string_view word = next_word(cursor); !word.empty(); word = next_word(cursor)) {
      if (!is_object) {
        open.push_back({std::string(word), face, face});
        continue;
      }
      if (!name.empty()) name += ' ';
      name += word;
    }
    if (!name.empty()) open.push_back({std::move(name), face, face});
  }

  void finish(std::uint32_t face) {
    end(object_, face);
    end(groups_, face);
  }

 private:
  void end(MeshParts& open, std::uint32_t face) {
    for (MeshPart& part : open) {
      part.last = face;
      if (parts_ != nullptr && part.first < face) parts_->push_back(std::move(part));
    }
    open.clear();
  }

  MeshParts* parts_;
  MeshParts object_;
  MeshParts groups_;
};

}  // namespace

// A line of OBJ comes first, but for comments. Words of other files that an OBJ might begin with tell nothing.
bool is_obj(std::string_view bytes) {
  const std::string no_path;
  if (is_binary_stl(bytes)) return false;
  const std::string_view word = TextCursor(bytes, no_path).word();
  return word == "v" || word == "o" || word == "g" || word == "mtllib" || word == "usemtl" || word == "vt" ||
         word == "vn";
}

Mesh read_obj(std::string_view bytes, const std::string& path, MeshParts* parts) {
  TextCursor cursor(bytes, path);
  Mesh mesh;
  mesh.vertices.reserve(count_vertices(bytes));
  NamedRuns runs(parts);
  std::vector<std::size_t> lines;
  while (!cursor.at_end()) {
    const std::string_view word = cursor.word_in_line();
    if (word == "v") {
      read_vertex(cursor, mesh);
    } else if (word == "f" || word == "fo") {
      read_face(cursor, mesh, lines);
    } else if (word == "o" || word == "g") {
      runs.read(cursor, word == "o", static_cast<std::uint32_t>(mesh.face_count()));
    } else if (!is_other_keyword(word)) {
      // A file without vertices so far may be anything, and nothing of it is told.
      cursor.fail(FileProblem::kSyntax,
                  (mesh.vertices.empty() ? "this" : in_quotes(word)) + " does not begin a line of an OBJ file");
    }
    // What is left of the line: weights, colours, other statements (which may go on after a backslash).
    while (!next_word(cursor).empty()) {
    }
    cursor.skip_line();
  }
  runs.finish(static_cast<std::uint32_t>(mesh.face_count()));
  check_indices(cursor, mesh, lines);
  return mesh;
}

}  // namespace nef
