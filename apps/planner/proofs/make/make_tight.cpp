// SPDX-License-Identifier: Apache-2.0
//
// At a position inside of the largest cell of a passage, the pieces that touch and the sides of the box block cones of
// directions. Directions are cut into cones until one contact blocks all of a cone but what leads along the passage.
// The widest edge of a cone is halved. But halving only these, a cone with a direction along the passage in a corner
// would come nearer to it and never narrower around it; so every other time the edge that is seen from there is halved.
#include <algorithm>
#include <utility>

#include "apps/planner/free_space/free_space.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "apps/planner/proofs/make/piece_contact.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Tight = PathProof::Tight;

// Vectors that span the directions of a cell.
std::vector<Rational3> directions_of_cell(const FreeSpace& free, CellId cell) {
  std::vector<Rational3> result;
  const std::vector<Rational3> vertices = free.vertices(cell);
  const auto dimension = static_cast<std::size_t>(free.cells().dimension(cell));
  for (std::size_t i = 1; i < vertices.size() && result.size() < dimension; ++i) {
    const Rational3 d = to_rational(primitive(minus(vertices[i], vertices[0])));
    if (result.empty() || !is_zero(cross(result[0], d))) result.push_back(d);
  }
  return result;
}

class TightSearch {
 public:
  TightSearch(const PathProof::Claim& claim, const Rational3& position, std::vector<Rational3> along,
              const Monitor& monitor)
      : along_(std::move(along)), monitor_(monitor) {
    for (std::uint32_t side = 0; claim.box && side < 6; ++side) {
      const std::size_t axis = side % 3;
      if (position[axis] != (*claim.box)[side / 3][axis]) continue;
      Integer3 normal;
      normal[axis] = side < 3 ? 1 : -1;
      known_.push_back({{0, 0, {}, side}, {normal}});
    }
    for (std::uint32_t i = 0; i < claim.robot.size(); ++i) {
      std::vector<Rational3> piece;
      for (const Rational3& vertex : claim.robot[i]) piece.push_back(plus(vertex, position));
      for (std::uint32_t j = 0; j < claim.obstacles.size(); ++j) {
        monitor.check_interruption();
        std::optional<BlockingContact> found = contact_of_pieces(piece, claim.obstacles[j]);
        if (found) known_.push_back({{i, j, std::move(found->common), {}}, std::move(found->blocked)});
      }
    }
  }

  std::optional<Tight> run() {
    const auto frame = tight_frame(along_);
    if (!frame) return std::nullopt;
    for (unsigned octant = 0; octant < 8; ++octant) {
      ConeCorners corners = *frame;
      for (unsigned k = 0; k < 3; ++k) {
        if ((octant >> k & 1U) != 0) corners[k] = opposite(corners[k]);
      }
      std::optional<Tight::Cone> cone = cover(corners, 0);
      if (!cone) return std::nullopt;
      tight_.octants[octant] = std::move(*cone);
    }
    return std::move(tight_);
  }

 private:
  struct Known {
    Tight::Contact contact;
    OpenCone blocked;
    std::optional<std::uint32_t> number = std::nullopt;  // in the proof, which has the contacts that are used
  };

  [[nodiscard]] bool blocks(const OpenCone& cone, const ConeCorners& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](const Rational3& d) {
      const int most = is_along(along_, d) ? 0 : -1;
      return std::all_of(cone.begin(), cone.end(),
                         [&](const Integer3& n) { return sgn(dot(to_rational(n), d)) <= most; });
    });
  }

  [[nodiscard]] std::size_t edge_to_halve(const ConeCorners& corners, unsigned depth) const {
    std::array<bool, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = is_along(along_, corners[k]);
    const auto count = std::count(along.begin(), along.end(), true);
    if (depth % 2 == 1 || count == 0 || count == 3) return widest_edge(corners);
    // Opposite to the only corner that is along the passage, or to the only one that is not.
    const auto single = std::find(along.begin(), along.end(), count == 1);
    return static_cast<std::size_t>(single - along.begin() + 1) % 3;
  }

  std::optional<Tight::Cone> cover(const ConeCorners& corners, unsigned depth) {
    monitor_.check_interruption();
    if (++cones_ > kMostCones) return std::nullopt;
    for (Known& known : known_) {
      if (!blocks(known.blocked, corners)) continue;
      if (!known.number) {
        known.number = static_cast<std::uint32_t>(tight_.contacts.size());
        tight_.contacts.push_back(known.contact);
      }
      return Tight::Cone{std::nullopt, {}, *known.number};
    }
    if (depth == kMostHalvings) return std::nullopt;
    const std::size_t edge = edge_to_halve(corners, depth);
    Tight::Cone result;
    result.edge = static_cast<std::uint32_t>(edge);
    for (const std::size_t end : {(edge + 1) % 3, edge}) {
      ConeCorners half = corners;
      half[end] = balanced_sum(corners[edge], corners[(edge + 1) % 3]);
      std::optional<Tight::Cone> cone = cover(half, depth + 1);
      if (!cone) return std::nullopt;
      result.halves.push_back(std::move(*cone));
    }
    return result;
  }

  const std::vector<Rational3> along_;
  Monitor monitor_;
  std::vector<Known> known_;
  Tight tight_;
  std::size_t cones_ = 0;
};

}  // namespace

std::optional<PathProof> make_tight_proof(const Scene& scene, const FreeSpace& free, const Monitor& monitor) {
  PathProof proof;
  const MotionChecker checker = MotionChecker::of_scene(scene, monitor);
  for (const TightPassage& passage : free.passages()) {
    const auto cell = std::find_if(passage.cells.begin(), passage.cells.end(),
                                   [&](CellId c) { return free.cells().dimension(c) == passage.dimension; });
    const RigidPose pose{free.point_in(*cell, monitor), {1, 0, 0, 0}};
    std::optional<PathProof> stays = make_path_proof(checker, std::span(&pose, 1), monitor.quiet());
    if (!stays || stays->claim.status != PathProof::Claim::Status::kFree || stays->motions[0].size() != 1) {
      return std::nullopt;
    }
    std::vector<Rational3> along = directions_of_cell(free, *cell);
    std::optional<Tight> tight = TightSearch(stays->claim, pose.position, along, monitor).run();
    if (!tight) return std::nullopt;
    tight->planes = std::move(stays->motions[0][0].planes);
    if (proof.tight.empty()) {
      proof.claim = std::move(stays->claim);
      proof.claim.status = PathProof::Claim::Status::kTight;
    } else {
      proof.claim.path.push_back(pose);
    }
    proof.claim.along.push_back(std::move(along));
    proof.tight.push_back(std::move(*tight));
  }
  return proof.tight.empty() ? std::nullopt : std::optional(std::move(proof));
}

}  // namespace nef::planner
