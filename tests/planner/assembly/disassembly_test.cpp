// SPDX-License-Identifier: Apache-2.0
//
// Assemblies come apart, or are proved not to: against a lattice search for assemblies of unit cubes, by sweeping every
// step, and in scenes whose answers are known.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/assembly/closed_sets.h"
#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/assembly/free_directions.h"
#include "apps/program/reports/exact_json.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/report_shape.h"
#include "tests/support/shapes/fixed_cases.h"
#include "tests/support/shapes/oblique_rotation.h"

namespace nef::planner::test {
namespace {

Assembly load_assembly(const std::string& name) {
  return read_assembly(source_folder() + "/data/planner/assembly/" + name + ".json");
}

Polyhedron united(const Assembly& assembly, const PartSet& set) {
  std::vector<Polyhedron> parts;
  for (const std::size_t part : set) parts.push_back(assembly.parts[part]);
  return unite_all(parts);
}

// What is wrong with the steps; nothing if they are right. What moves must not meet, with its inside, what stays: its
// sweeps are exact sums. At the end the boxes are apart. The steps must part what is together, down to single parts or
// to what is said to be stuck.
std::string complaint(const Assembly& assembly, const Disassembly& answer) {
  PartSet all;
  for (std::size_t i = 0; i < assembly.parts.size(); ++i) all.push_back(i);
  std::set<PartSet> together{all};
  for (const DisassemblyStep& step : answer.steps) {
    PartSet both = step.parts;
    both.insert(both.end(), step.stay.begin(), step.stay.end());
    std::sort(both.begin(), both.end());
    if (together.erase(both) != 1) return "a step of what is not together";
    together.insert(step.parts);
    together.insert(step.stay);
    const Polyhedron moving = interior(united(assembly, step.parts));
    const Polyhedron stay = united(assembly, step.stay);
    if (step.path.front() != Rational3{}) return "a step begins elsewhere";
    if (step.straight && step.path.size() != 2) return "not straight";
    for (std::size_t i = 0; i + 1 < step.path.size(); ++i) {
      const Polyhedron segment = make_segment(step.path[i], step.path[i + 1]);
      if (!intersect(minkowski::minkowski_sum(moving, segment), stay).is_empty()) return "a step collides";
    }
    const auto mine = *bounding_box(moving);
    const auto theirs = *bounding_box(stay);
    bool apart = false;
    for (std::size_t i = 0; i < 3; ++i) {
      apart =
          apart || mine[0][i] + step.path.back()[i] >= theirs[1][i] || mine[1][i] + step.path.back()[i] <= theirs[0][i];
    }
    if (!apart) return "not apart at the end";
  }
  for (const Inseparable& stuck : answer.inseparable) {
    if (together.erase(stuck.parts) != 1) return "what is stuck is not together";
  }
  for (const PartSet& set : together) {
    if (set.size() != 1) return "something is left together";
  }
  return {};
}

using Cell = std::array<int, 3>;
using Cells = std::set<Cell>;

// True if cubes can move away from others: by unit steps on the lattice, which lose nothing, since the free space of
// cubes on a lattice consists of closed cells of that lattice.
bool leaves(const Cells& moving, const Cells& stay, int size) {
  const auto is_free = [&](const Cell& t) {
    return std::none_of(moving.begin(), moving.end(), [&](const Cell& c) {
      return stay.count({c[0] + t[0], c[1] + t[1], c[2] + t[2]}) != 0;
    });
  };
  std::set<Cell> seen{{0, 0, 0}};
  std::vector<Cell> stack{{0, 0, 0}};
  while (!stack.empty()) {
    const Cell at = stack.back();
    stack.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(at[i]) >= size) return true;
      for (const int step : {1, -1}) {
        Cell next = at;
        next[i] += step;
        if (is_free(next) && seen.insert(next).second) stack.push_back(next);
      }
    }
  }
  return false;
}

