// SPDX-License-Identifier: Apache-2.0
//
// Cameras from silhouettes against rendered truth: how near they come, what the hull of them is, what is named, and
// that nothing moves without a reason.
#include "apps/visual_hull/refine/refine.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <opencv2/imgproc.hpp>

#include "nef/base/error.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/visual_hull/refine/camera_difference.h"
#include "tests/visual_hull/refine/rendered.h"

namespace nef::visual_hull {
namespace {

using refine::Fault;
using refine::Model;
using refine::Refinement;
using testing::cameras_by;
using testing::cut_lowest;
using testing::Difference;
using testing::difference;
using testing::disturbed;
using testing::Ellipsoid;
using testing::generic_object;
using testing::refined_cameras;
using testing::rendered_set;
using testing::ring;
using testing::Set;
using testing::Shot;
using testing::standing_off;

TEST_CASE("Cameras half a degree, 5 pixels and 1 % off come within .4 pixels of the truth") {
  for (std::uint64_t seed = 1; seed <= nef::test::fewer(2); ++seed) {
    const Set set = rendered_set(generic_object(seed), ring(10, false));
    const std::vector<Shot> given = disturbed(set.truth, 0.5, 5, 1.01, 7 * seed);
    const Refinement result = refined_cameras(set, given);
    const Difference before = difference(cameras_by(given), set.truth);
    const Difference after = difference(cameras_by(result), set.truth);
    INFO("seed " << seed << ": " << before.pixels << " to " << after.pixels << " px");
    CHECK(before.pixels > 3);
    CHECK(result.accepted);
    CHECK(result.model == Model::kViews);
    CHECK(after.pixels < 0.4);
    CHECK(result.after.mean < result.before.mean / 10);
    CHECK(result.held_out_after.mean < result.held_out_before.mean / 10);
    // Lengths are those of the given cameras, so volumes are compared in the scale of the truth.
    const double volume = testing::volume_of_hull(set, cameras_by(result)) / std::pow(after.scale, 3);
    CHECK(volume == Approx(testing::volume_of_hull(set, cameras_by(set.truth))).epsilon(0.005));
  }
}

TEST_CASE("Cameras of a turntable are found as such, and ten times as well") {
  const Set set = rendered_set(generic_object(1), ring(12, true));
  const Refinement result = refined_cameras(set, disturbed(set.truth, 0.5, 5, 1.01, 7));
  CHECK(result.model == Model::kTurntable);
  CHECK(difference(cameras_by(result), set.truth).pixels < 0.1);
  CHECK(result.focal_factor == Approx(1 / 1.01).epsilon(0.005));
}

TEST_CASE("An axis that is off is corrected by four parameters") {
  const Set set = rendered_set(generic_object(5), ring(12, true));
  std::vector<Shot> given = set.truth;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, 0.5, 1).normalized()).toRotationMatrix();
  const Eigen::Vector3d middle(0, 0, 4);
  for (Shot& shot : given) {
    shot.r = turn * shot.r;
    shot.t = turn * (shot.t - middle) + middle + Eigen::Vector3d(0.02, 0, 0);
  }
  const Refinement result = refined_cameras(set, given);
  CHECK(result.model == Model::kTurntable);
  CHECK(difference(cameras_by(result), set.truth).pixels < 0.1);
}

TEST_CASE("Cameras that are right stay as they are, to the last digit") {
  for (const bool turntable : {false, true}) {
    const Set set = rendered_set(generic_object(3), ring(12, turntable));
    const Refinement result = refined_cameras(set, set.truth);
    CHECK_FALSE(result.accepted);
    CHECK(result.model == Model::kNone);
    CHECK(result.before.mean < 0.05);
    CHECK(result.after.mean == result.before.mean);
    const std::vector<Camera> given = cameras_by(set.truth);
    for (std::size_t i = 0; i < given.size(); ++i) {
      CHECK(result.views[i].camera.matrix() == given[i].matrix());
      CHECK(result.views[i].fault == Fault::kNone);
    }
  }
}

TEST_CASE("One camera that stands off among right ones is named and put back") {
  for (std::uint64_t seed = 1; seed <= nef::test::fewer(2); ++seed) {
    const bool turned = seed % 2 == 0;
    const Set set = rendered_set(generic_object(seed), ring(12, false));
    const std::size_t wrong = seed * 5 % 12;
    std::vector<Shot> given = set.truth;
    given[wrong] = standing_off(given[wrong], turned, seed);
    const Refinement result = refined_cameras(set, given);
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      CHECK(result.views[i].fault == (i == wrong ? Fault::kCamera : Fault::kNone));
    }
    const Difference after = difference(cameras_by(result), set.truth, {wrong});
    CHECK(after.pixels < 0.4);
    CHECK(after.views[wrong] < 0.8);
  }
}

TEST_CASE("A mask that has lost a part is named, and does not pull the other cameras") {
  for (std::uint64_t seed = 1; seed <= nef::test::fewer(3); seed += 2) {
    Set set = rendered_set(generic_object(seed), ring(12, false));
    const std::size_t wrong = seed * 5 % 12;
    cut_lowest(set, wrong, 0.15);
    const bool off = seed == 3;  // cameras that are off, too
    const Refinement result = refined_cameras(set, off ? disturbed(set.truth, 0.5, 5, 1, 3) : set.truth);
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      CHECK(result.views[i].fault == (i == wrong ? Fault::kMask : Fault::kNone));
    }
    const Difference after = difference(cameras_by(result), set.truth, {wrong});
    CHECK(after.pixels < 0.4);
    CHECK(result.accepted == off);
    if (off) CHECK(after.views[wrong] < 1.5);
  }
}

