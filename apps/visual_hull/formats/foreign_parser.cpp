// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/foreign_parser.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "nef/base/error.h"
#include "nef/io/bounded_process.h"

namespace nef::visual_hull {
namespace {

using nlohmann::json;

// Text of a file may be no UTF-8; as MessagePack, JSON values hold any bytes.
json to_json(const View& view) {
  json matrix = json::array();
  for (const auto& row : view.camera.matrix()) {
    for (const Rational& x : row) matrix.push_back(nef::to_string(x));
  }
  json intrinsics = json::array();
  for (const Rational3& row : view.distortion.intrinsics) {
    for (const Rational& x : row) intrinsics.push_back(nef::to_string(x));
  }
  json entry{{"name", view.name},
             {"image", view.image.string()},
             {"camera", view.camera.name()},
             {"matrix", std::move(matrix)},
             {"coefficients", view.distortion.coefficients},
             {"intrinsics", std::move(intrinsics)}};
  if (view.size) entry["size"] = {view.size->width, view.size->height};
  return entry;
}

Rational rational_of(const json& value) { return nef::parse_rational(value.get_ref<const std::string&>()); }

View view_of(const json& entry) {
  View view;
  view.name = entry["name"];
  view.image = entry["image"].get<std::string>();
  Matrix34 matrix;
  for (std::size_t i = 0; i < 12; ++i) matrix[i / 4][i % 4] = rational_of(entry["matrix"][i]);
  view.camera = Camera(entry["camera"], matrix);
  view.distortion.coefficients = entry["coefficients"].get<std::vector<double>>();
  for (std::size_t i = 0; i < 9; ++i) view.distortion.intrinsics[i / 3][i % 3] = rational_of(entry["intrinsics"][i]);
  if (entry.contains("size")) view.size = ImageSize{entry["size"][0], entry["size"][1]};
  return view;
}

std::string to_bytes(const Scene& scene) {
  json views = json::array();
  for (const View& view : scene.views) views.push_back(to_json(view));
  const json whole{{"format", scene.format},
                   {"corner", scene.origin == PixelOrigin::kCorner},
                   {"ignored", scene.ignored},
                   {"views", std::move(views)}};
  std::string bytes;
  json::to_msgpack(whole, bytes);
  return bytes;
}

Scene scene_of(const std::string& bytes) {
  const json whole = json::from_msgpack(bytes);
  Scene scene;
  scene.format = whole["format"];
  scene.origin = whole["corner"].get<bool>() ? PixelOrigin::kCorner : PixelOrigin::kCenter;
  scene.ignored = whole["ignored"].get<std::vector<std::string>>();
  for (const json& entry : whole["views"]) scene.views.push_back(view_of(entry));
  return scene;
}

}  // namespace

Scene read_with_limits(const std::filesystem::path& file, const std::string& parser, std::size_t bytes,
                       const std::function<Scene()>& read) {
  const nef::ParserLimits limits = nef::parser_limits(bytes);
  const std::optional<std::string> scene = nef::run_bounded(limits, [&] { return to_bytes(read()); });
  if (scene) return scene_of(*scene);
  throw nef::InputError(
      fmt::format("{}: {} could not read the file within {}: it is damaged or nested too "
                  "deeply; write its matrices to a text file, a name and twelve numbers per line",
                  file.string(), parser, nef::limits_text(limits)));
}

}  // namespace nef::visual_hull
