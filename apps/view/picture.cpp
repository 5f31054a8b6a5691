// SPDX-License-Identifier: Apache-2.0
//
// The painter's input is collected first: triangles of facets, lines for edges and dots for vertices, all projected,
// each line and dot with the list of facets whose planes hold it, which never hide it. Then bands of rows are painted
// and averaged, so that memory is bounded whatever the size of the picture. Shading depends on how a facet is turned to
// a fixed light at the camera. All in doubles: a picture decides nothing.
#include "apps/view/picture.h"

#include <algorithm>
#include <cmath>

#include "apps/view/picture/raster.h"
#include "apps/view/scene/palette.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::view {
namespace {

constexpr std::uint32_t kFactor = 3;  // samples along each side of a pixel
constexpr std::uint32_t kLargest = 16384;
constexpr std::size_t kBandSamples = std::size_t{16} << 20U;
constexpr Point kDefaultFrom{0.55, -0.75, 0.42};
constexpr Color kWhite{255, 255, 255};
constexpr Color kGrey{150, 162, 174};
const Point kLight = unit({0.35, 0.65, 0.7});  // along the camera's axes

Color shaded(const Color& color, double light) {
  Color result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = static_cast<std::uint8_t>(std::lround(std::min(1.0, light) * color[i]));
  return result;
}

// What all layers have to paint, in samples.
class PictureBuilder {
 public:
  PictureBuilder(const PictureCamera& camera, double pixel) : camera_(camera), pixel_(pixel) {}

  void add(const Layer& layer, const LayerColors& colors) {
    find_facets_at_vertices(layer.scene);
    for (const SceneVertex& vertex : layer.scene.vertices) projected_.push_back(camera_.project(vertex.position));
    for (std::size_t f = 0; f < layer.scene.facets.size(); ++f) add_facet(layer, colors, f);
    const double length = mean_length(layer.scene);
    if (layer.surface.none()) {  // else lines and dots would cover its colours
      for (const SceneEdge& edge : layer.scene.edges) add_edge(edge, length);
      for (std::uint32_t v = 0; v < layer.scene.vertices.size(); ++v) add_vertex(layer.scene, v, length);
    }
    if (layer.scene.box) add_box(*layer.scene.box);
    for (const Polyline& line : layer.lines) {
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        add_segment(line.points[i], line.points[i + 1], 1.1, line.color);
      }
    }
    for (const Photo& photo : layer.photos) add_photo(photo);
    facet_count_ += static_cast<std::uint32_t>(layer.scene.facets.size());
    projected_.clear();
  }

  [[nodiscard]] Image draw(std::uint32_t width, std::uint32_t height) {
    Image image{width, height, {}};
    image.rgb.reserve(std::size_t{width} * height * 3);
    resolve_spans();
    const std::size_t per_row = std::size_t{width} * kFactor * kFactor;
    const auto band = static_cast<std::uint32_t>(std::clamp<std::size_t>(kBandSamples / per_row, 1, height));
    for (std::uint32_t y = 0; y < height; y += band) {
      const std::uint32_t rows = std::min(band, height - y);
      Raster raster(width * kFactor, y * kFactor, rows * kFactor, pixel_);
      for (const PaintTriangle& triangle : triangles_) {
        if (triangle.opacity >= 1) raster.paint(triangle);
      }
      for (const PaintTriangle& triangle : triangles_) {
        if (triangle.opacity < 1) raster.paint(triangle);
      }
      for (const PaintLine& line : lines_) raster.paint(line);
      for (const PaintDot& dot : dots_) raster.paint(dot);
      const std::vector<std::uint8_t> pixels = raster.resolve(kFactor);
      image.rgb.insert(image.rgb.end(), pixels.begin(), pixels.end());
    }
    return image;
  }

