// SPDX-License-Identifier: Apache-2.0
//
// How the triangles of a surface meet beyond the vertices and edges that they share.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_patches.h"

namespace nef {

/// Pairs of triangles of a surface.
using OpenPairs = std::vector<std::array<std::uint32_t, 2>>;

/// Finds where a triangulated surface crosses, overlaps or touches itself.
///
/// Two triangles cross if their relative interiors meet in a segment. If these meet in an area, they overlap (turned
/// the same way) or cover each other (back to back). What they have in common otherwise lies on the border of one of
/// them. If that is a segment, the surface may still cross itself there: if the triangles of one that go on from the
/// segment lie on both sides of the other, and going around it means more than going in and out of a solid. If it
/// is a point, it is harmless: wherever the surface crosses itself through a point, other triangles meet in
/// segments that end there.
class SurfaceContacts {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  enum class Kind : std::uint8_t { kNone, kTouch, kCover, kCross, kOverlap };

  /// The surface must outlive this object.
  SurfaceContacts(const MeshSurface& surface, const Monitor& monitor);

  /// Of the triangles of the surface.
  [[nodiscard]] const VertexStars& stars() const { return patches_.stars(); }

  /// Calls visit(kind, t, u) for every pair t < u with a contact, in lexicographic order; kind is not kNone.
  /// Stops when visit returns false. Of points near doubles (MeshPoints::near): pairs that they leave open go to `open`
  /// if it is given, up to one for every 32 triangles.
  void for_each(const std::function<bool(Kind, std::uint32_t, std::uint32_t)>& visit, OpenPairs* open = nullptr) const;

  /// Calls visit(u, v, triangles) for every edge of more than two triangles which use it equally often in both
  /// directions but do not separate inside from outside around it.
  void for_each_bad_edge(
      const std::function<bool(std::uint32_t, std::uint32_t, std::span<const std::uint32_t>)>& visit) const;

  /// A triangle around the segment from u to v: its corner beside the segment, +1 if it runs from u to v or -1 if
  /// from v to u, and whether it belongs to the first or second of two surfaces.
  struct Wing {
    std::uint32_t apex = 0;
    int direction = 0;
    bool second = false;
  };
  struct Around {
    bool separates = false;    ///< going around the segment goes in and out of a solid, which it winds around once
    bool interleaved = false;  ///< the second surface goes on in different sectors of the first
  };
  /// How triangles lie around a segment. O(n log n) for n of them.
  [[nodiscard]] Around around_segment(std::uint32_t u, std::uint32_t v, std::span<const Wing> wings) const;

 private:
  // A triangle at an edge.
  struct HalfEdge {
    std::uint32_t triangle = 0;
    std::uint32_t apex = 0;
    int direction = 0;  // +1 if the triangle runs from the smaller to the larger vertex
  };
  struct Interval;
  struct Edge {
    std::uint32_t u = 0, v = 0;
    bool valid = false;
  };

  [[nodiscard]] Kind classify(std::uint32_t t, std::uint32_t u) const;
  [[nodiscard]] bool meet_in_corner(std::uint32_t t, std::uint32_t u) const;
  [[nodiscard]] Kind classify_general(std::uint32_t t, std::uint32_t u, int shared) const;
  [[nodiscard]] Kind classify_coplanar(std::uint32_t t, std::uint32_t u, int shared) const;
  [[nodiscard]] Kind classify_neighbours(std::uint32_t t, std::uint32_t u, std::size_t t_free,
                                         std::size_t u_free) const;
  [[nodiscard]] Kind resolve_segment(std::uint32_t t, Edge t_edge, std::uint32_t u, Edge u_edge) const;
  [[nodiscard]] std::vector<HalfEdge> around(std::uint32_t u, std::uint32_t v) const;
  bool add_wings(std::uint32_t triangle, Edge own, Edge along, bool second, std::vector<Wing>& wings) const;
  [[nodiscard]] bool same_direction(Edge a, Edge b) const;
  [[nodiscard]] bool turned_alike(const Triangle& a, const Triangle& b) const;

  [[nodiscard]] int side(std::uint32_t triangle, std::uint32_t place) const;

  const MeshPoints& points_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint32_t> face_of_;
  SurfacePatches patches_;
  Monitor monitor_;
};

/// Two faces that meet otherwise than in common vertices and edges, f < g, or one that meets itself, f == g.
struct FaceContact {
  std::uint32_t f = 0;
  std::uint32_t g = 0;
  SurfaceContacts::Kind kind = SurfaceContacts::Kind::kNone;  ///< the worst of those between their triangles
  bool covers = false;                                        ///< two of their triangles cover each other
};

/// Those of a surface, if they have been looked for.
using KnownContacts = std::optional<std::vector<FaceContact>>;

/// All contacts of a surface, each pair of faces once, in lexicographic order. `open`: see SurfaceContacts::for_each.
std::vector<FaceContact> face_contacts(const MeshSurface& surface, const SurfaceContacts& contacts,
                                       OpenPairs* open = nullptr);

/// How many of them are crossings or overlaps.
std::size_t count_crossings(std::span<const FaceContact> contacts);

}  // namespace nef
