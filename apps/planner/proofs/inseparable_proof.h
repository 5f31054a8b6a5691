// SPDX-License-Identifier: Apache-2.0
//
// Proofs that no set of parts can begin to move, as data that anybody can check (docs/proofs.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "apps/planner/assembly/separation.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A claim that whatever set of some parts moves, in whatever direction, overlaps one of the others at once; and what
/// shows it: directions are cut into cones, and for each of these there are pairs of pieces that tie all parts
/// together.
struct InseparableProof {
  struct Part {
    std::string name;
    ProofPieces pieces;  ///< the part is their union
  };
  /// Two pieces of different parts with a point in common. The first one overlaps the second one as soon as it moves in
  /// a direction of the inside of the cone that the vectors from the point to the second one's vertices and from the
  /// first one's vertices to the point span; and the second one the first one in the opposite directions.
  struct Contact {
    struct Piece {
      std::uint32_t part = 0;
      std::uint32_t piece = 0;
    };
    Piece first;
    Piece second;
    CommonPoint common;  ///< robot: of the first piece, obstacle: of the second one
  };
  /// The directions that three vectors span, without zero: either two halves, or what is blocked in all of them.
  struct Cone {
    /// Cut by the sum of two of the vectors: `edge` and the next one. The first half has the sum in place of the
    /// latter, the second half in place of the former.
    std::optional<std::uint32_t> edge;
    std::vector<Cone> halves;  ///< none or two
    /// Numbers of contacts of which the first, or the second, part is blocked: they tie all parts together, each part
    /// to each other one along some of them.
    std::vector<std::uint32_t> first_blocked;
    std::vector<std::uint32_t> second_blocked;
  };

  std::vector<Part> parts;
  std::vector<Contact> contacts;
  /// Octant i is spanned by (+-1, 0, 0), (0, +-1, 0) and (0, 0, +-1), in that order; the k-th is negative if bit k of i
  /// is set.
  std::array<Cone, 8> octants;
};

/// The proof that no set of some parts can begin to move; nothing if one can, or if more than some ten thousand cones
/// were necessary. Costs the convex pieces of all parts, a linear program for each pair of them that is near, and the
/// cones, whose number grows with the inverse square of the smallest angle by which one direction is blocked.
std::optional<InseparableProof> make_inseparable_proof(const Assembly& assembly, const PartSet& parts,
                                                       const Monitor& monitor = {});

/// What is wrong with a proof; nothing if its claim holds. Everything is rational, and nothing of the search is used.
/// O(k^3) for each contact of pieces with k vertices, and the number of cones.
std::optional<std::string> complaint_about(const InseparableProof& proof);

/// What is different between a claim and an assembly; nothing if each part of the claim is the union of its pieces, and
/// the parts do not overlap.
std::optional<std::string> complaint_about(const InseparableProof& proof, const Assembly& assembly,
                                           const Monitor& monitor = {});

/// The text of a .proof file.
std::string proof_text(const InseparableProof& proof);

/// Reads a .proof file about parts. Only its form is checked. Throws InputError "name: what" for a key that is missing,
/// unknown or has a value of another kind.
InseparableProof parse_inseparable_proof(const std::string& text, const std::string& name);

}  // namespace nef::planner
