// SPDX-License-Identifier: Apache-2.0
//
// Faces in the same place have the same ring from its smallest corner on, forwards or backwards; a sorted map of rings
// finds them. Places that share a side of no other faces are decided together (union-find). Then sides vote: a side
// with an even number of other faces says that a doubled face there is a wall, one with an odd number that it is a
// copy. Sides with one undecided place are certain and vote first; when these say no more, all sides vote, and
// last those inside of blocks, where only walls meet. Each decision makes others certain, so the votes begin again
// after it.
#include "nef/import/repair/doubled_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "nef/base/union_find.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/mesh.h"

namespace nef {
namespace {

using Ring = std::vector<std::uint32_t>;

// The ring from its smallest corner on; the smallest of all starts if a corner is named more than once.
Ring rotated(const Ring& ring) {
  if (ring.empty()) return ring;
  const std::uint32_t least = *std::min_element(ring.begin(), ring.end());
  Ring best;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] != least) continue;
    Ring candidate(ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
    candidate.insert(candidate.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i));
    if (best.empty() || candidate < best) best = std::move(candidate);
  }
  return best;
}

class Copies {
 public:
  explicit Copies(std::vector<Ring> rings) : rings_(std::move(rings)) {}

  std::vector<Ring> drop(std::vector<std::uint32_t>* numbers, bool only_opposite) {
    only_opposite_ = only_opposite;
    find_places();
    if (places_.size() == rings_.size()) {
      if (numbers != nullptr) {
        numbers->resize(rings_.size());
        std::iota(numbers->begin(), numbers->end(), 0U);
      }
      return std::move(rings_);
    }
    find_sides();
    decide();
    std::vector<Ring> kept;
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      const std::uint32_t p = place_of_[f];
      Place& place = places_[p];
      if (is_doubled(p)) {
        if (place.kept == (is_wall(p) ? 2U : 1U)) continue;
        if (place.kept == 1 && forward_[f] == place.first_forward) std::reverse(rings_[f].begin(), rings_[f].end());
        if (place.kept++ == 0) place.first_forward = forward_[f];
      }
      kept.push_back(std::move(rings_[f]));
      if (numbers != nullptr) numbers->push_back(f);
    }
    return kept;
  }

  std::vector<std::uint32_t> repeated() {
    find_places();
    std::vector<std::uint32_t> result;
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      Place& place = places_[place_of_[f]];
      if (place.kept > 0 && forward_[f] == place.first_forward) result.push_back(f);
      if (place.kept++ == 0) place.first_forward = forward_[f];
    }
    return result;
  }

  std::vector<bool> doubled() {
    find_places();
    std::vector<bool> result;
    for (const std::uint32_t p : place_of_) result.push_back(places_[p].faces > 1);
    return result;
  }

  std::size_t count_cancelled() {
    find_places();
    UnionFind components(rings_.size());
    std::unordered_map<std::uint64_t, std::uint32_t> face_at;  // a face at each side
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      for_each_side(rings_[f], [&](std::uint32_t u, std::uint32_t v) {
        components.unite(face_at.emplace(edge_key(u, v), f).first->second, f);
      });
    }
    std::vector<bool> encloses(rings_.size(), false);
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      const Place& there = places_[place_of_[f]];
      if (2 * there.forward != there.faces) encloses[components.find(f)] = true;
    }
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < rings_.size(); ++f) count += encloses[components.find(f)] ? 0 : 1;
    return count;
  }

 private:
  // Where faces have the same ring, turned either way.
  struct Place {
    std::uint32_t faces = 0;
    std::uint32_t forward = 0;  // of these
    std::uint32_t kept = 0;
    bool first_forward = false;
  };
  struct Side {
    std::uint32_t single = 0;  // faces that nothing is decided about, such as those that stand alone in their place
    std::vector<std::uint32_t> doubled;  // places of several faces
  };
  enum class Kind : std::uint8_t { kUnknown, kWall, kCopy };
  // What the sides of places that are decided together say.
  struct Votes {
    std::uint32_t wall = 0;
    std::uint32_t copy = 0;
  };

  void find_places() {
    std::map<Ring, std::uint32_t> number;
    for (const Ring& ring : rings_) {
      Ring there = rotated(ring);
      Ring back = rotated(Ring(ring.rbegin(), ring.rend()));
      const bool forward = there <= back;
      forward_.push_back(forward);
      const auto [at, is_new] =
          number.emplace(std::move(forward ? there : back), static_cast<std::uint32_t>(places_.size()));
      if (is_new) places_.emplace_back();
      ++places_[at->second].faces;
      places_[at->second].forward += forward ? 1 : 0;
      place_of_.push_back(at->second);
    }
  }

  void find_sides() {
    std::vector<bool> seen(places_.size(), false);
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      const std::uint32_t p = place_of_[f];
      if (seen[p]) continue;
      seen[p] = true;
      for_each_side(rings_[f], [&](std::uint32_t u, std::uint32_t v) {
        Side& side = sides_[edge_key(u, v)];
        if (is_doubled(p)) {
          side.doubled.push_back(p);
        } else {
          side.single += places_[p].faces;
        }
      });
    }
  }

  // How a side is asked for votes: one with a single undecided place tells for certain, others what is likely.
  enum class Asked : std::uint8_t { kCertain, kLikely, kWallsOnly };

  void decide() {
    together_.reset(places_.size());
    for (const auto& [key, side] : sides_) {
      if (side.single == 0 && side.doubled.size() == 2) together_.unite(side.doubled[0], side.doubled[1]);
    }
    together_.flatten();
    kind_.assign(places_.size(), Kind::kUnknown);
    constexpr std::array kOrder{Asked::kCertain, Asked::kLikely, Asked::kWallsOnly};
    for (std::size_t i = 0; i < kOrder.size();) i = decide_some(kOrder[i]) ? 0 : i + 1;
  }

  // Returns whether there was something to decide.
  bool decide_some(Asked asked) {
    std::vector<Votes> votes(places_.size());
    for (const auto& [key, side] : sides_) vote(side, asked, votes);
    bool changed = false;
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      if (votes[p].wall + votes[p].copy == 0) continue;
      kind_[p] = votes[p].wall > votes[p].copy ? Kind::kWall : Kind::kCopy;
      changed = true;
    }
    return changed;
  }

  void vote(const Side& side, Asked asked, std::vector<Votes>& votes) const {
    std::uint32_t single = side.single;
    std::uint32_t walls = 0;
    std::vector<std::uint32_t> unknown;  // representatives
    for (const std::uint32_t p : side.doubled) {
      const std::uint32_t root = together_.root(p);
      single += kind_[root] == Kind::kCopy ? 1 : 0;
      walls += kind_[root] == Kind::kWall ? 1 : 0;
      if (kind_[root] != Kind::kUnknown) continue;
      // Two places that are decided together leave the number even, walls or copies: a skin that was doubled and that
      // touches others here.
      const auto at = std::find(unknown.begin(), unknown.end(), root);
      if (at == unknown.end()) {
        unknown.push_back(root);
      } else {
        unknown.erase(at);
      }
    }
    if (asked == Asked::kCertain && unknown.size() > 1) return;
    // Inside of a block of solids walls meet walls only.
    if (single == 0 && (asked != Asked::kWallsOnly || walls == 0)) return;
    for (const std::uint32_t root : unknown) ++(single % 2 == 0 ? votes[root].wall : votes[root].copy);
  }

  // Whether something is to be decided about the faces in a place.
  [[nodiscard]] bool is_doubled(std::uint32_t place) const {
    const Place& there = places_[place];
    return there.faces > 1 && (!only_opposite_ || 2 * there.forward == there.faces);
  }

  [[nodiscard]] bool is_wall(std::uint32_t place) const { return kind_[together_.root(place)] == Kind::kWall; }

  std::vector<Ring> rings_;
  bool only_opposite_ = false;
  std::vector<std::uint32_t> place_of_;  // of each face
  std::vector<bool> forward_;            // of each face: turned like the key of its place
  std::vector<Place> places_;
  std::unordered_map<std::uint64_t, Side> sides_;
  UnionFind together_;
  std::vector<Kind> kind_;  // of the representatives of places that are decided together
};

}  // namespace

std::vector<Ring> without_copies(std::vector<Ring> rings, std::vector<std::uint32_t>* kept, bool only_opposite) {
  return Copies(std::move(rings)).drop(kept, only_opposite);
}

std::vector<std::uint32_t> repeated(std::vector<Ring> rings) { return Copies(std::move(rings)).repeated(); }

std::vector<bool> doubled(std::vector<Ring> rings) { return Copies(std::move(rings)).doubled(); }

std::size_t count_cancelled(std::vector<Ring> rings) { return Copies(std::move(rings)).count_cancelled(); }

}  // namespace nef
