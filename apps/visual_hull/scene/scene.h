// SPDX-License-Identifier: Apache-2.0
//
// What a scene file says, before any image is opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/world_box.h"

namespace nef::visual_hull {

/// How pixels become object or background.
struct ThresholdOptions {
  enum class Kind { kDefault, kValue, kOtsu };
  /// Value: the largest of red, green and blue; saturation: their range over the value. The last three are half of a
  /// difference plus half of the range, so that gray is in the middle.
  enum class Channel : std::uint8_t {
    kGray,
    kRed,
    kGreen,
    kBlue,
    kAlpha,
    kValue,
    kSaturation,
    kRedBlue,
    kRedGreen,
    kGreenBlue
  };
  Kind kind = Kind::kDefault;  ///< alpha where it varies, otherwise brighter than half of the type's range
  double value = 0;            ///< brighter than this is object (in the image's own units)
  bool invert = false;         ///< what is darker is object
  Channel channel = Channel::kGray;
};

/// The names of channels, in the order of their enum: "gray", "red", ..., "red-blue", "red-green", "green-blue".
const std::vector<std::string>& channel_names();

/// Parses one of these names. Throws InputError.
ThresholdOptions::Channel parse_channel(const std::string& text);

/// Parses "otsu" or a number. Throws InputError.
ThresholdOptions parse_threshold(const std::string& text);

/// Lens distortion as OpenCV's calibration knows it; the intrinsics are those of the camera.
struct Distortion {
  std::vector<double> coefficients;  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 ...]]: 4, 5, 8, 12 or 14; none: no distortion
  Matrix3 intrinsics;
};

/// Which point of a pixel has whole coordinates (u, v): its centre, or its upper left corner.
enum class PixelOrigin { kCenter, kCorner };

/// The size of an image in pixels.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// One camera with an image, or with polygons in its place.
struct View {
  std::string name;
  Camera camera;
  std::filesystem::path image;                ///< empty if there are polygons
  std::optional<std::vector<Ring>> polygons;  ///< rings in image coordinates, combined by parity
  Distortion distortion;
  std::optional<ImageSize> size;  ///< of the image that the camera was calibrated for, where the file tells
};

struct Scene {
  std::vector<View> views;
  std::string format;                                ///< what the file was taken for, in words
  PixelOrigin origin = PixelOrigin::kCenter;         ///< of the format
  std::vector<std::filesystem::path> image_folders;  ///< where images are looked up after the scene's own folder
  std::optional<WorldBox> box;
  std::optional<ThresholdOptions> threshold;
  /// Root mean square of what cameras are off by in their images of the object, in pixels, where a calibration tells.
  std::optional<double> camera_error;
  bool guessed = false;  ///< the cameras stand for a turntable of equal steps of which nothing else is known
  std::vector<std::string> ignored;  ///< names in the file that mean nothing to it, in their order
};

}  // namespace nef::visual_hull
