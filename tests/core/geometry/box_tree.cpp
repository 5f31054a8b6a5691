// SPDX-License-Identifier: Apache-2.0
#include "nef/geometry/search/box_tree.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace nef::test {
namespace {

// Small integers, so that many boxes touch or lie in each other; some are flat, some are points, some reach to
// infinity, and some gaps between them are smaller than floats tell, or lie beyond all floats.
std::vector<Box> random_boxes(std::mt19937& random, std::size_t count) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = static_cast<int>(random() % 20);
      box.high[axis] = box.low[axis] + static_cast<int>(random() % 4);
    }
    if (random() % 4 == 0) box.high[random() % 3] -= 0x1p-40;
    if (random() % 4 == 0) box.low[random() % 3] += 0x1p-40;
    for (const double far : {1e39, 1e300}) {
      if (random() % 16 > 0) continue;
      const std::size_t axis = random() % 3;
      box.low[axis] *= far;
      box.high[axis] *= far;
    }
    if (random() % 16 == 0) box.high[random() % 3] = HUGE_VAL;
    if (random() % 16 == 0) box.low[random() % 3] = -HUGE_VAL;
  }
  return boxes;
}

}  // namespace

TEST_CASE("trees of boxes find what overlaps, however they are split") {
  std::mt19937 random(7);
  for (const std::size_t count : {0U, 1U, 4U, 5U, 40U, 300U}) {
    std::vector<Box> boxes = random_boxes(random, count);
    if (count == 40) std::fill(boxes.begin(), boxes.end(), boxes[0]);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t j = i + 1; j < count; ++j) {
        if (boxes[i].overlaps(boxes[j])) pairs.emplace_back(i, j);
      }
    }
    for (const BoxSplit split : {BoxSplit::kCells, BoxSplit::kMedians}) {
      CAPTURE(count, static_cast<int>(split));
      const BoxTree tree(boxes, split);
      CHECK(tree.size() == count);
      std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
      tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) { found.emplace_back(i, j); });
      std::sort(found.begin(), found.end());
      CHECK(found == pairs);
      for (const Box& query : random_boxes(random, 20)) {
        std::vector<bool> hit(count, false);
        tree.for_each_overlap(query, [&](std::uint32_t i) {
          CHECK(!hit[i]);
          hit[i] = true;
        });
        for (std::uint32_t i = 0; i < count; ++i) CHECK(hit[i] == boxes[i].overlaps(query));
      }
    }
  }
}

TEST_CASE("two trees of boxes find what overlaps, until the visitor has enough") {
  std::mt19937 random(11);
  for (const auto& [count, other_count] : {std::array{0U, 5U}, {5U, 0U}, {1U, 300U}, {300U, 3U}, {120U, 90U}}) {
    CAPTURE(count, other_count);
    const std::vector<Box> boxes = random_boxes(random, count);
    const std::vector<Box> others = random_boxes(random, other_count);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t j = 0; j < other_count; ++j) {
        if (boxes[i].overlaps(others[j])) pairs.emplace_back(i, j);
      }
    }
    const BoxTree tree(boxes);
    const BoxTree other(others, BoxSplit::kMedians);
    const auto meet = [](const Box& a, const Box& b) { return a.overlaps(b); };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    tree.for_each_pair_with(other, meet, [&](std::uint32_t i, std::uint32_t j) {
      found.emplace_back(i, j);
      return true;
    });
    std::sort(found.begin(), found.end());
    CHECK(found == pairs);
    std::size_t visits = 0;
    tree.for_each_pair_with(other, meet, [&](std::uint32_t, std::uint32_t) { return ++visits < 3; });
    CHECK(visits == std::min<std::size_t>(pairs.size(), 3));
  }
}

}  // namespace nef::test
