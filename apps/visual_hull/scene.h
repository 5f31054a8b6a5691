// SPDX-License-Identifier: Apache-2.0
//
// What a scene file says, before any image is opened.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/camera.h"
#include "apps/visual_hull/cone.h"

namespace visual_hull {

/// How pixels become object or background.
struct ThresholdOptions {
  enum class Kind { kDefault, kValue, kOtsu };
  enum class Channel { kGray, kRed, kGreen, kBlue, kAlpha };
  Kind kind = Kind::kDefault;  ///< alpha where it varies, otherwise brighter than half of the type's range
  double value = 0;            ///< brighter than this is object (in the image's own units)
  bool invert = false;         ///< what is darker is object
  Channel channel = Channel::kGray;
};

/// Parses "gray", "red", "green", "blue" or "alpha". Throws InputError.
ThresholdOptions::Channel parse_channel(const std::string& text);

/// Parses "otsu" or a number. Throws InputError.
ThresholdOptions parse_threshold(const std::string& text);

/// Lens distortion as OpenCV's calibration knows it; the intrinsics are those of the camera.
struct Distortion {
  std::vector<double> coefficients;  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 ...]]: 4, 5, 8, 12 or 14; none: no distortion
  Matrix3 intrinsics;
};

/// One camera with an image, or with polygons in its place.
struct View {
  std::string name;
  Camera camera;
  std::filesystem::path image;                ///< empty if there are polygons
  std::optional<std::vector<Ring>> polygons;  ///< rings in image coordinates, combined by parity
  Distortion distortion;
};

struct Scene {
  std::vector<View> views;
  std::optional<WorldBox> box;
  std::optional<ThresholdOptions> threshold;
};

/// Reads a scene; the format is told by the content of the file:
///  - a folder of camera files, and blocks of intrinsic and extrinsic parameters, see scene_blocks.h;
///  - JSON (first character '{'), see scene_json.h;
///  - `.vsh` by its extension, see vsh.h;
///  - Middlebury: optionally the number of views, then lines of a name, K (9 numbers), R (9), t (3);
///  - matrices: lines of an optional name and 12 numbers; or a camera as three lines of four
///    numbers, optionally with a line of its own for the name. '#' begins a comment.
/// Names of images are looked up by find_image. Numbers are the rationals that they spell.
/// Throws InputError.
Scene read_scene(const std::filesystem::path& file);

/// The folder in which the images of a scene are looked up: the scene itself if it is one.
std::filesystem::path scene_folder(const std::filesystem::path& scene);

/// The image that a scene calls `name`: as it is, with a usual extension added, or with another
/// usual extension, beside the scene or in its folders masks, silhouettes or images. Throws InputError if there is
/// none.
std::filesystem::path find_image(const std::filesystem::path& folder, const std::string& name);

/// The images of a folder in the order of their names.
std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Parses "x0,y0,z0,x1,y1,z1". Throws InputError.
WorldBox parse_box(const std::string& text);

/// Checks that the box has a volume. Throws InputError with `where` in front.
void check_box(const WorldBox& box, const std::string& where);

}  // namespace visual_hull
