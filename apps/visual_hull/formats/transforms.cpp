// SPDX-License-Identifier: Apache-2.0
//
// A value is looked up in the frame first and then in the document, whose values are those of all frames. Numbers are
// read exactly and rounded once to doubles, as lens models are made of doubles. Poses are turned from OpenGL's axes to
// those of this program (`from_opengl`).
#include "apps/visual_hull/formats/transforms.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/program/reports/exact_json.h"
#include "apps/visual_hull/scene/images.h"
#include "apps/visual_hull/scene/pose.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

using nlohmann::json;

// One frame, whose values stand in the frame or, for all frames, in the document.
class Frame {
 public:
  Frame(const json& document, const json& frame, std::string where)
      : document_(document), frame_(frame), where_(std::move(where)) {}

  [[nodiscard]] std::optional<double> number(const char* key) const {
    const json* value = find(key);
    if (value == nullptr || value->is_null()) return std::nullopt;
    const Rational number = nef::rational_of(*value, where_ + ", " + key);
    check_size(number, where_ + ", " + key);
    return nef::nearest_double(number);
  }

  [[nodiscard]] std::optional<std::string> text(const char* key) const {
    const json* value = find(key);
    if (value == nullptr || value->is_null()) return std::nullopt;
    if (!value->is_string()) {
      throw nef::InputError(
          fmt::format("{}, {}: text is needed, not {}", where_, key, nef::in_quotes(nef::spelled(*value))));
    }
    return value->get<std::string>();
  }

  [[nodiscard]] bool flag(const char* key) const {
    const json* value = find(key);
    return value != nullptr && value->is_boolean() && value->get<bool>();
  }

  [[nodiscard]] Eigen::Matrix4d transform() const {
    if (!frame_.contains("transform_matrix")) throw nef::InputError(where_ + ": 'transform_matrix' is missing");
    const std::vector<Rational> v = nef::rationals_of(frame_["transform_matrix"], where_ + ", transform_matrix");
    if (v.size() != 16 && v.size() != 12) {
      throw nef::InputError(
          fmt::format("{}, transform_matrix: 4x4 or 3x4 numbers are needed, not {}", where_, v.size()));
    }
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < v.size(); ++i) {
      check_size(v[i], where_ + ", transform_matrix");
      m(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = nef::nearest_double(v[i]);
    }
    return m;
  }

  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  [[nodiscard]] const json* find(const char* key) const {
    if (frame_.contains(key)) return &frame_[key];
    return document_.contains(key) ? &document_[key] : nullptr;
  }

  const json& document_;
  const json& frame_;
  std::string where_;
};

std::vector<double> distortion_of(const Frame& frame) {
  const std::string model = frame.text("camera_model").value_or("OPENCV");
  const bool fisheye = frame.flag("is_fisheye") || model.find("FISHEYE") != std::string::npos;
  if (fisheye || model == "EQUIRECTANGULAR" || model == "ORTHOPHOTO") {
    throw nef::InputError(frame.where() + ": the camera model " + (fisheye ? "fisheye" : model) +
                          " has no straight lines; undistort the images first");
  }
  if (frame.number("k4").value_or(0) != 0) {
    throw nef::InputError(frame.where() + ", k4: not a coefficient of OpenCV's model; undistort the images first");
  }
  std::vector<double> coefficients;
  for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) coefficients.push_back(frame.number(key).value_or(0));
  return coefficients;
}

double focal_length(const Frame& frame, double angle, double extent, const char* key) {
  if (!(angle > 0 && angle < M_PI)) {
    throw nef::InputError(
        fmt::format("{}, {}: an angle of view between 0 and pi is needed, not {}", frame.where(), key, angle));
  }
  return extent / 2 / std::tan(angle / 2);
}

Lens lens_of(const Frame& frame, const std::optional<ImageSize>& image_size) {
  Lens lens;
  const std::optional<double> w = frame.number("w");
  const std::optional<double> h = frame.number("h");
  if (w && h) {
    lens.size = ImageSize{static_cast<int>(*w), static_cast<int>(*h)};
  } else {
    lens.size = image_size;
  }
  const auto needs_size = [&] {
    if (!lens.size) {
      throw nef::InputError(frame.where() + ": the image is not there, so its size is not known: give 'w' and 'h'");
    }
    return *lens.size;
  };
  const std::optional<double> fx = frame.number("fl_x");
  const std::optional<double> fy = frame.number("fl_y");
  const std::optional<double> angle_x = frame.number("camera_angle_x");
  const std::optional<double> angle_y = frame.number("camera_angle_y");
  if (fx) {
    lens.fx = *fx;
  } else if (angle_x) {
    lens.fx = focal_length(frame, *angle_x, needs_size().width, "camera_angle_x");
  } else {
    throw nef::InputError(frame.where() + ": the focal length is missing: fl_x or camera_angle_x");
  }
  if (fy) {
    lens.fy = *fy;
  } else if (!fx && angle_y) {
    lens.fy = focal_length(frame, *angle_y, needs_size().height, "camera_angle_y");
  } else {
    lens.fy = lens.fx;
  }
  const std::optional<double> cx = frame.number("cx");
  const std::optional<double> cy = frame.number("cy");
  lens.cx = cx ? *cx : needs_size().width / 2.0;
  lens.cy = cy ? *cy : needs_size().height / 2.0;
  lens.distortion = distortion_of(frame);
  return lens;
}

}  // namespace

Scene read_transforms(const json& document, const std::filesystem::path& file) {
  if (!document.is_object() || !document.contains("frames") || !document["frames"].is_array()) {
    throw nef::InputError(file.string() + ": a list 'frames' is needed");
  }
  Scene scene;
  scene.format = "NeRF transforms (camera to world, OpenGL axes)";
  scene.origin = PixelOrigin::kCorner;
  const std::filesystem::path folder = file.parent_path();
  std::optional<ImageSize> image_size;
  for (const json& entry : document["frames"]) {
    const std::size_t number = scene.views.size() + 1;
    if (!entry.is_object())
      throw nef::InputError(fmt::format("{}, frame {}: an object is needed", file.string(), number));
    Frame frame(document, entry, fmt::format("{}, frame {}", file.string(), number));
    const std::string image = frame.text("file_path").value_or("");
    const std::string mask = frame.text("mask_path").value_or("");
    const std::string name = image.empty() ? std::to_string(number) : std::filesystem::path(image).filename().string();
    const bool sized = frame.number("w") && frame.number("h");
    if (!sized && !image_size) image_size = size_of_image(folder, mask.empty() ? image : mask);
    View view = make_view(name, lens_of(frame, image_size), from_opengl(frame.transform()));
    view.image = mask.empty() ? image : mask;
    scene.views.push_back(std::move(view));
  }
  if (scene.views.empty()) throw nef::InputError(file.string() + ": the list 'frames' is empty");
  return scene;
}

}  // namespace nef::visual_hull
