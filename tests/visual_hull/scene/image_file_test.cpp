// SPDX-License-Identifier: Apache-2.0
//
// Image files against OpenCV's reader, bit by bit.
#include "apps/visual_hull/scene/image_file.h"

#include <png.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "nef/io/bounded_process.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull::testing {
namespace {

constexpr int kWidth = 37;
constexpr int kHeight = 23;

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

void check_against_opencv(const std::string& file) {
  INFO(file);
  const cv::Mat pixels = cv::imread(file, cv::IMREAD_UNCHANGED);
  REQUIRE_FALSE(pixels.empty());
  CHECK(same(read_pixels(file), pixels));
  CHECK(same(read_colors(file), cv::imread(file, cv::IMREAD_COLOR)));
}

cv::Mat noise(int type) {
  cv::Mat image(kHeight, kWidth, type);
  cv::RNG rng(7);
  rng.fill(image, cv::RNG::UNIFORM, 0, 65536);
  return image;
}

// Kinds of PNG that OpenCV does not write.
void write_png(const std::string& file, std::uint32_t format) {
  std::vector<std::uint8_t> pixels(std::size_t{4} * kWidth * kHeight);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * i % 13);
  std::vector<std::uint8_t> palette(std::size_t{4} * 256);
  for (std::size_t i = 0; i < palette.size(); ++i) palette[i] = static_cast<std::uint8_t>(i * 31);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = kWidth;
  image.height = kHeight;
  image.format = format;
  image.colormap_entries = 16;
  REQUIRE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, palette.data()) != 0);
}

// A white pixel with so many texts of 7 MB, each packed to a thousandth.
std::string png_with_texts(std::size_t count) {
  std::string bytes;
  const auto append = [](png_structp png, png_bytep data, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
  };
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, 1, 1, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::string key = "Comment";
  std::string long_text(7'000'000, 'a');
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_zTXt;
  text.key = key.data();
  text.text = long_text.data();
  text.text_length = long_text.size();
  png_set_text(png, info, &text, 1);
  png_write_info(png, info);
  const std::size_t begin = bytes.find("zTXt") - 4;  // the chunk's length comes first
  const std::string chunk = bytes.substr(begin);
  for (std::size_t i = 1; i < count; ++i) bytes += chunk;
  const png_byte white = 255;
  png_write_row(png, &white);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

TEST_CASE("Texts in a PNG are not unpacked") {
  const Scratch scratch;
  const auto file = scratch.write("texts.png", png_with_texts(200));
  const auto brightness = [&]() -> std::string {
    const cv::Mat image = read_pixels(file);
    return image.empty() ? "none" : std::to_string(image.at<std::uint8_t>(0, 0));
  };
  CHECK(nef::run_bounded({.bytes = std::size_t{256} << 20U, .seconds = 10}, brightness) == "255");
}

TEST_CASE("PNG of every kind is read as OpenCV does") {
  const Scratch scratch;
  const auto file = [&scratch](const std::string& name) { return (scratch.folder() / name).string(); };
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}) {
    const std::string name = file(std::to_string(type) + ".png");
    REQUIRE(cv::imwrite(name, noise(type)));
    check_against_opencv(name);
  }
  REQUIRE(cv::imwrite(file("bilevel.png"), noise(CV_8UC1) > 100, {cv::IMWRITE_PNG_BILEVEL, 1}));
  check_against_opencv(file("bilevel.png"));
  write_png(file("gray_alpha.png"), PNG_FORMAT_GA);
  check_against_opencv(file("gray_alpha.png"));
  write_png(file("palette.png"), PNG_FORMAT_RGB_COLORMAP);
  check_against_opencv(file("palette.png"));
  write_png(file("palette_alpha.png"), PNG_FORMAT_RGBA_COLORMAP);
  check_against_opencv(file("palette_alpha.png"));
}

TEST_CASE("Images that are no PNG are read by OpenCV, whatever their names say") {
  const Scratch scratch;
  for (const char* extension : {".jpg", ".pgm", ".bmp", ".tif"}) {
    const std::filesystem::path file = scratch.folder() / ("image" + std::string(extension));
    REQUIRE(cv::imwrite(file.string(), noise(CV_8UC1)));
    check_against_opencv(file.string());
    const std::filesystem::path renamed = scratch.folder() / "image.png";
    std::filesystem::rename(file, renamed);
    check_against_opencv(renamed.string());
  }
}

TEST_CASE("A file that is no image, or not all of one, has no pixels") {
  const Scratch scratch;
  CHECK(read_pixels(scratch.folder() / "missing.png").empty());
  CHECK(read_pixels(scratch.write("empty.png", "")).empty());
  CHECK(read_pixels(scratch.write("text.png", "this is no image")).empty());
  const std::string whole = (scratch.folder() / "whole.png").string();
  REQUIRE(cv::imwrite(whole, noise(CV_8UC3)));
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  for (const std::size_t length : {std::size_t{8}, std::size_t{20}, bytes.size() / 2}) {
    const auto file = scratch.write("cut.png", bytes.substr(0, length));
    CHECK(read_pixels(file).empty());
    CHECK(read_colors(file).empty());
  }
}

}  // namespace nef::visual_hull::testing
