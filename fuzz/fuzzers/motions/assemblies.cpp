// SPDX-License-Identifier: Apache-2.0
//
// Assemblies of unit cubes: parts at random in a small block, and parts with play in pockets of a block, several of
// which may have to move as one. The truth is a search over all sets of parts, each by unit steps on the lattice, which
// lose nothing, since the free space of cubes on a lattice consists of closed cells of that lattice. Verdicts and
// proofs are asked of the same parts: what a part of cubes is blocked in is told by 26 directions.
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/planner/verdict/verdict.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"

namespace nef::fuzz {
namespace {

using planner::PartSet;
using Cube = std::array<int, 3>;
using Cubes = std::set<Cube>;
using PartMask = unsigned;  // a set of parts

PartMask bits_of(const PartSet& set) {
  PartMask bits = 0;
  for (const std::size_t part : set) bits |= 1U << part;
  return bits;
}

// Which sets of parts come apart, and which are stuck.
class LatticeTruth {
 public:
  explicit LatticeTruth(const std::vector<Cubes>& parts) : parts_(parts) {
    for (const Cubes& part : parts) {
      for (const Cube& c : part) {
        for (const int x : c) size_ = std::max(size_, x + 1);
      }
    }
  }

  /// The largest sets that stay together, whatever is done: of two sets none of which can leave one is no part of the
  /// other, and the order of steps makes no difference.
  [[nodiscard]] std::set<PartMask> stuck() const {
    std::set<PartMask> result;
    find_stuck((1U << parts_.size()) - 1, result);
    return result;
  }

  /// True if what is not in `moving` stays clear of its insides along the path.
  [[nodiscard]] bool is_free(PartMask moving, PartMask stay, const std::vector<Rational3>& path) const {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (const Cube& a : cubes_of(moving)) {
        for (const Cube& b : cubes_of(stay)) {
          if (meets(a, b, path[i], path[i + 1])) return false;
        }
      }
    }
    return true;
  }

 private:
  [[nodiscard]] Cubes cubes_of(PartMask set) const {
    Cubes result;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if ((set >> i & 1U) != 0) result.insert(parts_[i].begin(), parts_[i].end());
    }
    return result;
  }

  // The inside of a, moved from one vector to another, meets the inside of b.
  static bool meets(const Cube& a, const Cube& b, const Rational3& from, const Rational3& to) {
    Rational low = 0;
    Rational high = 1;
    bool at_ends = true;  // the ends of the segment count: an open interval is cut on neither side yet
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational begin = from[k] + a[k] - b[k];
      const Rational speed = to[k] - from[k];
      if (speed == 0) {
        if (begin <= -1 || begin >= 1) return false;
        continue;
      }
      Rational t0 = (-1 - begin) / speed;
      Rational t1 = (1 - begin) / speed;
      if (t0 > t1) std::swap(t0, t1);
      if (t1 <= 0 || t0 >= 1) return false;
      low = std::max(low, t0);
      high = std::min(high, t1);
      at_ends = false;
    }
    return at_ends || low < high;
  }

  // The side of fewer cubes moves.
  [[nodiscard]] bool leaves(PartMask one, PartMask other) const {
    Cubes moving = cubes_of(one);
    Cubes stay = cubes_of(other);
    if (moving.size() > stay.size()) std::swap(moving, stay);
    const auto is_free = [&](const Cube& t) {
      return std::none_of(moving.begin(), moving.end(), [&](const Cube& c) {
        return stay.contains({c[0] + t[0], c[1] + t[1], c[2] + t[2]});
      });
    };
    std::set<Cube> seen{{0, 0, 0}};
    std::vector<Cube> stack{{0, 0, 0}};
    while (!stack.empty()) {
      const Cube at = stack.back();
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(at[k]) >= size_) return true;
        for (const int step : {1, -1}) {
          Cube next = at;
          next[k] += step;
          if (!seen.contains(next) && is_free(next)) {
            seen.insert(next);
            stack.push_back(next);
          }
        }
      }
    }
    return false;
  }

  void find_stuck(PartMask set, std::set<PartMask>& result) const {
    if ((set & (set - 1)) == 0) return;
    const PartMask first = set & ~(set - 1);  // it stays
    for (PartMask moving = (set - 1) & set; moving != 0; moving = (moving - 1) & set) {
      if ((moving & first) != 0 || !leaves(moving, set & ~moving)) continue;
      find_stuck(moving, result);
      find_stuck(set & ~moving, result);
      return;
    }
    result.insert(set);
  }

  const std::vector<Cubes>& parts_;
  int size_ = 0;
};

// Each cube of a small block goes to a part, or to none.
std::vector<Cubes> random_block(Choices& choices) {
  const int count = choices.between(2, 8);
  std::vector<Cubes> parts(static_cast<std::size_t>(count));
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 3; ++z) {
        const int owner = choices.between(0, count);
        if (owner < count) parts[static_cast<std::size_t>(owner)].insert({x, y, z});
      }
    }
  }
  return parts;
}

