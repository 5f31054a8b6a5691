// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/background_view.h"

#include <catch2/catch.hpp>

#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using testing::rectangle;

TEST_CASE("A view that carves its background keeps the image of the box but for the background") {
  const Camera camera;  // at the origin, along +z
  const WorldBox box{{-3, -2, 1}, {4, 2, 5}};
  const Silhouette background = nest({rectangle(1, -1, 2, 1)}, {});
  const std::optional<Silhouette> kept = beside_background(camera, background, box, {});
  REQUIRE(kept);
  REQUIRE(kept->rings.size() == 2);
  CHECK(kept->hole_count() == 1);
  for (const auto& [x, y] : {std::array{-3, -2}, {4, 2}, {-3, 2}, {0, 0}}) {
    CHECK(locate(*kept, Point2::from_doubles(x, y)) == Side::kInside);  // at depth 1
  }
  CHECK(locate(*kept, Point2::from_doubles(1.5, 0)) == Side::kOutside);
  CHECK(locate(*kept, Point2::from_doubles(2, 0)) == Side::kBoundary);
  // An island in the background is kept.
  const Silhouette around = nest({rectangle(-1, -1, 1, 1), rectangle(-0.5, -0.5, 0.5, 0.5)}, {});
  const std::optional<Silhouette> island = beside_background(camera, around, box, {});
  REQUIRE(island);
  CHECK(locate(*island, Point2()) == Side::kInside);
  CHECK(locate(*island, Point2::from_doubles(0.75, 0)) == Side::kOutside);
}

TEST_CASE("A background beyond the image of the box is a hole all the same") {
  const WorldBox box{{-1, -1, 4}, {1, 1, 5}};
  const std::optional<Silhouette> kept = beside_background(Camera(), nest({rectangle(10, 10, 20, 20)}, {}), box, {});
  REQUIRE(kept);
  CHECK(check(*kept).empty());
  CHECK(kept->hole_count() == 1);
}

TEST_CASE("Of a box that is not wholly in front nothing is said") {
  const Silhouette background = nest({rectangle(1, -1, 2, 1)}, {});
  CHECK_FALSE(beside_background(Camera(), background, {{-1, -1, 0}, {1, 1, 1}}, {}));
  CHECK_FALSE(beside_background(Camera(), background, {{-1, -1, -2}, {1, 1, 1}}, {}));
}

}  // namespace
}  // namespace nef::visual_hull
