// SPDX-License-Identifier: Apache-2.0
//
// render_silhouettes MESH -o DIR: silhouettes of a mesh from cameras around it, as 1-bit PNGs with a JSON
// scene. The cameras are rounded to six decimals first and the pixels are decided with those, so
// that a visual hull of the result has no error but the pixels'.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "apps/program/run_program.h"
#include "apps/program/version.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_reader.h"

namespace {

using Eigen::Vector3d;

struct Arguments {
  std::string mesh;
  std::string directory;
  int views = 12;
  int width = 320;
  int height = 240;
  std::vector<double> elevations{20, 45, -10};
  std::string up = "y";
};

struct View {
  std::array<std::string, 9> r;  // as they will be written
  std::array<std::string, 3> t;
  Eigen::Matrix3d turn;  // what was written
  Vector3d shift;
};

View look(const Vector3d& from, const Vector3d& at, const Vector3d& up) {
  const Vector3d z = (at - from).normalized();
  const Vector3d x = z.cross(up).normalized();  // to the right: v points down
  const std::array<Vector3d, 3> rows{x, z.cross(x), z};
  View view;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) view.r[3 * i + j] = fmt::format("{:.6f}", rows[i](j));
    view.t[i] = fmt::format("{:.6f}", -rows[i].dot(from));
    for (std::size_t j = 0; j < 3; ++j) view.turn(i, j) = std::stod(view.r[3 * i + j]);
    view.shift(i) = std::stod(view.t[i]);
  }
  return view;
}

struct Sphere {
  Vector3d centre;
  double radius = 0;
};

Sphere bound(const std::vector<Vector3d>& points) {
  Vector3d low = points[0];
  Vector3d high = points[0];
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Sphere sphere{(low + high) / 2};
  for (const Vector3d& p : points) sphere.radius = std::max(sphere.radius, (p - sphere.centre).norm());
  return sphere;
}

// Sets the pixels whose centre lies in the triangle.
void fill(cv::Mat& mask, const std::array<std::array<double, 2>, 3>& p) {
  const auto [x0, x1] = std::minmax({p[0][0], p[1][0], p[2][0]});
  const auto [y0, y1] = std::minmax({p[0][1], p[1][1], p[2][1]});
  for (int y = std::max(0, static_cast<int>(std::ceil(y0))); y <= std::min(mask.rows - 1, static_cast<int>(y1)); ++y) {
    for (int x = std::max(0, static_cast<int>(std::ceil(x0))); x <= std::min(mask.cols - 1, static_cast<int>(x1));
         ++x) {
      int positive = 0;
      int negative = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& a = p[i];
        const auto& b = p[(i + 1) % 3];
        const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        positive += side > 0 ? 1 : 0;
        negative += side < 0 ? 1 : 0;
      }
      if (positive == 0 || negative == 0) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
}

cv::Mat render(const std::vector<Vector3d>& points, const nef::Mesh& mesh, const View& view, double focal, double cx,
               double cy, const Arguments& a) {
  cv::Mat mask(a.height, a.width, CV_8U, cv::Scalar(0));
  std::vector<std::array<double, 2>> seen;
  for (const Vector3d& p : points) {
    const Vector3d c = view.turn * p + view.shift;
    seen.push_back({focal * c[0] / c[2] + cx, focal * c[1] / c[2] + cy});
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) fill(mask, {seen[face[0]], seen[face[i]], seen[face[i + 1]]});
  }
  return mask;
}

std::string camera_json(const View& view, const std::string& image, double focal, double cx, double cy) {
  std::string r;
  std::string t;
  for (std::size_t i = 0; i < 9; ++i) r += (i == 0 ? "[" : i % 3 == 0 ? "], [" : ", ") + view.r[i];
  for (std::size_t i = 0; i < 3; ++i) t += (i == 0 ? "" : ", ") + view.t[i];
  return fmt::format(
      "    {{\"image\": \"{}\",\n     \"K\": [[{}, 0, {}], [0, {}, {}], [0, 0, 1]],\n     \"R\": [{}]],\n     \"t\": "
      "[{}]}}",
      image, focal, cx, focal, cy, r, t);
}

void run(const Arguments& a) {
  const nef::Mesh mesh = nef::read_mesh(a.mesh);
  std::vector<Vector3d> points;
  for (const nef::Rational3& p : mesh.vertices) {
    points.emplace_back(nef::nearest_double(p[0]), nef::nearest_double(p[1]), nef::nearest_double(p[2]));
  }
  if (points.empty()) throw nef::InputError(a.mesh + ": the mesh has no vertices");
  const Sphere sphere = bound(points);
  const double focal = 1.25 * a.width;
  const double cx = (a.width - 1) / 2.0;  // whole coordinates are centres of pixels
  const double cy = (a.height - 1) / 2.0;
  const double distance = sphere.radius * std::hypot(1.0, focal / (0.46 * std::min(a.width, a.height)));
  const int up = a.up == "x" ? 0 : a.up == "y" ? 1 : 2;
  const Vector3d up_vector = Vector3d::Unit(up);
  const std::string stem = std::filesystem::path(a.mesh).stem().string();
  std::filesystem::create_directories(a.directory);
  std::string cameras;
  for (int i = 0; i < a.views; ++i) {
    const double azimuth = 2 * M_PI * i / a.views;
    const double elevation = a.elevations[static_cast<std::size_t>(i) % a.elevations.size()] * M_PI / 180;
    Vector3d from = sphere.centre;
    from[(up + 1) % 3] += distance * std::cos(elevation) * std::cos(azimuth);
    from[(up + 2) % 3] += distance * std::cos(elevation) * std::sin(azimuth);
    from[up] += distance * std::sin(elevation);
    const View view = look(from, sphere.centre, up_vector);
    const std::string image = fmt::format("{}_{:02}.png", stem, i);
    const cv::Mat mask = render(points, mesh, view, focal, cx, cy, a);
    const std::string path = (std::filesystem::path(a.directory) / image).string();
    std::vector<unsigned char> png;
    if (!cv::imencode(".png", mask, png, {cv::IMWRITE_PNG_BILEVEL, 1, cv::IMWRITE_PNG_COMPRESSION, 9})) {
      throw nef::InputError("cannot make an image of " + path);
    }
    nef::write_file(path, std::string(png.begin(), png.end()));
    cameras += (i == 0 ? "" : ",\n") + camera_json(view, image, focal, cx, cy);
  }
  const std::filesystem::path scene = std::filesystem::path(a.directory) / (stem + ".json");
  nef::write_file(scene.string(), "{\n  \"cameras\": [\n" + cameras + "\n  ]\n}\n");
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Renders silhouettes of a mesh from cameras around it, with a scene for visual_hull",
               "render_silhouettes"};
  app.add_option("MESH", arguments.mesh, "Any mesh that nef reads")->required();
  app.add_option("-o,--output", arguments.directory, "Directory for the images and the scene")->required();
  app.add_option("--views", arguments.views, "Number of cameras")->check(CLI::Range(1, 1000));
  app.add_option("--width", arguments.width, "Width of the images")->check(CLI::Range(8, 10000));
  app.add_option("--height", arguments.height, "Height of the images")->check(CLI::Range(8, 10000));
  app.add_option("--elevations", arguments.elevations, "Angles over the horizon in degrees, in turn");
  app.add_option("--up", arguments.up, "Vertical axis")->check(CLI::IsMember({"x", "y", "z"}));
  app.set_version_flag("--version", nef::version_text("render_silhouettes"));
  return nef::run_program(app, argc, argv, [&arguments] {
    run(arguments);
    return 0;
  });
}
