// SPDX-License-Identifier: Apache-2.0
//
// How photographs become masks.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// A method, as `--mask` names it.
struct MaskMethod {
  enum class Kind : std::uint8_t { kAuto, kThreshold, kBackground, kMedian, kKey, kGrabCut };
  Kind kind = Kind::kAuto;
  ThresholdOptions::Channel channel = ThresholdOptions::Channel::kGray;  ///< of kThreshold
  std::optional<double> level;                                           ///< of kThreshold, of 255; else it is found
  bool below = false;                                                    ///< the object is darker than `level`
  std::filesystem::path background;             ///< of kBackground: a picture without the object
  std::array<int, 3> key{};                     ///< of kKey: red, green and blue, of 255
  std::optional<std::array<int, 4>> rectangle;  ///< of kGrabCut: x, y, width, height in pixels
  std::filesystem::path strokes;  ///< of kGrabCut: a picture with strokes, or a folder of them (strokes.h)
  bool soft = false;              ///< masks are opacities (silhouette/opacity.h), if the method tells them
};

/// Parses "auto", "threshold[:CHANNEL[:LEVEL|:<LEVEL]]", "background:FILE", "background:median", "key:#RRGGBB",
/// "key:NAME" of a colour, or "grabcut[:X,Y,WIDTH,HEIGHT|:STROKES]". Throws InputError.
MaskMethod parse_mask_method(const std::string& text);

}  // namespace nef::visual_hull
