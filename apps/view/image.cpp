// SPDX-License-Identifier: Apache-2.0
#include "apps/view/image.h"

#include <png.h>
#include <zlib.h>

#include "nef/base/error.h"

namespace nef::view {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 255U);
  return bytes;
}

// The chunk that says how large pixels are; libpng's simple interface has none.
std::string size_chunk(std::uint32_t pixels_per_metre) {
  constexpr char kMetres = 1;
  const std::string content = "pHYs" + big_endian(pixels_per_metre) + big_endian(pixels_per_metre) + kMetres;
  const uLong check = crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  return big_endian(static_cast<std::uint32_t>(content.size() - 4)) + content +
         big_endian(static_cast<std::uint32_t>(check));
}

}  // namespace

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
  constexpr std::size_t kBehindHeader = 8 + 25;  // the signature and the first chunk
  if (image.pixels_per_metre != 0) bytes.insert(kBehindHeader, size_chunk(image.pixels_per_metre));
  return bytes;
}

}  // namespace nef::view
