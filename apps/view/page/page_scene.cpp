// SPDX-License-Identifier: Apache-2.0
//
// Coordinates are written as floats relative to the centre of the page, so that a small thing far from the origin
// still looks right; everything exact is text.
#include <nlohmann/json.hpp>

#include "apps/view/page.h"
#include "apps/view/page/byte_text.h"
#include "apps/view/page/exact_text.h"
#include "apps/view/page/sphere_arrays.h"

namespace nef::view {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(const Color& color) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t c : color) {
    text += kDigits[c >> 4U];
    text += kDigits[c & 15U];
  }
  return text;
}

// Collects the arrays of all layers behind one another.
class SceneWriter {
 public:
  SceneWriter(const std::vector<Layer>& layers, const PageOptions& options) : layers_(layers), options_(options) {
    if (const auto bounds = bounds_of(layers, Framing::kAll)) {
      for (std::size_t i = 0; i < 3; ++i) center_[i] = (*bounds)[0][i] / 2 + (*bounds)[1][i] / 2;
    }
  }

  std::string run() {
    Json page{{"title", options_.title}, {"center", center_}, {"layers", Json::array()}};
    if (const auto bounds = bounds_of(layers_, Framing::kAll)) {
      page["bounds"] = {relative((*bounds)[0]), relative((*bounds)[1])};
    }
    if (const auto seen = bounds_of(layers_, Framing::kFocus))
      page["focus"] = {relative((*seen)[0]), relative((*seen)[1])};
    for (std::size_t i = 0; i < layers_.size(); ++i) page["layers"].push_back(layer(i));
    const std::string json = page.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::array<std::uint32_t, 1> length{static_cast<std::uint32_t>(json.size())};
    std::string result;
    append_array<std::uint32_t>(result, length);
    result += json;
    append_array<char>(result, blobs_, ' ');
    return result;
  }

 private:
  template <typename T>
  Json array(const char* type, const std::vector<T>& values) {
    return {type, append_array<T>(blobs_, values), values.size()};
  }

  Json text(const std::string& lines) { return {"text", append_array<char>(blobs_, lines), lines.size()}; }

  [[nodiscard]] Point relative(const Point& point) const {
    return {point[0] - center_[0], point[1] - center_[1], point[2] - center_[2]};
  }

  void push(std::vector<float>& out, const Point& point) const {
    for (const double x : relative(point)) out.push_back(static_cast<float>(x));
  }

  Json layer(std::size_t index) {
    const Layer& layer = layers_[index];
    const Scene& scene = layer.scene;
    const LayerColors colors = colors_of(layers_, index);
    Json json{{"name", layer.name},       {"color", hex(colors.layer)},        {"opacity", layer.opacity},
              {"visible", layer.visible}, {"vertices", vertices(scene)},       {"edges", edges(scene)},
              {"facets", facets(scene)},  {"volumes", volumes(scene, colors)}, {"lines", lines(layer)},
              {"photos", photos(layer)}};
    if (!layer.surface.none()) json["surface"] = surface(layer.surface);
    if (scene.box) json["box"] = {relative((*scene.box)[0]), relative((*scene.box)[1])};
    if (!layer.motion.empty()) json["motion"] = {{"times", layer.motion.times}, {"offsets", layer.motion.offsets}};
    if (!layer.motion.turns.empty()) {
      json["motion"]["turns"] = layer.motion.turns;
      json["motion"]["pivot"] = relative(layer.motion.pivot);
    }
    if (options_.details) {
      json["spheres"] = spheres(scene);
      add_exact(scene, json);
    }
    return json;
  }

  Json surface(const SurfaceColors& surface) {
    if (!surface.has_image()) {
      std::vector<std::uint8_t> rgb;
      for (const Color& color : surface.vertices) rgb.insert(rgb.end(), color.begin(), color.end());
      return {{"rgb", array("u8", rgb)}};
    }
    std::vector<float> places;
    for (const auto& place : surface.places) places.insert(places.end(), place.begin(), place.end());
    return {{"places", array("f32", places)}, {"url", "data:image/png;base64," + base64(png_bytes(surface.image))}};
  }

  static std::uint8_t flags(bool isolated, Origin origin) {
    return static_cast<std::uint8_t>((isolated ? 1U : 0U) | static_cast<unsigned>(origin) << 1U);
  }

  Json vertices(const Scene& scene) {
    std::vector<float> xyz;
    std::vector<std::uint16_t> marks;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint8_t> flag;
    for (const SceneVertex& vertex : scene.vertices) {
      push(xyz, vertex.position);
      marks.push_back(vertex.mark);
      indices.push_back(vertex.index);
      flag.push_back(flags(vertex.isolated, vertex.origin));
    }
    return {{"xyz", array("f32", xyz)},
            {"mark", array("u16", marks)},
            {"index", array("u32", indices)},
            {"flags", array("u8", flag)}};
  }

