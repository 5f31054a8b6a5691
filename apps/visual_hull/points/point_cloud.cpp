// SPDX-License-Identifier: Apache-2.0
//
// Points by area: a sweep over the triangles with the sum of their areas. Within a triangle, pairs of numbers of the R2
// sequence, folded along the diagonal of the square.
#include "apps/visual_hull/points/point_cloud.h"

#include <algorithm>
#include <cmath>

#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"

namespace nef::visual_hull {
namespace {

/// A sample: its triangle, as corners of the mesh, and its weights.
struct Sample {
  std::array<std::uint32_t, 3> corners{};
  std::array<double, 3> weights{};
};

std::array<double, 3> weights_of(std::size_t i) {
  // The reciprocals of the plastic number and of its square.
  constexpr std::array<double, 2> kStep{0.7548776662466927, 0.5698402909980532};
  double s = std::fmod(0.5 + kStep[0] * static_cast<double>(i + 1), 1.0);
  double t = std::fmod(0.5 + kStep[1] * static_cast<double>(i + 1), 1.0);
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return {1 - s - t, s, t};
}

nef::Double3 normal_of(const std::vector<nef::Double3>& points, const std::array<std::uint32_t, 3>& t) {
  return nef::cross(nef::minus(points[t[1]], points[t[0]]), nef::minus(points[t[2]], points[t[0]]));
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const nef::Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) triangles.push_back({face[0], face[k], face[k + 1]});
  }
  return triangles;
}

std::vector<Sample> samples_of(const std::vector<nef::Double3>& points,
                               const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t count) {
  std::vector<double> sums;  // of areas
  double sum = 0;
  for (const auto& t : triangles) {
    const nef::Double3 normal = normal_of(points, t);
    const double area = std::sqrt(nef::dot(normal, normal));
    if (std::isfinite(area)) sum += area;
    sums.push_back(sum);
  }
  std::vector<Sample> samples;
  if (!(sum > 0) || !std::isfinite(sum)) return samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = sum * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto reached = std::upper_bound(sums.begin(), sums.end(), at);
    const auto t = static_cast<std::size_t>(std::min(reached, sums.end() - 1) - sums.begin());
    samples.push_back({triangles[t], weights_of(i)});
  }
  return samples;
}

SurfacePoint point_of(const std::vector<nef::Double3>& points, const Sample& sample) {
  SurfacePoint point;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) point.position[k] += sample.weights[i] * points[sample.corners[i]][k];
  }
  point.normal = normal_of(points, sample.corners);
  const double length = std::sqrt(nef::dot(point.normal, point.normal));
  for (double& x : point.normal) x /= length;
  return point;
}

// The colours of samples and vertices are looked up together, so that photographs are read once.
void add_colors(const nef::Mesh& mesh, const std::vector<Sample>& samples, const Result& result,
                const nef::Monitor& monitor, PointCloud& cloud) {
  std::vector<std::array<double, 3>> places;
  for (const SurfacePoint& point : cloud.points) places.push_back(point.position);
  const std::vector<nef::Double3> corners = rounded_points(mesh);
  places.insert(places.end(), corners.begin(), corners.end());
  const FoundColors found = surface_colors(mesh, places, result.views, result.origin, "--points", monitor);
  FoundColors of_vertices(found.begin() + static_cast<std::ptrdiff_t>(samples.size()), found.end());
  spread_colors(mesh, of_vertices);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (found[i]) {
      cloud.points[i].color = rounded_color(found[i]);
      continue;
    }
    std::array<double, 3> color{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = of_vertices[samples[i].corners[k]].value_or(std::array<double, 3>{128, 128, 128});
      for (std::size_t c = 0; c < 3; ++c) color[c] += samples[i].weights[k] * corner[c];
    }
    cloud.points[i].color = rounded_color(color);
  }
}

}  // namespace

std::vector<SurfacePoint> sample_surface(const nef::Mesh& mesh, std::size_t count) {
  const std::vector<nef::Double3> points = rounded_points(mesh);
  std::vector<SurfacePoint> result;
  for (const Sample& sample : samples_of(points, triangles_of(mesh), count)) result.push_back(point_of(points, sample));
  return result;
}

PointCloud sample_hull(const Result& result, std::size_t count, const nef::Monitor& monitor) {
  const nef::Mesh mesh = nef::to_mesh(result.hull, {}, monitor).mesh;
  const std::vector<nef::Double3> points = rounded_points(mesh);
  const std::vector<Sample> samples = samples_of(points, triangles_of(mesh), count);
  PointCloud cloud;
  for (const Sample& sample : samples) cloud.points.push_back(point_of(points, sample));
  const bool images =
      std::any_of(result.views.begin(), result.views.end(), [](const ViewResult& view) { return !view.image.empty(); });
  if (images) {
    add_colors(mesh, samples, result, monitor, cloud);
  } else {
    cloud.notes.emplace_back("the points are grey, because the views have no images");
  }
  return cloud;
}

std::string colmap_points(const std::vector<SurfacePoint>& points) {
  std::string text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: " +
      std::to_string(points.size()) + ", mean track length: 0\n";
  std::size_t number = 0;
  for (const SurfacePoint& point : points) {
    text += std::to_string(++number);
    for (const double x : point.position) {
      text += ' ';
      nef::append_number(text, x);
    }
    for (const std::uint8_t channel : point.color) text += " " + std::to_string(channel);
    text += " -1\n";
  }
  return text;
}

std::string ply_points(const std::vector<SurfacePoint>& points) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) bytes += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue"}) bytes += std::string("property uchar ") + name + "\n";
  bytes += "end_header\n";
  for (const SurfacePoint& point : points) {
    for (const double x : point.position) nef::append_little_endian(bytes, static_cast<float>(x));
    for (const double x : point.normal) nef::append_little_endian(bytes, static_cast<float>(x));
    for (const std::uint8_t channel : point.color) nef::append_little_endian(bytes, channel);
  }
  return bytes;
}

void write_points(const PointCloud& cloud, const std::filesystem::path& file) {
  const bool text = file.extension() == ".txt";
  nef::write_file(file.string(), text ? colmap_points(cloud.points) : ply_points(cloud.points));
}

}  // namespace nef::visual_hull
