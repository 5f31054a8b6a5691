// SPDX-License-Identifier: Apache-2.0
#include "nef/base/id.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <type_traits>

#include "nef/complex/ids.h"

namespace nef {

// No index turns into a number, or into an index of another kind, unless it is told to.
static_assert(!std::is_convertible_v<FacetId, std::uint32_t> && !std::is_constructible_v<std::uint32_t, FacetId>);
static_assert(!std::is_convertible_v<std::uint32_t, FacetId> && !std::is_convertible_v<int, FacetId>);
static_assert(!std::is_constructible_v<VolumeId, ShellId> && !std::is_assignable_v<VolumeId&, ShellId>);
static_assert(!std::is_invocable_v<std::equal_to<>, VolumeId, ShellId>);
static_assert(!std::is_invocable_v<std::less<>, VolumeId, std::uint32_t>);

template <typename Array, typename Index>
concept IndexedBy = requires(Array array, Index index) {
  array[index];
};
static_assert(IndexedBy<IndexedVector<FacetId, int>, FacetId>);
static_assert(!IndexedBy<IndexedVector<FacetId, int>, VolumeId>);
static_assert(!IndexedBy<IndexedVector<FacetId, int>, std::uint32_t>);
static_assert(!IndexedBy<IndexedVector<FacetId, int>, int>);

// They cost what numbers cost.
static_assert(sizeof(FacetId) == sizeof(std::uint32_t) && std::is_trivially_copyable_v<FacetId>);
static_assert(sizeof(IndexedVector<FacetId, int>) == sizeof(std::vector<int>));

TEST_CASE("halffacets are the two sides of facets") {
  for (const FacetId facet : IdRange(FacetId{0}, FacetId{5})) {
    for (const bool below : {false, true}) {
      const HalffacetId side = halffacet_of(facet, below);
      CHECK(facet_of(side) == facet);
      CHECK(is_below(side) == below);
      CHECK(opposite(side) == halffacet_of(facet, !below));
      CHECK(opposite(opposite(side)) == side);
    }
  }
}

TEST_CASE("a range of indices counts from its first to before its end") {
  const IdRange<CycleId> range(CycleId{4}, 3U);
  CHECK(std::vector<CycleId>(range.begin(), range.end()) == std::vector{CycleId{4}, CycleId{5}, CycleId{6}});
  CHECK(range.size() == 3);
  CHECK(range[2] == CycleId{6});
  CHECK(range.position(CycleId{6}) == 2);
  CHECK(range.contains(CycleId{4}));
  CHECK_FALSE(range.contains(CycleId{3}));
  CHECK_FALSE(range.contains(range.end_id()));
  CHECK(IdRange<CycleId>().empty());
  CHECK(std::lower_bound(range.begin(), range.end(), CycleId{5}) == range.begin() + 1);
  CHECK(range.end() - range.begin() == 3);
  CHECK(*(range.end() - 1) == CycleId{6});
  CHECK(range.begin()[1] == CycleId{5});
}

TEST_CASE("no index is none, and the greatest") {
  CHECK_FALSE(ShellId().valid());
  CHECK(ShellId{0}.valid());
  CHECK(ShellId{7} < ShellId());
  CHECK(ShellId{7}.next() == ShellId{8});
}

TEST_CASE("an indexed vector tells the index of what is appended") {
  IndexedVector<ShellId, int> values;
  CHECK(values.end_id() == ShellId{0});
  CHECK(values.push_back(10) == ShellId{0});
  CHECK(values.push_back(20) == ShellId{1});
  CHECK(values.contains(ShellId{1}));
  CHECK_FALSE(values.contains(ShellId{2}));
  CHECK_FALSE(values.contains(ShellId()));
  int sum = 0;
  for (const ShellId id : values.ids()) sum += values[id];
  CHECK(sum == 30);
  values[IdRange(ShellId{1}, ShellId{2})][0] = 5;
  CHECK(values.back() == 5);
  IndexedVector<ShellId, bool> flags(3, false);
  flags[ShellId{2}] = true;
  CHECK(std::count(flags.begin(), flags.end(), true) == 1);
}

}  // namespace nef
