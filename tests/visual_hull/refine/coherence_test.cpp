// SPDX-License-Identifier: Apache-2.0
//
// The parts of the refinement against arithmetic: distances to outlines, cameras taken apart, derivatives against
// differences.
#include "apps/visual_hull/refine/coherence.h"

#include <catch2/catch.hpp>

#include "apps/visual_hull/refine/turntable_axis.h"
#include "tests/visual_hull/helpers.h"
#include "tests/visual_hull/refine/rendered.h"

namespace nef::visual_hull {
namespace {

using refine::Coherence;
using refine::MovingCamera;
using refine::Vector6;
using testing::disturbed;
using testing::generic_object;
using testing::rendered_set;
using testing::ring;
using testing::Set;
using testing::Shot;

TEST_CASE("The distance to the outline of a disc of pixels is that to the circle") {
  cv::Mat mask(200, 200, CV_8U, cv::Scalar(0));
  const Eigen::Vector2d middle(97.3, 103.8);
  const double radius = 60.4;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      if ((Eigen::Vector2d(x, y) - middle).norm() <= radius) mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  const Silhouette silhouette = testing::pixel_silhouette(mask);
  const refine::Outline outline = refine::make_outline(silhouette, {}, {}, PixelOrigin::kCenter, 120);
  CHECK(outline.samples.size() == Approx(120).margin(2));
  std::size_t held_out = 0;
  for (const refine::OutlineSample& sample : outline.samples) {
    CHECK((sample.point - middle).norm() == Approx(radius).margin(0.4));
    held_out += sample.held_out ? 1 : 0;
  }
  CHECK(held_out == Approx(60).margin(6));
  for (const double far : {-30.0, -10.0, -3.0, 3.0, 10.0, 100.0}) {
    for (const double angle : {0.1, 1.7, 2.9, 4.4}) {
      const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
      Eigen::Vector2d g;
      const double value = outline.distance.value(middle + (radius + far) * out, g);
      // Far away the nearest pixel counts, not the mean of many; beyond the grid it is that way and then on.
      CHECK(value == Approx(-far).margin(far > 50 ? 10 : std::abs(far) > 5 ? 0.8 : 0.4));
      CHECK(g.dot(out) == Approx(-1).margin(0.15));
      CHECK(value == outline.distance.value(middle + (radius + far) * out));
    }
  }
}

TEST_CASE("What the frame of an image cuts is not measured there") {
  cv::Mat mask(100, 120, CV_8U, cv::Scalar(0));
  mask(cv::Rect(40, 0, 30, 50)).setTo(255);
  const Silhouette silhouette = testing::pixel_silhouette(mask);
  const refine::Outline outline = refine::make_outline(silhouette, {120, 100}, {}, PixelOrigin::kCenter, 120);
  for (const refine::OutlineSample& sample : outline.samples) CHECK(sample.point.y() > 1);
  // Beyond the frame nobody knows: the object may go on.
  CHECK(outline.distance.value({55, -50}) > 10);
  CHECK(outline.distance.value({20, -50}) < -10);
  CHECK(outline.distance.value({55, 80}) < -25);
}

TEST_CASE("Matrices are taken apart and put together again, mirrored ones, too") {
  for (const double mirror : {1.0, -1.0}) {
    Shot shot = ring(7, false)[3];
    shot.k(0, 1) = 3;
    shot.k.row(1) *= mirror;
    const testing::Matrix34d given = 2.5 * shot.matrix();
    const MovingCamera camera(make_view("v", given).camera);
    CHECK((camera.matrix() - given).norm() < 1e-9 * given.norm());
    CHECK(camera.rotation().determinant() == Approx(1));
    const Eigen::Vector3d p(0.1, -0.3, 0.2);
    CHECK((camera.seen(camera.inward(p)) - shot.seen(p)).norm() < 1e-9);
    CHECK((camera.outward(2.0 * camera.ray(shot.seen(p))) - camera.centre())
              .normalized()
              .dot((p - camera.centre()).normalized()) == Approx(1));
  }
}

TEST_CASE("The derivative of the coherence is that of its differences") {
  const Set set = rendered_set(generic_object(4), ring(8, false));
  const std::vector<Shot> given = disturbed(set.truth, 0.5, 5, 1.01, 9);
  std::vector<MovingCamera> cameras;
  std::vector<refine::Outline> outlines;
  for (std::size_t i = 0; i < given.size(); ++i) {
    cameras.emplace_back(given[i].k, given[i].r, given[i].t);
    outlines.push_back(refine::make_outline(set.silhouettes[i], {}, {}, PixelOrigin::kCenter, 40));
  }
  const refine::Ball ball = refine::object_ball(cameras, outlines);
  const refine::Measure what{std::vector<std::uint8_t>(8, 1), refine::Pieces::kAll, refine::Search::kDeep};
  std::vector<std::vector<Coherence>> values;
  refine::measure(cameras, outlines, ball, what, values, {});
  std::vector<Eigen::Vector3d> pivots;
  for (const MovingCamera& camera : cameras) pivots.push_back(camera.inward(ball.centre));
  constexpr double kStep = 2e-4;
  std::size_t compared = 0;
  std::size_t agree = 0;
  for (std::size_t moved = 0; moved < cameras.size(); ++moved) {
    for (int k = 0; k < 7; ++k) {
      std::vector<std::vector<Coherence>> up = values;
      std::vector<std::vector<Coherence>> down = values;
      for (const double sign : {1.0, -1.0}) {
        std::vector<MovingCamera> changed = cameras;
        if (k == 6) {
          for (MovingCamera& camera : changed) camera.zoom(sign * kStep);
        } else {
          changed[moved].move(sign * kStep * Vector6::Unit(k), pivots[moved]);
        }
        refine::measure(changed, outlines, ball, what, sign > 0 ? up : down, {});
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t s = 0; s < values[i].size(); ++s) {
          if (values[i][s].value > 0) continue;
          const refine::CoherenceRow row = refine::derivative(cameras, outlines, pivots, i, s, values[i][s]);
          double expected = k == 6 ? row.by_zoom : 0;
          for (std::size_t v = 0; k < 6 && v < row.count; ++v) {
            if (row.view[v] == moved) expected += row.by_motion[v][k];
          }
          const double found = (up[i][s].value - down[i][s].value) / (2 * kStep);
          ++compared;
          // Between kinks: the field is bilinear, and the best point may leap.
          if (std::abs(found - expected) < 20 + 0.15 * std::abs(expected)) ++agree;
        }
      }
    }
  }
  CHECK(compared > 3000);
  CHECK(static_cast<double>(agree) > 0.95 * static_cast<double>(compared));
}

TEST_CASE("The axis of a turntable is found, and rings of other cameras have none") {
  std::vector<MovingCamera> cameras;
  for (const Shot& shot : ring(12, true)) cameras.emplace_back(shot.k, shot.r, shot.t);
  const auto axis = refine::turntable_axis(cameras, 0.01, 0.01);
  REQUIRE(axis);
  CHECK(std::abs(axis->direction.z()) == Approx(1));
  CHECK(axis->point.head<2>().norm() < 1e-9);
  const auto again = refine::as_turntable(cameras, *axis, true);
  REQUIRE(again);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    CHECK((again->at(i).matrix() - cameras[i].matrix()).norm() < 1e-6 * cameras[i].matrix().norm());
  }
  std::vector<MovingCamera> other;
  for (const Shot& shot : ring(12, false)) other.emplace_back(shot.k, shot.r, shot.t);
  CHECK_FALSE(refine::turntable_axis(other, 0.04, 0.04));
}

}  // namespace
}  // namespace nef::visual_hull