  Json edges(const Scene& scene) {
    std::vector<std::uint32_t> ends;
    std::vector<std::uint16_t> marks;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> twins;
    std::vector<std::uint8_t> flag;
    const Complex& complex = scene.source.complex();
    for (const SceneEdge& edge : scene.edges) {
      ends.insert(ends.end(), {edge.from, edge.to});
      marks.push_back(edge.mark);
      indices.push_back(edge.index);
      twins.push_back(edge.index == kArtificial ? kArtificial : complex.twin[HalfedgeId{edge.index}].index());
      flag.push_back(flags(edge.isolated, edge.origin));
    }
    return {{"ends", array("u32", ends)},
            {"mark", array("u16", marks)},
            {"index", array("u32", indices)},
            {"twin", array("u32", twins)},
            {"flags", array("u8", flag)}};
  }

  Json facets(const Scene& scene) {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint16_t> marks;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> above;
    std::vector<std::uint32_t> below;
    std::vector<std::uint8_t> flag;
    for (const SceneFacet& facet : scene.facets) {
      begin.push_back(facet.first_triangle);
      marks.push_back(facet.mark);
      indices.push_back(facet.index);
      above.push_back(facet.above);
      below.push_back(facet.below);
      flag.push_back(flags(false, facet.origin));
    }
    begin.push_back(static_cast<std::uint32_t>(scene.triangles.size()));
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : scene.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    return {{"begin", array("u32", begin)},    {"mark", array("u16", marks)},  {"index", array("u32", indices)},
            {"above", array("u32", above)},    {"below", array("u32", below)}, {"flags", array("u8", flag)},
            {"corners", array("u32", corners)}};
  }

  static Json volumes(const Scene& scene, const LayerColors& colors) {
    Json list = Json::array();
    for (std::size_t v = 0; v < scene.volumes.size(); ++v) {
      const SceneVolume& volume = scene.volumes[v];
      list.push_back({{"index", volume.index == kArtificial ? Json() : Json(volume.index)},
                      {"mark", volume.mark},
                      {"bounded", volume.bounded},
                      {"color", hex(colors.volumes[v])}});
    }
    return list;
  }

  Json spheres(const Scene& scene) {
    SphereArrays arrays;
    for (const SceneVertex& vertex : scene.vertices) {
      arrays.add(vertex.index == kArtificial ? SphereDrawing{}
                                             : draw_sphere_map(scene.source.complex(), VertexId{vertex.index}));
    }
    return {{"begin", array("u32", arrays.begin)},     {"directions", array("i16", arrays.directions)},
            {"dots", array("u32", arrays.dots)},       {"normals", array("i16", arrays.normals)},
            {"arcs", array("u32", arrays.arcs)},       {"circleNormals", array("i16", arrays.circle_normals)},
            {"circles", array("u32", arrays.circles)}, {"regions", array("u32", arrays.regions)}};
  }

  Json lines(const Layer& layer) {
    Json list = Json::array();
    for (const Polyline& line : layer.lines) {
      std::vector<float> xyz;
      for (const Point& point : line.points) push(xyz, point);
      list.push_back({{"name", line.name}, {"color", hex(line.color)}, {"xyz", array("f32", xyz)}});
    }
    return list;
  }

  Json photos(const Layer& layer) {
    Json list = Json::array();
    for (const Photo& photo : layer.photos) {
      Json corners = Json::array();
      for (const Point& corner : photo.corners) corners.push_back(relative(corner));
      Json item{{"name", photo.name},
                {"corners", corners},
                {"url", "data:" + photo.media_type + ";base64," + base64(photo.bytes)}};
      if (photo.eye) item["eye"] = relative(*photo.eye);
      list.push_back(item);
    }
    return list;
  }

  // One line for each vertex (x y z) and facet (a b c d: a x + b y + c z + d = 0); nothing for artificial ones.
  void add_exact(const Scene& scene, Json& json) {
    const Complex& complex = scene.source.complex();
    std::string points;
    std::string planes;
    for (const SceneVertex& vertex : scene.vertices) {
      if (vertex.index != kArtificial) {
        points += point_text(complex, VertexId{vertex.index});
      }
      points += '\n';
      if (points.size() > options_.exact_text_limit) return;
    }
    for (const SceneFacet& facet : scene.facets) {
      if (facet.index != kArtificial) {
        planes += plane_text(complex, FacetId{facet.index});
      }
      planes += '\n';
      if (points.size() + planes.size() > options_.exact_text_limit) return;
    }
    json["exact"] = {{"points", text(points)}, {"planes", text(planes)}};
  }

  const std::vector<Layer>& layers_;
  const PageOptions& options_;
  Point center_{};
  std::string blobs_;
};

}  // namespace

std::string page_scene(const std::vector<Layer>& layers, const PageOptions& options) {
  return SceneWriter(layers, options).run();
}

}  // namespace nef::view