// A pocket one cube high in a layer of a block: a walk of cubes, which may lead out of it.
std::set<std::array<int, 2>> random_pocket(Choices& choices, int width) {
  std::set<std::array<int, 2>> pocket;
  std::array<int, 2> at{width / 2, width / 2};
  for (int steps = choices.between(4, 24); steps > 0; --steps) {
    pocket.insert(at);
    const std::size_t axis = choices.below(2);
    at[axis] = std::clamp(at[axis] + (choices.below(2) == 0 ? 1 : -1), 0, width - 1);
  }
  return pocket;
}

// A block with pockets in layers of its own, and up to two parts in each, with room: they cannot leave each other but
// in the plane of the layer.
std::vector<Cubes> random_pockets(Choices& choices) {
  constexpr int kWidth = 6;
  const int layers = choices.between(1, 4);
  std::vector<Cubes> parts(1);
  for (int z = 0; z <= 2 * layers; ++z) {
    std::set<std::array<int, 2>> pocket;
    if (z % 2 == 1) pocket = random_pocket(choices, kWidth);
    std::array<Cubes, 2> pair;
    for (int x = 0; x < kWidth; ++x) {
      for (int y = 0; y < kWidth; ++y) {
        if (!pocket.contains({x, y})) {
          parts.front().insert({x, y, z});
          continue;
        }
        const std::uint32_t owner = choices.below(5);  // two in five stay empty
        if (owner < 2) pair[0].insert({x, y, z});
        if (owner == 2) pair[1].insert({x, y, z});
      }
    }
    for (Cubes& part : pair) {
      if (!part.empty()) parts.push_back(std::move(part));
    }
  }
  return parts;
}

// A ring and a cube in its hole, with room on both sides, in a tunnel with a bend, which leads out of the block on one
// side or the other, or ends in it; each of some pairs in a layer of its own.
std::vector<Cubes> rings_in_tunnels(Choices& choices) {
  const int pairs = choices.between(1, 4);
  std::vector<Cubes> parts(1);
  for (int z = 0; z <= 2 * pairs; ++z) {
    const bool is_tunnel = z % 2 == 1;
    const bool up = is_tunnel && choices.below(2) == 0;
    const int wall = is_tunnel && choices.one_in(4) ? 1 : 0;
    for (int x = 0; x < 13; ++x) {
      for (int y = 0; y < 11; ++y) {
        const bool along = x >= 1 && x < 12 && y >= 4 && y < 7;
        const bool across = x >= 7 && x < 12 && (up ? y >= 4 && y < 11 - wall : y >= wall && y < 7);
        if (!is_tunnel || !(along || across)) parts.front().insert({x, y, z});
      }
    }
    if (!is_tunnel) continue;
    Cubes ring;
    for (int x = 1; x < 6; ++x) {
      for (int y = 4; y < 7; ++y) {
        if (y != 5 || x == 1 || x == 5) ring.insert({x, y, z});
      }
    }
    parts.push_back(std::move(ring));
    parts.push_back({{choices.between(2, 4), 5, z}});
  }
  return parts;
}

// Rows of cubes, as boxes.
Polyhedron solid_of(const Cubes& cubes) {
  std::vector<Polyhedron> boxes;
  Cubes rest = cubes;
  while (!rest.empty()) {
    const Cube low = *rest.begin();
    Cube high = low;
    while (rest.erase(high) == 1) ++high[2];
    boxes.push_back(make_box({low[0], low[1], low[2]}, {low[0] + 1, low[1] + 1, high[2]}));
  }
  return unite_all(boxes);
}

std::string text_of(const Cubes& cubes) {
  std::string text;
  for (const Cube& c : cubes) {
    text += (text.empty() ? "" : " ") + std::to_string(c[0]) + "," + std::to_string(c[1]) + "," + std::to_string(c[2]);
  }
  return text;
}

// The steps part what is together, along free ways; what is stuck is what the truth says.
void compare_steps(const planner::Disassembly& answer, const LatticeTruth& truth, std::size_t count) {
  std::set<PartMask> together{(1U << count) - 1};
  for (const planner::DisassemblyStep& step : answer.steps) {
    const PartMask moving = bits_of(step.parts);
    const PartMask stay = bits_of(step.stay);
    Case::require(together.erase(moving | stay) == 1, "steps: of what is not together");
    together.insert(moving);
    together.insert(stay);
    Case::require(truth.is_free(moving, stay, step.path), "steps: a way that is not free");
  }
  std::set<PartMask> stuck;
  for (const planner::Inseparable& parts : answer.inseparable) stuck.insert(bits_of(parts.parts));
  for (const PartMask set : together) {
    Case::require((set & (set - 1)) == 0 || stuck.contains(set), "steps: something is left together");
  }
  Case::require(stuck == truth.stuck(), "inseparable: not what a search over all sets says");
}

