// SPDX-License-Identifier: Apache-2.0
//
// An image hangs on a plane across its camera's axis, halfway between camera and hull, with its corners on the rays of
// the frame's corners. Rays are exact and rounded for display. Images that a browser shows as they are (small,
// undistorted JPEG or PNG) are embedded as files; others are decoded, scaled and encoded as PNG.
#include "apps/visual_hull/command/pictures/pictures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "apps/view/page.h"
#include "apps/visual_hull/color/vertex_colors.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "apps/visual_hull/texture/hull_texture.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using nef::view::Layer;
using nef::view::Point;

constexpr nef::view::Color kCameraColor{110, 110, 120};
constexpr nef::view::Color kOutlineColor{200, 40, 40};
constexpr std::uintmax_t kLargestFile = std::uintmax_t{512} << 10U;  // of an image that is embedded as it is
constexpr int kLongestSide = 1024;                                   // pixels of others

// The triangles of a scene as a mesh whose faces are counterclockwise as seen from outside.
nef::Mesh mesh_of(const nef::view::Scene& scene) {
  nef::Mesh mesh;
  for (const nef::view::SceneVertex& vertex : scene.vertices) {
    mesh.vertices.push_back({nef::exact_rational(vertex.position[0]), nef::exact_rational(vertex.position[1]),
                             nef::exact_rational(vertex.position[2])});
  }
  for (const nef::view::SceneFacet& facet : scene.facets) {
    const bool turn = nef::view::Scene::selected(scene.volumes[facet.above].mark);
    for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      mesh.push_face(turn ? std::array{a, c, b} : std::array{a, b, c});
    }
  }
  return mesh;
}

// The corners of mesh_of's faces that were turned are turned back.
nef::view::SurfaceColors textured_surface(const nef::view::Scene& scene, HullTexture texture) {
  nef::view::SurfaceColors surface;
  surface.image = image_of(texture.image);
  surface.places = std::move(texture.corners);
  for (const nef::view::SceneFacet& facet : scene.facets) {
    if (!nef::view::Scene::selected(scene.volumes[facet.above].mark)) continue;
    for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
      std::swap(surface.places[3 * t + 1], surface.places[3 * t + 2]);
    }
  }
  return surface;
}

// Where a camera's image hangs: halfway to the hull, or in it for a camera that stands in it.
double image_depth(const Camera& camera, const Result& result) {
  WorldBox box = result.box;
  if (const auto bounds = nef::bounding_box(result.hull)) box = {(*bounds)[0], (*bounds)[1]};
  const DepthRange range = depth_range(camera, box);
  const double near = nef::nearest_double(range.nearest);
  const double far = nef::nearest_double(range.farthest);
  if (near > 0) return near / 2;
  return far > 0 ? far / 4 : 1;  // the camera looks away: any depth
}

/// Places points of a camera's image on a plane of constant depth.
class ImagePlane {
 public:
  ImagePlane(const Camera& camera, double depth) : camera_(camera), depth_(depth) {
    require_pinhole(camera, "--page");
    for (std::size_t i = 0; i < 3; ++i) centre_[i] = nef::nearest_double(camera.centre()[i]);
  }

  Point operator()(double u, double v) const {
    const Rational3 ray = camera_.ray(Point2::from_doubles(u, v));
    Point result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = centre_[i] + depth_ * nef::nearest_double(ray[i]);
    return result;
  }

  [[nodiscard]] const Point& centre() const { return centre_; }

 private:
  const Camera& camera_;
  double depth_;
  Point centre_{};
};

// The image as bytes that a browser can show; the size of the frame goes to `size`.
bool embed_image(const ViewResult& view, PixelOrigin origin, nef::view::Photo& photo) {
  std::string extension = view.image.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  std::error_code error;
  const bool plain = view.distortion.coefficients.empty() && (jpeg || extension == ".png");
  if (plain && fs::file_size(view.image, error) <= kLargestFile && !error) {
    photo.media_type = jpeg ? "image/jpeg" : "image/png";
    photo.bytes = nef::read_file(view.image.string());
    return true;
  }
  cv::Mat image = read_photograph(view.image, view.distortion, origin);
  if (image.empty()) return false;
  const int longest = std::max(image.cols, image.rows);
  if (longest > kLongestSide) {
    const double scale = static_cast<double>(kLongestSide) / longest;
    cv::resize(image, image, cv::Size(), scale, scale, cv::INTER_AREA);
  }
  photo.media_type = "image/png";
  photo.bytes = png_of(image);
  return true;
}

