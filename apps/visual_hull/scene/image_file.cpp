// SPDX-License-Identifier: Apache-2.0
//
// A file that begins with PNG's signature goes to libpng. For other formats, OpenCV's `imread` is found by its mangled
// name in the library of image formats, once for the process, and called in a child process with limits
// (`run_bounded`), which returns the pixels behind a small header.
#include "apps/visual_hull/scene/image_file.h"

#include <dlfcn.h>
#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "nef/base/error.h"
#include "nef/io/bounded_process.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

constexpr std::size_t kMostBytes = std::size_t{2} << 30U;  // of pixels: far more than any camera gives
// For decoders of other formats, which keep a few copies of the pixels.
constexpr nef::ParserLimits kDecoderLimits{.bytes = 3 * kMostBytes, .seconds = 120};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A PNG file that is being decoded. libpng tells of errors by longjmp, so what calls it holds nothing that would have
/// to be destroyed.
class PngReader {
 public:
  PngReader()
      : png_(png_create_read_struct(
            PNG_LIBPNG_VER_STRING, nullptr, [](png_structp png, png_const_charp) { png_longjmp(png, 1); },
            [](png_structp, png_const_charp) {})) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_chunk_cache_max(png_, 1);  // texts and the like are skipped: each unpacks to megabytes
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  /// From the first byte on. Pixels are to come with eight bits at most, or as they are.
  bool read_header(std::FILE* file, bool eight_bits) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, file);
    png_read_info(png_, info_);
    const int color = png_get_color_type(png_, info_);
    const bool palette = color == PNG_COLOR_TYPE_PALETTE;
    if (palette) png_set_palette_to_rgb(png_);
    if ((palette || color == PNG_COLOR_TYPE_RGB) && png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) {
      png_set_tRNS_to_alpha(png_);
    }
    if (color == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png_, info_) < 8) png_set_expand_gray_1_2_4_to_8(png_);
    if (eight_bits) png_set_strip_16(png_);
    if (color == PNG_COLOR_TYPE_GRAY_ALPHA) png_set_gray_to_rgb(png_);
    png_set_bgr(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);  // of 16 bits
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  /// All pixels, row by row, and what comes behind them.
  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  [[nodiscard]] std::size_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::size_t height() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int type() const {
    return CV_MAKETYPE(png_get_bit_depth(png_, info_) == 16 ? CV_16U : CV_8U, png_get_channels(png_, info_));
  }

 private:
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool is_png(std::FILE* file) {
  std::array<png_byte, 8> begin{};
  const std::size_t count = std::fread(begin.data(), 1, begin.size(), file);
  std::rewind(file);
  return count == begin.size() && png_sig_cmp(begin.data(), 0, begin.size()) == 0;
}

cv::Mat read_png(std::FILE* file, bool eight_bits) {
  PngReader reader;
  if (!reader.read_header(file, eight_bits)) return {};
  const std::size_t row_bytes = reader.width() * CV_ELEM_SIZE(reader.type());
  if (row_bytes > kMostBytes / reader.height()) return {};
  cv::Mat image(static_cast<int>(reader.height()), static_cast<int>(reader.width()), reader.type());
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.rows; ++y) rows.push_back(image.ptr<png_byte>(y));
  return reader.read_rows(rows.data()) ? image : cv::Mat();
}

using Imread = decltype(&cv::imread);

Imread load_imread() {
  void* const library = dlopen(NEF_OPENCV_IMGCODECS, RTLD_LAZY | RTLD_LOCAL);  // for good
  void* const function = library == nullptr
                             ? nullptr
                             : dlsym(library, "_ZN2cv6imreadERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEi");
  if (function != nullptr) return reinterpret_cast<Imread>(function);
  throw nef::Error(std::string("images other than PNG need OpenCV's image formats: ") + dlerror());
}

// Rows, columns and type, then the pixels.
struct PixelHeader {
  int rows = 0;
  int columns = 0;
  int type = 0;
};

std::string to_bytes(const cv::Mat& image) {
  if (image.empty() || image.total() * image.elemSize() > kMostBytes) return {};
  const PixelHeader header{image.rows, image.cols, image.type()};
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.reserve(bytes.size() + row_bytes * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y) bytes.append(image.ptr<char>(y), row_bytes);
  return bytes;
}

cv::Mat image_of(const std::string& bytes) {
  PixelHeader header;
  if (bytes.size() < sizeof header) return {};
  std::memcpy(&header, bytes.data(), sizeof header);
  cv::Mat image(header.rows, header.columns, header.type);
  std::memcpy(image.data, bytes.data() + sizeof header, bytes.size() - sizeof header);
  return image;
}

cv::Mat read_other(const std::filesystem::path& file, int flags) {
  static const Imread imread = load_imread();
  const std::optional<std::string> bytes = nef::run_bounded(kDecoderLimits, [&]() -> std::string {
    try {
      return to_bytes(imread(file.string(), flags));
    } catch (const cv::Exception&) {
      return {};
    }
  });
  return bytes ? image_of(*bytes) : cv::Mat();
}

// Null if there is no such file. Throws for devices and named pipes, which may never end.
File open_image(const std::filesystem::path& file) {
  if (std::error_code unknown; std::filesystem::exists(file, unknown)) nef::require_readable_file(file.string());
  return {std::fopen(file.c_str(), "rb"), &std::fclose};
}

}  // namespace

cv::Mat read_pixels(const std::filesystem::path& file) {
  const File stream = open_image(file);
  if (!stream) return {};
  if (is_png(stream.get())) return read_png(stream.get(), false);
  return read_other(file, cv::IMREAD_UNCHANGED);
}

cv::Mat read_colors(const std::filesystem::path& file) {
  const File stream = open_image(file);
  if (!stream) return {};
  if (!is_png(stream.get())) return read_other(file, cv::IMREAD_COLOR);
  cv::Mat image = read_png(stream.get(), true);
  if (image.empty() || image.channels() == 3) return image;
  cv::cvtColor(image, image, image.channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
  return image;
}
}  // namespace nef::visual_hull
