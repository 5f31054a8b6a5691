// SPDX-License-Identifier: Apache-2.0
//
// The positions at which two convex pieces overlap are an open convex polytope; near a position at which they touch it
// is the cone of directions of their contact. Let the three vectors of a cone have n d <= 0 for all normals n around
// it, and n d < 0 unless d is along the passage. A direction of the cone that is not along the passage has a part of a
// vector that is not, so n d < 0 for it, too, and it is blocked. There are finitely many cones, so it is blocked up to
// some distance that is the same for all directions.
#include <algorithm>

#include "apps/planner/proofs/check/check_parts.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {

std::optional<std::array<Rational3, 3>> tight_frame(std::span<const Rational3> along) {
  std::array<Rational3, 3> frame{Rational3{1, 0, 0}, Rational3{0, 1, 0}, Rational3{0, 0, 1}};
  if (along.empty()) return frame;
  if (along.size() > 2 || is_zero(along.front())) return std::nullopt;
  if (along.size() == 2) {
    frame = {along[0], along[1], cross(along[0], along[1])};
    return is_zero(frame[2]) ? std::nullopt : std::optional(frame);
  }
  const auto first = std::find_if(along[0].begin(), along[0].end(), [](const Rational& x) { return x != 0; });
  frame.at(static_cast<std::size_t>(first - along[0].begin())) = frame[0];
  frame[0] = along[0];
  return frame;
}

bool is_along(std::span<const Rational3> along, const Rational3& direction) {
  if (along.empty()) return is_zero(direction);
  return along.size() == 1 ? is_zero(cross(along[0], direction)) : dot(cross(along[0], along[1]), direction) == 0;
}

namespace {

Rational length_of(const Rational3& v) { return abs(v[0]) + abs(v[1]) + abs(v[2]); }

// a times the largest power of two with which it is not longer than b; itself if it is longer.
Rational3 lengthened(const Rational3& a, const Rational3& b) {
  const Rational ratio = length_of(b) / length_of(a);
  if (ratio < 1) return a;
  const Integer whole = ratio.get_num() / ratio.get_den();
  Rational factor = 1;
  mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), mpz_sizeinbase(whole.get_mpz_t(), 2) - 1);
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

}  // namespace

Rational3 balanced_sum(const Rational3& a, const Rational3& b) { return plus(lengthened(a, b), lengthened(b, a)); }

namespace {

using TightComplaint = std::optional<std::string>;
using Normals = std::vector<Rational3>;
using Corners = std::array<Rational3, 3>;
using Tight = PathProof::Tight;

class TightCheck {
 public:
  TightCheck(const PathProof& proof, std::size_t pose)
      : claim_(proof.claim),
        tight_(proof.tight[pose]),
        position_(claim_.path[pose].position),
        along_(claim_.along[pose]) {}

  TightComplaint run() {
    const auto frame = tight_frame(along_);
    if (!frame) return "a passage needs at most two vectors, linearly independent";
    for (const Tight::Contact& contact : tight_.contacts) {
      if (TightComplaint complaint = contact.side ? check_side(*contact.side) : check_pieces(contact)) return complaint;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      Corners corners = *frame;
      for (unsigned k = 0; k < 3; ++k) {
        if ((octant & 1U << k) != 0) corners[k] = opposite(corners[k]);
      }
      if (TightComplaint complaint = check(tight_.octants[octant], corners)) return complaint;
    }
    return std::nullopt;
  }

 private:
  TightComplaint check_side(std::uint32_t side) {
    const std::size_t axis = side % 3;
    const bool upper = side >= 3;
    if (side > 5 || !claim_.box || position_[axis] != (*claim_.box)[upper ? 1 : 0][axis]) {
      return "a position is not on the side of the box that its proof names";
    }
    Rational3 normal;
    normal[axis] = upper ? -1 : 1;
    normals_.push_back({normal});
    return std::nullopt;
  }

  TightComplaint check_pieces(const Tight::Contact& contact) {
    if (contact.robot >= claim_.robot.size() || contact.obstacle >= claim_.obstacles.size()) {
      return "a contact names a piece that does not exist";
    }
    std::vector<Rational3> piece;
    for (const Rational3& vertex : claim_.robot[contact.robot]) piece.push_back(plus(vertex, position_));
    const std::vector<Rational3>& obstacle = claim_.obstacles[contact.obstacle];
    const std::optional<Rational3> point = weighted_sum(piece, contact.common.robot, false);
    if (!point || point != weighted_sum(obstacle, contact.common.obstacle, false)) {
      return "the point of a contact is not common to its pieces";
    }
    std::vector<Rational3> vectors;
    for (const Rational3& vertex : obstacle) vectors.push_back(minus(vertex, *point));
    for (const Rational3& vertex : piece) vectors.push_back(minus(*point, vertex));
    normals_.push_back(outer_planes(vectors));
    if (normals_.back().empty()) return "two pieces of a contact overlap, or are flat";
    return std::nullopt;
  }

  [[nodiscard]] TightComplaint check(const Tight::Cone& cone, const Corners& corners) const {
    if (!cone.edge) {
      if (cone.contact >= normals_.size()) return "a cone names a contact that does not exist";
      for (const Rational3& d : corners) {
        const bool may_be_free = is_along(along_, d);
        for (const Rational3& n : normals_[cone.contact]) {
          const int side = sgn(dot(n, d));
          if (side > 0 || (side == 0 && !may_be_free)) return "a contact does not block all directions of a cone";
        }
      }
      return std::nullopt;
    }
    if (*cone.edge > 2) return "a cone has three edges";
    const std::size_t next = (*cone.edge + 1) % 3;
    for (const std::size_t half : {0U, 1U}) {
      Corners part = corners;
      part[half == 0 ? next : *cone.edge] = balanced_sum(corners[*cone.edge], corners[next]);
      if (TightComplaint complaint = check(cone.halves[half], part)) return complaint;
    }
    return std::nullopt;
  }

  const PathProof::Claim& claim_;
  const Tight& tight_;
  const Rational3& position_;
  const std::vector<Rational3>& along_;
  std::vector<Normals> normals_;  // of each contact
};

}  // namespace

TightComplaint complaint_about_tight(const PathProof& proof, std::size_t pose) { return TightCheck(proof, pose).run(); }

}  // namespace nef::planner
