// SPDX-License-Identifier: Apache-2.0
//
// Bottlenecks of tight passages and rooms that only touch, on free spaces made by hand: rooms are boxes, passages are
// polygons and segments between them.
#include <catch2/catch.hpp>

#include "apps/planner/free_space/free_space.h"
#include "apps/program/expression/expression.h"

namespace nef::planner::test {
namespace {

const std::string kLeft = "box(0,0,0, 2,2,2)";
const std::string kRight = "box(8,0,0, 10,2,2)";

Polyhedron set(const std::string& expression) { return evaluate_expression(expression); }

// The only passage of a free space.
TightPassage only_passage(const std::string& expression) {
  const FreeSpace free(set(expression));
  REQUIRE(free.passages().size() == 1);
  CHECK(free.touching_volumes().empty());
  return free.passages().front();
}

void check_bottleneck(const std::string& expression, int dimension, int piece, int junction) {
  CAPTURE(expression);
  const TightPassage passage = only_passage(expression);
  CHECK(passage.dimension == dimension);
  CHECK(passage.volumes.size() == 2);
  REQUIRE(passage.bottleneck);
  CHECK(passage.bottleneck->piece == piece);
  CHECK(passage.bottleneck->junction == junction);
}

TEST_CASE("the bottleneck of a passage of one kind is that kind") {
  // The mouths of a sheet are edges, those of a line are vertices.
  check_bottleneck(kLeft + "+" + kRight + "+ polygon((2,0,1),(8,0,1),(8,2,1),(2,2,1))", 2, 2, 1);
  check_bottleneck(kLeft + "+" + kRight + "+ segment((2,1,1),(8,1,1))", 1, 1, 0);
}

TEST_CASE("the bottleneck of a mixed passage is the thinnest part that every way has to take") {
  const std::string sheet = "polygon((2,0,1),(5,0,1),(5,2,1),(2,2,1))";
  // A sheet that goes on as a line.
  check_bottleneck(kLeft + "+" + kRight + "+" + sheet + "+ segment((5,1,1),(8,1,1))", 2, 1, 0);
  // A sheet all the way, and a line that leads nowhere, or from room to room beside it.
  const std::string whole = "polygon((2,0,1),(8,0,1),(8,2,1),(2,2,1))";
  check_bottleneck(kLeft + "+" + kRight + "+" + whole + "+ segment((5,2,1),(5,9,1))", 2, 2, 1);
  check_bottleneck(kLeft + "+" + kRight + "+" + whole + "+ segment((2,1,3/2),(5,1,1)) + segment((5,1,1),(8,1,3/2))", 2,
                   2, 1);
  // Two sheets that meet in a point: everywhere a sheet, but the way goes through a vertex.
  check_bottleneck(kLeft + "+" + kRight + "+ polygon((2,0,1),(5,1,1),(2,2,1)) + polygon((8,0,1),(5,1,1),(8,2,1))", 2, 2,
                   0);
  // Two sheets that meet in an edge.
  check_bottleneck(kLeft + "+" + kRight + "+" + sheet + "+ polygon((5,0,1),(8,0,2),(8,2,2),(5,2,1))", 2, 2, 1);
  // A line between two sheets.
  check_bottleneck(kLeft + "+" + kRight +
                       "+ polygon((2,0,1),(4,0,1),(4,2,1),(2,2,1)) + segment((4,1,1),(6,1,1)) + "
                       "polygon((6,0,1),(8,0,1),(8,2,1),(6,2,1))",
                   2, 1, 0);
}

TEST_CASE("a passage that leads to one room only has no bottleneck") {
  const TightPassage passage = only_passage(kLeft + "+ polygon((2,0,1),(8,0,1),(8,2,1),(2,2,1))");
  CHECK(passage.dimension == 2);
  CHECK(passage.volumes.size() == 1);
  CHECK_FALSE(passage.bottleneck);
}

TEST_CASE("rooms that only touch are listed with where they do") {
  const auto touching = [](const std::string& expression) {
    const FreeSpace free(set(expression));
    CHECK(free.passages().empty());
    return std::vector<TouchingVolumes>(free.touching_volumes().begin(), free.touching_volumes().end());
  };
  // Along an edge with its two ends, and in a point.
  const std::vector<TouchingVolumes> edge = touching("box(0,0,0, 2,2,2) + box(2,2,0, 4,4,2)");
  REQUIRE(edge.size() == 1);
  CHECK(edge[0].dimension == 1);
  CHECK(edge[0].cells.size() == 3);
  CHECK(edge[0].volumes.size() == 2);
  const std::vector<TouchingVolumes> point = touching("box(0,0,0, 2,2,2) + box(2,2,2, 4,4,4)");
  REQUIRE(point.size() == 1);
  CHECK(point[0].dimension == 0);
  CHECK(point[0].cells.size() == 1);
  // Three rooms around one point, two of them along an edge.
  const std::vector<TouchingVolumes> three = touching("box(0,0,0, 2,2,2) + box(2,2,0, 4,4,2) + box(0,2,2, 2,4,4)");
  REQUIRE(three.size() == 1);
  CHECK(three[0].volumes.size() == 3);
  // Open boxes do not touch; neither do boxes that share a wall, which are one room.
  CHECK(touching("interior(box(0,0,0, 2,2,2)) + interior(box(2,2,0, 4,4,2))").empty());
  CHECK(touching("box(0,0,0, 2,2,2) + box(2,0,0, 4,2,2)").empty());
  // A room that touches itself is no pair of rooms.
  CHECK(touching("box(0,0,0, 2,2,2) + box(2,2,0, 4,4,2) + box(0,0,2, 4,4,3)").empty());
}

}  // namespace
}  // namespace nef::planner::test