 private:
  // The facets at each vertex, sorted, in one array.
  void find_facets_at_vertices(const Scene& scene) {
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
      for (std::uint32_t i = scene.facet_vertex_begin[f]; i < scene.facet_vertex_begin[f + 1]; ++i) {
        pairs.push_back({scene.facet_vertices[i], facet_count_ + f});
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    facets_at_.assign(scene.vertices.size() + 1, 0);
    std::size_t next = 0;
    for (std::uint32_t v = 0; v < scene.vertices.size(); ++v) {
      facets_at_[v] = beside_.size();
      for (; next < pairs.size() && pairs[next][0] == v; ++next) beside_.push_back(pairs[next][1]);
    }
    facets_at_.back() = beside_.size();
  }

  void add_facet(const Layer& layer, const LayerColors& colors, std::size_t f) {
    const Scene& scene = layer.scene;
    const SceneFacet& facet = scene.facets[f];
    if (layer.opacity <= 0) return;
    // The largest triangle tells best how the facet is turned.
    Point normal{0, 0, 0};
    for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      const Point& origin = scene.vertices[a].position;
      const Point n = cross(minus(scene.vertices[b].position, origin), minus(scene.vertices[c].position, origin));
      if (dot(n, n) > dot(normal, normal)) normal = n;
    }
    const Point& corner = scene.vertices[scene.triangles[facet.first_triangle][0]].position;
    const bool from_above = dot(normal, camera_.from_eye(corner)) < 0;
    Point facing = camera_.turned(unit(normal));
    if (!from_above) facing = {-facing[0], -facing[1], -facing[2]};
    const FacetSide side = facet_side(scene, facet, from_above);
    const Color base = side.volume == kArtificial ? colors.layer : colors.volumes[side.volume];
    const double light = 0.55 + 0.36 * std::max(dot(facing, kLight), 0.0) + 0.14 * std::max(facing[2], 0.0);
    const Color color = shaded(base, light * (side.inner ? 0.8 : 1.0));
    const bool own_colors = !layer.surface.none() && !side.inner && facet.origin == Origin::kOwn;
    for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      triangles_.push_back({{projected_[a], projected_[b], projected_[c]},
                            facet.origin == Origin::kSection ? base : color,
                            fill_of(facet),
                            static_cast<float>(layer.opacity),
                            facet_count_ + static_cast<std::uint32_t>(f)});
      if (own_colors) triangles_.back().surface = {&layer.surface, {a, b, c}, 3 * t};
    }
  }

  static Fill fill_of(const SceneFacet& facet) {
    if (facet.origin == Origin::kBox) return Fill::kFaded;
    if (facet.origin == Origin::kSection) return Fill::kCut;
    return Scene::selected(facet.mark) ? Fill::kSolid : Fill::kStriped;
  }

  // Of the edges on the picture, in pixels: dense meshes get finer lines and dots.
  [[nodiscard]] double mean_length(const Scene& scene) const {
    double sum = 0;
    for (const SceneEdge& edge : scene.edges) {
      const Projected& a = projected_[edge.from];
      const Projected& b = projected_[edge.to];
      sum += std::hypot(a.x - b.x, a.y - b.y);
    }
    return scene.edges.empty() ? 1e9 : sum / static_cast<double>(scene.edges.size()) / pixel_;
  }

  void add_edge(const SceneEdge& edge, double length) {
    const bool own = edge.origin != Origin::kBox;
    double half_width = std::clamp(length * 0.04, 0.3, 0.9);
    if (edge.isolated && own) half_width = 1.7;
    if (edge.origin != Origin::kOwn) half_width = std::min(half_width, 0.6);
    const Color color = !own ? kGrey : Scene::selected(edge.mark) ? kInk : kOrange;
    // The facets at both ends: their planes hold the edge.
    const std::size_t first = beside_.size();
    std::set_intersection(beside_.begin() + at(edge.from), beside_.begin() + at(edge.from + 1),
                          beside_.begin() + at(edge.to), beside_.begin() + at(edge.to + 1),
                          std::back_inserter(scratch_));
    beside_.insert(beside_.end(), scratch_.begin(), scratch_.end());
    scratch_.clear();
    lines_.push_back({projected_[edge.from], projected_[edge.to], half_width * pixel_, color, {}});
    line_spans_.push_back({first, beside_.size()});
  }

  [[nodiscard]] std::ptrdiff_t at(std::size_t vertex) const { return static_cast<std::ptrdiff_t>(facets_at_[vertex]); }

  void add_vertex(const Scene& scene, std::uint32_t v, double length) {
    const SceneVertex& vertex = scene.vertices[v];
    if (vertex.origin != Origin::kOwn) return;
    const double radius = vertex.isolated ? 5.5 : std::min(4.0, length * 0.12);
    if (radius < 1.2) return;  // more would be a smear
    const bool selected = Scene::selected(vertex.mark);
    dots_.push_back({projected_[v],
                     radius * pixel_,
                     std::min(1.6, radius * 0.4) * pixel_,
                     selected ? kInk : kWhite,
                     selected ? kInk : kOrange,
                     {}});
    dot_spans_.push_back({facets_at_[v], facets_at_[v + 1]});
  }

  void add_segment(const Point& a, const Point& b, double half_width, const Color& color) {
    lines_.push_back({camera_.project(a), camera_.project(b), half_width * pixel_, color, {}});
    line_spans_.push_back({0, 0});
  }

  void add_photo(const Photo& photo) {
    for (std::size_t i = 0; i < 4; ++i) {
      add_segment(photo.corners[i], photo.corners[(i + 1) % 4], 0.6, kGrey);
      if (photo.eye) add_segment(*photo.eye, photo.corners[i], 0.5, kGrey);
    }
  }

  // Dashed, so that it is not taken for a part of the set.
  void add_box(const std::array<Point, 2>& box) {
    constexpr int kDashes = 24;
    for (unsigned corner = 0; corner < 8; ++corner) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1U) != 0) continue;
        Point a;
        for (std::size_t i = 0; i < 3; ++i) a[i] = box[corner >> i & 1U][i];
        Point b = a;
        const double step = (box[1][axis] - box[0][axis]) / kDashes;
        for (int k = 0; k < kDashes; k += 2) {
          a[axis] = box[0][axis] + k * step;
          b[axis] = a[axis] + step;
          add_segment(a, b, 0.6, kGrey);
        }
      }
    }
  }

  // Spans into beside_ are only valid once it does not grow any more.
  void resolve_spans() {
    const auto span = [this](const std::array<std::size_t, 2>& range) {
      return std::span<const std::uint32_t>(beside_.data() + range[0], range[1] - range[0]);
    };
    for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i].beside = span(line_spans_[i]);
    for (std::size_t i = 0; i < dots_.size(); ++i) dots_[i].beside = span(dot_spans_[i]);
  }

  const PictureCamera& camera_;
  double pixel_;                   // samples for each unit of width: a pixel of a picture 900 high
  std::uint32_t facet_count_ = 0;  // of the layers before
  std::vector<Projected> projected_;
  std::vector<std::size_t> facets_at_;  // of each vertex of the layer, into beside_
  std::vector<std::uint32_t> beside_;
  std::vector<std::uint32_t> scratch_;
  std::vector<PaintTriangle> triangles_;
  std::vector<PaintLine> lines_;
  std::vector<PaintDot> dots_;
  std::vector<std::array<std::size_t, 2>> line_spans_;
  std::vector<std::array<std::size_t, 2>> dot_spans_;
};