bool comes_apart(const std::vector<Cells>& parts, unsigned set, int size) {
  if ((set & (set - 1)) == 0) return true;
  for (unsigned moving = (set - 1) & set; moving != 0; moving = (moving - 1) & set) {
    Cells mine;
    Cells theirs;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if ((set >> i & 1U) == 0) continue;
      Cells& side = (moving >> i & 1U) != 0 ? mine : theirs;
      side.insert(parts[i].begin(), parts[i].end());
    }
    if (leaves(mine, theirs, size)) {
      return comes_apart(parts, moving, size) && comes_apart(parts, set & ~moving, size);
    }
  }
  return false;
}

// Random cubes of a 3 x 3 x 3 block for each part; the last share stays empty.
std::vector<Cells> random_cells(unsigned seed, unsigned count) {
  std::mt19937 random(seed);
  std::vector<Cells> cells(count);
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 3; ++z) {
        const auto owner = random() % (count + 1);
        if (owner < count) cells[owner].insert({x, y, z});
      }
    }
  }
  return cells;
}

Assembly assembly_of(const std::vector<Cells>& cells) {
  Assembly assembly;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<Polyhedron> cubes;
    for (const Cell& c : cells[i]) cubes.push_back(make_box({c[0], c[1], c[2]}, {c[0] + 1, c[1] + 1, c[2] + 1}));
    REQUIRE_FALSE(cubes.empty());
    assembly.parts.push_back(unite_all(cubes));
    assembly.names.push_back(std::to_string(i));
  }
  return assembly;
}

TEST_CASE("the cone of free directions holds what a small step shows to be free") {
  std::set<int> dimensions;
  for (unsigned seed = 100; seed < 100 + nef::test::fewer(20); ++seed) {
    INFO("seed " << seed);
    const Assembly assembly = assembly_of(random_cells(seed, 3));
    const FreeDirections free = free_directions(assembly, 1);
    dimensions.insert(free.dimension);
    const Polyhedron others = unite(assembly.parts[0], assembly.parts[2]);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          // All faces are at whole coordinates, so a hundredth of a step is like the smallest one.
          const Rational3 d{Rational(x, 100), Rational(y, 100), Rational(z, 100)};
          const Polyhedron moved = transform(interior(assembly.parts[1]), AffineMap::translate(d));
          CHECK(contains(free.cone, d) == intersect(moved, others).is_empty());
        }
      }
    }
    for (const Integer3& ray : free.rays) {
      CHECK(contains(free.cone, {Rational(ray[0], 100), Rational(ray[1], 100), Rational(ray[2], 100)}));
    }
  }
  CHECK(dimensions.size() > 1);
  CHECK(free_directions(load_assembly("rings"), 0).everything);
  CHECK(free_directions(load_assembly("cube_in_a_box"), 1).dimension == 0);
  const std::vector<Integer3> along{{0, 1, 0}};
  CHECK(free_directions(load_assembly("dovetail"), 1).rays == along);
}

TEST_CASE("assemblies of unit cubes come apart iff a search on the lattice through all sets of parts says so") {
  int stuck = 0;
  int planned = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(48); ++seed) {
    INFO("seed " << seed);
    std::vector<Cells> cells = random_cells(seed, seed < 40 ? 2 + seed % 3 : 5 + seed % 4);
    std::erase_if(cells, [](const Cells& part) { return part.empty(); });
    const Assembly assembly = assembly_of(cells);
    const Disassembly answer = take_apart(assembly);
    CHECK(answer.inseparable.empty() == comes_apart(cells, (1U << cells.size()) - 1, 3));
    CHECK(complaint(assembly, answer) == "");
    CHECK(answer.undecided.empty());
    stuck += answer.inseparable.empty() ? 0 : 1;
    for (const DisassemblyStep& step : answer.steps) planned += step.straight ? 0 : 1;
  }
  CHECK(stuck > 4);
  CHECK(planned > 0);
}

