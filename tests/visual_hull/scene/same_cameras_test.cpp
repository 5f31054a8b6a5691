// SPDX-License-Identifier: Apache-2.0
//
// The same seven cameras and masks in every format that scenes come in: one hull. What the cameras see is derived here
// from where they stand and look, not from anything the readers do.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "apps/visual_hull/formats/turntable.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scene/mat_file.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using nef::cross;
using nef::dot;
using nef::Double3;
using testing::Scratch;

Double3 unit(const Double3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

constexpr int kViews = 7;
constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr double kFocalLength = 50;
constexpr double kCentreX = 30;  // whole coordinates are centres of pixels
constexpr double kCentreY = 25;
constexpr double kRadius = 30;
constexpr double kStand = 20;

/// A camera by where it stands and its axes.
struct Stand {
  Double3 centre, right, down, ahead;

  [[nodiscard]] std::array<double, 2> see(const Double3& point) const {
    const Double3 d{point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]};
    return {kFocalLength * dot(d, right) / dot(d, ahead) + kCentreX,
            kFocalLength * dot(d, down) / dot(d, ahead) + kCentreY};
  }
  [[nodiscard]] Double3 translation() const { return {-dot(right, centre), -dot(down, centre), -dot(ahead, centre)}; }
};

// Upright cameras about the z axis that look at the origin, each a seventh further clockwise.
Stand stand(int i) {
  const double angle = -2 * M_PI * i / kViews;
  Stand s;
  s.centre = {kRadius * std::cos(angle), kRadius * std::sin(angle), kStand};
  s.ahead = unit({-s.centre[0], -s.centre[1], -s.centre[2]});
  s.right = unit(cross(s.ahead, {0, 0, 1}));
  s.down = cross(s.ahead, s.right);
  return s;
}

// A solid without any symmetry: three boxes.
bool in_solid(const Double3& p) {
  const auto in = [&](const Double3& low, const Double3& high) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (p[k] < low[k] || p[k] > high[k]) return false;
    }
    return true;
  };
  return in({-6, -3, -2}, {5, 3, 1}) || in({2, -3, 1}, {5, -1, 6}) || in({-6, 1, 1}, {-4, 7, 2});
}

// Pixels that a fine grid of points of the solid falls into.
cv::Mat mask_of(const Stand& s) {
  cv::Mat mask(kHeight, kWidth, CV_8U, cv::Scalar(0));
  constexpr double kStep = 0.2;
  for (double x = -8; x < 8; x += kStep) {
    for (double y = -8; y < 8; y += kStep) {
      for (double z = -8; z < 8; z += kStep) {
        if (!in_solid({x, y, z})) continue;
        const auto [u, v] = s.see({x, y, z});
        mask.at<std::uint8_t>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u))) = 255;
      }
    }
  }
  return mask;
}

std::string text_of(const std::vector<double>& numbers, const char* between = " ") {
  std::string text;
  for (const double x : numbers) {
    std::array<char, 40> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.17g", x);
    text += (text.empty() ? "" : between) + std::string(buffer.data());
  }
  return text;
}

// K [R | t], row by row; pixels begin half a pixel earlier where whole coordinates are corners.
std::vector<double> matrix_of(const Stand& s) {
  const Double3 t = s.translation();
  std::vector<double> p;
  for (std::size_t k = 0; k < 3; ++k) p.push_back(kFocalLength * s.right[k] + kCentreX * s.ahead[k]);
  p.push_back(kFocalLength * t[0] + kCentreX * t[2]);
  for (std::size_t k = 0; k < 3; ++k) p.push_back(kFocalLength * s.down[k] + kCentreY * s.ahead[k]);
  p.push_back(kFocalLength * t[1] + kCentreY * t[2]);
  p.insert(p.end(), s.ahead.begin(), s.ahead.end());
  p.push_back(t[2]);
  return p;
}

std::vector<double> rotation_of(const Stand& s) {
  std::vector<double> r(s.right.begin(), s.right.end());
  r.insert(r.end(), s.down.begin(), s.down.end());
  r.insert(r.end(), s.ahead.begin(), s.ahead.end());
  return r;
}

