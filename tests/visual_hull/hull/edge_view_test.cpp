// SPDX-License-Identifier: Apache-2.0
//
// Images of points in doubles against the exact ones, where the error is worst.
#include "apps/visual_hull/viewing_edges/edge_view.h"

#include "tests/support/numbers/worst_error.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

using nef::test::Genes;
using nef::test::part_of;
using nef::test::worst;

TEST_CASE("The image of a spot: its error holds where it is worst", "[bounds]") {
  const Silhouette silhouette = make_silhouette({testing::rectangle(-1, -1, 1, 1)}, "");
  for (const unsigned bits : {54U, 62U}) {
    const auto part = [&](const Genes& g) {
      Matrix34 m;
      for (std::size_t i = 0; i < 12; ++i) m[i / 4][i % 4] = Rational(g[i]) / g[15];
      m[2][3] = 4 * abs(m[2][3]);
      const Camera camera("", m);
      Rational3 point;
      Spot spot;
      Double3 reach{};
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = Rational(g[12 + k]) / g[15];
        spot.at[k] = nef::nearest_double(point[k]);
        spot.error = std::max(spot.error, std::abs(spot.at[k]) * 0x1p-53);
        reach[k] = std::abs(spot.at[k]) * (1 + 0x1p-52);
      }
      std::vector<ViewingEdge> edges(silhouette.vertex_count());
      const auto view = EdgeView::make(camera, silhouette, 0, 0, reach, edges);
      const std::optional<Seen> seen = view ? view->project(spot) : std::nullopt;
      if (!seen) return 0.0;
      const Projection exact = camera.project(point);
      return std::max(part_of(nef::exact_rational(seen->u) - exact.x / exact.depth, seen->error),
                      part_of(nef::exact_rational(seen->v) - exact.y / exact.depth, seen->error));
    };
    const double found = worst(bits, 16, bits, part, 10);
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 64);
  }
}

}  // namespace
}  // namespace nef::visual_hull