TEST_CASE("A view is placed where it was, wherever the search begins and whatever its mask has lost") {
  Set set = rendered_set(generic_object(3), ring(12, false));
  cut_lowest(set, 3, 0.15);
  std::vector<refine::MovingCamera> cameras;
  std::vector<refine::Outline> outlines;
  for (std::size_t i = 0; i < set.truth.size(); ++i) {
    cameras.emplace_back(set.truth[i].k, set.truth[i].r, set.truth[i].t);
    outlines.push_back(refine::make_outline(set.silhouettes[i], {}, {}, PixelOrigin::kCenter, 120));
  }
  const refine::MovingCamera truth = cameras[3];
  std::vector<std::uint8_t> used(cameras.size(), 1);
  used[3] = 0;
  const std::vector<Eigen::Vector3d> points = refine::ball_points({0, 0, 0}, testing::kObjectRadius);
  for (std::uint64_t seed = 1; seed <= nef::test::fewer(3); ++seed) {
    const Shot start = disturbed(set.truth, 1, 5, 1, seed)[3];
    cameras[3] = refine::MovingCamera(start.k, start.r, start.t);
    CHECK(refine::image_distance(cameras[3], truth, points) > 4);
    CHECK(refine::image_distance(refine::resect(cameras, outlines, used, 3, {}), truth, points) < 1.5);
  }
}

TEST_CASE("What a ball does not determine is said") {
  const std::vector<Ellipsoid> ball{{{0, 0, 0}, 1.5 * Eigen::Matrix3d::Identity()}};
  const Set set = rendered_set(ball, ring(12, false));
  const Refinement result = refined_cameras(set, disturbed(set.truth, 0.5, 5, 1.01, 3));
  CHECK(result.undetermined == std::vector<std::string>{"focal length", "poses of 12 views"});
  const Set generic = rendered_set(generic_object(2), ring(12, false));
  const Refinement all = refined_cameras(generic, disturbed(generic.truth, 0.5, 5, 1.01, 3));
  CHECK(all.undetermined.empty());
}

// A ball leaves open how cameras stand around it: without a word on how good they are, they end pixels away.
TEST_CASE("Cameras whose error is known stay as near as that where outlines do not say more") {
  constexpr double kError = 0.5;
  const std::vector<Ellipsoid> ball{{{0, 0, 0}, 1.5 * Eigen::Matrix3d::Identity()}};
  const Set set = rendered_set(ball, ring(12, false));
  const std::vector<Shot> given = disturbed(set.truth, 0.06, 0.5, 1.001, 3);
  const double before = difference(cameras_by(given), set.truth).pixels;
  CHECK(before < 2 * kError);
  const Refinement held = refined_cameras(set, given, 1, kError);
  CHECK(difference(cameras_by(held), set.truth).pixels < 1.1 * before);
  for (const refine::RefinedView& view : held.views) CHECK(view.moved_px < 3 * kError);
  // Where outlines say more, they are heard: cameras come nearer than what they were known to.
  const Set generic = rendered_set(generic_object(2), ring(12, false));
  const std::vector<Shot> off = disturbed(generic.truth, 0.12, 1, 1.002, 3);
  const Refinement better = refined_cameras(generic, off, 1, 1.0);
  CHECK(better.accepted);
  CHECK(difference(cameras_by(better), generic.truth).pixels < difference(cameras_by(off), generic.truth).pixels / 3);
}

TEST_CASE("Refined cameras do not depend on threads") {
  const Set set = rendered_set(generic_object(6), ring(10, false));
  const std::vector<Shot> given = disturbed(set.truth, 0.5, 5, 1.01, 5);
  const std::vector<Camera> one = cameras_by(refined_cameras(set, given, 1));
  const std::vector<Camera> three = cameras_by(refined_cameras(set, given, 3));
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i].matrix() == three[i].matrix());
}

TEST_CASE("A turntable is found from its silhouettes alone, whichever way it turns") {
  for (std::uint64_t seed = 1; seed <= nef::test::fewer(2); ++seed) {
    std::vector<Shot> shots = ring(10, true, seed == 1 ? 400 : 900, seed == 1 ? 3 : 6);
    if (seed == 2) std::reverse(shots.begin() + 1, shots.end());
    const Eigen::Matrix3d roll = Eigen::AngleAxisd(0.14, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (Shot& shot : shots) {
      shot.r = roll * shot.r;
      shot.t = roll * shot.t;
    }
    const Set set = rendered_set(generic_object(seed), shots);
    std::vector<refine::GivenView> views;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      views.push_back({std::to_string(i), Camera(), &set.silhouettes[i], {}, {}});
    }
    const ImageSize size{testing::kWidth, testing::kHeight};
    const Refinement result = refine::refine_cameras(views, {PixelOrigin::kCenter, size}, {});
    CHECK(result.found);
    CHECK(result.accepted);
    CHECK(result.model == Model::kTurntable);
    CHECK(difference(cameras_by(result), set.truth).pixels < 0.3);
    CHECK(result.focal == Approx(shots[0].k(0, 0)).epsilon(0.01));
  }
}

TEST_CASE("Two views are too few to refine") {
  const Set set = rendered_set(generic_object(1), ring(2, true));
  CHECK_THROWS_AS(refined_cameras(set, set.truth), nef::InputError);
}

}  // namespace
}  // namespace nef::visual_hull
