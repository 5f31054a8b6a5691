// SPDX-License-Identifier: Apache-2.0
//
// Moments against closed forms and against sums over unit cells.
#include "nef/query/moments.h"

#include <cmath>

#include "nef/base/error.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/laws/laws.h"
#include "tests/support/shapes/oblique_rotation.h"

namespace nef {
namespace {

using test::set;

// Integrals over the unit cell with its lowest corner at (x, y, z).
void add_cell(Moments& sum, const std::array<int, 3>& low) {
  sum.volume += 1;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.first[i] += Rational(2 * low[i] + 1, 2);
    for (std::size_t j = 0; j < 3; ++j) {
      // Of t^2 from l to l + 1, or of the product of two independent coordinates.
      sum.second[i][j] += i == j ? Rational(3 * low[i] * low[i] + 3 * low[i] + 1, 3)
                                 : Rational(2 * low[i] + 1, 2) * Rational(2 * low[j] + 1, 2);
    }
  }
}

bool same_moments(const Moments& a, const Moments& b) {
  return a.volume == b.volume && a.first == b.first && a.second == b.second;
}

}  // namespace

TEST_CASE("moments of solids of cells") {
  CHECK(rc::check("cells", [] {
    std::array<std::array<std::array<bool, 4>, 4>, 4> full{};
    Polyhedron whole;
    const int boxes = *rc::gen::inRange(1, 5);
    for (int b = 0; b < boxes; ++b) {
      std::array<int, 3> low{};
      std::array<int, 3> high{};
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = *rc::gen::inRange(0, 4);
        high[i] = *rc::gen::inRange(low[i] + 1, 5);
      }
      const bool add = b == 0 || *rc::gen::inRange(0, 3) > 0;
      const Polyhedron box = make_box({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
      whole = add ? unite(whole, box) : subtract(whole, box);
      for (int x = low[0]; x < high[0]; ++x) {
        for (int y = low[1]; y < high[1]; ++y) {
          for (int z = low[2]; z < high[2]; ++z) {
            full[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)][static_cast<std::size_t>(z)] = add;
          }
        }
      }
    }
    Moments truth;
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) {
        for (int z = 0; z < 4; ++z) {
          if (full[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)][static_cast<std::size_t>(z)]) {
            add_cell(truth, {x - 2, y + 1, z});
          }
        }
      }
    }
    const Polyhedron moved = transform(whole, AffineMap::translate({-2, 1, 0}));
    const std::optional<Moments> answer = moments(moved);
    RC_ASSERT(answer.has_value());
    RC_ASSERT(same_moments(*answer, truth));
    // Sheared: x' = M x has the second moments M S M^T |det M|.
    AffineMap map = AffineMap::identity();
    map.linear = {{{2, 1, 0}, {0, 1, Rational(1, 3)}, {0, 0, -1}}};
    const std::optional<Moments> image = moments(transform(moved, map));
    for (std::size_t i = 0; i < 3; ++i) {
      Rational first = 0;
      for (std::size_t k = 0; k < 3; ++k) first += 2 * map.linear[i][k] * truth.first[k];
      RC_ASSERT(image->first[i] == first);
      for (std::size_t j = 0; j < 3; ++j) {
        Rational second = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          for (std::size_t l = 0; l < 3; ++l) second += 2 * map.linear[i][k] * truth.second[k][l] * map.linear[j][l];
        }
        RC_ASSERT(image->second[i][j] == second);
      }
    }
  }));
}

