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
      const BoxTree::PairSearch search(tree);
      for (const std::size_t parts : {1U, 3U, 50U, 10000U}) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found_in_parts;
        for (const BoxTree::PairSearch::Part& part : search.parts(parts)) {
          search.for_each(part, [&](std::uint32_t i, std::uint32_t j) { found_in_parts.emplace_back(i, j); });
        }
        CHECK(found_in_parts == found);
      }
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
    const BoxTree::Rough rough = tree.rough();
    const BoxTree::Rough rough_other = other.rough();
    const RoughBox::Moved meet(tree.bounds(), {});
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    tree.for_each_pair_with(rough, other, rough_other, meet, [&](std::uint32_t i, std::uint32_t j) {
      if (boxes[i].overlaps(others[j])) found.emplace_back(i, j);  // floats take what all but meets, too
      return true;
    });
    std::sort(found.begin(), found.end());
    CHECK(found == pairs);
    std::size_t visits = 0;
    tree.for_each_pair_with(rough, other, rough_other, meet,
                            [&](std::uint32_t, std::uint32_t) { return ++visits < 3; });
    CHECK(visits >= std::min<std::size_t>(pairs.size(), 3));
    CHECK(visits <= 3);
  }
}

TEST_CASE("boxes in floats that are moved meet all that they overlap, and little else") {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double size : {1.0, 1e-40, 1e25, 1e200}) {
    for (int k = 0; k < 200; ++k) {
      CAPTURE(size, k);
      const std::array<double, 3> by = {size * number(random), size * number(random), size * number(random)};
      Box box;
      Box beside;  // touches the box, moved
      Box beyond;  // does not, by far more than floats are rounded by
      for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = size * number(random);
        box.high[i] = box.low[i] + 0.1 * size;
        beside.low[i] = std::nextafter(box.high[i] + by[i], -HUGE_VAL) - 0x1p-52 * size;
        beside.high[i] = beside.low[i] + size;
        beyond.low[i] = beside.low[i] + (i == 1 ? 1e-4 * size : 0);
        beyond.high[i] = beyond.low[i] + size;
      }
      const RoughBox::Moved meet(box, by);
      CHECK(meet(RoughBox(box), RoughBox(beside)));
      if (size == 1) CHECK(!meet(RoughBox(box), RoughBox(beyond)));
      // And the other way: what is moved back.
      const RoughBox::Moved back(beside, {-by[0], -by[1], -by[2]});
      CHECK(back(RoughBox(beside), RoughBox(box)));
    }
  }
}

}  // namespace nef::test
