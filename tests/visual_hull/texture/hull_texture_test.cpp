// SPDX-License-Identifier: Apache-2.0
//
// Textures of rendered things whose colours are known everywhere.
#include "apps/visual_hull/texture/hull_texture.h"

#include <cmath>
#include <optional>

#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/vectors.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/texture/painted.h"

namespace nef::visual_hull {
namespace {

using testing::kSix;
using testing::PaintedBox;
using testing::Rig;
using testing::Vec;

const Rig kSmall{18, 160, 120, 300};

// As a graphics card looks it up: between the four pixels around a place.
Vec color_in(const cv::Mat& image, double u, double v) {
  const double x = std::clamp(u * image.cols - 0.5, 0.0, image.cols - 1.0);
  const double y = std::clamp((1 - v) * image.rows - 0.5, 0.0, image.rows - 1.0);
  Vec color{};
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      const int column = std::min(static_cast<int>(x) + dx, image.cols - 1);
      const int row = std::min(static_cast<int>(y) + dy, image.rows - 1);
      const double s = x - std::floor(x);
      const double t = y - std::floor(y);
      const double weight = (dx == 1 ? s : 1 - s) * (dy == 1 ? t : 1 - t);
      for (std::size_t c = 0; c < 3; ++c)
        color[c] += weight * image.at<cv::Vec3b>(row, column)[2 - static_cast<int>(c)];
    }
  }
  return color;
}

/// Calls visit(place, colour) for points of the surface, nine for each triangle.
template <typename Visit>
void for_points(const nef::Mesh& mesh, const HullTexture& texture, Visit&& visit) {
  const auto points = rounded_points(mesh);
  for (std::size_t t = 0; t < mesh.face_count(); ++t) {
    for (const double a : {0.1, 0.4, 0.7}) {
      for (const double b : {0.1, 0.5, 0.9}) {
        const Vec w{a, (1 - a) * b, (1 - a) * (1 - b)};
        Vec place{};
        Vec uv{};
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t k = 0; k < 3; ++k) place[k] += w[i] * points[mesh.face(t)[i]][k];
          for (std::size_t k = 0; k < 2; ++k) uv[k] += w[i] * static_cast<double>(texture.corners[3 * t + i][k]);
        }
        visit(place, color_in(texture.image, uv[0], uv[1]));
      }
    }
  }
}

double difference(const Vec& color, const Color& truth) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(color[c] - truth[c]);
  return sum / 3;
}

Result hull_of(const std::filesystem::path& scene) {
  Options options;
  options.silhouette.simplify.tolerance = 1;
  return compute(read_scene(scene), scene.parent_path(), options);
}

// The mean error of the texture of an ellipsoid's hull at points that some view sees.
double error_of_ellipsoid(const Rig& rig, const std::function<double(std::size_t)>& exposure, double& unseen) {
  const testing::Scratch scratch;
  const Vec radii{1.3, 0.9, 1.1};
  const testing::Tracer trace = testing::ellipsoid(radii);
  const Result result = hull_of(testing::render(trace, rig, scratch, exposure));
  const nef::Mesh mesh = nef::to_mesh(result.hull).mesh;
  const HullTexture texture = hull_texture(mesh, result.views, result.origin, {});
  REQUIRE(texture.corners.size() == mesh.corners.size());
  unseen = texture.unseen;
  double sum = 0;
  std::size_t count = 0;
  for_points(mesh, texture, [&](const Vec& place, const Vec& color) {
    const double reach =
        std::sqrt(place[0] * place[0] / (radii[0] * radii[0]) + place[1] * place[1] / (radii[1] * radii[1]) +
                  place[2] * place[2] / (radii[2] * radii[2]));
    const Vec below{place[0] / reach, place[1] / reach, place[2] / reach};
    if (rig.views_that_see(trace, below) == 0) return;
    sum += difference(color, testing::smooth_color(below));
    ++count;
  });
  REQUIRE(count > 0);
  return sum / static_cast<double>(count);
}

TEST_CASE("The texture of a hull is that of the thing in the photographs") {
  double unseen = 1;
  CHECK(error_of_ellipsoid(kSmall, {}, unseen) < 2);
  CHECK(unseen < 0.02);
}

