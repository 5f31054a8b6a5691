// SPDX-License-Identifier: Apache-2.0
//
// PLY, text and binary of both byte orders: the properties x, y, z of the element vertex and the list vertex_indices
// of the elements face and tristrips. Everything else is skipped by its declared type.
#include <cmath>
#include <optional>

#include "nef/io/binary_cursor.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/text_cursor.h"

namespace nef {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Type type = Type::kFloat;
  std::optional<Type> count;  // of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { kText, kLittle, kBig } format = Format::kText;
  std::vector<Element> elements;
};

Type read_type(TextCursor& cursor, std::string_view word) {
  if (word == "char" || word == "int8") return Type::kInt8;
  if (word == "uchar" || word == "uint8") return Type::kUint8;
  if (word == "short" || word == "int16") return Type::kInt16;
  if (word == "ushort" || word == "uint16") return Type::kUint16;
  if (word == "int" || word == "int32") return Type::kInt32;
  if (word == "uint" || word == "uint32") return Type::kUint32;
  if (word == "float" || word == "float32") return Type::kFloat;
  if (word == "double" || word == "float64") return Type::kDouble;
  cursor.fail(FileProblem::kSyntax, in_quotes(word) + " is not a type of a PLY property");
}

bool is_integer(Type type) { return type != Type::kFloat && type != Type::kDouble; }

void read_format(TextCursor& cursor, Header& header) {
  const std::string_view word = cursor.word_in_line();
  if (word == "ascii") {
    header.format = Header::Format::kText;
  } else if (word == "binary_little_endian") {
    header.format = Header::Format::kLittle;
  } else if (word == "binary_big_endian") {
    header.format = Header::Format::kBig;
  } else {
    cursor.fail(FileProblem::kSyntax, in_quotes(word) + " is not a PLY format");
  }
}

void read_property(TextCursor& cursor, Header& header) {
  if (header.elements.empty()) cursor.fail(FileProblem::kSyntax, "a property comes before the first element");
  Property property;
  std::string_view word = cursor.word_in_line();
  if (word == "list") {
    property.count = read_type(cursor, cursor.word_in_line());
    if (!is_integer(*property.count)) cursor.fail(FileProblem::kSyntax, "the length of a list must be an integer");
    word = cursor.word_in_line();
  }
  property.type = read_type(cursor, word);
  property.name = std::string(cursor.word_in_line());
  header.elements.back().properties.push_back(std::move(property));
}

// The header is text in any format; it ends with the line end_header.
Header read_ply_header(TextCursor& cursor) {
  Header header;
  if (cursor.word() != "ply") cursor.fail(FileProblem::kSyntax, "a PLY file begins with the word ply");
  bool format = false;
  for (cursor.skip_line();; cursor.skip_line()) {
    const std::string_view word = cursor.word_in_line();
    if (word.empty() && cursor.rest().empty()) {
      cursor.fail(FileProblem::kTruncated, "the file ends without 'end_header'; it is truncated");
    }
    if (word == "end_header") break;
    if (word == "format") {
      read_format(cursor, header);
      format = true;
    } else if (word == "element") {
      Element element;
      element.name = std::string(cursor.word_in_line());
      const std::int64_t count = cursor.parse_integer(cursor.word_in_line(), "number of elements");
      if (count < 0 || count > 0x7fffffff) {
        cursor.fail(FileProblem::kWrongCount, "the number of elements is " + std::to_string(count));
      }
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      read_property(cursor, header);
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      cursor.fail(FileProblem::kSyntax, in_quotes(word) + " does not begin a line of a PLY header");
    }
  }
  if (!format) cursor.fail(FileProblem::kSyntax, "the line 'format ...' is missing");
  cursor.skip_line();
  return header;
}

