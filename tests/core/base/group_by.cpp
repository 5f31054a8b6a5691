// SPDX-License-Identifier: Apache-2.0
#include "nef/base/threads/group_by.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include <random>
#include <span>

namespace nef::test {

TEST_CASE("Items are grouped by their keys as a stable sort orders them, on any number of threads", "[threads]") {
  std::mt19937 random(3);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{5000}}) {
    for (const std::uint32_t keys : {1U, 2U, 3U, 700U}) {
      std::vector<std::uint32_t> key(count);
      for (std::uint32_t& k : key) k = random() % (keys + 2);  // the last two are no keys
      std::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < keys; ++k) {
        for (std::uint32_t i = 0; i < count; ++i) {
          if (key[i] == k) expected.push_back(i);
        }
      }
      for (const unsigned threads : {1U, 2U, 5U, 0U}) {
        std::vector<std::uint32_t> items(count, 0xffffffffU);
        const auto each = [&](const auto& visit) {
          for (std::uint32_t i = 0; i < count; ++i) visit(key[i], i);
        };
        const std::vector<std::uint32_t> begin = group_by(
            keys, each, [&](std::uint32_t place, std::uint32_t i) { items[place] = i; }, Monitor().on_threads(threads));
        CAPTURE(count, keys, threads);
        REQUIRE(begin.size() == keys + 1);
        REQUIRE(begin.back() == expected.size());
        for (std::uint32_t k = 0; k < keys; ++k) {
          for (std::uint32_t i = begin[k]; i < begin[k + 1]; ++i) CHECK(key[items[i]] == k);
        }
        items.resize(expected.size());
        CHECK(items == expected);
      }
    }
  }
  CHECK(group_by(
            0, [](const auto& visit) { visit(0U); }, [](std::uint32_t) {}, Monitor().on_threads(2)) ==
        std::vector<std::uint32_t>{0});
}

TEST_CASE("Short and long ranges are sorted as a stable sort does it") {
  using Item = std::array<std::uint32_t, 2>;  // what it is sorted by, and where it was
  const auto less = [](const Item& a, const Item& b) { return a[0] < b[0]; };
  std::mt19937 random(5);
  for (std::uint32_t count = 0; count < 60; ++count) {
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < count; ++i) items.push_back({static_cast<std::uint32_t>(random() % 8), i});
    std::vector<Item> sorted = items;
    sort_short(std::span(sorted), less);
    std::stable_sort(items.begin(), items.end(), less);
    CHECK(sorted == items);
  }
}

TEST_CASE("Blocks of work come in their order, on one thread as a single one", "[threads]") {
  const auto range = [](std::size_t first, std::size_t last, const Monitor&) { return std::array{first, last}; };
  using Ranges = std::vector<std::array<std::size_t, 2>>;
  CHECK(blocks_of(10, 4, Monitor().on_threads(2), range) == Ranges{{0, 4}, {4, 8}, {8, 10}});
  CHECK(blocks_of(8, 4, Monitor().on_threads(3), range) == Ranges{{0, 4}, {4, 8}});
  CHECK(blocks_of(10, 4, Monitor().on_threads(1), range) == Ranges{{0, 10}});
  for (const unsigned threads : {1U, 2U})
    CHECK(blocks_of(0, 4, Monitor().on_threads(threads), range) == Ranges{{0, 0}});
}

}  // namespace nef::test