TEST_CASE("Photographs of different exposures are levelled") {
  double unseen = 1;
  const auto exposure = [](std::size_t view) { return view % 2 == 0 ? 0.9 : 1.1; };
  CHECK(error_of_ellipsoid(kSmall, exposure, unseen) < 4);
}

// An ellipsoid in one colour, lit by a lamp that goes with the camera, to its right, and with a highlight there.
struct LitEllipsoid {
  Vec radii;

  [[nodiscard]] Vec normal(const Vec& p) const {
    Vec n{};
    for (std::size_t k = 0; k < 3; ++k) n[k] = p[k] / (radii[k] * radii[k]);
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x /= length;
    return n;
  }

  [[nodiscard]] double brightness(const Vec& p, const Vec& eye) const {
    const double across = std::hypot(eye[0], eye[1]);
    const Vec lamp{eye[0] - 6 * eye[1] / across, eye[1] + 6 * eye[0] / across, eye[2]};
    Vec middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = lamp[k] + eye[k] - 2 * p[k];  // about half of the way to both
    const Vec n = normal(p);
    const auto cosine = [&](const Vec& to) { return std::max(0.0, nef::dot(n, to) / std::hypot(to[0], to[1], to[2])); };
    return 60 + 110 * cosine(nef::minus(lamp, p)) + 80 * std::pow(cosine(middle), 60);
  }

  [[nodiscard]] testing::Tracer tracer() const {
    const testing::Tracer place = testing::ellipsoid(radii);
    return [*this, place](const Vec& from, const Vec& direction) -> testing::Hit {
      const double at = place(from, direction).first;
      if (!std::isfinite(at)) return {at, {}};
      Vec p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + at * direction[k];
      const auto level = static_cast<std::uint8_t>(std::lround(brightness(p, from)));
      return {at, {level, level, level}};
    };
  }

  /// The mean of what the cameras see, weighted by the cosine of the angle at which they do; nothing if none does.
  [[nodiscard]] std::optional<double> mean(const Rig& rig, const Vec& p) const {
    double sum = 0;
    double weights = 0;
    for (std::size_t view = 0; view < rig.views; ++view) {
      const Vec ray = nef::minus(rig.position(view), p);
      const double cosine = nef::dot(normal(p), ray) / std::hypot(ray[0], ray[1], ray[2]);
      if (cosine < 0.05) continue;  // of a convex thing all else is seen
      sum += cosine * brightness(p, rig.position(view));
      weights += cosine;
    }
    if (weights == 0) return std::nullopt;
    return sum / weights;
  }
};

TEST_CASE("Shades and highlights of a lamp that goes with the camera are averaged over the views") {
  const testing::Scratch scratch;
  const LitEllipsoid thing{{1.3, 0.9, 1.1}};
  const Result result = hull_of(testing::render(thing.tracer(), kSmall, scratch));
  const nef::Mesh mesh = nef::to_mesh(result.hull).mesh;
  const HullTexture texture = hull_texture(mesh, result.views, result.origin, {});
  double sum = 0;
  std::size_t count = 0;
  for_points(mesh, texture, [&](const Vec& place, const Vec& color) {
    const double reach = std::hypot(place[0] / thing.radii[0], place[1] / thing.radii[1], place[2] / thing.radii[2]);
    const std::optional<double> truth = thing.mean(kSmall, {place[0] / reach, place[1] / reach, place[2] / reach});
    if (!truth) return;
    sum += std::abs(color[0] - *truth);
    ++count;
  });
  REQUIRE(count > 1000);
  CHECK(sum / static_cast<double>(count) < 10);  // 27 if each chart keeps the shades of its view
}

// Both triangles of each cell of a grid on each side of a box, and their colours.
void add_box(const PaintedBox& box, std::uint32_t cells, nef::Mesh& mesh, std::vector<Color>& truth) {
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t axis = side / 2;
    const std::size_t u = (axis + (side % 2 == 0 ? 2 : 1)) % 3;
    const std::size_t v = 3 - axis - u;
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i <= cells; ++i) {
      for (std::uint32_t j = 0; j <= cells; ++j) {
        nef::Rational3 p;
        p[axis] = side % 2 == 0 ? box.low[axis] : box.high[axis];
        p[u] = box.low[u] + (box.high[u] - box.low[u]) * i / cells;
        p[v] = box.low[v] + (box.high[v] - box.low[v]) * j / cells;
        mesh.vertices.push_back(p);
        if (i == cells || j == cells) continue;
        const std::uint32_t at = base + i * (cells + 1) + j;
        mesh.push_face(std::array{at, at + cells + 1, at + cells + 2});
        mesh.push_face(std::array{at, at + cells + 2, at + 1});
        truth.insert(truth.end(), 2, box.sides[side]);
      }
    }
  }
}

