// SPDX-License-Identifier: Apache-2.0
//
// Equal items are found whatever their hashes and the threads.
#include "nef/base/threads/first_equal.h"

#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <vector>

namespace nef {
namespace {

std::vector<std::uint32_t> one_by_one(const std::vector<std::uint32_t>& items) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    std::uint32_t k = 0;
    while (items[k] != items[i]) ++k;
    result.push_back(k);
  }
  return result;
}

TEST_CASE("The first of equal items is found, though others have its hash, on any number of threads", "[threads]") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& some) {
    const std::uint32_t values = *rc::gen::inRange(1U, 200U);
    const std::uint32_t hashes = *rc::gen::inRange(1U, 200U);
    std::vector<std::uint32_t> items(some.begin(), some.end());
    for (std::uint32_t& item : items) item %= values;
    const auto hash = [&](std::size_t i) { return mixed_bits(items[i] % hashes); };
    const auto equal = [&](std::uint32_t i, std::uint32_t k) { return items[i] == items[k]; };
    const std::vector<std::uint32_t> expected = one_by_one(items);
    for (const unsigned threads : {1U, 3U}) {
      RC_ASSERT(first_equal(items.size(), Monitor().on_threads(threads), hash, equal) == expected);
    }
  }));
}

TEST_CASE("Different items are numbered as they first come") {
  const FirstNumbers numbers = numbers_by_first({0, 1, 0, 3, 1, 3, 6});
  CHECK(numbers.number == std::vector<std::uint32_t>{0, 1, 0, 2, 1, 2, 3});
  CHECK(numbers.first == std::vector<std::uint32_t>{0, 1, 3, 6});
  CHECK(numbers_by_first({}).number.empty());
}

TEST_CASE("Numbers stay different when their bits are mixed, in the highest bits, too") {
  std::vector<std::size_t> shares(16, 0);
  for (std::uint64_t i = 0; i < 16000; ++i) ++shares[mixed_bits(i << 32U | 5) >> 60U];
  for (const std::size_t count : shares) CHECK((count > 800 && count < 1200));
  CHECK(rc::check([](std::uint64_t a, std::uint64_t b) { RC_ASSERT((mixed_bits(a) == mixed_bits(b)) == (a == b)); }));
}

}  // namespace
}  // namespace nef
