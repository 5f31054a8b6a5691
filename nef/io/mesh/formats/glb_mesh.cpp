// SPDX-License-Identifier: Apache-2.0
//
// A GLB file is a chunk of JSON and one of bytes. Reading walks the tree of nodes with exact affine maps, resolves each
// accessor to a checked range of the binary chunk, and merges equal points. Everything that the JSON says is checked
// before it is used, as any of it may be wrong: types, ranges, depth, nodes with two parents, and how much more is
// placed than is stored. Writing adds positions, then the indices of each group of faces, to a document.
#include "nef/io/mesh/formats/glb_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "nef/base/text/in_quotes.h"
#include "nef/export/nearest_float.h"
#include "nef/io/binary_cursor.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/formats/glb_document.h"
#include "nef/io/mesh/unfolding.h"
#include "nef/io/number_text.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/vertex_merger.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Json = nlohmann::json;

class GlbReader {
 public:
  GlbReader(std::string_view bytes, const std::string& path) : path_(path) {
    BinaryCursor header(bytes, path, 0, std::endian::little);
    if (header.take<std::uint32_t>("header") != kGlbMagic) fail(FileProblem::kSyntax, "not a binary glTF file");
    if (header.take<std::uint32_t>("header") != 2) fail(FileProblem::kUnsupported, "only version 2 of glTF is read");
    const auto size = header.take<std::uint32_t>("header");
    if (size != bytes.size()) {
      fail(size > bytes.size() ? FileProblem::kTruncated : FileProblem::kWrongCount,
           "its header says that it has " + std::to_string(size) + " bytes, but it has " +
               std::to_string(bytes.size()) + "; it is truncated or damaged");
    }
    for (std::size_t position = 12; position < bytes.size();) position += read_chunk(bytes, position);
    if (!document_.is_object()) fail(FileProblem::kSyntax, "it contains no JSON");
  }

