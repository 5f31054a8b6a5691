// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/write_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

// A double has at most 1074 digits behind the point, and 309 before it.
std::string exact_decimal(double value) {
  std::vector<char> text(1500);
  std::snprintf(text.data(), text.size(), "%.1074f", value);
  std::string digits = text.data();
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::string number(const Rational& value) {
  const double nearest = nef::nearest_double(value);
  return nef::exact_rational(nearest) == value ? exact_decimal(nearest) : "\"" + nef::to_string(value) + "\"";
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

template <typename Row>
std::string list(const Row& row) {
  std::vector<std::string> items;
  for (const Rational& value : row) items.push_back(number(value));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

template <typename Matrix>
std::string matrix(const Matrix& m) {
  return fmt::format("[{},\n           {},\n           {}]", list(m[0]), list(m[1]), list(m[2]));
}

std::string polygons(const std::vector<Ring>& rings) {
  std::vector<std::string> texts;
  for (const Ring& ring : rings) {
    std::vector<std::string> points;
    for (const Point2& p : ring) points.push_back(list(std::vector<Rational>{p.x(), p.y()}));
    texts.push_back(fmt::format("[{}]", fmt::join(points, ", ")));
  }
  return fmt::format("[{}]", fmt::join(texts, ",\n                  "));
}

std::string view_json(const View& view) {
  std::vector<std::string> keys{"\"name\": " + quoted(view.name)};
  if (view.polygons) keys.push_back("\"polygons\": " + polygons(*view.polygons));
  if (!view.polygons && !view.image.empty()) keys.push_back("\"image\": " + quoted(view.image.generic_string()));
  keys.push_back("\"P\": " + matrix(view.camera.matrix()));
  if (!view.distortion.coefficients.empty()) {
    std::vector<Rational> coefficients;
    for (const double c : view.distortion.coefficients) coefficients.push_back(nef::exact_rational(c));
    keys.push_back("\"K\": " + matrix(view.distortion.intrinsics));
    keys.push_back("\"distortion\": " + list(coefficients));
  }
  return fmt::format("    {{{}}}", fmt::join(keys, ",\n     "));
}

}  // namespace

std::string write_scene_json(const Scene& scene) {
  std::vector<std::string> views;
  for (const View& view : scene.views) views.push_back(view_json(view));
  std::string text = fmt::format("{{\n  \"cameras\": [\n{}\n  ]", fmt::join(views, ",\n"));
  if (scene.origin == PixelOrigin::kCorner) text += ",\n  \"pixel_origin\": \"corner\"";
  // Ten digits: an estimate.
  if (scene.camera_error) text += fmt::format(",\n  \"camera_error_px\": {:.10f}", *scene.camera_error);
  if (scene.box) {
    std::vector<Rational> corners(scene.box->low.begin(), scene.box->low.end());
    corners.insert(corners.end(), scene.box->high.begin(), scene.box->high.end());
    text += ",\n  \"box\": " + list(corners);
  }
  if (scene.threshold) {
    const ThresholdOptions& threshold = *scene.threshold;
    if (threshold.kind == ThresholdOptions::Kind::kOtsu) text += ",\n  \"threshold\": \"otsu\"";
    if (threshold.kind == ThresholdOptions::Kind::kValue) {
      text += ",\n  \"threshold\": " + exact_decimal(threshold.value);
    }
    if (threshold.channel != ThresholdOptions::Channel::kGray) {
      text += ",\n  \"channel\": " + quoted(channel_names()[static_cast<std::size_t>(threshold.channel)]);
    }
    if (threshold.invert) text += ",\n  \"invert\": true";
  }
  return text + "\n}\n";
}

void write_scene_file(const std::filesystem::path& file, Scene scene) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(file).parent_path();
  for (View& view : scene.views) {
    if (!view.image.empty()) view.image = fs::absolute(view.image).lexically_proximate(folder);
  }
  nef::write_file(file.string(), write_scene_json(scene));
}

}  // namespace nef::visual_hull