// Whether cubes overlap others when they begin to move in one of the 26 directions: where they do, they have a side, an
// edge or a corner in common, and the other cube begins on that side.
bool blocked_at_once(const Cubes& moving, const Cubes& stay, const Cube& d) {
  return std::any_of(moving.begin(), moving.end(), [&](const Cube& a) {
    for (unsigned some = 1; some < 8; ++some) {  // moves by less than one cube along some of its axes
      Cube b = a;
      bool moves = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if ((some >> k & 1U) == 0) continue;
        moves = moves && d[k] != 0;
        b[k] += d[k];
      }
      if (moves && stay.contains(b)) return true;
    }
    return false;
  });
}

std::vector<Cube> all_directions() {
  std::vector<Cube> result;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) result.push_back({x, y, z});
      }
    }
  }
  return result;
}

// True if some set of parts can begin to move.
bool something_moves(const std::vector<Cubes>& parts) {
  for (const Cube& d : all_directions()) {
    for (PartMask moving = 1; moving + 1 < 1U << parts.size(); ++moving) {
      bool blocked = false;
      for (std::size_t a = 0; a < parts.size() && !blocked; ++a) {
        for (std::size_t b = 0; b < parts.size() && !blocked; ++b) {
          blocked = (moving >> a & 1U) != 0 && (moving >> b & 1U) == 0 && blocked_at_once(parts[a], parts[b], d);
        }
      }
      if (!blocked) return true;
    }
  }
  return false;
}

void compare_verdict(const planner::Assembly& assembly, const std::vector<Cubes>& parts) {
  const planner::PartsVerdict found = planner::verdict(assembly);
  Case::require(!found.interferes(), "verdict: an overlap of cubes that do not");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Cubes others;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j != i) others.insert(parts[j].begin(), parts[j].end());
    }
    const planner::PartVerdict& judged = found.parts[i];
    bool stuck = true;
    for (const Cube& d : all_directions()) {
      const bool free = !blocked_at_once(parts[i], others, d);
      stuck = stuck && !free;
      Case::require(contains(judged.first.cone, {Rational(d[0]), Rational(d[1]), Rational(d[2])}) == free,
                    "verdict: another cone of first motions");
    }
    Case::require((judged.status == planner::PartVerdict::Status::kStuck) == stuck, "verdict: stuck or not");
    if (judged.status != planner::PartVerdict::Status::kRemovable) continue;
    const Rational3& d = *judged.direction;
    const LatticeTruth truth(parts);
    const PartMask all = (1U << parts.size()) - 1;
    Case::require(
        truth.is_free(1U << i, all & ~(1U << i), {{}, {Rational(99 * d[0]), Rational(99 * d[1]), Rational(99 * d[2])}}),
        "verdict: a part is not removable");
  }
}

void compare_proof(const planner::Assembly& assembly, const planner::Disassembly& answer,
                   const std::vector<Cubes>& parts) {
  for (const planner::Inseparable& stuck : answer.inseparable) {
    std::vector<Cubes> of_them;
    for (const std::size_t part : stuck.parts) of_them.push_back(parts[part]);
    const bool moves = something_moves(of_them);
    Case::require(stuck.nothing_moves == !moves, "inseparable: something moves, or not");
    const std::optional<planner::InseparableProof> proof = planner::make_inseparable_proof(assembly, stuck.parts);
    Case::require(proof.has_value() == !moves, "proof: there is one, or not");
    if (!proof) continue;
    const planner::InseparableProof read = planner::parse_inseparable_proof(planner::proof_text(*proof), "proof");
    Case::require(!planner::complaint_about(read), "proof: does not hold");
    Case::require(!planner::complaint_about(read, assembly), "proof: of other parts");
  }
}

}  // namespace

void fuzz_assemblies(const Case& the_case) {
  Choices& choices = the_case.choices();
  const std::uint32_t kind = choices.below(8);
  std::vector<Cubes> parts = kind < 4   ? random_block(choices)
                             : kind < 7 ? random_pockets(choices)
                                        : rings_in_tunnels(choices);
  std::erase_if(parts, [](const Cubes& part) { return part.empty(); });
  if (parts.empty()) return;
  planner::Assembly assembly;
  for (const Cubes& part : parts) {
    assembly.names.push_back(std::to_string(assembly.names.size()));
    the_case.tell("part " + assembly.names.back() + ": " + text_of(part));
    assembly.parts.push_back(solid_of(part));
  }
  const planner::Disassembly answer = planner::take_apart(assembly);
  Case::require(!answer.overlap, "overlap: of cubes that do not");
  Case::require(answer.undecided.empty(), "undecided: without anybody to stop it");
  compare_steps(answer, LatticeTruth(parts), parts.size());
  compare_verdict(assembly, parts);
  if (kind < 4 && parts.size() < 6) compare_proof(assembly, answer, parts);
  the_case.count(answer.inseparable.empty() ? "taken apart" : "stuck");
  for (const planner::DisassemblyStep& step : answer.steps) {
    if (!step.straight) the_case.count(step.parts.size() > 1 ? "planned steps of several parts" : "planned steps");
  }
}

}  // namespace nef::fuzz
