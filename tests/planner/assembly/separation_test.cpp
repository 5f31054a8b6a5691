// SPDX-License-Identifier: Apache-2.0
//
// Which parts can leave the others: the search against a look at every set, and assemblies of parts that leave only
// together, though each of them can begin to move alone.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "apps/planner/assembly/disassembly.h"
#include "nef/base/timing/time_limit.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// Sets of parts as bits: whatever holds `moving` cannot leave whatever holds `stay`.
struct Tie {
  unsigned moving;
  unsigned stay;
};

unsigned bits_of(const PartSet& set) {
  unsigned bits = 0;
  for (const std::size_t part : set) bits |= 1U << part;
  return bits;
}

bool lets_go(const std::vector<Tie>& ties, unsigned moving, unsigned stay) {
  const auto holds = [](unsigned set, unsigned some) { return (some & ~set) == 0; };
  return std::none_of(ties.begin(), ties.end(), [&](const Tie& tie) {
    return (holds(moving, tie.moving) && holds(stay, tie.stay)) || (holds(stay, tie.moving) && holds(moving, tie.stay));
  });
}

// A test that only says yes or no.
template <class Separates>
HeldBy held_unless(const Separates& separates) {
  return [separates](const PartSet& moving, const PartSet& stay) -> std::optional<Core> {
    if (separates(moving, stay)) return std::nullopt;
    return Core{moving, stay};
  };
}

// Ties between a few parts each.
std::vector<Tie> random_ties(std::mt19937& random, unsigned parts) {
  std::vector<Tie> ties(1 + random() % (2 * parts));
  for (Tie& tie : ties) {
    tie = {1U << random() % parts, 0};
    if (random() % 2 == 0) tie.moving |= 1U << random() % parts;
    for (unsigned more = 1 + random() % 3; more > 0; --more) tie.stay |= 1U << random() % parts;
    tie.stay &= ~tie.moving;
  }
  std::erase_if(ties, [](const Tie& tie) { return tie.stay == 0; });
  return ties;
}

TEST_CASE("a set of parts leaves iff a look at every set finds one") {
  int none = 0;
  unsigned several = 0;
  std::size_t questions = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(3000); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const unsigned count = 2 + random() % 9;
    const std::vector<Tie> cheap = random_ties(random, count);
    const std::vector<Tie> costly = random_ties(random, count);
    const unsigned all = (1U << count) - 1;
    std::size_t least = count;  // parts of the smallest set that leaves
    for (unsigned set = 1; set < all; ++set) {
      if (!lets_go(cheap, set, all & ~set) || !lets_go(costly, set, all & ~set)) continue;
      least = std::min(least, static_cast<std::size_t>(std::popcount(set)));
    }
    PartSet parts;
    for (std::size_t i = 0; i < count; ++i) parts.push_back(i);
    std::vector<HeldBy> tests;
    for (const std::vector<Tie>* ties : {&cheap, &costly}) {
      tests.push_back(held_unless([ties](const PartSet& moving, const PartSet& stay) {
        return lets_go(*ties, bits_of(moving), bits_of(stay));
      }));
    }
    SeparationSearch search(parts, tests);
    const std::optional<PartSet> moving = search.run();
    REQUIRE(moving.has_value() == (least < count));
    if (moving) {
      const unsigned set = bits_of(*moving);
      CHECK(lets_go(cheap, set, all & ~set));
      CHECK(lets_go(costly, set, all & ~set));
      CHECK(moving->size() == least);
      CHECK(search.proved_below() == least);
      several += least > 1 ? 1 : 0;
    } else {
      CHECK(search.proved_below() == count);
      ++none;
    }
    questions += search.questions();
  }
  CHECK(none > 100);
  CHECK(several > nef::test::fewer(80));
  CHECK(questions > 0);
}

TEST_CASE("forty parts in pairs that leave together need few questions") {
  // Part 2 i is tied to part 2 i + 1, and all but the last pair to a frame.
  constexpr std::size_t kPairs = 20;
  PartSet parts;
  for (std::size_t i = 0; i <= 2 * kPairs; ++i) parts.push_back(i);
  const auto holds = [](const PartSet& set, std::size_t part) {
    return std::binary_search(set.begin(), set.end(), part);
  };
  const auto tied = [&](const PartSet& moving, const PartSet& stay) {
    for (std::size_t i = 0; i < kPairs; ++i) {
      if (holds(moving, 2 * i) && holds(stay, 2 * i + 1)) return true;
      if (holds(moving, 2 * i + 1) && holds(stay, 2 * i)) return true;
      if (i + 1 < kPairs && holds(moving, 2 * i) && holds(stay, 2 * kPairs)) return true;
    }
    return false;
  };
  const std::vector<HeldBy> tests{held_unless(
      [&](const PartSet& moving, const PartSet& stay) { return !tied(moving, stay) && !tied(stay, moving); })};
  SeparationSearch search(parts, tests);
  CHECK(search.run() == PartSet{2 * kPairs - 2, 2 * kPairs - 1});
  CHECK(search.questions() < 1000);
}

