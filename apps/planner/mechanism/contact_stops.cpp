// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/mechanism/contact_stops.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "nef/query/location_name.h"

namespace nef::planner {
namespace {

// A point inside an item of a piece.
Rational3 place_of(const ContactPiece& piece, std::uint32_t item, bool is_vertex, bool is_face) {
  if (is_vertex) return piece.vertices()[item];
  std::vector<std::uint32_t> corners;
  if (is_face) {
    corners = piece.faces[item].ring;
  } else {
    corners = {piece.edges[item].from, piece.edges[item].to};
  }
  Rational3 middle;
  for (const std::uint32_t corner : corners) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] += piece.vertices()[corner][k] / Rational(corners.size());
  }
  return middle;
}

// The cell of the set that a point is in: pieces have vertices, edges and faces where the set has none.
std::string name_of(const Polyhedron& set, const Rational3& point) {
  const Location at = locate(set, point);
  return std::string(location_name(at.kind)) + " " + std::to_string(at.index);
}

}  // namespace

std::vector<ContactPair> stops_at(const JointEvent& event, const Joint& joint, const MechanismPieces& pieces,
                                  const MechanismSets& sets) {
  std::vector<ContactPair> result;
  std::optional<std::pair<std::uint32_t, PlacedPiece>> placed;
  for (const auto& [pair, items] : event.items) {
    const ContactPiece& fixed = pieces.fixed[pair[1]];
    if (event.between) {
      const Joint::Sweep sweep = joint.sweep((*event.between)[0], (*event.between)[1], 0);
      if (!may_touch(pieces.moving[pair[0]], fixed, sweep.all, items)) continue;
    } else {
      if (!placed || placed->first != pair[0]) {
        placed.emplace(pair[0], PlacedPiece(pieces.moving[pair[0]], joint, event.value));
      }
      if (!placed->second.touch(fixed, items)) continue;
    }
    using Kind = ContactItems::Kind;
    const std::size_t owner = sets.owners[pair[1]];
    ContactPair stop{name_of(sets.moving, place_of(pieces.moving[pair[0]], items.moving,
                                                   items.kind == Kind::kVertexFace, items.kind == Kind::kFaceVertex)),
                     owner,
                     name_of(sets.fixed[owner], place_of(fixed, items.fixed, items.kind == Kind::kFaceVertex,
                                                         items.kind == Kind::kVertexFace))};
    const auto same = [&](const ContactPair& other) {
      return other.moving == stop.moving && other.fixed == stop.fixed && other.of_fixed == stop.of_fixed;
    };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(stop));
  }
  return result;
}

}  // namespace nef::planner
