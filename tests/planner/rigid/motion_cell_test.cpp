// SPDX-License-Identifier: Apache-2.0
//
// Images of points in a part of a motion, in doubles, against the exact ones, where the error is worst.
#include "apps/planner/rigid/motion_cell.h"

#include <catch2/catch.hpp>

#include "tests/support/numbers/worst_error.h"

namespace nef::planner::test::motion_cell {
namespace {

using nef::test::Genes;
using nef::test::part_of;
using nef::test::point_of_genes;
using nef::test::worst;

RigidPose pose_of_genes(const Genes& g, std::size_t first) {
  RigidPose pose;
  pose.position = point_of_genes(g, first, 17);
  for (std::size_t k = 0; k < 4; ++k) pose.quaternion[k] = Rational(g[first + 3 + k]) / g[18];
  return pose;
}

TEST_CASE("Images in a part of a motion: the bound holds where the error is worst", "[rigid][bounds]") {
  for (const unsigned bits : {54U, 62U}) {
    const auto part = [](const Genes& g) {
      const RigidMotion motion(pose_of_genes(g, 0), pose_of_genes(g, 7));
      const MotionCells cells(motion);
      const std::array<Rational3, 1> p{point_of_genes(g, 14, 17)};
      const MotionCell cell = cells.part(0.125, 0.75);
      if (cell.wide) return 0.0;
      const double bound = MotionCell::kImageError * (to_vector(p[0]).lpNorm<1>() + cell.position_reach);
      const std::vector<Rational3> exact = cells.exact_images(0.125, 0.75, p);
      std::size_t count = 0;
      double largest = 0;
      cell.for_each_image(to_vector(p[0]), [&](const Vector3d& image) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational off = exact_rational(image[static_cast<Eigen::Index>(k)]) - exact[count][k];
          largest = std::max(largest, part_of(off, bound));
        }
        ++count;
      });
      return count == exact.size() ? largest : 2;
    };
    const double found = worst(bits, 19, bits, part, 5);
    INFO(bits << " bits: " << found);
    CHECK(found <= 1);
    CHECK(found > 1.0 / 256);
  }
}

}  // namespace
}  // namespace nef::planner::test::motion_cell
