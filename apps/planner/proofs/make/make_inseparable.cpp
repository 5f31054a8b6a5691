// SPDX-License-Identifier: Apache-2.0
//
// Each pair of convex pieces of different parts that touch blocks a cone of directions. What is blocked in a direction
// is blocked in directions near to it, so if everything is tied together in each direction, it is in all directions of
// small enough cones: cones are halved along their longest side until it is.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "apps/planner/assembly/closed_sets.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "apps/planner/proofs/make/piece_contact.h"
#include "apps/planner/rigid/rigid_body.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using DirectionCone = InseparableProof::Cone;
using Corners = ConeCorners;

class TieSearch {
 public:
  TieSearch(const Assembly& assembly, const PartSet& parts, const Monitor& monitor) : monitor_(monitor) {
    for (const std::size_t part : parts) {
      InseparableProof::Part& named = proof_.parts.emplace_back();
      named.name = assembly.names[part];
      const RigidBody body = RigidBody::of_set(assembly.parts[part], monitor);
      for (const RigidBody::Piece& piece : body.pieces()) named.pieces.push_back(piece.mesh.vertices);
    }
    for (std::uint32_t a = 0; a < proof_.parts.size(); ++a) {
      for (std::uint32_t b = a + 1; b < proof_.parts.size(); ++b) find_contacts(a, b);
    }
  }

  std::optional<InseparableProof> run() {
    for (unsigned octant = 0; octant < 8; ++octant) {
      Corners corners;
      for (unsigned k = 0; k < 3; ++k) corners[k][k] = (octant >> k & 1U) != 0 ? -1 : 1;
      std::optional<DirectionCone> cone = cover(corners, 0);
      if (!cone) return std::nullopt;
      proof_.octants[octant] = std::move(*cone);
    }
    return std::move(proof_);
  }

 private:
  void find_contacts(std::uint32_t a, std::uint32_t b) {
    const ProofPieces& pieces_a = proof_.parts[a].pieces;
    const ProofPieces& pieces_b = proof_.parts[b].pieces;
    for (std::uint32_t i = 0; i < pieces_a.size(); ++i) {
      for (std::uint32_t j = 0; j < pieces_b.size(); ++j) {
        monitor_.check_interruption();
        std::optional<BlockingContact> found = contact_of_pieces(pieces_a[i], pieces_b[j]);
        if (!found) continue;
        OpenCone opposite = opposite_cone(found->blocked);
        contacts_.push_back(
            {{{a, i}, {b, j}, std::move(found->common)}, std::move(found->blocked), std::move(opposite)});
      }
    }
  }

  std::optional<DirectionCone> cover(const Corners& corners, unsigned depth) {
    monitor_.check_interruption();
    if (++cones_ > kMostCones) return std::nullopt;
    if (std::optional<DirectionCone> leaf = tied(corners)) return leaf;
    if (depth == kMostHalvings) return std::nullopt;
    const std::size_t edge = widest_edge(corners);
    const std::size_t next = (edge + 1) % 3;
    DirectionCone result;
    result.edge = static_cast<std::uint32_t>(edge);
    for (const std::size_t end : {next, edge}) {
      std::optional<DirectionCone> cone = cover(half_cone(corners, edge, end), depth + 1);
      if (!cone) return std::nullopt;
      result.halves.push_back(std::move(*cone));
    }
    return result;
  }

  // Contacts, one for each two parts, that tie all parts together in all directions of a cone.
  std::optional<DirectionCone> tied(const Corners& corners) {
    const auto blocks = [&](const OpenCone& cone) {
      return std::all_of(corners.begin(), corners.end(), [&](const Rational3& d) { return contains(cone, d); });
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> ties;  // a is blocked by b, at this contact
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Known& known = contacts_[i];
      const std::pair both(known.contact.first.part, known.contact.second.part);
      const std::pair turned(both.second, both.first);
      if (!ties.contains(both) && blocks(known.first_blocked)) ties.emplace(both, i);
      if (!ties.contains(turned) && blocks(known.second_blocked)) ties.emplace(turned, i);
    }
    if (!ties_all(ties)) return std::nullopt;
    for (auto tie = ties.begin(); tie != ties.end();) {
      const auto taken = *tie;
      tie = ties.erase(tie);
      if (!ties_all(ties)) ties.insert(taken);
    }
    DirectionCone leaf;
    for (const auto& [parts, contact] : ties) {
      std::vector<std::uint32_t>& blocked = parts.first < parts.second ? leaf.first_blocked : leaf.second_blocked;
      blocked.push_back(number_of(contact));
    }
    return leaf;
  }

  template <class Ties>
  [[nodiscard]] bool ties_all(const Ties& ties) const {
    BlockingGraph graph(proof_.parts.size());
    for (const auto& [parts, contact] : ties) graph[parts.first].push_back(parts.second);
    return minimal_closed_sets(graph).front().size() == graph.size();
  }

  // In the proof, which has the contacts that are used.
  std::uint32_t number_of(std::size_t contact) {
    Known& known = contacts_[contact];
    if (!known.number) {
      known.number = static_cast<std::uint32_t>(proof_.contacts.size());
      proof_.contacts.push_back(known.contact);
    }
    return *known.number;
  }

  struct Known {
    InseparableProof::Contact contact;
    OpenCone first_blocked;
    OpenCone second_blocked;
    std::optional<std::uint32_t> number = std::nullopt;
  };

  Monitor monitor_;
  InseparableProof proof_;
  std::vector<Known> contacts_;
  std::size_t cones_ = 0;
};

}  // namespace

std::optional<InseparableProof> make_inseparable_proof(const Assembly& assembly, const PartSet& parts,
                                                       const Monitor& monitor) {
  if (parts.size() < 2) return std::nullopt;
  return TieSearch(assembly, parts, monitor).run();
}

}  // namespace nef::planner