// (w, x, y, z) by the largest component [Shepperd 1978].
std::array<double, 4> quaternion_of(const Stand& s) {
  const std::vector<double> r = rotation_of(s);
  const std::array<double, 4> t{r[0] + r[4] + r[8], r[0] - r[4] - r[8], r[4] - r[0] - r[8], r[8] - r[0] - r[4]};
  const std::size_t k = static_cast<std::size_t>(std::max_element(t.begin(), t.end()) - t.begin());
  const double h = std::sqrt(1 + t[k]) / 2;
  const double yz = r[7] - r[5], zx = r[2] - r[6], xy = r[3] - r[1];
  const double sxy = r[1] + r[3], szx = r[2] + r[6], syz = r[5] + r[7];
  const double d = 4 * h;
  if (k == 0) return {h, yz / d, zx / d, xy / d};
  if (k == 1) return {yz / d, h, sxy / d, szx / d};
  if (k == 2) return {zx / d, sxy / d, h, syz / d};
  return {xy / d, szx / d, syz / d, h};
}

// Axis times angle, from the quaternion.
std::vector<double> rotation_vector(const Stand& s) {
  const auto q = quaternion_of(s);
  const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double factor = 2 * std::atan2(sine, q[0]) / sine;
  return {q[1] * factor, q[2] * factor, q[3] * factor};
}

std::string name_of(int i) { return "mask_" + std::to_string(i) + ".png"; }

/// A folder with the masks, and scenes beside them.
class Formats {
 public:
  Formats() {
    for (int i = 0; i < kViews; ++i) {
      stands.push_back(stand(i));
      masks.push_back(mask_of(stands.back()));
      for (const char* folder : {"", "colmap/masks", "binary/masks", "pmvs/silhouettes"}) {
        std::filesystem::create_directories(scratch.folder() / folder);
        cv::imwrite((scratch.folder() / folder / name_of(i)).string(), masks.back());
      }
    }
  }

  std::vector<std::pair<std::string, Scene>> scenes() const {
    std::vector<std::pair<std::string, Scene>> result;
    const auto add = [&](const std::string& what, const std::filesystem::path& file) {
      result.emplace_back(what, read_scene(file));
      result.back().second.image_folders.insert(result.back().second.image_folders.begin(), scratch.folder());
    };
    add("JSON, P", json(true));
    add("JSON, K R t", json(false));
    add("transforms.json", transforms());
    add("COLMAP, text", colmap_text());
    add("COLMAP, binary", colmap_binary());
    add("OpenCV, R t", opencv(false));
    add("OpenCV, rvec tvec", opencv(true));
    add("MATLAB", matlab());
    add("PMVS", pmvs());
    add("matrices", matrices());
    add("Middlebury", middlebury());
    add("blocks", blocks());
    result.emplace_back("turntable", make_turntable({kViews, {kFocalLength, kCentreX, kCentreY}, kRadius, kStand}));
    return result;
  }

  Scratch scratch;
  std::vector<Stand> stands;
  std::vector<cv::Mat> masks;