TEST_CASE("a search that is left tells how far it came") {
  const PartSet parts{0, 1, 2, 3, 4, 5};
  int asked = 0;
  const std::vector<HeldBy> tests{held_unless([&asked](const PartSet& moving, const PartSet& stay) {
    if (std::min(moving.size(), stay.size()) > 1 && ++asked > 20) throw std::runtime_error("enough");
    return moving.size() + stay.size() < 6;
  })};
  SeparationSearch search(parts, tests);
  CHECK_THROWS_AS(search.run(), std::runtime_error);
  CHECK(search.proved_below() == 2);
}

// Pairs of parts in a block, each in a tunnel with a bend: a ring that just fits into the height of the tunnel, and a
// cube in its hole with room on both sides. Each of the two can begin to move alone, the cube can leave the ring only
// outside of the tunnel, and the ring leaves the tunnel only with the cube in it, along x and then along y, by turns up
// and down, so that the block cannot leave all of them at once.
std::string pairs_in_tunnels(int pairs) {
  nlohmann::json parts;
  std::string block = "box(-1,-4,-1, 12,7," + std::to_string(2 * pairs) + ")";
  for (int i = 0; i < pairs; ++i) {
    const std::string low = std::to_string(2 * i);
    const std::string high = std::to_string(2 * i + 1);
    const auto box = [&](const std::string& from, const std::string& to) {
      return "box(" + from + "," + low + ", " + to + "," + high + ")";
    };
    block += " - " + box("0,0", "11,3") + " - " + (i % 2 == 0 ? box("6,0", "11,7") : box("6,-4", "11,3"));
    parts["ring " + std::to_string(i)] = box("0,0", "5,3") + " - " + box("1,1", "4,2");
    parts["cube " + std::to_string(i)] = box("2,1", "3,2");
  }
  parts["block"] = block;
  return nlohmann::json{{"parts", parts}}.dump();
}

TEST_CASE("pairs of parts that leave a block together are taken apart, however many there are") {
  for (const int pairs : {2, 3, 4}) {
    INFO(pairs << " pairs");
    const Assembly assembly = parse_assembly(pairs_in_tunnels(pairs), "", "tunnels");
    const Disassembly answer = take_apart(assembly);
    CHECK(answer.inseparable.empty());
    CHECK(answer.undecided.empty());
    REQUIRE(answer.steps.size() == static_cast<std::size_t>(2 * pairs));
    int together = 0;
    for (const DisassemblyStep& step : answer.steps) together += step.straight ? 0 : 1;
    CHECK(together == pairs);
    CHECK(answer.steps.front().parts.size() == 2);
  }
}

TEST_CASE("pairs of parts in closed tunnels are proved inseparable, for all sets") {
  std::string text = pairs_in_tunnels(4);
  // The tunnels end in the block.
  for (const auto& [open, closed] : {std::pair("11,7,", "11,6,"), std::pair("6,-4,", "6,-3,")}) {
    for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open)) text.replace(at, 5, closed);
  }
  const Assembly assembly = parse_assembly(text, "", "closed");
  const Disassembly answer = take_apart(assembly);
  REQUIRE(answer.inseparable.size() == 1);
  CHECK(answer.inseparable.front().parts.size() == 9);
  CHECK_FALSE(answer.inseparable.front().nothing_moves);
  CHECK(answer.steps.empty());
}

TEST_CASE("without time an assembly is undecided, not inseparable") {
  const Folder folder;
  const TimeLimit over(0.0);
  const Disassembly answer = take_apart(parse_assembly(pairs_in_tunnels(4), "", "tunnels"), {}, over.monitor());
  CHECK(answer.inseparable.empty());
  REQUIRE(answer.undecided.size() == 1);
  CHECK(answer.undecided[0].parts.size() == 9);
  CHECK(answer.undecided[0].proved_below <= 1);
  const std::string tunnels = folder.write("tunnels.json", pairs_in_tunnels(4));
  const Run none = planner(folder, "--assembly " + tunnels + " --time 0.001 --json");
  CHECK(none.code == 5);
  const nlohmann::json report = nlohmann::json::parse(none.out);
  CHECK(report["status"] == "undecided");
  CHECK_FALSE(report.contains("inseparable"));
  const Run all = planner(folder, "--assembly " + tunnels + " --time 1000");
  CHECK(all.code == 0);
  CHECK_THAT(all.out, Catch::StartsWith("sequence\n"));
}

}  // namespace
}  // namespace nef::planner::test
