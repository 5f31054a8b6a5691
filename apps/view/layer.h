// SPDX-License-Identifier: Apache-2.0
//
// What a picture, a page or a GLB file shows: named scenes with a colour, and what programs add to them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/image.h"
#include "apps/view/scene.h"

namespace nef::view {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue as in sRGB

/// A motion in time: at times[i] (seconds, increasing) the layer is moved by offsets[i], in between linearly. If there
/// are turns, it is first turned by turns[i] about the pivot, in between about one axis at constant speed.
struct Motion {
  std::vector<double> times;
  std::vector<Point> offsets;
  std::vector<std::array<double, 4>> turns{};  ///< unit quaternions w x y z, none or one for each time
  Point pivot{};                               ///< where it is before any motion
  [[nodiscard]] bool empty() const { return times.empty(); }
};

/// A line of segments that is no part of a polyhedron: a path, a viewing ray.
struct Polyline {
  std::string name;
  std::vector<Point> points;
  Color color{40, 40, 40};
};

/// An image that hangs in space: a photograph in front of its camera. Pages only.
struct Photo {
  std::string name;
  std::array<Point, 4> corners{};  ///< top left, top right, bottom right, bottom left as the image shows it
  std::optional<Point> eye;        ///< where the camera is; lines from there to the corners are drawn
  std::string media_type;          ///< "image/png", "image/jpeg"
  std::string bytes;               ///< the file
};

/// Colours of the facets of a scene in place of those of its volumes: of each vertex, or an image. They are shown as
/// they are, without light and shade. Pages and pictures only.
struct SurfaceColors {
  std::vector<Color> vertices;  ///< of each vertex of the scene, interpolated over triangles; or none
  Image image;                  ///< or an image; of width 0: none
  /// For each corner of each triangle its place in the image, from (0, 0) at the lower left to (1, 1) at the upper
  /// right.
  std::vector<std::array<float, 2>> places;

  [[nodiscard]] bool has_image() const { return image.width > 0; }
  [[nodiscard]] bool none() const { return vertices.empty() && !has_image(); }
};

struct Layer {
  std::string name;
  Scene scene;
  std::optional<Color> color;  ///< of all its volumes; one from the palette for each volume (or layer) if not given
  double opacity = 1;          ///< of its facets
  bool visible = true;         ///< at first; pages can switch it
  Motion motion;
  std::vector<Polyline> lines;
  std::vector<Photo> photos;
  SurfaceColors surface = {};
};

/// The colours of a layer's items.
struct LayerColors {
  Color layer{};               ///< of the layer as a whole, and of its flat parts
  std::vector<Color> volumes;  ///< of each volume of the scene
};

/// Colour `index` of a palette that people with any colour vision can tell apart; repeats after eight.
Color palette_color(std::size_t index);

/// The colour given, or one for the layer if there are several, or one for each selected volume if there is one layer.
LayerColors colors_of(const std::vector<Layer>& layers, std::size_t index);

/// The volume whose colour a side of a facet shows to an eye on that side (above or below it): the selected one
/// behind the facet, or the one in front seen from within; kArtificial for a facet between unselected volumes.
struct FacetSide {
  std::uint32_t volume = kArtificial;
  bool inner = false;  ///< the volume is in front: the eye looks at its wall from within
};
FacetSide facet_side(const Scene& scene, const SceneFacet& facet, bool seen_from_above);

/// What bounds_of looks at.
enum class Framing : std::uint8_t {
  kAll,   ///< all layers, their lines and photos
  kFocus  ///< visible layers and their lines; photos, which stand far around a set, only if there is nothing else
};

/// Smallest and largest coordinates, wherever motions take the layers; nothing if there is nothing.
std::optional<std::array<Point, 2>> bounds_of(const std::vector<Layer>& layers, Framing framing);

}  // namespace nef::view