// Values from text.
class TextSource {
 public:
  explicit TextSource(TextCursor& cursor) : cursor_(cursor) {}
  void coordinate(Type /*type*/, Rational& value, std::size_t vertex) {
    cursor_.number(value, "coordinate of vertex", vertex, FileElement::vertex(vertex));
  }
  std::int64_t integer(Type /*type*/) { return cursor_.integer("index or count"); }
  void skip(Type /*type*/) {
    if (cursor_.word().empty()) fail(FileProblem::kTruncated, "the file ends early; it is truncated");
  }
  bool done() { return cursor_.at_end(); }
  [[nodiscard]] std::size_t bytes_left() const { return cursor_.rest().size(); }
  [[noreturn]] void fail(FileProblem problem, const std::string& what, FileElement element = {}) const {
    cursor_.fail(problem, what, element);
  }

 private:
  TextCursor& cursor_;
};

// Values from bytes.
class BinarySource {
 public:
  explicit BinarySource(BinaryCursor cursor) : cursor_(cursor) {}

  void coordinate(Type type, Rational& value, std::size_t vertex) {
    if (is_integer(type)) {
      value = static_cast<long>(integer(type));
      return;
    }
    const double number = type == Type::kFloat ? static_cast<double>(cursor_.take<float>("coordinate"))
                                               : cursor_.take<double>("coordinate");
    if (!std::isfinite(number)) {
      fail(FileProblem::kNotANumber, "a coordinate of vertex " + std::to_string(vertex) + " is not a finite number",
           FileElement::vertex(vertex));
    }
    value = number;
  }

  std::int64_t integer(Type type) {
    constexpr std::string_view kWhat = "index or count";
    switch (type) {
      case Type::kInt8:
        return cursor_.take<std::int8_t>(kWhat);
      case Type::kUint8:
        return cursor_.take<std::uint8_t>(kWhat);
      case Type::kInt16:
        return cursor_.take<std::int16_t>(kWhat);
      case Type::kUint16:
        return cursor_.take<std::uint16_t>(kWhat);
      case Type::kInt32:
        return cursor_.take<std::int32_t>(kWhat);
      case Type::kUint32:
        return cursor_.take<std::uint32_t>(kWhat);
      case Type::kFloat:
      case Type::kDouble:
        break;
    }
    fail(FileProblem::kSyntax, "an index is declared as a floating-point number");
  }

  void skip(Type type) {
    if (type == Type::kFloat) {
      cursor_.take<float>("property");
    } else if (type == Type::kDouble) {
      cursor_.take<double>("property");
    } else {
      integer(type);
    }
  }

  bool done() { return cursor_.left() == 0; }
  [[nodiscard]] std::size_t bytes_left() const { return cursor_.left(); }
  [[noreturn]] void fail(FileProblem problem, const std::string& what, FileElement element = {}) const {
    cursor_.fail(problem, what, element);
  }

 private:
  BinaryCursor cursor_;
};

template <typename Source>
void skip_property(Source& source, const Property& property) {
  if (!property.count) {
    source.skip(property.type);
    return;
  }
  const std::int64_t count = source.integer(*property.count);
  for (std::int64_t i = 0; i < count; ++i) source.skip(property.type);
}

template <typename Source>
void read_vertices(Source& source, const Element& element, Mesh& mesh) {
  std::vector<int> axes;  // of each property; -1 for others
  std::array<bool, 3> found{};
  for (const Property& property : element.properties) {
    const int axis = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
    axes.push_back(property.count ? -1 : axis);
    if (axes.back() >= 0) found[static_cast<std::size_t>(axis)] = true;
  }
  if (!found[0] || !found[1] || !found[2]) {
    source.fail(FileProblem::kSyntax, "the vertices of this file lack one of the properties x, y, z");
  }
  mesh.vertices.reserve(std::min(element.count, source.bytes_left() / 3 + 1));
  for (std::size_t v = 0; v < element.count; ++v) {
    Rational3& point = mesh.vertices.emplace_back();
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (axes[i] >= 0) {
        source.coordinate(element.properties[i].type, point[static_cast<std::size_t>(axes[i])], v);
      } else {
        skip_property(source, element.properties[i]);
      }
    }
  }
}

