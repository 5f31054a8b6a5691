// SPDX-License-Identifier: Apache-2.0
//
// Image files against OpenCV's reader, bit by bit.
#include "apps/visual_hull/scene/image_file.h"

#include <png.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "tests/visual_hull/scratch.h"

namespace visual_hull::testing {
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

}  // namespace

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

}  // namespace visual_hull::testing