// A block of unit cubes cut into parts that come apart in some order: each is carved out of what is left so that it can
// leave straight.
std::vector<Cells> carved_block(unsigned seed, int size, std::size_t count) {
  std::mt19937 random(seed);
  Cells left;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z < size; ++z) left.insert({x, y, z});
    }
  }
  const auto any_of_cells = [&random](const Cells& cells) {
    return *std::next(cells.begin(), static_cast<std::ptrdiff_t>(random() % cells.size()));
  };
  // What is in the way of a cube that leaves along an axis, and the cube.
  const auto column = [&](Cell at, std::size_t axis, int sign) {
    Cells result;
    for (; at[axis] >= 0 && at[axis] < size; at[axis] += sign) {
      if (left.contains(at)) result.insert(at);
    }
    return result;
  };
  const std::size_t wanted = left.size() / count;
  std::vector<Cells> parts;
  while (parts.size() + 1 < count && left.size() > wanted) {
    const std::size_t axis = random() % 3;
    const int sign = random() % 2 == 0 ? 1 : -1;
    Cells part = column(any_of_cells(left), axis, sign);
    for (int tries = 0; tries < 60 && part.size() < wanted; ++tries) {
      Cell next = any_of_cells(part);
      next[random() % 3] += random() % 2 == 0 ? 1 : -1;
      if (left.contains(next)) part.merge(column(next, axis, sign));
    }
    for (const Cell& cell : part) left.erase(cell);
    parts.push_back(std::move(part));
  }
  parts.push_back(left);
  std::shuffle(parts.begin(), parts.end(), random);
  return parts;
}

TEST_CASE("eighty parts without clearance come apart, upright and turned") {
  Assembly assembly = assembly_of(carved_block(1, 9, 80));
  REQUIRE(assembly.parts.size() >= 80);
  const Disassembly answer = take_apart(assembly);
  CHECK(answer.inseparable.empty());
  CHECK(answer.undecided.empty());
  CHECK(answer.steps.size() == assembly.parts.size() - 1);
  for (Polyhedron& part : assembly.parts) part = transform(part, nef::test::oblique_rotation());
  CHECK(take_apart(assembly).steps.size() == assembly.parts.size() - 1);
}

TEST_CASE("an answer that takes too long has the steps that are known") {
  const Assembly assembly = assembly_of(carved_block(2, 6, 20));
  std::size_t most = 0;
  for (const std::size_t questions : {10U, 1000U, 100000U, 100000000U}) {
    std::size_t asked = 0;
    const StopQuestion question([&] { return ++asked > questions; });
    const Disassembly some = take_apart(assembly, {}, question.monitor());
    CHECK(some.overlap == std::nullopt);
    CHECK(some.inseparable.empty());
    CHECK(some.undecided.empty() == (some.steps.size() == assembly.parts.size() - 1));
    CHECK(some.steps.size() >= most);
    most = some.steps.size();
  }
  CHECK(most == assembly.parts.size() - 1);
}

TEST_CASE("minimal closed sets are those that a search through all sets finds") {
  for (unsigned seed = 0; seed < nef::test::fewer(200); ++seed) {
    std::mt19937 random(seed);
    BlockingGraph graph(1 + random() % 6);
    for (std::size_t i = 0; i < graph.size(); ++i) {
      for (std::size_t j = 0; j < graph.size(); ++j) {
        if (i != j && random() % 3 == 0) graph[i].push_back(j);
      }
    }
    std::set<unsigned> closed;
    for (unsigned set = 1; set < 1U << graph.size(); ++set) {
      bool is_closed = true;
      for (std::size_t i = 0; i < graph.size(); ++i) {
        for (const std::size_t j : graph[i]) is_closed = is_closed && ((set >> i & 1U) == 0 || (set >> j & 1U) != 0);
      }
      if (is_closed) closed.insert(set);
    }
    std::set<unsigned> minimal;
    for (const unsigned set : closed) {
      const bool has_smaller = std::any_of(closed.begin(), closed.end(),
                                           [&](unsigned other) { return other != set && (other & ~set) == 0; });
      if (!has_smaller) minimal.insert(set);
    }
    std::set<unsigned> found;
    for (const std::vector<std::size_t>& set : minimal_closed_sets(graph)) {
      unsigned bits = 0;
      for (const std::size_t i : set) bits |= 1U << i;
      found.insert(bits);
    }
    CHECK(found == minimal);
  }
}