TEST_CASE("What another part hides from a view is not in its texture, whatever the threads") {
  const PaintedBox six{{-1, -0.8, -0.9}, {1, 0.8, 0.9}, kSix};
  PaintedBox white{{1.3, -0.7, -0.8}, {1.5, 0.7, 0.8}, {}};  // before the green side
  white.sides.fill({250, 250, 250});
  const testing::Tracer trace = testing::tracer_of({six, white});
  const testing::Scratch scratch;
  const Result result = hull_of(testing::render(trace, kSmall, scratch));
  nef::Mesh mesh;
  std::vector<Color> truth;
  add_box(six, 4, mesh, truth);
  add_box(white, 1, mesh, truth);
  const HullTexture texture = hull_texture(mesh, result.views, result.origin, {});
  double sum = 0;
  std::size_t count = 0;
  std::size_t wrong = 0;
  std::size_t point = 0;
  for_points(mesh, texture, [&](const Vec& place, const Vec& color) {
    const Color& right = truth[point++ / 9];
    if (kSmall.views_that_see(trace, place) == 0) return;
    const double off = difference(color, right);
    sum += off;
    if (off > 60) ++wrong;
    ++count;
  });
  CHECK(count > 1000);
  CHECK(sum / static_cast<double>(count) < 3);
  CHECK(wrong * 100 < count);
  CHECK(texture.unseen > 0);
  const HullTexture again = hull_texture(mesh, result.views, result.origin, nef::Monitor().on_threads(2));
  CHECK(cv::norm(texture.image, again.image, cv::NORM_INF) == 0);
  CHECK(texture.corners == again.corners);
}

TEST_CASE("A texture needs images and triangles") {
  const testing::Scratch scratch;
  Result result = hull_of(testing::render(testing::ellipsoid({1, 1, 1}), {4, 60, 60, 120}, scratch));
  nef::Mesh mesh = nef::to_mesh(result.hull).mesh;
  nef::Mesh quad;
  quad.vertices = testing::box_corners({0, 0, 0}, {1, 1, 1});
  quad.push_face(std::array<std::uint32_t, 4>{0, 2, 3, 1});
  CHECK_THROWS_WITH(hull_texture(quad, result.views, result.origin, {}), Catch::Contains("mesh of triangles"));
  std::filesystem::remove(result.views[0].image);
  CHECK_THROWS_WITH(hull_texture(mesh, result.views, result.origin, {}), Catch::Contains("cannot read the image"));
  for (ViewResult& view : result.views) view.image.clear();
  CHECK_THROWS_WITH(hull_texture(mesh, result.views, result.origin, {}), Catch::Contains("--texture needs images"));
}

TEST_CASE("Of a mesh that no view sees every texel is grey") {
  const testing::Scratch scratch;
  const Result result = hull_of(testing::render(testing::ellipsoid({1, 1, 1}), {4, 60, 60, 120}, scratch));
  nef::Mesh mesh;
  for (nef::Rational3 p : testing::box_corners({0, 0, 0}, {1, 1, 1})) {
    p[0] += nef::Rational(1000000);
    mesh.vertices.push_back(p);
  }
  mesh.push_face(std::array<std::uint32_t, 3>{0, 2, 1});
  mesh.push_face(std::array<std::uint32_t, 3>{1, 1, 1});
  const HullTexture texture = hull_texture(mesh, result.views, result.origin, {});
  CHECK(texture.unseen == 1);
  CHECK(cv::norm(texture.image, cv::Mat(texture.image.size(), CV_8UC3, cv::Scalar(128, 128, 128)), cv::NORM_INF) == 0);
}

}  // namespace
}  // namespace nef::visual_hull
