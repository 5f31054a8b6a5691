// SPDX-License-Identifier: Apache-2.0
//
// All vertices of a layer are one accessor of positions; volumes, flat parts, edges and isolated vertices are
// primitives that index it. A layer that turns gets two nodes, since glTF turns about a node's origin: the outer one at
// the pivot, the inner one moves its content back. Animations sample translation and rotation at the same times.
#include "apps/view/glb.h"

#include <algorithm>
#include <cmath>

#include "apps/view/scene/palette.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/face_groups.h"
#include "nef/io/mesh/formats/glb_document.h"

namespace nef::view {
namespace {

using Json = GlbDocument::Json;

class GlbWriter {
 public:
  explicit GlbWriter(const std::vector<Layer>& layers) : layers_(layers) {
    if (const auto bounds = bounds_of(layers, Framing::kAll)) {
      for (std::size_t i = 0; i < 3; ++i) center_[i] = (*bounds)[0][i] / 2 + (*bounds)[1][i] / 2;
    }
  }

  std::string run() {
    const double half = std::sqrt(0.5);
    // A quarter turn about x takes z up to y up; the centre is turned with it.
    nodes_.push_back({{"name", "scene"},
                      {"translation", {center_[0], center_[2], -center_[1]}},
                      {"rotation", {-half, 0, 0, half}},
                      {"children", Json::array()}});
    Json hidden = Json::array();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const std::size_t node = add_layer(i);
      (layers_[i].visible ? nodes_[0]["children"] : hidden).push_back(node);
    }
    // glTF cannot hide a node; what is not to be seen at first is in a second scene only, under a root of its own.
    Json scenes{{{"nodes", {0}}}};
    if (!hidden.empty()) {
      Json root = nodes_[0];
      root["name"] = "hidden at first";
      root["children"] = std::move(hidden);
      scenes[0]["name"] = "shown at first";
      scenes.push_back({{"name", "everything"}, {"nodes", {0, nodes_.size()}}});
      nodes_.push_back(std::move(root));
    }
    if (nodes_[0]["children"].empty()) nodes_[0].erase("children");
    document_.scenes = std::move(scenes);
    return document_.bytes();
  }

