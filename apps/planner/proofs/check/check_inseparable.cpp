// SPDX-License-Identifier: Apache-2.0
//
// The cone of each contact is found from its vertices anew, by trying all planes through two of its vectors. A cone of
// directions that three vectors span is in an open convex cone iff these are. In each cone that is not cut, every part
// must be led to from the first one, and lead to it, along parts that block each other.
#include <algorithm>
#include <set>

#include "apps/planner/proofs/check/check_parts.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef::planner {
namespace {

using Complaint = std::optional<std::string>;
using PieceContact = InseparableProof::Contact;
using DirectionCone = InseparableProof::Cone;
using Corners = std::array<Rational3, 3>;
using Normals = std::vector<Rational3>;
using Tie = std::array<std::size_t, 2>;  // the first part is blocked by the second one

// Whether vectors are in the open cone of all d with n * d < 0.
bool contains_all(const Normals& normals, const Corners& vectors) {
  return std::all_of(normals.begin(), normals.end(), [&](const Rational3& n) {
    return std::all_of(vectors.begin(), vectors.end(), [&](const Rational3& d) { return dot(n, d) < 0; });
  });
}

class InseparableCheck {
 public:
  explicit InseparableCheck(const InseparableProof& proof) : proof_(proof) {}

  Complaint run() {
    if (proof_.parts.size() < 2) return "the claim has fewer than two parts";
    std::set<std::string> names;
    for (const InseparableProof::Part& part : proof_.parts) {
      if (!names.insert(part.name).second) return "two parts have the name " + part.name;
      for (const auto& piece : part.pieces) {
        if (piece.empty()) return "a piece has no vertices";
      }
    }
    for (const PieceContact& contact : proof_.contacts) {
      if (Complaint complaint = check(contact)) return complaint;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      Corners corners;
      for (unsigned k = 0; k < 3; ++k) corners[k][k] = (octant & 1U << k) == 0 ? 1 : -1;
      if (Complaint complaint = check(proof_.octants[octant], corners)) return complaint;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] const std::vector<Rational3>* piece(const PieceContact::Piece& of) const {
    if (of.part >= proof_.parts.size() || of.piece >= proof_.parts[of.part].pieces.size()) return nullptr;
    return &proof_.parts[of.part].pieces[of.piece];
  }

  Complaint check(const PieceContact& contact) {
    const std::vector<Rational3>* const first = piece(contact.first);
    const std::vector<Rational3>* const second = piece(contact.second);
    if (first == nullptr || second == nullptr) return "a contact names a piece that does not exist";
    if (contact.first.part == contact.second.part) return "a contact joins two pieces of one part";
    const std::optional<Rational3> point = weighted_sum(*first, contact.common.robot, false);
    if (!point || point != weighted_sum(*second, contact.common.obstacle, false)) {
      return "the point of a contact is not common to its pieces";
    }
    std::vector<Rational3> vectors;
    for (const Rational3& vertex : *second) vectors.push_back(minus(vertex, *point));
    for (const Rational3& vertex : *first) vectors.push_back(minus(*point, vertex));
    normals_.push_back(outer_planes(vectors));
    if (normals_.back().empty()) return "two pieces of a contact overlap, or are flat";
    return std::nullopt;
  }

  Complaint check(const DirectionCone& cone, const Corners& corners) {
    if (!cone.edge) return check_ties(cone, corners);
    if (*cone.edge > 2) return "a cone has three edges";
    const std::size_t next = (*cone.edge + 1) % 3;
    const Rational3 middle = plus(corners[*cone.edge], corners[next]);
    Corners half = corners;
    half[next] = middle;
    if (Complaint complaint = check(cone.halves[0], half)) return complaint;
    half = corners;
    half[*cone.edge] = middle;
    return check(cone.halves[1], half);
  }

  Complaint check_ties(const DirectionCone& cone, const Corners& corners) {
    const Corners back{opposite(corners[0]), opposite(corners[1]), opposite(corners[2])};
    std::vector<Tie> ties;
    for (const bool first : {true, false}) {
      for (const std::uint32_t number : first ? cone.first_blocked : cone.second_blocked) {
        if (number >= proof_.contacts.size()) return "a cone names a contact that does not exist";
        if (!contains_all(normals_[number], first ? corners : back))
          return "a contact does not block all directions of a cone";
        const PieceContact& contact = proof_.contacts[number];
        ties.push_back(first ? Tie{contact.first.part, contact.second.part}
                             : Tie{contact.second.part, contact.first.part});
      }
    }
    for (const std::size_t from : {0U, 1U}) {
      if (reached(ties, from) < proof_.parts.size()) return "in some directions a set of parts is not blocked";
    }
    return std::nullopt;
  }

  // How many parts are reached from the first one, by ties from their end `from` to the other one.
  static std::size_t reached(const std::vector<Tie>& ties, std::size_t from) {
    std::set<std::size_t> known{0};
    for (std::size_t before = 0; before < known.size();) {
      before = known.size();
      for (const Tie& tie : ties) {
        if (known.contains(tie[from])) known.insert(tie[1 - from]);
      }
    }
    return known.size();
  }

  const InseparableProof& proof_;
  std::vector<Normals> normals_;  // of each contact
};

}  // namespace

Complaint complaint_about(const InseparableProof& proof) { return InseparableCheck(proof).run(); }

Complaint complaint_about(const InseparableProof& proof, const Assembly& assembly, const Monitor& monitor) {
  std::vector<Polyhedron> interiors;
  for (const InseparableProof::Part& part : proof.parts) {
    const auto found = std::find(assembly.names.begin(), assembly.names.end(), part.name);
    if (found == assembly.names.end()) return "the assembly has no part " + part.name;
    std::vector<Polyhedron> hulls;
    for (const auto& piece : part.pieces) hulls.push_back(convex_hull(piece, monitor));
    const Polyhedron& set = assembly.parts[static_cast<std::size_t>(found - assembly.names.begin())];
    if (!equal(unite_all(hulls, monitor), set, monitor))
      return "the pieces of " + part.name + " do not make up the assembly's part";
    interiors.push_back(interior(set, monitor));
  }
  for (std::size_t a = 0; a < interiors.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!intersect(interiors[a], interiors[b], monitor).is_empty()) {
        return proof.parts[b].name + " and " + proof.parts[a].name + " overlap";
      }
    }
  }
  return std::nullopt;
}

}  // namespace nef::planner