TEST_CASE("known assemblies") {
  struct Known {
    const char* name;
    bool apart;
    std::size_t steps;
    const char* first;  // the first part to go, or nothing
  };
  for (const Known& known :
       {Known{"tray", true, 9, ""}, Known{"lid_and_pin", true, 2, "pin"}, Known{"peg", true, 1, ""},
        Known{"dovetail", true, 1, "tail"}, Known{"rings", false, 0, ""}, Known{"burr", true, 5, "key"},
        Known{"cube_in_a_box", false, 0, ""}}) {
    INFO(known.name);
    const Assembly assembly = load_assembly(known.name);
    const Disassembly answer = take_apart(assembly);
    CHECK(answer.inseparable.empty() == known.apart);
    CHECK(answer.steps.size() == known.steps);
    CHECK(complaint(assembly, answer) == "");
    if (known.first[0] != 0) {
      REQUIRE_FALSE(answer.steps.empty());
      CHECK(assembly.names[answer.steps.front().parts.front()] == known.first);
    }
  }
  const Inseparable rings = take_apart(load_assembly("rings")).inseparable.at(0);
  CHECK_FALSE(rings.nothing_moves);
  CHECK(rings.blocked_by.size() == 2);
  CHECK(take_apart(load_assembly("cube_in_a_box")).inseparable.at(0).nothing_moves);
  // Both ends of the dovetail's groove but one are closed: there is one direction only.
  const Disassembly tail = take_apart(load_assembly("dovetail"));
  REQUIRE(tail.steps.size() == 1);
  const Rational3 end = tail.steps.front().path.back();
  CHECK(end[0] == 0);
  CHECK(end[1] > 0);
  CHECK(end[2] == 0);
}

// The longest decimal fraction among the coordinates; -1 if one has no end.
int decimals_of(const std::vector<Rational3>& path) {
  int most = 0;
  for (const Rational3& point : path) {
    for (Rational x : point) {
      int count = 0;
      for (; x.get_den() != 1 && count < 40; ++count) x *= 10;
      if (count == 40) return -1;
      most = std::max(most, count);
    }
  }
  return most;
}

// Thirds and sevenths, so that nothing is a decimal number by itself, and one part of three that has to go round a
// corner.
Assembly odd_assembly() {
  const auto third = [](int n) { return Rational(n, 3); };
  Assembly assembly;
  assembly.name = "odd";
  const auto add = [&](const char* name, const Polyhedron& part) {
    assembly.names.emplace_back(name);
    assembly.parts.push_back(transform(part, AffineMap::translate({Rational(1, 7), Rational(2, 7), Rational(-1, 7)})));
  };
  // A channel with a bend, closed above and below: the part in it goes along x, then along y.
  const Polyhedron block = make_box({0, 0, third(-1)}, {third(20), third(20), third(4)});
  const Polyhedron channel = unite(make_box({third(4), third(4), 0}, {third(13), third(8), 1}),
                                   make_box({third(9), third(4), 0}, {third(13), 7, 1}));
  add("block", subtract(block, channel));
  add("slider", make_box({third(4), third(4), 0}, {third(7), third(7), 1}));
  return assembly;
}

TEST_CASE("way-points of assemblies in bounded decimals") {
  const Assembly odd = odd_assembly();
  const Disassembly exact = take_apart(odd);
  REQUIRE(exact.steps.size() == 1);
  CHECK_FALSE(exact.steps.front().straight);
  CHECK(decimals_of(exact.steps.front().path) == -1);
  CHECK(exact.steps.front().unrounded.empty());
  for (const unsigned digits : {1U, 3U, 8U}) {
    const Disassembly answer = take_apart(odd, {.digits = digits});
    REQUIRE(answer.steps.size() == 1);
    CHECK(answer.inseparable.empty());
    CHECK(complaint(odd, answer) == "");
    const DisassemblyStep& step = answer.steps.front();
    CHECK(decimals_of({step.path.front(), step.path.back()}) <= static_cast<int>(digits));
    for (std::size_t i = 0; i < step.path.size(); ++i) {
      const int count = decimals_of({step.path[i]});
      const bool more = count < 0 || count > static_cast<int>(digits);
      CHECK(more == (std::count(step.unrounded.begin(), step.unrounded.end(), i) == 1));
    }
  }
  // One straight motion, in a direction without rational length: its end is rounded, and on the ray still.
  Assembly wedge;
  wedge.name = "wedge";
  wedge.names = {"groove", "wedge"};
  AffineMap shear = AffineMap::identity();
  shear.linear[0][2] = Rational(2, 7);
  shear.linear[1][2] = Rational(1, 3);
  const Polyhedron peg = transform(make_box({1, 1, 1}, {2, 2, 3}), shear);
  wedge.parts = {subtract(transform(make_box({0, 0, 0}, {3, 3, 3}), shear), peg), peg};
  const Disassembly way = take_apart(wedge, {.digits = 2});
  REQUIRE(way.steps.size() == 1);
  CHECK(way.steps.front().straight);
  CHECK(complaint(wedge, way) == "");
  const Rational3 end = way.steps.front().path.back();
  CHECK(decimals_of({end}) <= 2);
  CHECK(decimals_of({end}) >= 0);
  CHECK(end[0] == end[2] * Rational(2, 7));
  CHECK(end[1] == end[2] * Rational(1, 3));
}