template <typename Source>
void read_face(Source& source, const Property& list, Mesh& mesh) {
  const std::int64_t size = source.integer(*list.count);
  if (size < 3) {
    source.fail(FileProblem::kSyntax, "face " + std::to_string(mesh.face_count()) + " has " + std::to_string(size) +
                                          " corners; a face needs at least three");
  }
  for (std::int64_t i = 0; i < size; ++i) {
    const std::int64_t index = source.integer(list.type);
    if (index < 0 || index > 0x7fffffff) {
      source.fail(FileProblem::kBadIndex,
                  "face " + std::to_string(mesh.face_count()) + " names vertex " + std::to_string(index),
                  FileElement::face(mesh.face_count()));
    }
    mesh.corners.push_back(static_cast<std::uint32_t>(index));
  }
  mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

// Triangles of three successive corners each, every second one turned over; -1 begins another strip. Those that name a
// corner twice turn a strip around and are no faces.
template <typename Source>
void read_strips(Source& source, const Property& list, Mesh& mesh) {
  const std::int64_t size = source.integer(*list.count);
  std::array<std::uint32_t, 3> t{};
  std::size_t in_strip = 0;
  for (std::int64_t i = 0; i < size; ++i) {
    const std::int64_t index = source.integer(list.type);
    if (index == -1) {
      in_strip = 0;
      continue;
    }
    if (index < 0 || index > 0x7fffffff) {
      source.fail(FileProblem::kBadIndex, "a triangle strip names vertex " + std::to_string(index));
    }
    t = {t[1], t[2], static_cast<std::uint32_t>(index)};
    if (++in_strip < 3 || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    const bool turned = in_strip % 2 == 0;
    mesh.push_face(std::array<std::uint32_t, 3>{turned ? t[1] : t[0], turned ? t[0] : t[1], t[2]});
  }
}

template <typename Source>
void read_faces(Source& source, const Element& element, Mesh& mesh) {
  const bool strips = element.name == "tristrips";
  bool found = false;
  const auto is_list = [](const Property& property) {
    return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
  };
  for (const Property& property : element.properties) found = found || is_list(property);
  if (!found && element.count > 0) {
    source.fail(FileProblem::kUnsupported, "the faces of this file lack the list property vertex_indices");
  }
  for (std::size_t f = 0; f < element.count; ++f) {
    for (const Property& property : element.properties) {
      if (is_list(property) && strips) {
        read_strips(source, property, mesh);
      } else if (is_list(property)) {
        read_face(source, property, mesh);
      } else {
        skip_property(source, property);
      }
    }
  }
}

template <typename Source>
Mesh read_elements(Source& source, const Header& header) {
  Mesh mesh;
  bool vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(source, element, mesh);
      vertices = true;
    } else if (element.name == "face" || element.name == "tristrips") {
      read_faces(source, element, mesh);
    } else {
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip_property(source, property);
      }
    }
  }
  if (!vertices) source.fail(FileProblem::kSyntax, "the file declares no element vertex");
  if (!source.done()) source.fail(FileProblem::kWrongCount, "there is more in the file than its header announces");
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t v : mesh.face(f)) {
      if (v < mesh.vertices.size()) continue;
      source.fail(FileProblem::kBadIndex,
                  "face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", but there are " +
                      std::to_string(mesh.vertices.size()),
                  FileElement::face(f));
    }
  }
  return mesh;
}

}  // namespace

Mesh read_ply(std::string_view bytes, const std::string& path) {
  TextCursor cursor(bytes, path);
  const Header header = read_ply_header(cursor);
  if (header.format == Header::Format::kText) {
    TextSource source(cursor);
    return read_elements(source, header);
  }
  const std::endian order = header.format == Header::Format::kBig ? std::endian::big : std::endian::little;
  BinarySource source(BinaryCursor(bytes, path, cursor.position(), order));
  return read_elements(source, header);
}

}  // namespace nef