 private:
  std::filesystem::path json(bool whole) const {
    std::string text;
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      const Double3 t = s.translation();
      text += std::string(i == 0 ? "" : ",\n") + R"({"image": ")" + name_of(i) + "\", ";
      if (whole) {
        text += "\"P\": [" + text_of(matrix_of(s), ", ") + "]}";
      } else {
        text += "\"K\": [" + text_of({kFocalLength, 0, kCentreX, 0, kFocalLength, kCentreY, 0, 0, 1}, ", ") +
                "], \"R\": [" + text_of(rotation_of(s), ", ") + "], \"t\": [" + text_of({t[0], t[1], t[2]}, ", ") +
                "]}";
      }
    }
    return scratch.write(whole ? "p.json" : "krt.json", "{\"cameras\": [" + text + "]}");
  }

  // Camera to world: columns are x right, y up, z back, and the centre.
  std::filesystem::path transforms() const {
    std::string text;
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      std::vector<double> m;
      for (std::size_t k = 0; k < 3; ++k) m.insert(m.end(), {s.right[k], -s.down[k], -s.ahead[k], s.centre[k]});
      text += std::string(i == 0 ? "" : ",\n") + R"({"file_path": ")" + name_of(i) + R"(", "transform_matrix": [)" +
              text_of(m, ", ") + ", 0, 0, 0, 1]}";
    }
    return scratch.write("transforms.json", "{" + ("\"fl_x\": " + text_of({kFocalLength})) +
                                                ", \"w\": 64, \"h\": 48, " + "\"cx\": " + text_of({kCentreX + 0.5}) +
                                                ", \"cy\": " + text_of({kCentreY + 0.5}) + ", \"frames\": [" + text +
                                                "]}");
  }

  std::filesystem::path colmap_text() const {
    std::string images;
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      const auto q = quaternion_of(s);
      const Double3 t = s.translation();
      images += std::to_string(i + 1) + " " + text_of({q[0], q[1], q[2], q[3], t[0], t[1], t[2]}) + " 1 " + name_of(i) +
                "\n\n";
    }
    std::filesystem::create_directories(scratch.folder() / "colmap/sparse/0");
    scratch.write("colmap/sparse/0/cameras.txt",
                  "1 SIMPLE_PINHOLE 64 48 " + text_of({kFocalLength, kCentreX + 0.5, kCentreY + 0.5}) + "\n");
    scratch.write("colmap/sparse/0/images.txt", images);
    return scratch.folder() / "colmap";
  }

  std::filesystem::path colmap_binary() const {
    using testing::put;
    std::string cameras;
    put<std::uint64_t>(cameras, 1);
    put<std::uint32_t>(cameras, 5);
    put<std::int32_t>(cameras, 1);
    put<std::uint64_t>(cameras, kWidth);
    put<std::uint64_t>(cameras, kHeight);
    for (const double x : {kFocalLength, kFocalLength, kCentreX + 0.5, kCentreY + 0.5}) put<double>(cameras, x);
    std::string images;
    put<std::uint64_t>(images, kViews);
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      put<std::uint32_t>(images, static_cast<std::uint32_t>(i));
      for (const double x : quaternion_of(s)) put<double>(images, x);
      for (const double x : s.translation()) put<double>(images, x);
      put<std::uint32_t>(images, 5);
      images += name_of(i) + std::string(1, '\0');
      put<std::uint64_t>(images, 0);
    }
    std::filesystem::create_directories(scratch.folder() / "binary/sparse/0");
    scratch.write("binary/sparse/0/cameras.bin", cameras);
    scratch.write("binary/sparse/0/images.bin", images);
    return scratch.folder() / "binary";
  }

  std::filesystem::path opencv(bool vectors) const {
    std::string text = "%YAML:1.0\n---\n";
    const auto matrix = [&](const std::string& name, int rows, int columns, const std::vector<double>& numbers) {
      text += name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) + "\n   cols: " + std::to_string(columns) +
              "\n   dt: d\n   data: [ " + text_of(numbers, ", ") + " ]\n";
    };
    matrix("K", 3, 3, {kFocalLength, 0, kCentreX, 0, kFocalLength, kCentreY, 0, 0, 1});
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      const Double3 t = s.translation();
      const std::string number = std::to_string(i);
      if (vectors) {
        matrix("rvec" + number, 3, 1, rotation_vector(s));
      } else {
        matrix("R" + number, 3, 3, rotation_of(s));
      }
      matrix((vectors ? "tvec" : "t") + number, 3, 1, {t[0], t[1], t[2]});
    }
    return scratch.write(vectors ? "vectors.yml" : "rotations.yml", text);
  }

  // Columns first.
  std::filesystem::path matlab() const {
    std::string data;
    for (const Stand& s : stands) {
      const std::vector<double> p = matrix_of(s);
      for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 3; ++row) testing::put<double>(data, p[4 * row + column]);
      }
    }
    return scratch.write("p.mat", testing::mat_header() + testing::mat_array(testing::kMatDouble, {3, 4, kViews}, "P",
                                                                             testing::mat_element(9, data)));
  }

  std::filesystem::path pmvs() const {
    std::filesystem::create_directories(scratch.folder() / "pmvs/txt");
    for (int i = 0; i < kViews; ++i) {
      const std::vector<double> p = matrix_of(stands[static_cast<std::size_t>(i)]);
      std::string text = "CONTOUR\n";
      for (auto row = p.begin(); row != p.end(); row += 4) text += text_of({row, row + 4}) + "\n";
      scratch.write("pmvs/txt/mask_" + std::to_string(i) + ".txt", text);
    }
    return scratch.folder() / "pmvs";
  }

  std::filesystem::path matrices() const {
    std::string text;
    for (int i = 0; i < kViews; ++i) {
      text += name_of(i) + " " + text_of(matrix_of(stands[static_cast<std::size_t>(i)])) + "\n";
    }
    return scratch.write("matrices.txt", text);
  }

  std::filesystem::path middlebury() const {
    std::string text = std::to_string(kViews) + "\n";
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      const Double3 t = s.translation();
      text += name_of(i) + " " + text_of({kFocalLength, 0, kCentreX, 0, kFocalLength, kCentreY, 0, 0, 1}) + " " +
              text_of(rotation_of(s)) + " " + text_of({t[0], t[1], t[2]}) + "\n";
    }
    return scratch.write("table_par.txt", text);
  }

  std::filesystem::path blocks() const {
    std::string text = "#Intrinsic parameter\n" + text_of({kFocalLength, 0, kCentreX}) + "\n" +
                       text_of({0, kFocalLength, kCentreY}) + "\n0 0 1\n";
    for (int i = 0; i < kViews; ++i) {
      const Stand& s = stands[static_cast<std::size_t>(i)];
      const std::vector<double> r = rotation_of(s);
      const Double3 t = s.translation();
      text += "#Extrinsic parameter for " + name_of(i) + "\n";
      for (std::size_t k = 0; k < 3; ++k) text += text_of({r[3 * k], r[3 * k + 1], r[3 * k + 2], t[k]}) + "\n";
    }
    return scratch.write("blocks.txt", text);
  }
};

