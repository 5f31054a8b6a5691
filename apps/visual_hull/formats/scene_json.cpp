// SPDX-License-Identifier: Apache-2.0
//
// The document is parsed with exact numbers, then read key by key; each message names the file, the camera and the key.
// Unknown keys are collected for a note, except those that may mean a lens, which are refused.
#include "apps/visual_hull/formats/scene_json.h"

#include <set>

#include "apps/program/reports/exact_json.h"
#include "apps/visual_hull/formats/transforms.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

using nlohmann::json;

std::vector<Rational> numbers(const json& value, std::size_t count, const std::string& where) {
  std::vector<Rational> out = nef::rationals_of(value, where);
  if (out.size() != count) {
    throw nef::InputError(where + ": " + std::to_string(count) + " numbers are needed, not " +
                          std::to_string(out.size()));
  }
  for (const Rational& value : out) check_size(value, where);
  return out;
}

Matrix3 matrix3(const json& value, const std::string& where) {
  const std::vector<Rational> v = numbers(value, 9, where);
  Matrix3 m;
  for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = v[i];
  return m;
}

std::string text_of(const json& value, const std::string& where) {
  if (!value.is_string()) throw nef::InputError(where + ": text is needed, not " + nef::in_quotes(nef::spelled(value)));
  return value.get<std::string>();
}

// A threshold is a number or a word.
std::string threshold_text(const json& value, const std::string& where) {
  return value.is_string() ? value.get<std::string>() : nef::to_string(nef::rational_of(value, where));
}

