// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene.h"

#include <algorithm>
#include <map>

#include "apps/visual_hull/scene_blocks.h"
#include "apps/visual_hull/scene_json.h"
#include "apps/visual_hull/scene_text.h"
#include "apps/visual_hull/vsh.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/program/numbers.h"

namespace visual_hull {
namespace fs = std::filesystem;

namespace {

const std::vector<std::string>& image_extensions() {
  static const std::vector<std::string> extensions{".png",  ".pgm", ".pbm",  ".bmp", ".tif",
                                                   ".tiff", ".jpg", ".jpeg", ".ppm", ".webp"};
  return extensions;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

ThresholdOptions parse_threshold(const std::string& text) {
  ThresholdOptions options;
  if (text == "otsu") {
    options.kind = ThresholdOptions::Kind::kOtsu;
    return options;
  }
  options.kind = ThresholdOptions::Kind::kValue;
  try {
    options.value = nef::nearest_double(nef::parse_rational(text));
  } catch (const nef::InputError&) {
    throw nef::InputError("threshold '" + text + "' is neither a number nor otsu");
  }
  return options;
}

ThresholdOptions::Channel parse_channel(const std::string& text) {
  using Channel = ThresholdOptions::Channel;
  static const std::map<std::string, Channel> names{{"gray", Channel::kGray},
                                                    {"red", Channel::kRed},
                                                    {"green", Channel::kGreen},
                                                    {"blue", Channel::kBlue},
                                                    {"alpha", Channel::kAlpha}};
  const auto found = names.find(text);
  if (found == names.end()) throw nef::InputError("channel '" + text + "' is not gray, red, green, blue or alpha");
  return found->second;
}

void check_box(const WorldBox& box, const std::string& where) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.low[i] >= box.high[i]) {
      throw nef::InputError(where + ": the box is empty or flat along " + std::string(1, "xyz"[i]) + " (" +
                            nef::to_string(box.low[i]) + " to " + nef::to_string(box.high[i]) + ")");
    }
  }
}

WorldBox parse_box(const std::string& text) {
  const std::vector<Rational> numbers = nef::parse_numbers(text, "--box");
  if (numbers.size() != 6) {
    throw nef::InputError("--box: six numbers x0,y0,z0,x1,y1,z1 are needed, not " + std::to_string(numbers.size()));
  }
  WorldBox box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  check_box(box, "--box");
  return box;
}

fs::path find_image(const fs::path& folder, const std::string& name) {
  const fs::path given(name);
  const auto exists = [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  };
  for (const char* sub : {"", "masks", "silhouettes", "images"}) {
    fs::path base = folder / sub / given;
    if (exists(base)) return base;
    for (const std::string& extension : image_extensions()) {
      if (exists(base.string() + extension)) return base.string() + extension;
    }
    // The mask of photo.jpg may be photo.png.
    const auto& known = image_extensions();
    if (std::find(known.begin(), known.end(), lower(base.extension().string())) == known.end()) continue;
    for (const std::string& extension : known) {
      fs::path other = fs::path(base).replace_extension(extension);
      if (exists(other)) return other;
    }
  }
  throw nef::InputError("view " + name + ": there is no image " + (folder / given).string() +
                        ", with or without a usual extension, nor one in masks/, silhouettes/ or images/ there");
}

std::vector<fs::path> list_images(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw nef::InputError(folder.string() + " is not a directory of images");
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string extension = lower(entry.path().extension().string());
    const auto& known = image_extensions();
    if (entry.is_regular_file() && std::find(known.begin(), known.end(), extension) != known.end()) {
      images.push_back(entry.path());
    }
  }
  std::sort(images.begin(), images.end());
  return images;
}

fs::path scene_folder(const fs::path& scene) {
  std::error_code error;
  return fs::is_directory(scene, error) ? scene : scene.parent_path();
}

Scene read_scene(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) return read_camera_folder(file);
  const std::string text = nef::read_file(file.string());
  if (text[text.find_first_not_of(" \t\r\n")] == '{') return read_json_scene(text, file);
  if (lower(file.extension().string()) == ".vsh") return read_vsh(text, file);
  if (has_parameter_blocks(text)) return read_parameter_blocks(text, file);
  return read_text_scene(text, file);
}

}  // namespace visual_hull
