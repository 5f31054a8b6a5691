// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/contour.h"

#include <catch2/catch.hpp>
#include <set>

#include "nef/base/error.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::random_mask;

cv::Mat picture(const std::vector<std::string>& rows) {
  cv::Mat mask(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), CV_8U);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      mask.at<std::uint8_t>(y, x) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    }
  }
  return mask;
}

double area(const Silhouette& s) {
  double sum = 0;
  for (const Ring& ring : s.rings) sum += twice_area(ring) / 2;
  return sum;
}

TEST_CASE("One pixel is a unit square around its centre or right of its corner") {
  const cv::Mat mask = picture({"...", ".#.", "..."});
  const Silhouette centre = trace_contours(mask, PixelOrigin::kCenter);
  REQUIRE(centre.rings.size() == 1);
  REQUIRE(centre.rings[0].size() == 4);
  CHECK(locate(centre, Point2(Rational(1, 2), Rational(1, 2))) == Side::kBoundary);
  CHECK(locate(centre, Point2(1, 1)) == Side::kInside);
  CHECK(locate(centre, Point2(Rational(3, 2), 1)) == Side::kBoundary);
  const Silhouette corner = trace_contours(mask, PixelOrigin::kCorner);
  CHECK(locate(corner, Point2(1, 1)) == Side::kBoundary);
  CHECK(locate(corner, Point2(Rational(3, 2), Rational(3, 2))) == Side::kInside);
}

TEST_CASE("Holes and islands in holes are nested") {
  const Silhouette s = trace_contours(picture({"#########", "#.......#", "#.#####.#", "#.#...#.#", "#.#.#.#.#",
                                               "#.#...#.#", "#.#####.#", "#.......#", "#########"}),
                                      PixelOrigin::kCenter);
  REQUIRE(s.rings.size() == 5);
  std::vector<int> depth = s.depth;
  std::sort(depth.begin(), depth.end());
  CHECK(depth == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(s.hole_count() == 2);
  for (std::size_t i = 0; i < s.rings.size(); ++i) {
    if (s.depth[i] == 0) {
      CHECK(s.parent[i] == -1);
    } else {
      CHECK(s.depth[static_cast<std::size_t>(s.parent[i])] == s.depth[i] - 1);
    }
  }
  CHECK(check(s).empty());
}

TEST_CASE("Pixels that touch in a corner only make rings that touch there") {
  const Silhouette diagonal = trace_contours(picture({"#.", ".#"}), PixelOrigin::kCorner);
  CHECK(diagonal.rings.size() == 2);
  CHECK(diagonal.vertex_count() == 8);
  CHECK(check(diagonal).empty());
  // The chain closes in a corner: an outer ring and a hole that touch there.
  const Silhouette joined = trace_contours(picture({"#.", ".#"}), PixelOrigin::kCorner, DiagonalPixels::kJoin);
  CHECK(joined.rings.size() == 1);
  CHECK(joined.vertex_count() == 10);
  CHECK(check(joined).empty());
  CHECK(area(joined) == 2 + 1.0 / 16);  // two triangles with legs of a quarter
  CHECK(locate(joined, Point2(1, 1)) == Side::kInside);
  const Silhouette closed = trace_contours(picture({".##", "#.#", "###"}), PixelOrigin::kCorner);
  CHECK(closed.rings.size() == 2);
  CHECK(closed.hole_count() == 1);
  CHECK(check(closed).empty());
}

TEST_CASE("A full image and a single row") {
  const Silhouette full = trace_contours(cv::Mat(4, 7, CV_8U, cv::Scalar(255)), PixelOrigin::kCorner);
  REQUIRE(full.rings.size() == 1);
  CHECK(full.rings[0].size() == 4);
  CHECK(area(full) == 28);
  CHECK(touches_frame(cv::Mat(4, 7, CV_8U, cv::Scalar(255))));
  const Silhouette row = trace_contours(picture({"##.#"}), PixelOrigin::kCorner);
  CHECK(row.rings.size() == 2);
  CHECK_FALSE(touches_frame(picture({"...", ".#.", "..."})));
  CHECK(trace_contours(picture({"...", "..."}), PixelOrigin::kCorner).empty());
}

TEST_CASE("Contours hold exactly the pixels that are set") {
  testing::property("every pixel, the area, and the promises of a silhouette", [] {
    const int width = *rc::gen::inRange(1, 24);
    const int height = *rc::gen::inRange(1, 24);
    const int smoothing = *rc::gen::inRange(0, 3);
    const cv::Mat mask = random_mask(width, height, smoothing, *rc::gen::arbitrary<std::uint64_t>());
    const Silhouette s = trace_contours(mask, PixelOrigin::kCenter);
    RC_ASSERT(check(s) == "");
    RC_ASSERT(area(s) == cv::countNonZero(mask));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        RC_ASSERT((locate(s, Point2(x, y)) == Side::kInside) == (mask.at<std::uint8_t>(y, x) != 0));
      }
    }
  });
}