 private:
  std::size_t add_material(const Color& color, double opacity, bool two_sided) {
    Json material{
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {linear_light(color[0]), linear_light(color[1]), linear_light(color[2]), opacity}},
          {"metallicFactor", 0},
          {"roughnessFactor", 0.85}}},
        {"doubleSided", two_sided}};
    if (opacity < 1) material["alphaMode"] = "BLEND";
    document_.materials.push_back(material);
    return document_.materials.size() - 1;
  }

  std::size_t add_positions(const std::vector<Point>& points) {
    std::vector<float> values;
    for (const Point& point : points) {
      for (std::size_t i = 0; i < 3; ++i) values.push_back(static_cast<float>(point[i] - center_[i]));
    }
    return document_.add_floats(values, 3, GlbTarget::kVertices);
  }

  // A node with one primitive on the points of an accessor, as child of another.
  void add_part(std::size_t parent, const std::string& name, std::size_t positions,
                const std::vector<std::uint32_t>& indices, GlbMode mode, std::size_t material) {
    document_.meshes.push_back({{"name", name},
                                {"primitives",
                                 {{{"attributes", {{"POSITION", positions}}},
                                   {"indices", document_.add_indices(indices)},
                                   {"material", material},
                                   {"mode", static_cast<std::size_t>(mode)}}}}});
    nodes_.push_back({{"name", name}, {"mesh", document_.meshes.size() - 1}});
    nodes_[parent]["children"].push_back(nodes_.size() - 1);
  }

  std::size_t add_layer(std::size_t index) {
    const Layer& layer = layers_[index];
    const std::size_t top = nodes_.size();
    nodes_.push_back({{"name", layer.name}});
    std::size_t node = top;
    if (!layer.motion.turns.empty()) {
      // It turns about its pivot: the node is there, and what it holds is moved back.
      const Point pivot = pivot_of(layer.motion);
      nodes_[top]["translation"] = pivot;
      nodes_[top]["children"] = Json::array({++node});
      nodes_.push_back(
          {{"name", layer.name + ", about its pivot"}, {"translation", {-pivot[0], -pivot[1], -pivot[2]}}});
    }
    const Scene& scene = layer.scene;
    if (!scene.vertices.empty()) {
      std::vector<Point> points;
      for (const SceneVertex& vertex : scene.vertices) points.push_back(vertex.position);
      const std::size_t positions = add_positions(points);
      const LayerColors colors = colors_of(layers_, index);
      add_volumes(layer, node, positions, colors);
      add_edges(layer, node, positions);
      add_vertices(layer, node, positions);
    }
    for (const Polyline& line : layer.lines) {
      if (line.points.size() < 2) continue;
      std::vector<std::uint32_t> indices;
      for (std::uint32_t i = 0; i < line.points.size(); ++i) indices.push_back(i);
      add_part(node, line.name, add_positions(line.points), indices, GlbMode::kLineStrip,
               add_material(line.color, 1, true));
    }
    add_motion(layer, top);
    return top;
  }

  [[nodiscard]] Point pivot_of(const Motion& motion) const {
    if (motion.turns.empty()) return {};
    return {motion.pivot[0] - center_[0], motion.pivot[1] - center_[1], motion.pivot[2] - center_[2]};
  }

  void add_volumes(const Layer& layer, std::size_t node, std::size_t positions, const LayerColors& colors) {
    const Scene& scene = layer.scene;
    std::vector<std::vector<std::uint32_t>> parts(scene.volumes.size());
    std::vector<std::uint32_t> flat;
    const auto selected = [&scene](std::uint32_t v) { return Scene::selected(scene.volumes[v].mark); };
    for (const SceneFacet& facet : scene.facets) {
      const bool above = selected(facet.above);
      const bool below = selected(facet.below);
      for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
        const auto& [a, b, c] = scene.triangles[t];
        // The eye that sees a triangle turn counterclockwise is outside the volume.
        if (below) parts[facet.below].insert(parts[facet.below].end(), {a, b, c});
        if (above) parts[facet.above].insert(parts[facet.above].end(), {a, c, b});
        if (!above && !below) flat.insert(flat.end(), {a, b, c});
      }
    }
    for (std::size_t v = 0; v < parts.size(); ++v) {
      if (parts[v].empty()) continue;
      const std::uint32_t number = scene.volumes[v].index;
      const std::string name = "volume " + std::to_string(number == kArtificial ? v : number);
      add_part(node, name, positions, parts[v], GlbMode::kTriangles,
               add_material(colors.volumes[v], layer.opacity, false));
    }
    if (!flat.empty()) {
      add_part(node, "flat parts", positions, flat, GlbMode::kTriangles,
               add_material(colors.layer, layer.opacity, true));
    }
  }

  void add_edges(const Layer& layer, std::size_t node, std::size_t positions) {
    std::array<std::vector<std::uint32_t>, 2> ends;
    for (const SceneEdge& edge : layer.scene.edges) {
      if (edge.origin != Origin::kOwn) continue;
      std::vector<std::uint32_t>& list = ends[Scene::selected(edge.mark) ? 1 : 0];
      list.insert(list.end(), {edge.from, edge.to});
    }
    if (!ends[1].empty()) add_part(node, "edges", positions, ends[1], GlbMode::kLines, add_material(kInk, 1, true));
    if (!ends[0].empty()) {
      add_part(node, "edges, not selected", positions, ends[0], GlbMode::kLines, add_material(kOrange, 1, true));
    }
  }

  void add_vertices(const Layer& layer, std::size_t node, std::size_t positions) {
    std::vector<std::uint32_t> isolated;
    for (std::uint32_t v = 0; v < layer.scene.vertices.size(); ++v) {
      if (layer.scene.vertices[v].isolated) isolated.push_back(v);
    }
    if (!isolated.empty()) {
      add_part(node, "isolated vertices", positions, isolated, GlbMode::kPoints, add_material(kInk, 1, true));
    }
  }

  // All layers are in one animation, since most programs play one at a time.
  void add_motion(const Layer& layer, std::size_t node) {
    if (layer.motion.empty()) return;
    if (document_.animations.empty()) {
      document_.animations.push_back({{"name", "motion"}, {"samplers", Json::array()}, {"channels", Json::array()}});
    }
    std::vector<float> times;
    std::vector<float> offsets;
    for (const double time : layer.motion.times) times.push_back(static_cast<float>(time));
    const Point pivot = pivot_of(layer.motion);
    for (const Point& offset : layer.motion.offsets) {
      for (std::size_t k = 0; k < 3; ++k) offsets.push_back(static_cast<float>(pivot[k] + offset[k]));
    }
    std::vector<float> turns;
    for (const auto& [w, x, y, z] : layer.motion.turns) {
      for (const double q : {x, y, z, w}) turns.push_back(static_cast<float>(q));  // glTF's order
    }
    const std::size_t input = document_.add_floats(times, 1, GlbTarget::kNone);
    Json& samplers = document_.animations[0]["samplers"];
    Json& channels = document_.animations[0]["channels"];
    const auto add = [&](const char* path, std::size_t output) {
      channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
      samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    };
    add("translation", document_.add_floats(offsets, 3, GlbTarget::kNone));
    if (!turns.empty()) add("rotation", document_.add_floats(turns, 4, GlbTarget::kNone));
  }

  const std::vector<Layer>& layers_;
  Point center_{};
  GlbDocument document_;
  Json& nodes_ = document_.nodes;
};

}  // namespace

std::string glb_bytes(const std::vector<Layer>& layers) { return GlbWriter(layers).run(); }

void write_glb(const std::vector<Layer>& layers, const std::string& path) { write_file(path, glb_bytes(layers)); }

}  // namespace nef::view