  Mesh read(MeshParts* parts) {
    try {
      walk_all();
    } catch (const Json::exception&) {
      fail(FileProblem::kSyntax, "its JSON lacks something or has something of the wrong type");
    }
    if (parts != nullptr) *parts = std::move(parts_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(FileProblem problem, const std::string& what) const {
    throw FileError(problem, path_ + ": " + what);
  }

  // Returns the bytes of the chunk that begins there.
  std::size_t read_chunk(std::string_view bytes, std::size_t position) {
    constexpr std::size_t kHead = 8;
    BinaryCursor cursor(bytes, path_, position, std::endian::little);
    const auto length = cursor.take<std::uint32_t>("chunk");
    const auto type = cursor.take<std::uint32_t>("chunk");
    if (cursor.left() < length)
      fail(FileProblem::kTruncated, "the file ends in the middle of a chunk; it is truncated");
    const std::string_view chunk = bytes.substr(position + kHead, length);
    if (type == kGlbJsonChunk && document_.is_null()) {
      document_ = Json::parse(chunk, nullptr, false);
      if (document_.is_discarded()) fail(FileProblem::kSyntax, "the JSON in it is not valid");
    } else if (type == kGlbBinaryChunk && binary_.empty()) {
      binary_ = chunk;
    }
    return kHead + length;
  }

  // Integers are spelled without a point or an exponent; conversions of the library round, wrap around or do as if
  // true were 1.
  [[nodiscard]] std::size_t integer(const Json& value, const char* what) const {
    if (!value.is_number_unsigned()) {
      fail(FileProblem::kSyntax,
           std::string("a '") + what + "' in its JSON is not a whole number of at least 0; the file is damaged");
    }
    return value.get<std::size_t>();
  }
  [[nodiscard]] std::size_t integer_in(const Json& object, const char* key) const {
    return integer(object.at(key), key);
  }
  [[nodiscard]] std::size_t integer_in(const Json& object, const char* key, std::size_t usual) const {
    return object.contains(key) ? integer(object[key], key) : usual;
  }

  // An array, of so many values if that is said.
  [[nodiscard]] const Json& array_of(const Json& value, const char* what, std::size_t count = 0) const {
    if (!value.is_array() || (count != 0 && value.size() != count)) {
      fail(FileProblem::kSyntax, std::string("'") + what + "' in its JSON is not a list" +
                                     (count == 0 ? "" : " of " + std::to_string(count) + " numbers") +
                                     "; it is damaged");
    }
    return value;
  }
  // The empty array if there is none.
  [[nodiscard]] const Json& array_in(const Json& object, const char* key) const {
    static const Json kNone = Json::array();
    return object.contains(key) ? array_of(object[key], key) : kNone;
  }

  [[nodiscard]] const Json& item(const char* list, std::size_t index) const {
    const auto found = document_.find(list);
    if (found == document_.end() || !found->is_array() || index >= found->size()) {
      fail(FileProblem::kBadIndex,
           std::string("it names item ") + std::to_string(index) + " of '" + list + "', which does not exist");
    }
    return (*found)[index];
  }

  void walk_all() {
    for (const Json& extension : array_in(document_, "extensionsRequired")) {
      fail(FileProblem::kUnsupported, "it needs the extension " + in_quotes(extension.get<std::string>()));
    }
    // z up here, y up there.
    AffineMap upright;
    upright.linear[0][0] = 1;
    upright.linear[1][2] = -1;
    upright.linear[2][1] = 1;
    if (document_.contains("scenes")) {
      placed_nodes_.resize(array_in(document_, "nodes").size(), false);
      const Json& scene = item("scenes", integer_in(document_, "scene", 0));
      for (const Json& node : array_in(scene, "nodes")) walk(integer(node, "node"), upright, 0);
      return;
    }
    for (std::size_t m = 0; m < array_in(document_, "meshes").size(); ++m) add_mesh(m, upright);
  }

  // Nodes are trees: those of one scene are placed once each.
  void walk(std::size_t index, const AffineMap& above, int depth) {
    constexpr int kDeepest = 200;
    if (depth > kDeepest) fail(FileProblem::kUnsupported, "its nodes are nested too deeply");
    const Json& node = item("nodes", index);
    if (placed_nodes_[index]) {
      fail(FileProblem::kSyntax, "node " + std::to_string(index) +
                                     " is named twice in the tree of nodes, where glTF allows one parent; copy it");
    }
    placed_nodes_[index] = true;
    const AffineMap here = above.after(placement(node));
    const std::uint32_t first = faces();
    if (node.contains("mesh")) add_mesh(integer_in(node, "mesh"), here);
    for (const Json& child : array_in(node, "children")) walk(integer(child, "child"), here, depth + 1);
    name_faces(node, first);
  }

  [[nodiscard]] Rational number(const Json& value) const {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (!std::isfinite(x)) fail(FileProblem::kNotANumber, "a transformation has a number that is not finite");
    return exact_rational(x);
  }

  [[nodiscard]] AffineMap placement(const Json& node) const {
    AffineMap p = AffineMap::identity();
    if (node.contains("matrix")) {
      const Json& m = array_of(node["matrix"], "matrix", 16);  // column by column
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) p.linear[i][k] = number(m.at(4 * k + i));
        p.translation[i] = number(m.at(12 + i));
      }
      return p;
    }
    if (node.contains("rotation")) p.linear = rotation(array_of(node["rotation"], "rotation", 4));
    if (node.contains("scale")) {
      const Json& scale = array_of(node["scale"], "scale", 3);
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational factor = number(scale[k]);
        for (std::size_t i = 0; i < 3; ++i) p.linear[i][k] *= factor;
      }
    }
    if (node.contains("translation")) {
      const Json& translation = array_of(node["translation"], "translation", 3);
      for (std::size_t i = 0; i < 3; ++i) p.translation[i] = number(translation[i]);
    }
    return p;
  }

  // Of a quaternion x, y, z, w of any length but zero.
  [[nodiscard]] std::array<Rational3, 3> rotation(const Json& quaternion) const {
    std::array<Rational, 4> q;
    Rational norm;
    for (std::size_t i = 0; i < 4; ++i) {
      q[i] = number(quaternion.at(i));
      norm += q[i] * q[i];
    }
    if (norm == 0) fail(FileProblem::kNotANumber, "a rotation is the zero quaternion");
    const Rational s = 2 / norm;
    std::array<Rational3, 3> r;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      r[i][i] = 1 - s * (q[j] * q[j] + q[k] * q[k]);
      r[i][j] = s * (q[i] * q[j] - q[k] * q[3]);
      r[i][k] = s * (q[i] * q[k] + q[j] * q[3]);
    }
    return r;
  }

  struct Accessor {
    std::string_view bytes;
    std::size_t count = 0;
    std::size_t stride = 0;
    GlbComponent type = GlbComponent::kFloat;
  };

  [[nodiscard]] GlbComponent component_type(const Json& accessor) const {
    for (const GlbComponent known :
         {GlbComponent::kUint8, GlbComponent::kUint16, GlbComponent::kUint32, GlbComponent::kFloat}) {
      if (integer_in(accessor, "componentType") == static_cast<std::size_t>(known)) return known;
    }
    fail(FileProblem::kUnsupported, "its numbers are neither floats nor unsigned integers");
  }

  // The bytes of the buffer of a view: the binary chunk but for what fills it up.
  [[nodiscard]] std::size_t buffer_size(const Json& view) const {
    const Json& buffer = item("buffers", integer_in(view, "buffer"));
    if (integer_in(view, "buffer") != 0 || buffer.contains("uri")) {
      fail(FileProblem::kUnsupported, "its numbers are in another file");
    }
    const std::size_t size = integer_in(buffer, "byteLength");
    if (size > binary_.size()) {
      fail(FileProblem::kWrongCount, "its buffer is said to have " + std::to_string(size) + " bytes, but there are " +
                                         std::to_string(binary_.size()) + "; it is damaged");
    }
    return size;
  }

  // Its elements have `components` numbers of at most four bytes.
  [[nodiscard]] Accessor accessor(std::size_t index, const char* type, std::size_t components) const {
    const Json& json = item("accessors", index);
    if (json.contains("sparse") || !json.contains("bufferView") || json.at("type").get<std::string>() != type) {
      fail(FileProblem::kUnsupported, "accessor " + std::to_string(index) + " is sparse, empty or of an unusual type");
    }
    Accessor result;
    result.type = component_type(json);
    result.count = integer_in(json, "count");
    const std::size_t size = components * (result.type == GlbComponent::kUint8    ? 1
                                           : result.type == GlbComponent::kUint16 ? 2
                                                                                  : 4);
    const Json& view = item("bufferViews", integer_in(json, "bufferView"));
    const std::size_t buffer = buffer_size(view);
    result.stride = integer_in(view, "byteStride", size);
    const std::size_t first = integer_in(json, "byteOffset", 0);
    const std::size_t view_first = integer_in(view, "byteOffset", 0);
    const std::size_t view_size = integer_in(view, "byteLength");
    constexpr std::size_t kMost = std::size_t{1} << 32U;  // a file holds no more, and sums do not overflow
    const bool fits = result.count < kMost && result.stride >= size && result.stride < 256 && first < kMost &&
                      view_first < kMost && view_size < kMost && view_first + view_size <= buffer &&
                      (result.count == 0 || first + (result.count - 1) * result.stride + size <= view_size);
    if (!fits) fail(FileProblem::kTruncated, "accessor " + std::to_string(index) + " reaches beyond its buffer");
    result.bytes = binary_.substr(view_first + first);
    return result;
  }

  template <typename T>
  T value(const Accessor& accessor, std::size_t element, std::size_t component) const {
    BinaryCursor cursor(accessor.bytes, path_, element * accessor.stride + component * sizeof(T), std::endian::little);
    return cursor.take<T>("number");
  }

  [[nodiscard]] std::vector<std::uint32_t> indices(const Json& primitive, std::size_t vertices) {
    std::vector<std::uint32_t> result;
    if (!primitive.contains("indices")) {
      for (std::uint32_t i = 0; i < vertices; ++i) result.push_back(i);
      return result;
    }
    const Accessor list = accessor(integer_in(primitive, "indices"), "SCALAR", 1);
    if (list.type == GlbComponent::kFloat) fail(FileProblem::kUnsupported, "its indices are floats");
    place(integer_in(primitive, "indices"), list.count);
    for (std::size_t i = 0; i < list.count; ++i) {
      const std::uint32_t index = list.type == GlbComponent::kUint8    ? value<std::uint8_t>(list, i, 0)
                                  : list.type == GlbComponent::kUint16 ? value<std::uint16_t>(list, i, 0)
                                                                       : value<std::uint32_t>(list, i, 0);
      if (index >= vertices) {
        fail(FileProblem::kBadIndex,
             "a triangle names vertex " + std::to_string(index) + ", but there are " + std::to_string(vertices));
      }
      result.push_back(index);
    }
    return result;
  }

  [[nodiscard]] std::uint32_t faces() const { return static_cast<std::uint32_t>(mesh_.face_count()); }

  // The faces from `first` on are a part, if the item has a name.
  void name_faces(const Json& named, std::uint32_t first) {
    const auto name = named.find("name");
    if (name == named.end() || !name->is_string() || name->get<std::string>().empty()) return;
    parts_.push_back({name->get<std::string>(), first, faces()});
  }

  void add_mesh(std::size_t index, const AffineMap& placement) {
    const std::uint32_t first_of_all = faces();
    for (const Json& primitive : array_of(item("meshes", index).at("primitives"), "primitives")) {
      const auto mode =
          static_cast<GlbMode>(integer_in(primitive, "mode", static_cast<std::size_t>(GlbMode::kTriangles)));
      if (mode != GlbMode::kTriangles && mode != GlbMode::kTriangleStrip && mode != GlbMode::kTriangleFan)
        continue;  // points and lines
      const std::uint32_t first = faces();
      add_primitive(primitive, mode, placement);
      const Json& materials = array_in(document_, "materials");
      const Json number = primitive.value("material", Json());
      if (number.is_number_unsigned() && number.get<std::size_t>() < materials.size()) {
        name_faces(materials[number.get<std::size_t>()], first);
      }
    }
    name_faces(item("meshes", index), first_of_all);
  }

  // Takes note that the elements of an accessor are read, maybe once more.
  void place(std::size_t index, std::size_t count) {
    if (known_accessors_.insert(index).second) unfolding_.add_stored(count);
    unfolding_.add_placed(count);
  }

  void add_primitive(const Json& primitive, GlbMode mode, const AffineMap& placement) {
    const Json& attributes = primitive.at("attributes");
    const Accessor positions = accessor(integer_in(attributes, "POSITION"), "VEC3", 3);
    if (positions.type != GlbComponent::kFloat) fail(FileProblem::kUnsupported, "its positions are not floats");
    place(integer_in(attributes, "POSITION"), positions.count);
    std::vector<std::uint32_t> vertex;
    for (std::size_t v = 0; v < positions.count; ++v) {
      Rational3 point;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto x = static_cast<double>(value<float>(positions, v, i));
        if (!std::isfinite(x)) fail(FileProblem::kNotANumber, "a coordinate is not a finite number");
        point[i] = x;
      }
      vertex.push_back(merger_.add(placement(point)));
    }
    const std::vector<std::uint32_t> list = indices(primitive, positions.count);
    const std::size_t step = mode == GlbMode::kTriangles ? 3 : 1;
    const bool mirrors = placement.determinant() < 0;
    for (std::size_t i = 0; i + 2 < list.size(); i += step) {
      std::array<std::uint32_t, 3> t{list[mode == GlbMode::kTriangleFan ? 0 : i], list[i + 1], list[i + 2]};
      if ((mode == GlbMode::kTriangleStrip && i % 2 == 1) != mirrors) std::swap(t[0], t[1]);
      for (std::uint32_t& v : t) v = vertex[v];
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.push_face(t);
    }
  }

  const std::string& path_;
  Json document_;
  std::string_view binary_;
  std::vector<bool> placed_nodes_;
  std::set<std::size_t> known_accessors_;
  Unfolding unfolding_{path_};
  Mesh mesh_;
  MeshParts parts_;
  VertexMerger merger_{mesh_.vertices};
};