TEST_CASE("The same cameras in every format give the same hull, the one that the masks say") {
  const Formats formats;
  // Points and what the masks say of them; nothing of those that are seen on the border of a pixel.
  std::vector<std::pair<Double3, bool>> truth;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-9, 9);
  std::size_t inside_count = 0;
  while (truth.size() < 600 || inside_count < 100) {
    const Double3 p{coordinate(random), coordinate(random), coordinate(random)};
    bool inside = true;
    bool clear = true;
    for (int i = 0; i < kViews; ++i) {
      const auto [u, v] = formats.stands[static_cast<std::size_t>(i)].see(p);
      for (const double x : {u, v}) clear = clear && std::abs(x - std::floor(x) - 0.5) > 1e-6;
      const int column = static_cast<int>(std::lround(u));
      const int row = static_cast<int>(std::lround(v));
      inside = inside && column >= 0 && row >= 0 && column < kWidth && row < kHeight &&
               formats.masks[static_cast<std::size_t>(i)].at<std::uint8_t>(row, column) != 0;
    }
    if (!clear) continue;
    truth.emplace_back(p, inside);
    if (inside) ++inside_count;
  }
  // Roundings in the seventeenth digit part planes that meet in a point of the turntable's axis one way or another, so
  // hulls are compared as sets, not by their counts.
  std::optional<nef::Polyhedron> first;
  for (const auto& [what, scene] : formats.scenes()) {
    INFO(what);
    REQUIRE(scene.views.size() == kViews);
    const Result result = compute(scene, formats.scratch.folder(), {});
    if (!first) first = result.hull;
    const double volume = nef::nearest_double(nef::volume(*first).value());
    CHECK(volume > 100);
    const nef::Polyhedron difference = nef::symmetric_difference(*first, result.hull);
    CHECK(nef::nearest_double(nef::volume(difference).value()) < 1e-9 * volume);
    std::size_t wrong = 0;
    for (const auto& [p, inside] : truth) {
      const Rational3 exact{nef::exact_rational(p[0]), nef::exact_rational(p[1]), nef::exact_rational(p[2])};
      if (nef::contains(result.hull, exact) != inside) ++wrong;
    }
    CHECK(wrong == 0);
  }
}

}  // namespace
}  // namespace nef::visual_hull
