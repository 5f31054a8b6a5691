// SPDX-License-Identifier: Apache-2.0
//
// Text and binary models are read into the same lists of lenses and images, and these become views. Binary counts are
// compared with the bytes that are left before anything is allocated. Camera models without a known lens are listed
// with their number of parameters, so that the binary file can be read past them for a clear message.
#include "apps/visual_hull/formats/colmap.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "apps/visual_hull/scene/natural_order.h"
#include "apps/visual_hull/scene/pose.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/io/binary_cursor.h"

namespace nef::visual_hull {
namespace fs = std::filesystem;

namespace {

// In the order of COLMAP's numbers. Of those without a lens we know the number of parameters only.
struct Model {
  const char* name;
  std::size_t parameters;
  bool understood;
};
constexpr std::array<Model, 11> kModels{{{"SIMPLE_PINHOLE", 3, true},
                                         {"PINHOLE", 4, true},
                                         {"SIMPLE_RADIAL", 4, true},
                                         {"RADIAL", 5, true},
                                         {"OPENCV", 8, true},
                                         {"OPENCV_FISHEYE", 8, false},
                                         {"FULL_OPENCV", 12, true},
                                         {"FOV", 5, false},
                                         {"SIMPLE_RADIAL_FISHEYE", 4, false},
                                         {"RADIAL_FISHEYE", 5, false},
                                         {"THIN_PRISM_FISHEYE", 12, false}}};

struct Image {
  std::string name;
  std::uint32_t camera = 0;
  Pose pose;
};

struct Colmap {
  std::map<std::uint32_t, Lens> lenses;
  std::vector<Image> images;
};

Lens lens_of(const Model& model, const std::vector<double>& p, ImageSize size, const std::string& where) {
  if (!model.understood) {
    throw nef::InputError(where + ": the camera model " + model.name +
                          " is not understood; undistort the images with `colmap image_undistorter`");
  }
  // The models with "SIMPLE" in their name, and RADIAL, have one focal length.
  const std::string name = model.name;
  const bool one_focal = name.find("SIMPLE") != std::string::npos || name == "RADIAL";
  std::size_t i = 0;
  Lens lens;
  lens.size = size;
  lens.fx = p[i++];
  lens.fy = one_focal ? lens.fx : p[i++];
  lens.cx = p[i++];
  lens.cy = p[i++];
  lens.distortion.assign(p.begin() + static_cast<std::ptrdiff_t>(i), p.end());
  // Radial coefficients alone: the tangential ones are zero.
  if (lens.distortion.size() == 1) lens.distortion = {p[i], 0, 0, 0};
  if (lens.distortion.size() == 2) lens.distortion = {p[i], p[i + 1], 0, 0};
  return lens;
}

Pose pose_of(const std::array<double, 7>& v, const std::string& where) {
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!(q.norm() > 0)) throw nef::InputError(where + ": the quaternion is zero");
  return {q.normalized().toRotationMatrix(), Eigen::Vector3d(v[4], v[5], v[6])};
}

// A line of text with its number for messages.
class Words {
 public:
  Words(const std::string& line, std::string where, Quote quote)
      : stream_(line), where_(std::move(where)), quote_(quote) {}

  std::string next(const char* what) {
    std::string word;
    if (!(stream_ >> word)) throw nef::InputError(fmt::format("{}: the {} is missing", where_, what));
    return word;
  }
  double number(const char* what) { return nef::nearest_double(scene_number(next(what), where_, what, quote_)); }
  std::uint32_t whole(const char* what) {
    const double value = number(what);
    if (!(value >= 0 && value <= 4e9 && value == std::floor(value))) {
      throw nef::InputError(fmt::format("{}: the {} is a whole number, not {}", where_, what, value));
    }
    return static_cast<std::uint32_t>(value);
  }
  /// The rest of the line without spaces around it.
  std::string rest() {
    std::string text;
    std::getline(stream_ >> std::ws, text);
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
    return text;
  }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  std::istringstream stream_;
  std::string where_;
  Quote quote_;
};

// Nothing is told of a file that has not shown what it should hold: it may be anything.
Quote quote_after(bool recognized) { return recognized ? Quote::kWord : Quote::kNever; }

bool is_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string::npos && line[first] == '#';
}

bool is_blank(const std::string& line) { return line.find_first_not_of(" \t\r") == std::string::npos; }

void read_cameras_text(const fs::path& file, Colmap& model) {
  std::istringstream stream(nef::read_file(file.string()));
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (is_comment(line) || is_blank(line)) continue;
    Words words(line, fmt::format("{}, line {}", file.string(), number), quote_after(!model.lenses.empty()));
    const std::uint32_t id = words.whole("number of the camera");
    const std::string name = words.next("camera model");
    const auto known = std::find_if(kModels.begin(), kModels.end(), [&](const Model& m) { return name == m.name; });
    if (known == kModels.end())
      throw nef::InputError(words.where() + ": there is no camera model " + nef::in_quotes(name));
    const auto width = static_cast<int>(words.whole("width"));
    const auto height = static_cast<int>(words.whole("height"));
    std::vector<double> parameters;
    for (std::size_t i = 0; i < known->parameters; ++i) parameters.push_back(words.number("parameters of the camera"));
    model.lenses[id] = lens_of(*known, parameters, {width, height}, words.where());
  }
}