// A part of the triangles, with indices of their own.
GlbDocument::Json primitive_of(GlbDocument& document, const Mesh& mesh, const MeshSurface& surface,
                               const std::vector<std::uint32_t>& triangles, std::size_t positions) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t v : surface.corners_in_face(mesh, t)) indices.push_back(v);
  }
  return {{"attributes", {{"POSITION", positions}}},
          {"indices", document.add_indices(indices)},
          {"mode", static_cast<std::size_t>(GlbMode::kTriangles)}};
}

std::vector<float> coordinates_of(const std::vector<Rational3>& points) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Rational3& point : points) {
    for (const Rational& number : point) coordinates.push_back(nearest_float(number));
  }
  return coordinates;
}

// All triangles with the image on them. glTF counts rows of images from the top.
GlbDocument::Json textured_primitive(GlbDocument& document, const Mesh& mesh, const MeshSurface& surface,
                                     const MeshTexture& texture) {
  const TexturedVertices textured = textured_vertices(mesh, texture);
  std::vector<Rational3> points;
  points.reserve(textured.vertex.size());
  for (const std::uint32_t v : textured.vertex) points.push_back(mesh.vertices[v]);
  std::vector<float> places;
  for (const auto& [u, v] : textured.places) places.insert(places.end(), {u, 1 - v});
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t face : surface.face_of) {
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      indices.push_back(textured.corners[c]);
    }
  }
  const std::size_t positions = document.add_floats(coordinates_of(points), 3, GlbTarget::kVertices);
  const std::size_t image_places = document.add_floats(places, 2, GlbTarget::kVertices);
  document.materials.push_back({{"name", "photographs"},
                                {"pbrMetallicRoughness",
                                 {{"baseColorTexture", {{"index", document.add_texture(texture.png)}}},
                                  {"metallicFactor", 0.0},
                                  {"roughnessFactor", 1.0}}}});
  return {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", image_places}}},
          {"indices", document.add_indices(indices)},
          {"material", document.materials.size() - 1},
          {"mode", static_cast<std::size_t>(GlbMode::kTriangles)}};
}

