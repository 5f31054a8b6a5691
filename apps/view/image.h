// SPDX-License-Identifier: Apache-2.0
//
// Images and PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nef::view {

/// Rows from top to bottom, three bytes (red, green, blue as in sRGB) for each pixel.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;
  std::uint32_t pixels_per_metre = 0;  ///< of a picture that is to be printed to scale; 0: it says nothing
};

/// The bytes of a PNG file.
std::string png_bytes(const Image& image);

}  // namespace nef::view