TEST_CASE("moments in closed form") {
  const std::optional<Moments> tetrahedron = moments(set("hull(0,0,0, 1,0,0, 0,1,0, 0,0,1)"));
  REQUIRE(tetrahedron);
  CHECK(tetrahedron->volume == Rational(1, 6));
  CHECK(*tetrahedron->centroid() == Rational3{Rational(1, 4), Rational(1, 4), Rational(1, 4)});
  CHECK(tetrahedron->second[0][0] == Rational(1, 60));
  CHECK(tetrahedron->second[0][1] == Rational(1, 120));
  // A brick a x b x c about its centre: V (b^2 + c^2) / 12.
  const std::optional<Moments> brick = moments(set("box(1,1,1,3,5,7)"));
  CHECK(*brick->centroid() == Rational3{2, 3, 4});
  const Rational3x3 inertia = brick->inertia({2, 3, 4});
  CHECK(inertia[0][0] == 48 * (16 + 36) / 12);
  CHECK(inertia[1][1] == 48 * (4 + 36) / 12);
  CHECK(inertia[2][2] == 48 * (4 + 16) / 12);
  CHECK(inertia[0][1] == 0);
  const PrincipalInertia axes = principal_inertia(*brick);
  CHECK(axes.moments[0] == Approx(80));
  CHECK(axes.moments[1] == Approx(160));
  CHECK(axes.moments[2] == Approx(208));
  CHECK(std::fabs(axes.axes[0][2]) == Approx(1));
  // Turned, it has the same principal moments, and the axes turn with it.
  const AffineMap turn = AffineMap::rotate({1, 2, 2}, 40);
  const PrincipalInertia turned = principal_inertia(*moments(transform(set("box(1,1,1,3,5,7)"), turn)));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(turned.moments[i] == Approx(axes.moments[i]));
    double along = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      double image = 0;
      for (std::size_t k = 0; k < 3; ++k) image += turn.linear[j][k].get_d() * axes.axes[i][k];
      along += image * turned.axes[i][j];
    }
    CHECK(std::fabs(along) == Approx(1));
  }
  // Walls and wires weigh nothing; what has no volume has no centre; what is infinite has no moments.
  CHECK(same_moments(*moments(set("box(1,1,1,3,5,7) + segment(0,0,0,9,9,9) - point(2,2,2)")), *brick));
  CHECK_FALSE(moments(set("box(0,0,0,1,1,0)"))->centroid());
  CHECK_THROWS_AS(principal_inertia(*moments(Polyhedron())), InputError);
  CHECK_FALSE(moments(set("halfspace(0,0,1,0)")));
  CHECK_FALSE(moments(set("!box(0,0,0,1,1,1)")));
}

TEST_CASE("Measures in doubles are off by no more than they say") {
  const AffineMap away = AffineMap::translate({Rational(100001, 3), Rational(200003, 7), Rational(-50, 11)});
  const Polyhedron parts =
      unite(subtract(make_box({0, 0, 0}, {7, 5, 3}), make_box({1, 1, 1}, {2, 2, 9})), make_box({8, 0, 0}, {9, 1, 1}));
  for (const Polyhedron& some : {parts, transform(parts, test::oblique_rotation()),
                                 transform(parts, away.after(test::oblique_rotation())), boundary(parts)}) {
    const MeasuredVolume content = approximate_volume(some);
    CHECK(abs(*volume(some) - exact_rational(content.value)) <= exact_rational(content.error));
    CHECK(content.error < 1e-6);
    const std::optional<MeasuredMoments> measured = approximate_moments(some);
    const Moments truth = *moments(some);
    REQUIRE(measured.has_value() == (truth.volume != 0));
    if (!measured) continue;
    const Rational3 centre = *truth.centroid();
    const Rational3x3 inertia = truth.inertia(centre);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(abs(centre[i] - exact_rational(measured->centroid[i])) <= exact_rational(measured->centroid_error));
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(abs(inertia[i][j] - exact_rational(measured->inertia[i][j])) <= exact_rational(measured->inertia_error));
      }
    }
    CHECK(measured->centroid_error < 1e-6);
    CHECK(measured->inertia_error < 1e-3);
  }
  CHECK(std::isinf(approximate_volume(complement(parts)).value));
  CHECK_FALSE(approximate_moments(complement(parts)).has_value());
  // A plane is unbounded, and the rest is not.
  const Polyhedron with_plane = unite(parts, boundary(make_halfspace(0, 0, 1, 20, true)));
  const MeasuredVolume content = approximate_volume(with_plane);
  CHECK(abs(*volume(parts) - exact_rational(content.value)) <= exact_rational(content.error));
  CHECK(std::isinf(approximate_area(with_plane).value));
}

}  // namespace nef