// sRGB becomes linear light, which has more than eight bits.
std::size_t add_vertex_colors(GlbDocument& document, const std::vector<std::array<std::uint8_t, 3>>& colors) {
  constexpr std::uint16_t kFull = 65535;
  std::vector<std::uint16_t> channels;
  channels.reserve(4 * colors.size());
  for (const auto& color : colors) {
    for (const std::uint8_t channel : color) {
      channels.push_back(static_cast<std::uint16_t>(std::lround(kFull * linear_light(channel))));
    }
    channels.push_back(kFull);  // opaque
  }
  document.materials.push_back(
      {{"name", "colours"}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}});
  return document.add_colors(channels);
}

void add_groups(GlbDocument& document, const Mesh& mesh, const MeshSurface& surface, const FaceGroups& groups,
                std::size_t positions, GlbDocument::Json& primitives) {
  std::vector<std::vector<std::uint32_t>> triangles(groups.names.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (!groups.none()) triangles[groups.of_face[surface.face_of[t]]].push_back(t);
  }
  for (std::size_t g = 0; g < triangles.size(); ++g) {
    if (triangles[g].empty()) continue;
    primitives.push_back(primitive_of(document, mesh, surface, triangles[g], positions));
    primitives.back()["material"] = document.materials.size();
    const std::array<std::uint8_t, 3> color = group_color(g);
    document.materials.push_back(
        {{"name", groups.names[g]},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {linear_light(color[0]), linear_light(color[1]), linear_light(color[2]), 1.0}},
           {"metallicFactor", 0.0},
           {"roughnessFactor", 0.8}}}});
  }
}

}  // namespace

