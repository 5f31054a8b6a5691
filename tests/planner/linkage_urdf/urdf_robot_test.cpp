// SPDX-License-Identifier: Apache-2.0
//
// Linkages of URDF files: links, joints and shapes as the file says, places by trigonometry, and one line for each
// mistake.
#include "apps/planner/linkage_urdf/urdf_robot.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/planner/linkage_ompl/linkage_validity.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/paths.h"

namespace nef::planner::test::urdf_files {
namespace {

std::string crane(const std::string& extension) { return source_folder() + "/data/planner/linkage/crane." + extension; }

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

RigidBody box_body(const Rational3& low, const Rational3& high) { return RigidBody::of_set(make_box(low, high)); }

}  // namespace

TEST_CASE("without urdfdom a URDF file is refused, and the message says what to install") {
  if (reads_urdf()) return;
  CHECK_THROWS_WITH(read_urdf(crane("urdf")), Catch::Contains("liburdfdom-dev"));
}

TEST_CASE("a crane of a URDF file: its links, its joints and its shapes") {
  if (!reads_urdf()) return;
  const UrdfRobot robot = read_urdf(crane("urdf"), crane("srdf"));
  CHECK(robot.name == "crane");
  REQUIRE(robot.links.size() == 5);
  using Kind = LinkageJoint::Kind;
  CHECK(robot.links[0].name == "ground");
  CHECK(robot.links[1].joint_name == "slew");
  CHECK(robot.links[1].joint.kind == Kind::kRevolute);
  CHECK(robot.links[1].upper == Approx(M_PI));
  CHECK(robot.links[2].joint.axis == Vector3d(0, -1, 0));
  CHECK(robot.links[2].lower == -1);
  CHECK(robot.links[3].joint.kind == Kind::kPrismatic);
  CHECK(robot.links[3].joint.parent == 2);
  CHECK(robot.links[4].joint.kind == Kind::kFixed);
  CHECK(robot.links[4].joint.turn[3] == Approx(std::sin(0.25)));
  CHECK(equal(*robot.links[2].shape,
              make_box({0, Rational(-1, 8), Rational(-1, 8)}, {2, Rational(1, 8), Rational(1, 8)})));
  // The hook's mesh is scaled: 2 x 2 x 4, eight, eight and four times smaller.
  CHECK(equal(*robot.links[4].shape,
              make_box({Rational(-1, 8), Rational(-1, 8), -1}, {Rational(1, 8), Rational(1, 8), 0})));
  const std::array<std::size_t, 2> hook_and_boom{4, 2};
  CHECK(std::count(robot.allowed.begin(), robot.allowed.end(), hook_and_boom) == 1);
  CHECK(robot.linkage().dimension() == 3);
}

TEST_CASE("a crane's motions are certified, by OMPL's validator, too") {
  if (!reads_urdf()) return;
  using Status = MotionVerdict::Status;
  const UrdfRobot robot = read_urdf(crane("urdf"), crane("srdf"));
  // The jib ends 2.25 + reach from the mast's axis, and the hook hangs there.
  const LinkageChecker checker(robot.linkage(), box_body({3, -1, 1}, {4, 1, 3}));
  const auto status = [&](std::vector<double> from, std::vector<double> to) { return checker.check(from, to).status; };
  CHECK(status({0.5 * M_PI, 0, 1}, {M_PI, 0, 1}) == Status::kFree);
  CHECK(status({0.5 * M_PI, 0, 1}, {-0.5 * M_PI, 0, 1}) == Status::kCollides);  // sweeps through the box at slew 0
  CHECK(status({0, 0, 0}, {0, 0, 0.5}) == Status::kFree);  // its hook ends at 2.75 and a half width
  CHECK(status({0, 0, 0}, {0, 0, 1}) == Status::kCollides);
  // Of itself: the hook, below a boom that points down, meets the mast or the ground.
  CHECK(checker.check(std::vector<double>{1.5, -1, 0.5}).status == Status::kCollides);

  const auto space = std::make_shared<ompl::base::RealVectorStateSpace>(3);
  ompl::base::RealVectorBounds bounds(3);
  for (unsigned i = 0, value = 0; i < robot.links.size(); ++i) {
    if (i == 0 || robot.links[i].joint.kind == LinkageJoint::Kind::kFixed) continue;
    bounds.setLow(value, robot.links[i].lower);
    bounds.setHigh(value++, robot.links[i].upper);
  }
  space->setBounds(bounds);
  const auto si = std::make_shared<ompl::base::SpaceInformation>(space);
  const auto shared = std::make_shared<const LinkageChecker>(checker);
  si->setStateValidityChecker(std::make_shared<LinkageStateValidityChecker>(si, shared));
  si->setMotionValidator(std::make_shared<LinkageMotionValidator>(si, shared));
  si->setup();
  const auto moves = [&](const std::vector<double>& from, const std::vector<double>& to) {
    ompl::base::ScopedState<> a(space);
    ompl::base::ScopedState<> b(space);
    a = from;
    b = to;
    return si->checkMotion(a.get(), b.get());
  };
  CHECK_FALSE(moves({0.5 * M_PI, 0, 1}, {-0.5 * M_PI, 0, 1}));
  CHECK(moves({0.5 * M_PI, 0, 1}, {0.5 * M_PI, 0, 0}));  // drawn in, it passes
  CHECK(moves({0.5 * M_PI, 0, 0}, {-0.5 * M_PI, 0, 0}));
  CHECK(moves({-0.5 * M_PI, 0, 0}, {-0.5 * M_PI, 0, 1}));
  CHECK_FALSE(moves({-0.5 * M_PI, 0, 1}, {-0.5 * M_PI, 0, 2}));  // beyond the joint's limit
}

TEST_CASE("mistakes in URDF and SRDF files are told in one line") {
  if (!reads_urdf()) return;
  const Folder folder;
  const std::string box = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
  const auto robot = [&](const std::string& joint, const std::string& shape) {
    return "<robot name='r'><link name='a'>" + box + "</link><link name='b'>" + shape + "</link>" + joint + "</robot>";
  };
  const auto joint = [](const std::string& type, const std::string& more) {
    return "<joint name='j' type='" + type + "'><parent link='a'/><child link='b'/>" + more + "</joint>";
  };
  const std::string limit = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";
  const std::string hinge = joint("revolute", "<axis xyz='0 0 1'/>" + limit);
  CHECK(read_urdf(folder.write("good.urdf", robot(hinge, box))).links.size() == 2);
  struct Bad {
    std::string text;
    std::string word;
  };
  for (const Bad& bad : std::vector<Bad>{
           {"no xml", "bad.urdf:1"},
           {"<!DOCTYPE robot [<!ENTITY a 'b'>]>" + robot(hinge, box), "bad.urdf:1"},
           {"<robot name='r'>" + repeated("<a>", 100'000) + repeated("</a>", 100'000) + "</robot>",
            "more than 64 deep"},
           {"<robot name='r'>" + repeated("<link name='a'/>", 10'001) + "</robot>", "more than 10000 links"},
           {"<robot name='r'></robot>", "not a URDF file"},
           {robot("", box), "not a URDF file"},
           {robot(joint("floating", ""), box), "neither fixed"},
           {robot(joint("planar", ""), box), "neither fixed"},
           {robot(joint("revolute", "<axis xyz='0 0 1'/>" + limit + "<mimic joint='j'/>"), box), "mimics"},
           {robot(joint("revolute", "<axis xyz='0 0 0'/>" + limit), box), "zero vector"},
           {robot(joint("prismatic", "<limit lower='2' upper='1' effort='1' velocity='1'/>"), box), "limits"},
           {robot(hinge, "<collision><geometry><sphere radius='1'/></geometry></collision>"), "sphere"},
           {robot(hinge, "<collision><geometry><box size='1 1 0'/></geometry></collision>"), "positive"},
           {robot(hinge, "<collision><geometry><mesh filename='package://no/a.off'/></geometry></collision>"),
            "is in no folder"},
           {robot(hinge, "<collision><geometry><mesh filename='none.off'/></geometry></collision>"), "none.off"},
       }) {
    CAPTURE(bad.text);
    const std::string file = folder.write("bad.urdf", bad.text);
    try {
      read_urdf(file);
      FAIL("read");
    } catch (const InputError& error) {
      const std::string what = error.what();
      CHECK_THAT(what, Catch::Contains(bad.word));
      CHECK(what.find('\n') == std::string::npos);
    }
  }
  const std::string good = folder.file("good.urdf");
  CHECK_THROWS_WITH(read_urdf(good, folder.write("a.srdf", "<robot><disable_collisions link1='a' link2='c'/></robot>")),
                    Catch::Contains("no link 'c'"));
  CHECK_THROWS_WITH(read_urdf(good, folder.write("b.srdf", "<robot><disable_collisions link1='a'/></robot>")),
                    Catch::Contains("no link2"));
  CHECK_THROWS_AS(read_urdf(good, folder.write("c.srdf", "<robot><")), Error);
}

}  // namespace nef::planner::test::urdf_files