std::vector<Ring> to_rings(const json& value, const std::string& where) {
  if (!value.is_array()) throw nef::InputError(where + ": a list of polygons [[u, v], ...] is needed");
  std::vector<Ring> rings;
  for (const json& polygon : value) {
    const std::string here = where + ", polygon " + std::to_string(rings.size() + 1);
    if (!polygon.is_array()) throw nef::InputError(here + ": a list of points [u, v] is needed");
    Ring ring;
    for (const json& point : polygon) {
      const std::vector<Rational> uv = numbers(point, 2, here + ", point " + std::to_string(ring.size() + 1));
      ring.emplace_back(uv[0], uv[1]);
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

Camera read_camera(const json& entry, const std::string& name, const std::string& where) {
  if (entry.contains("P")) {
    const std::vector<Rational> v = numbers(entry["P"], 12, where + ", P");
    Matrix34 m;
    for (std::size_t i = 0; i < 12; ++i) m[i / 4][i % 4] = v[i];
    return {name, m};
  }
  for (const char* key : {"K", "R", "t"}) {
    if (!entry.contains(key)) {
      throw nef::InputError(where + ": '" + key + "' is missing: a camera has P, or K, R and t");
    }
  }
  const std::vector<Rational> t = numbers(entry["t"], 3, where + ", t");
  return Camera::from_parts(name, matrix3(entry["K"], where + ", K"), matrix3(entry["R"], where + ", R"),
                            {t[0], t[1], t[2]});
}

Distortion read_distortion(const json& entry, const std::string& where) {
  Distortion distortion;
  if (!entry.contains("distortion")) return distortion;
  if (!entry.contains("K")) {
    throw nef::InputError(where + ": 'distortion' needs the intrinsics: give K, R and t instead of P");
  }
  distortion.intrinsics = matrix3(entry["K"], where + ", K");
  const std::vector<Rational> values = nef::rationals_of(entry["distortion"], where + ", distortion");
  const std::size_t n = values.size();
  if (n != 4 && n != 5 && n != 8 && n != 12 && n != 14) {
    throw nef::InputError(where + ", distortion: 4, 5, 8, 12 or 14 coefficients are needed, not " + std::to_string(n));
  }
  bool any = false;
  for (const Rational& value : values) {
    check_size(value, where + ", distortion");
    distortion.coefficients.push_back(nef::nearest_double(value));
    any = any || sgn(value) != 0;
  }
  if (!any) distortion.coefficients.clear();
  return distortion;
}

// Keys that mean nothing here. What may be meant for a lens is refused: without it the hull would be a little wrong.
void note_ignored(const json& entry, const std::set<std::string>& known, const std::string& where,
                  std::set<std::string>& ignored) {
  for (const auto& item : entry.items()) {
    const std::string& key = item.key();
    if (known.count(key) != 0) continue;
    if (key.rfind("dist", 0) == 0 || key == "D") {
      throw nef::InputError(where + ": " + nef::in_quotes(key) + " is not understood; lens distortion is 'distortion'");
    }
    ignored.insert(key);
  }
}

View read_view(const json& entry, std::size_t number, const std::filesystem::path& file,
               std::set<std::string>& ignored) {
  std::string where = file.string() + ", camera " + std::to_string(number);
  if (!entry.is_object()) throw nef::InputError(where + ": an object is needed");
  const std::filesystem::path folder = file.parent_path();
  View view;
  view.name = std::to_string(number);
  if (entry.contains("image")) view.name = text_of(entry["image"], where + ", image");
  if (entry.contains("name")) view.name = text_of(entry["name"], where + ", name");
  where += " (" + view.name + ")";
  if (entry.contains("polygons")) {
    view.polygons = to_rings(entry["polygons"], where + ", polygons");
  } else if (entry.contains("silhouette")) {
    view.polygons = read_polygons(folder / text_of(entry["silhouette"], where + ", silhouette"));
  } else if (entry.contains("image")) {
    view.image = text_of(entry["image"], where + ", image");
  }
  note_ignored(entry, {"image", "name", "polygons", "silhouette", "P", "K", "R", "t", "distortion"}, where, ignored);
  view.camera = read_camera(entry, view.name, where);
  view.distortion = read_distortion(entry, where);
  return view;
}

}  // namespace

std::vector<Ring> read_polygons(const std::filesystem::path& file) {
  const json document = nef::parse_exact_json(nef::read_file(file.string()), file.string());
  if (document.is_object()) {
    if (!document.contains("polygons")) throw nef::InputError(file.string() + ": 'polygons' is missing");
    return to_rings(document["polygons"], file.string());
  }
  return to_rings(document, file.string());
}

Scene read_json_scene(const std::string& text, const std::filesystem::path& file) {
  const json document = nef::parse_exact_json(text, file.string());
  if (document.is_object() && document.contains("frames") && !document.contains("cameras")) {
    return read_transforms(document, file);
  }
  if (!document.is_object() || !document.contains("cameras") || !document["cameras"].is_array()) {
    throw nef::InputError(file.string() + ": a scene needs a list 'cameras'");
  }
  Scene scene;
  scene.format = "a JSON scene";
  std::set<std::string> ignored;
  note_ignored(document, {"cameras", "box", "threshold", "channel", "invert", "pixel_origin", "camera_error_px"},
               file.string(), ignored);
  for (const json& entry : document["cameras"]) {
    scene.views.push_back(read_view(entry, scene.views.size() + 1, file, ignored));
  }
  scene.ignored.assign(ignored.begin(), ignored.end());
  if (scene.views.empty()) throw nef::InputError(file.string() + ": the list 'cameras' is empty");
  if (document.contains("pixel_origin")) {
    const std::string where = file.string() + ", pixel_origin";
    const std::string origin = text_of(document["pixel_origin"], where);
    if (origin != "center" && origin != "corner") throw nef::InputError(where + ": center or corner is needed");
    scene.origin = origin == "corner" ? PixelOrigin::kCorner : PixelOrigin::kCenter;
  }
  if (document.contains("box")) {
    const std::vector<Rational> v = numbers(document["box"], 6, file.string() + ", box");
    scene.box = WorldBox{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    check_box(*scene.box, file.string());
  }
  if (document.contains("threshold")) {
    scene.threshold = parse_threshold(threshold_text(document["threshold"], file.string() + ", threshold"));
  }
  if (document.contains("channel")) {
    if (!scene.threshold) scene.threshold.emplace();
    scene.threshold->channel = parse_channel(text_of(document["channel"], file.string() + ", channel"));
  }
  if (document.contains("invert")) {
    if (!document["invert"].is_boolean()) throw nef::InputError(file.string() + ", invert: true or false is needed");
    if (!scene.threshold) scene.threshold.emplace();
    scene.threshold->invert = document["invert"].get<bool>();
  }
  if (document.contains("camera_error_px")) {
    const std::string where = file.string() + ", camera_error_px";
    scene.camera_error = nef::nearest_double(nef::rational_of(document["camera_error_px"], where));
    if (!(*scene.camera_error > 0)) throw nef::InputError(where + ": a number of pixels above 0 is needed");
  }
  return scene;
}

}  // namespace nef::visual_hull