Mesh read_glb(std::string_view bytes, const std::string& path, MeshParts* parts) {
  return GlbReader(bytes, path).read(parts);
}

std::string glb_bytes(const Mesh& mesh, const MeshWriteOptions& options) {
  const MeshSurface surface(mesh, options.monitor);
  GlbDocument document;
  document.scenes.push_back(GlbDocument::Json::object());
  if (surface.triangles.empty()) return document.bytes();
  document.scenes[0]["nodes"] = GlbDocument::Json::array({0});
  const double x = nearest_double(options.offset[0]);
  const double y = nearest_double(options.offset[1]);
  const double z = nearest_double(options.offset[2]);
  document.nodes = {{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, x, z, 0 - y, 1}}}};
  if (!options.texture.none()) {
    document.meshes.push_back({{"primitives", {textured_primitive(document, mesh, surface, options.texture)}}});
    return document.bytes();
  }
  const std::size_t positions = document.add_floats(coordinates_of(mesh.vertices), 3, GlbTarget::kVertices);
  const bool colored = !options.vertex_colors.empty();
  const std::size_t colors = colored ? add_vertex_colors(document, options.vertex_colors) : 0;
  GlbDocument::Json primitives = GlbDocument::Json::array();
  if (options.groups.none()) {
    std::vector<std::uint32_t> all(surface.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    primitives.push_back(primitive_of(document, mesh, surface, all, positions));
    if (colored) primitives.back()["material"] = 0;
  }
  add_groups(document, mesh, surface, options.groups, positions, primitives);
  if (colored) {
    for (auto& primitive : primitives) primitive["attributes"]["COLOR_0"] = colors;
  }
  document.meshes.push_back({{"primitives", std::move(primitives)}});
  return document.bytes();
}

}  // namespace nef
