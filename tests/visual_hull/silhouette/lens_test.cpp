// SPDX-License-Identifier: Apache-2.0
//
// Contours without the distortion of their lens, against rendered truth and OpenCV's model.
#include "apps/visual_hull/silhouette/lens.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/visual_hull/silhouette/silhouette.h"
#include "nef/base/error.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Scratch;

Distortion lens_of(int focal, int cx, int cy, std::vector<double> coefficients) {
  return {std::move(coefficients), {{{focal, 0, cx}, {0, focal, cy}, {0, 0, 1}}}};
}

// A wide lens: the straightened image is larger than the distorted one by a quarter to each side.
const Distortion& wide_lens() {
  static const Distortion kLens = lens_of(280, 320, 320, {-0.28, 0.06, 0, 0});
  return kLens;
}
const cv::Size kImageSize(640, 640);

// The oracle: the radius whose image is `distorted`, by bisection of the polynomial. In focal lengths.
double straight_radius(double distorted, double k1, double k2) {
  double low = 0;
  double high = 4;
  for (int i = 0; i < 80; ++i) {
    const double r = (low + high) / 2;
    (r * (1 + k1 * r * r + k2 * r * r * r * r) < distorted ? low : high) = r;
  }
  return low;
}

// What the wide lens shows of a region of the straight image, pixel by pixel.
template <typename Inside>
cv::Mat seen_through_wide_lens(const Inside& inside) {
  cv::Mat mask(kImageSize, CV_8U, cv::Scalar(0));
  for (int y = 0; y < kImageSize.height; ++y) {
    for (int x = 0; x < kImageSize.width; ++x) {
      const double u = (x - 320) / 280.0;
      const double v = (y - 320) / 280.0;
      const double r = std::hypot(u, v);
      const double scale = r > 0 ? straight_radius(r, -0.28, 0.06) / r : 1;
      if (inside(320 + 280 * scale * u, 320 + 280 * scale * v)) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  return mask;
}

double area_of(const Silhouette& silhouette) {
  double area = 0;
  for (const Ring& ring : silhouette.rings) area += twice_area(ring) / 2;
  return area;
}

TEST_CASE("The model of the lens is OpenCV's, with all coefficients, and its inverse is one") {
  testing::property("forward and back", [] {
    const auto number = [](int range) { return *rc::gen::inRange(-range, range + 1) / 1000.0; };
    std::vector<double> c{number(200), number(50), number(5), number(5), number(20)};
    const std::size_t size = *rc::gen::element<std::size_t>(4, 5, 8, 12, 14);
    while (c.size() < 14) c.push_back(c.size() < 8 ? number(30) : c.size() < 12 ? number(5) : number(60));
    c.resize(size);
    const Distortion distortion = lens_of(500, 310, 250, c);
    const LensModel lens(distortion);
    const double x = *rc::gen::inRange(-300, 301) / 500.0;
    const double y = *rc::gen::inRange(-250, 251) / 500.0;
    std::vector<cv::Point2d> images;
    cv::projectPoints(std::vector<cv::Point3d>{{x, y, 1}}, cv::Vec3d(), cv::Vec3d(),
                      cv::Matx33d(500, 0, 310, 0, 500, 250, 0, 0, 1), c, images);
    const std::array<double, 2> straight{310 + 500 * x, 250 + 500 * y};
    const auto seen = lens.distort(straight);
    RC_ASSERT(std::hypot(seen[0] - images[0].x, seen[1] - images[0].y) < 1e-9);
    const auto back = lens.straighten(seen);
    RC_ASSERT(back.has_value());
    RC_ASSERT(std::hypot((*back)[0] - straight[0], (*back)[1] - straight[1]) < 1e-6);
  });
}

TEST_CASE("A wide lens loses nothing that its image shows") {
  const auto check_rectangle = [](double x0, double y0, double x1, double y1) {
    const cv::Mat mask =
        seen_through_wide_lens([&](double x, double y) { return x > x0 && x < x1 && y > y0 && y < y1; });
    SilhouetteOptions options;
    const ViewSilhouette seen = silhouette_of_mask(mask, wide_lens(), "v", options);
    CHECK_FALSE(seen.cut_by_frame);
    CHECK(check(seen.region).empty());
    REQUIRE(seen.region.rings.size() == 1);
    CHECK(area_of(seen.region) == Approx((x1 - x0) * (y1 - y0)).epsilon(0.002));
    // A pixel at the border of the image is up to four pixels of the straight one.
    for (const Point2& p : seen.region.rings[0]) {
      const double x = p.approximate[0];
      const double y = p.approximate[1];
      const double off = std::min({std::abs(x - x0), std::abs(x - x1), std::abs(y - y0), std::abs(y - y1)});
      REQUIRE(off < 4);
      REQUIRE((x > x0 - 4 && x < x1 + 4 && y > y0 - 4 && y < y1 + 4));
    }
  };
  check_rectangle(200.3, 150.3, 420.7, 300.7);
  check_rectangle(-60.3, 40.3, 690.7, 400.7);  // beyond 0 to 640 on both sides
}

TEST_CASE("What the frame of the distorted image cuts is told, and may be left open") {
  const cv::Mat mask = seen_through_wide_lens([](double x, double /*y*/) { return x < 300; });
  SilhouetteOptions options;
  const ViewSilhouette cut = silhouette_of_mask(mask, wide_lens(), "v", options);
  CHECK(cut.cut_by_frame);
  options.border = Border::kUnknown;
  const ViewSilhouette open = silhouette_of_mask(mask, wide_lens(), "v", options);
  REQUIRE(open.background);
  REQUIRE(open.region.rings.size() == 1);
  CHECK(check(open.region).empty());
  CHECK(locate(open.region, Point2(400, 320)) == Side::kInside);
  CHECK(locate(open.region, Point2(700, 320)) == Side::kInside);  // seen, beyond 640
  CHECK(locate(open.region, Point2(200, 320)) == Side::kOutside);
  CHECK(locate(open.region, Point2(2000, 320)) == Side::kOutside);
}

TEST_CASE("Straightened contours are simple and nested as they were, whatever the mask") {
  testing::property("random masks and lenses", [] {
    const auto number = [](int range) { return *rc::gen::inRange(-range, range + 1) / 1000.0; };
    const Distortion lens = lens_of(30, 13, 10, {number(300), std::abs(number(60)), number(5), number(5), number(20)});
    const cv::Mat mask = testing::random_mask(26, 20, *rc::gen::inRange(0, 4), *rc::gen::arbitrary<std::uint64_t>());
    SilhouetteOptions options;
    options.diagonal = *rc::gen::element(DiagonalPixels::kTouch, DiagonalPixels::kJoin);
    const ViewSilhouette plain = silhouette_of_mask(mask, {}, "v", options);
    ViewSilhouette straight;
    try {
      straight = silhouette_of_mask(mask, lens, "v", options);
    } catch (const nef::InputError&) {
      RC_DISCARD("the lens folds the image");
    }
    RC_ASSERT(check(straight.region).empty());
    RC_ASSERT(straight.region.rings.size() == plain.region.rings.size());
    RC_ASSERT(straight.region.hole_count() == plain.region.hole_count());
  });
}

TEST_CASE("A lens that folds the image at the silhouette is refused by name") {
  cv::Mat mask(kImageSize, CV_8U, cv::Scalar(255));
  const Distortion folding = lens_of(280, 320, 320, {-1, 0, 0, 0});
  CHECK_THROWS_WITH(silhouette_of_mask(mask, folding, "seventh", {}),
                    Contains("view seventh: the lens distortion cannot be undone at (") && Contains("coefficients"));
}

// A box seen by wide lenses from three sides, so near that the straightened images are larger than the frame.
TEST_CASE("The hull of views with a wide lens is that of the same views without") {
  const std::vector<Rational3> corners = testing::box_corners({-2, -2, -2}, {2, 2, 2});
  const Scratch s;
  Scene distorted;
  Scene exact;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Rational3 centre{Rational(1, 20), Rational(1, 30), Rational(-1, 40)};
    centre[axis] = Rational(18, 5);
    const Camera plain = testing::axis_camera(centre, axis, -1);
    Matrix34 matrix = plain.matrix();
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 2; ++i) matrix[i][j] = 280 * matrix[i][j] + 320 * matrix[2][j];
    }
    View view;
    view.name = "v" + std::to_string(axis);
    view.camera = Camera(view.name, matrix);
    const Silhouette truth = testing::convex_silhouette(view.camera, corners);
    view.polygons = truth.rings;
    exact.views.push_back(view);
    view.polygons.reset();
    view.distortion = wide_lens();
    view.image = view.name + ".png";
    const cv::Mat mask = seen_through_wide_lens(
        [&](double x, double y) { return locate(truth, Point2::from_doubles(x, y)) == Side::kInside; });
    CHECK_FALSE(touches_frame(mask));
    cv::imwrite((s.folder() / view.image).string(), mask);
    distorted.views.push_back(view);
  }
  Options options;
  options.box = testing::cube(3);
  const double wanted = nef::approximate_volume(compute(exact, ".", options).hull).value;
  const double got = nef::approximate_volume(compute(distorted, s.folder(), options).hull).value;
  CHECK(got == Approx(wanted).epsilon(0.004));
}

}  // namespace
}  // namespace nef::visual_hull
