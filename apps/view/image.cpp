// SPDX-License-Identifier: Apache-2.0
#include "apps/view/image.h"

#include <png.h>

#include "nef/base/error.h"

namespace nef::view {

std::string png_bytes(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = image.width;
  header.height = image.height;
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&header, nullptr, &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    throw Error(std::string("picture cannot be made: ") + header.message);
  }
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    throw Error(std::string("picture cannot be made: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace nef::view