TEST_CASE("planner --assembly: reports, exit codes, pages") {
  const Folder folder;
  const std::string data = source_folder() + "/data/planner/assembly/";
  const Run pin = planner(folder, "--assembly " + data + "lid_and_pin.json --json --page " + folder.file("p.html") +
                                      " -o " + folder.file("p.glb"));
  CHECK(pin.code == 0);
  const nlohmann::json report = nlohmann::json::parse(pin.out);
  nef::test::check_report_shape(report, "assembly");
  CHECK(report["status"] == "sequence");
  REQUIRE(report["steps"].size() == 2);
  CHECK(report["steps"][0]["parts"] == nlohmann::json::array({"pin"}));
  CHECK(report["steps"][0]["straight"] == true);
  CHECK(report["steps"][0]["path"][0] == nlohmann::json{"0", "0", "0"});
  CHECK(std::filesystem::file_size(folder.file("p.html")) > 1000);
  CHECK(text_of(folder.file("p.glb")).find("\"animations\"") != std::string::npos);
  const Run rings = planner(folder, "--assembly " + data + "rings.json");
  CHECK(rings.code == 1);
  CHECK(rings.out ==
        "inseparable\ninseparable: ring 1, ring 2; no subset of them can leave (all subassemblies)\n"
        "  ring 1 is blocked by ring 2\n  ring 2 is blocked by ring 1\n");
  const std::string overlap =
      folder.write("o.json", R"J({"parts": {"a": "box(0,0,0,2,2,2)", "b": "box(1,1,1,3,3,3)"}})J");
  const Run bad = planner(folder, "--assembly " + overlap);
  CHECK(bad.code == 3);
  CHECK(bad.out == "overlap: a and b\n");
  for (const char* text :
       {"{}", "[]", R"J({"parts": {}})J", R"J({"parts": {"a": 1}})J", R"J({"parts": {"a": "nothing"}})J",
        R"J({"parts": {"a": "box(0,0,0,1,1,0)"}})J", R"J({"parts": {"a": "box(0,0,0,1,1,1)"}, "x": 1})J"}) {
    const Run wrong = planner(folder, "--assembly " + folder.write("bad.json", text));
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("bad.json"));
  }
  CHECK(planner(folder, "--assembly " + overlap + " --tight").code == 2);
  CHECK(planner(folder, "--assembly " + overlap + " --widest").code == 2);
  const std::string odd = folder.write("odd.json", R"J({"parts": {"a": "box(0,0,0, 1,1,1/3)",
    "b": "box(0,0,1/3, 1,1,6/7)"}})J");
  const Run digits = planner(folder, "--assembly " + odd + " --digits 2 --json");
  CHECK(digits.code == 0);
  const nlohmann::json step = nlohmann::json::parse(digits.out)["steps"][0];
  CHECK(step["unrounded"] == nlohmann::json::array());
  for (const auto& x : step["path"][1]) CHECK(decimals_of({{rational_of(x, "x"), 0, 0}}) <= 2);
  CHECK(planner(folder, "--assembly " + odd + " --free-directions a --digits 2").code == 2);
}

}  // namespace
}  // namespace nef::planner::test