// All points that must be seen.
std::vector<Point> points_of(const std::vector<Layer>& layers) {
  std::vector<Point> points;
  for (const Layer& layer : layers) {
    if (!layer.visible) continue;
    for (const SceneVertex& vertex : layer.scene.vertices) points.push_back(vertex.position);
    if (const auto& box = layer.scene.box) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        Point point;
        for (std::size_t i = 0; i < 3; ++i) point[i] = (*box)[corner >> i & 1U][i];
        points.push_back(point);
      }
    }
    for (const Polyline& line : layer.lines) points.insert(points.end(), line.points.begin(), line.points.end());
    for (const Photo& photo : layer.photos) {
      points.insert(points.end(), photo.corners.begin(), photo.corners.end());
      if (photo.eye) points.push_back(*photo.eye);
    }
  }
  return points;
}

}  // namespace

Image draw_picture(const std::vector<Layer>& layers, const PictureOptions& options) {
  if (options.width == 0 || options.height == 0 || options.width > kLargest || options.height > kLargest) {
    throw InputError("a picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " pixels cannot be drawn: give a size between 1x1 and 16384x16384");
  }
  const Point from = options.from.value_or(kDefaultFrom);
  if (unit(from) == Point{0, 0, 0})
    throw InputError("from 0,0,0 is not a direction: give one that leads to the camera");
  const std::vector<Point> points = points_of(layers);
  Point middle{0, 0, 0};
  if (const auto bounds = bounds_of(layers, Framing::kFocus)) {
    for (std::size_t i = 0; i < 3; ++i) middle[i] = (*bounds)[0][i] / 2 + (*bounds)[1][i] / 2;
  }
  const PictureCamera camera(from, middle, points, static_cast<double>(options.width) * kFactor,
                             static_cast<double>(options.height) * kFactor);
  PictureBuilder builder(camera, kFactor * std::min(options.width, options.height) / 900.0);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].visible) builder.add(layers[i], colors_of(layers, i));
  }
  return builder.draw(options.width, options.height);
}

void write_picture(const std::vector<Layer>& layers, const std::string& path, const PictureOptions& options) {
  write_file(path, png_bytes(draw_picture(layers, options)));
}

}  // namespace nef::view