// The overlay, which marks the residual.
void embed_overlay(const ViewResult& view, const Result& result, PixelOrigin origin, nef::view::Photo& photo) {
  photo.media_type = "image/png";
  photo.bytes = png_of(draw_overlay(view, result.hull, origin));
}

void add_image(Layer& layer, const ViewResult& view, const Result& result, PixelOrigin origin,
               const ImagePlane& plane) {
  nef::view::Photo photo;
  photo.name = view.name;
  if (!embed_image(view, origin, photo)) return;
  if (result.consistency) embed_overlay(view, result, origin, photo);
  // The frame runs along the outer sides of the pixels.
  const double shift = origin == PixelOrigin::kCenter ? -0.5 : 0;
  const double right = view.silhouette.image_size.width + shift;
  const double bottom = view.silhouette.image_size.height + shift;
  photo.corners = {plane(shift, shift), plane(right, shift), plane(right, bottom), plane(shift, bottom)};
  photo.eye = plane.centre();
  layer.photos.push_back(std::move(photo));
}

void add_outline(Layer& layer, const ViewResult& view, const ImagePlane& plane) {
  for (const Ring& ring : view.silhouette.region.rings) {
    nef::view::Polyline line;
    line.name = view.name;
    line.color = kOutlineColor;
    for (const Point2& p : ring) line.points.push_back(plane(p.approximate[0], p.approximate[1]));
    line.points.push_back(line.points.front());
    layer.lines.push_back(std::move(line));
  }
  if (view.silhouette.region.rings.empty()) return;
  // Four lines of sight, to the extremes of the outline.
  const Ring& ring = view.silhouette.region.rings[0];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax_element(ring.begin(), ring.end(), [axis](const Point2& a, const Point2& b) {
      return a.approximate[axis] < b.approximate[axis];
    });
    for (const auto& p : {*low, *high}) {
      nef::view::Polyline sight;
      sight.name = view.name;
      sight.color = kCameraColor;
      sight.points = {plane.centre(), plane(p.approximate[0], p.approximate[1])};
      layer.lines.push_back(std::move(sight));
    }
  }
}

}  // namespace

Layer hull_layer(const Result& result, PixelOrigin origin, const nef::Monitor& monitor, HullColors colors) {
  Layer layer;
  layer.name = "hull";
  layer.scene = nef::view::build_scene(result.hull, {}, monitor);
  if (colors == HullColors::kPlain || layer.scene.triangles.empty()) return layer;
  const nef::Mesh mesh = mesh_of(layer.scene);
  if (colors == HullColors::kVertices) {
    layer.surface.vertices = vertex_colors(mesh, result.views, origin, monitor).colors;
  } else {
    layer.surface = textured_surface(layer.scene, hull_texture(mesh, result.views, origin, monitor));
  }
  return layer;
}

std::vector<Layer> page_layers(const Result& result, PixelOrigin origin, Layer hull) {
  std::vector<Layer> layers;
  layers.push_back(std::move(hull));
  Layer cameras;
  cameras.name = "cameras";
  cameras.color = kCameraColor;
  for (const ViewResult& view : result.views) {
    const ImagePlane plane(view.camera, image_depth(view.camera, result));
    if (view.image.empty()) {
      add_outline(cameras, view, plane);
    } else {
      add_image(cameras, view, result, origin, plane);
    }
  }
  layers.push_back(std::move(cameras));
  return layers;
}

void write_page(const Result& result, PixelOrigin origin, Layer hull, const fs::path& file) {
  nef::view::PageOptions options;
  options.title = "visual hull of " + std::to_string(result.views.size()) + " views";
  nef::view::write_page(page_layers(result, origin, std::move(hull)), file.string(), options);
}

}  // namespace nef::visual_hull