void read_images_text(const fs::path& file, Colmap& model) {
  std::istringstream stream(nef::read_file(file.string()));
  std::string line;
  bool points = false;  // every second line lists the points seen in the image of the first; it may be empty
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (points) {
      points = false;
      continue;
    }
    if (is_comment(line) || is_blank(line)) continue;
    Words words(line, fmt::format("{}, line {}", file.string(), number), quote_after(!model.images.empty()));
    words.whole("number of the image");
    std::array<double, 7> motion{};
    for (double& value : motion) value = words.number("quaternion and translation");
    Image image;
    image.camera = words.whole("number of the camera");
    image.name = words.rest();
    image.pose = pose_of(motion, words.where());
    model.images.push_back(std::move(image));
    points = true;
  }
}

// More items than bytes are a wrong count, not an order to fetch memory.
std::uint64_t take_count(nef::BinaryCursor& cursor, const char* what) {
  const auto count = cursor.take<std::uint64_t>(what);
  if (count > cursor.left()) cursor.fail(nef::FileProblem::kWrongCount, fmt::format("{} items cannot follow", count));
  return count;
}

void read_cameras_binary(const fs::path& file, Colmap& model) {
  const std::string path = file.string();
  const std::string bytes = nef::read_file(path);
  nef::BinaryCursor cursor(bytes, path, 0, std::endian::little);
  const std::uint64_t count = take_count(cursor, "number of cameras");
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = cursor.take<std::uint32_t>("camera");
    const auto kind = cursor.take<std::int32_t>("camera");
    if (kind < 0 || static_cast<std::size_t>(kind) >= kModels.size()) {
      cursor.fail(nef::FileProblem::kUnsupported, fmt::format("there is no camera model {}", kind));
    }
    const Model& known = kModels[static_cast<std::size_t>(kind)];
    const auto width = static_cast<int>(cursor.take<std::uint64_t>("camera"));
    const auto height = static_cast<int>(cursor.take<std::uint64_t>("camera"));
    std::vector<double> parameters(known.parameters);
    for (double& value : parameters) value = cursor.take<double>("camera");
    model.lenses[id] = lens_of(known, parameters, {width, height}, fmt::format("{}, camera {}", path, id));
  }
}

void read_images_binary(const fs::path& file, Colmap& model) {
  const std::string path = file.string();
  const std::string bytes = nef::read_file(path);
  nef::BinaryCursor cursor(bytes, path, 0, std::endian::little);
  const std::uint64_t count = take_count(cursor, "number of images");
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = cursor.take<std::uint32_t>("image");
    std::array<double, 7> motion{};
    for (double& value : motion) value = cursor.take<double>("image");
    Image image;
    image.camera = cursor.take<std::uint32_t>("image");
    for (char c = cursor.take<char>("image"); c != '\0'; c = cursor.take<char>("name of an image")) image.name += c;
    image.pose = pose_of(motion, fmt::format("{}, image {}", path, id));
    const std::uint64_t points = take_count(cursor, "number of points");
    for (std::uint64_t k = 0; k < points; ++k) cursor.take<std::array<char, 24>>("points of an image");
    model.images.push_back(std::move(image));
  }
}

bool holds(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  return fs::is_regular_file(folder / ("cameras" + extension), error) &&
         fs::is_regular_file(folder / ("images" + extension), error);
}

}  // namespace

std::optional<fs::path> colmap_model(const fs::path& folder) {
  for (const char* sub : {"", "sparse/0", "sparse", "0"}) {
    const fs::path place = *sub == '\0' ? folder : folder / sub;
    if (holds(place, ".txt") || holds(place, ".bin")) return place;
  }
  return std::nullopt;
}

Scene read_colmap(const fs::path& model_folder) {
  Colmap model;
  const bool text = holds(model_folder, ".txt");
  if (text) {
    read_cameras_text(model_folder / "cameras.txt", model);
    read_images_text(model_folder / "images.txt", model);
  } else {
    read_cameras_binary(model_folder / "cameras.bin", model);
    read_images_binary(model_folder / "images.bin", model);
  }
  if (model.images.empty()) throw nef::InputError(model_folder.string() + ": the COLMAP model has no images");
  std::sort(model.images.begin(), model.images.end(),
            [](const Image& a, const Image& b) { return naturally_before(a.name, b.name); });
  Scene scene;
  scene.format = fmt::format("COLMAP model, {} (world to camera, y down)", text ? "text" : "binary");
  scene.origin = PixelOrigin::kCorner;
  for (const Image& image : model.images) {
    const auto lens = model.lenses.find(image.camera);
    if (lens == model.lenses.end()) {
      throw nef::InputError(fmt::format("{}: image {} names camera {}, which is not there", model_folder.string(),
                                        image.name, image.camera));
    }
    View view = make_view(image.name, lens->second, image.pose);
    view.image = image.name;
    scene.views.push_back(std::move(view));
  }
  fs::path above = fs::absolute(model_folder).lexically_normal();
  for (int levels = 0; levels < 2; ++levels) {
    above = above.parent_path();
    scene.image_folders.push_back(above);
  }
  return scene;
}

}  // namespace nef::visual_hull
