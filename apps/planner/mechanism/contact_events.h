// SPDX-License-Identifier: Apache-2.0
//
// When may two convex polytopes begin or cease to touch or to overlap, while a joint moves one of them?
//
// Two polytopes are apart iff a plane through a face of one of them, or along an edge of each, keeps them apart. As
// long as such a plane does, a product of its normal with a difference of vertices is positive; when none does any
// more, one of these products is 0. Each product is linear in the entries of the rotation, or in the stroke: a
// quadratic polynomial of a hinge's value, a linear one of a slider's. Their roots are all values at which anything can
// change. Of a screw they are transcendental (screw_contact.h).
#pragma once

#include <cstdint>
#include <vector>

#include "apps/planner/mechanism/joint.h"
#include "apps/planner/mechanism/screw_contact.h"
#include "apps/planner/rigid/rigid_body.h"

namespace nef::planner {

/// A convex polytope with an inside, ready for questions about contact.
struct ContactPiece {
  explicit ContactPiece(const RigidBody::Piece& its_piece);
  struct Face {
    Rational3 normal;  ///< outward
    std::vector<std::uint32_t> ring;
  };
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
  };
  const RigidBody::Piece* piece;  ///< outlives this
  std::vector<Face> faces;
  std::vector<Edge> edges;
  Vector3d middle = Vector3d::Zero();  ///< of the vertices, rounded
  [[nodiscard]] const std::vector<Rational3>& vertices() const { return piece->mesh.vertices; }
};

/// Which items of two pieces may touch at an event: a vertex of one and a face of the other, or an edge of each.
struct ContactItems {
  enum class Kind : std::uint8_t { kVertexFace, kFaceVertex, kEdges };  ///< the moving piece's item first
  Kind kind = Kind::kVertexFace;
  std::uint32_t moving = 0;  ///< the number of the item in its piece
  std::uint32_t fixed = 0;
};

struct ContactEvent {
  QuadraticRoot value;
  ContactItems items;
};

/// A contact product of two items that may be 0 in a part of a screw's motion.
struct ScrewContact {
  ScrewProduct product;
  ContactItems items;
};

/// The values in [from, to], which must be within one quarter, as events in them are found: made once for all pairs of
/// pieces. For all joints but four-bar linkages.
struct EventCell {
  EventCell(const Joint& joint, const Rational& from, const Rational& to);
  Rational from;
  Rational width;
  bool turning = false;
  std::array<Matrix3, 3> turns;  ///< control values of the rotation, with their weights
  std::array<Rational, 3> weights;
  std::array<Rational3, 2> positions;  ///< of a screw: the origin, and the way of a quarter
  MotionCell rounded;                  ///< the same in doubles
};

/// Appends all events in a cell at which the two may begin or cease to touch or to overlap. Doubles with proven bounds
/// drop most products; the others cost some microseconds.
void append_events(const ContactPiece& moving, const ContactPiece& fixed, const EventCell& cell,
                   std::vector<ContactEvent>& events);

/// The same for a screw: appends the products that tell it, without those that are 0 all the time.
void append_products(const ContactPiece& moving, const ContactPiece& fixed, const EventCell& cell,
                     std::vector<ScrewContact>& products);

/// About how many products there are.
std::size_t event_cost(const ContactPiece& moving, const ContactPiece& fixed);

/// False only if two items surely have no point in common in a cell that is about as narrow as doubles can tell, and in
/// which they come into one plane. O(corners).
bool may_touch(const ContactPiece& moving, const ContactPiece& fixed, const MotionCell& cell,
               const ContactItems& items);

/// The moving piece at a value, exactly.
class PlacedPiece {
 public:
  PlacedPiece(const ContactPiece& moving, const Joint& joint, const QuadraticRoot& value);
  /// Has the piece a point in common with one that it does not overlap? Then a vertex of one is in the other, or two
  /// edges cross. O(vertices faces + edges^2) in doubles with proven bounds, exact where they cannot tell.
  [[nodiscard]] bool touches(const ContactPiece& fixed) const;
  /// Have the two items a point in common, if the vertex is in the plane of the face? (Edges that are parallel count as
  /// having none.) O(corners).
  [[nodiscard]] bool touch(const ContactPiece& fixed, const ContactItems& items) const;
  /// Does the plane of a face, or along both edges, lie between the two pieces, which it may touch? The value must be
  /// that of an event of these items. O(vertices).
  ///
  /// Two pieces that overlap on one side of a value, however near to it, overlap there, too, unless an event's plane is
  /// between them. For if they do not, the origin is on a facet of their set of differences. Either that is parallel to
  /// a face, whose plane separates the two at the value and not next to it: a vertex behind the plane has come into it.
  /// Or it is spanned by two edges that meet, and is a facet next to the value, too, where the origin is inside. The
  /// product of these items is 0 at the value, and not all the time.
  [[nodiscard]] bool is_between(const ContactPiece& fixed, const ContactItems& items) const;

 private:
  [[nodiscard]] Surd3 turned(const Rational3& v) const;
  [[nodiscard]] bool edges_between(const ContactPiece& fixed, const ContactItems& items) const;
  [[nodiscard]] bool is_vertex_in(const ContactPiece& fixed, double error) const;
  [[nodiscard]] bool has_vertex_of(const ContactPiece& fixed, double error) const;

  const ContactPiece& moving_;
  MotionCell around_;  // a cell that has the value
  std::array<Surd3, 4> pose_;
  std::vector<Surd3> vertices_;
};

}  // namespace nef::planner