TEST_CASE("Joined diagonal pixels add two small triangles each, and no two rings touch") {
  testing::property("area, pixels, and the promises of a silhouette", [] {
    const int width = *rc::gen::inRange(1, 24);
    const int height = *rc::gen::inRange(1, 24);
    const cv::Mat mask = random_mask(width, height, *rc::gen::inRange(0, 3), *rc::gen::arbitrary<std::uint64_t>());
    const Silhouette s = trace_contours(mask, PixelOrigin::kCenter, DiagonalPixels::kJoin);
    RC_ASSERT(check(s) == "");
    const auto set = [&mask](int x, int y) { return mask.at<std::uint8_t>(y, x) != 0; };
    int pinches = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        RC_ASSERT((locate(s, Point2(x, y)) == Side::kInside) == set(x, y));
        if (x == 0 || y == 0 || set(x, y) == set(x - 1, y) || set(x, y) == set(x, y - 1)) continue;
        if (set(x, y) == set(x - 1, y - 1)) ++pinches;
      }
    }
    RC_ASSERT(area(s) == cv::countNonZero(mask) + pinches / 16.0);
    std::set<std::array<double, 2>> places;
    for (const Ring& ring : s.rings) {
      for (const Point2& p : ring) RC_ASSERT(places.insert(p.approximate).second);
    }
  });
}

TEST_CASE("Polygons from outside are cleaned, and refused by name if they cannot mean a region") {
  using testing::rectangle;
  using testing::ring;
  const auto problem = [](const std::vector<Ring>& rings) -> std::string {
    try {
      make_silhouette(rings, "view a");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  CHECK(problem({ring({{0, 0}, {2, 2}, {2, 0}, {0, 2}})}).find("view a: polygon 1 crosses itself") == 0);
  CHECK(problem({ring({{0, 0}, {1, 1}, {2, 2}})}) == "view a: polygon 1 has no area");
  CHECK(problem({rectangle(0, 0, 4, 4), rectangle(2, 2, 6, 6)}).find("polygon 1 crosses polygon 2") !=
        std::string::npos);
  CHECK(problem({rectangle(0, 0, 4, 4), rectangle(4, 0, 6, 4)}).find("runs along") != std::string::npos);
  CHECK(problem({rectangle(0, 0, 4, 4), rectangle(0, 0, 4, 4)}).find("runs along") != std::string::npos);
  // Two triangles that cross in a common vertex.
  CHECK(problem({ring({{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}}), ring({{2, 2}, {1, 1.5}, {3, 1.9}})}) != "");

  // Repeated and straight vertices go; orientation does not matter; a vertex may touch an edge.
  const Silhouette cleaned = make_silhouette({ring({{0, 0}, {0, 0}, {0, 2}, {0, 4}, {4, 4}, {4, 0}})}, "x");
  CHECK(cleaned.vertex_count() == 4);
  CHECK(ring_orientation(cleaned.rings[0]) == 1);
  const Silhouette touching = make_silhouette({rectangle(0, 0, 4, 4), ring({{0, 2}, {2, 1}, {2, 3}})}, "x");
  CHECK(touching.vertex_count() == 8);
  CHECK(touching.hole_count() == 1);
  CHECK(check(touching).empty());
}

// All vertices of these rings lie on the border of another one, so no decision can rest on where a vertex lies.
TEST_CASE("Rings that touch their neighbours in every vertex are nested whatever vertex they begin with") {
  const std::vector<Ring> rings{
      testing::rectangle(0, 0, 16, 16),
      testing::ring({{8, 0}, {16, 8}, {8, 16}, {0, 8}}),     // its corners halve the sides of the square
      testing::rectangle(4, 4, 12, 12),                      // and so on
      testing::ring({{8, 4}, {12, 8}, {8, 12}, {4, 8}}),     //
      testing::ring({{16, 0}, {24, 8}, {16, 16}, {20, 8}}),  // beside the square, from corner to corner
      testing::ring({{16, 0}, {18, 4}, {16, 8}}),            // along half a side: refused unless it is left out
      testing::ring({{8, 4}, {9, 6}, {8, 12}, {7, 6}}),      // in the innermost, from corner to corner
  };
  const std::vector<std::size_t> used{0, 1, 2, 3, 4, 6};
  const std::vector<int> depth{0, 1, 2, 3, 0, 4};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    for (std::size_t order = 0; order < used.size(); ++order) {
      std::vector<Ring> input;
      std::vector<int> expected;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const std::size_t i = (k + order) % used.size();
        Ring ring = rings[used[i]];
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(turn), ring.end());
        if ((order + turn) % 2 == 1) std::reverse(ring.begin(), ring.end());
        input.push_back(std::move(ring));
        expected.push_back(depth[i]);
      }
      const Silhouette nested = make_silhouette(input, "test");
      CHECK(nested.depth == expected);
      // Parity of the rings, one by one, where no border is near.
      for (double x = -0.875; x < 25; x += 1.75) {
        for (double y = -0.625; y < 18; y += 1.25) {
          const Point2 p = Point2::from_doubles(x, y);
          bool inside = false;
          bool clear = true;
          for (const Ring& ring : input) {
            const Side side = locate(ring, p);
            clear = clear && side != Side::kBoundary;
            if (side == Side::kInside) inside = !inside;
          }
          if (clear) CHECK((locate(nested, p) == Side::kInside) == inside);
        }
      }
    }
  }
  CHECK_THROWS_AS(make_silhouette({rings[0], rings[5]}, "test"), nef::InputError);
}

TEST_CASE("Orientation is exact where doubles are not") {
  // Points on a line of slope one third: rounding puts each double off the line.
  const Point2 a(Rational(1, 3), Rational(1, 9));
  const Point2 b(Rational(4, 3), Rational(4, 9));
  const Point2 c(Rational(1000000, 3), Rational(1000000, 9));
  CHECK(orientation(a, b, c) == 0);
  const Point2 above(c.x(), c.y() + Rational(1, Integer("1000000000000000000000000")));
  CHECK(orientation(a, b, above) == 1);
  CHECK(orientation(b, a, above) == -1);
  CHECK(on_segment(a, c, b));
  CHECK_FALSE(on_segment(a, b, c));
}

}  // namespace
}  // namespace nef::visual_hull
