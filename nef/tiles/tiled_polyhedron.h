// SPDX-License-Identifier: Apache-2.0
//
// A set in tiles: an operation costs what it touches, not what is there.
#pragma once

#include <optional>
#include <span>

#include "nef/base/monitor.h"
#include "nef/parts/section.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiling.h"

namespace nef {

struct TileRef;

/// An exact point set, as a Polyhedron is, cut along axis-parallel planes into the leaves of a tree (docs/tiles.md). It
/// never changes: operations return new sets, which share with their operands all tiles that stay as they are, so
/// copies are O(1) and old versions cost what they differ by. May be read from several threads at once.
///
/// Marks other than 0 are taken as 1. Where operands differ in their tiling, the result has that of the first one.
class TiledPolyhedron {
 public:
  /// The empty set.
  TiledPolyhedron();
  /// Cuts a set into tiles. O(n log n).
  TiledPolyhedron(const Polyhedron& set, const Tiling& tiling, const Monitor& monitor = {});
  /// The same with tiling_for() its vertices.
  explicit TiledPolyhedron(const Polyhedron& set);
  /// The union of any number of sets, region by region (import/union_in_tiles.h).
  explicit TiledPolyhedron(std::span<const Polyhedron> pieces, const Tiling& tiling = {.limit = kVerticesOfTileInFile},
                           const Monitor& monitor = {});

  [[nodiscard]] const Tiling& tiling() const { return tiling_; }
  [[nodiscard]] std::size_t tile_count() const;
  /// Of all tiles, those in their walls included.
  [[nodiscard]] std::size_t vertex_count() const;

  /// O(1).
  [[nodiscard]] bool is_empty() const;
  [[nodiscard]] bool is_everything() const;

  /// The set in one complex, in canonical order: it depends on the set alone, not on how it is cut. O(n log n).
  [[nodiscard]] Polyhedron polyhedron(const Monitor& monitor = {}) const;

  [[nodiscard]] const TileRef& tree() const { return *root_; }
  /// A set from a tree of tiles over all of space.
  TiledPolyhedron(TileRef root, const Tiling& tiling);

 private:
  std::shared_ptr<const TileRef> root_;
  Tiling tiling_;
};

// Boolean operations. O(1) for every node of the first operand's tree that the boundary of the second one meets, and an
// operation of Polyhedron for every such tile. A second operand that is in no tiles is not cut as long as it is small.
TiledPolyhedron unite(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor = {});
TiledPolyhedron unite(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
TiledPolyhedron intersect(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor = {});
TiledPolyhedron intersect(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
TiledPolyhedron subtract(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor = {});
TiledPolyhedron subtract(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
TiledPolyhedron symmetric_difference(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor = {});
TiledPolyhedron symmetric_difference(const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
/// Any other of them: a point is in the result if f[2 * (in a) + (in b)] holds.
TiledPolyhedron overlay(const TiledPolyhedron& a, const TiledPolyhedron& b, const std::array<bool, 4>& f,
                        const Monitor& monitor = {});
TiledPolyhedron overlay(const TiledPolyhedron& a, const Polyhedron& b, const std::array<bool, 4>& f,
                        const Monitor& monitor = {});

/// O(1).
TiledPolyhedron complement(const TiledPolyhedron& a);

// Topology of neighbourhoods, which tiles do not know at their walls: these glue and cut again, O(n log n).
TiledPolyhedron interior(const TiledPolyhedron& a, const Monitor& monitor = {});
TiledPolyhedron closure(const TiledPolyhedron& a, const Monitor& monitor = {});
TiledPolyhedron boundary(const TiledPolyhedron& a, const Monitor& monitor = {});
TiledPolyhedron exterior(const TiledPolyhedron& a, const Monitor& monitor = {});
TiledPolyhedron regularize(const TiledPolyhedron& a, const Monitor& monitor = {});

/// The image under an invertible map; throws InputError if the determinant is zero. Tile by tile if the map takes axes
/// to axes; otherwise the set is glued and cut again. O(n), or O(n log n).
TiledPolyhedron transform(const TiledPolyhedron& a, const AffineMap& map, const Monitor& monitor = {});

/// True if the two are the same set. Costs a symmetric difference: tiles that they share cost nothing.
bool equal(const TiledPolyhedron& a, const TiledPolyhedron& b, const Monitor& monitor = {});

/// Exact point location in the tiles that hold the point; O(log n) expected after their structures are built. The kind
/// of item is that of the whole set, whatever the tiles; its index means nothing and is 0.
Location locate(const TiledPolyhedron& a, const Rational3& point, const Monitor& monitor = {});
bool contains(const TiledPolyhedron& a, const Rational3& point, const Monitor& monitor = {});

/// The first vertex, edge or facet of the whole set on the ray from `origin` (excluded) in `direction` (not zero) that
/// `accept` takes, as of a Polyhedron; indices are 0. Only tiles along the ray are looked at. Throws InputError for no
/// direction.
std::optional<RayHit> shoot_ray(const TiledPolyhedron& a, const Rational3& origin, const Rational3& direction,
                                const std::function<bool(const Location&)>& accept = {}, const Monitor& monitor = {});

/// Volume of the set, if finite: the sum over the tiles.
std::optional<Rational> volume(const TiledPolyhedron& a, const Monitor& monitor = {});

/// Smallest and largest coordinates of the vertices, as of a Polyhedron. O(n); glues sets whose boundary is unbounded.
std::optional<std::array<Rational3, 2>> bounding_box(const TiledPolyhedron& a, const Monitor& monitor = {});

/// Both, where each tile is read once.
struct VolumeAndBox {
  std::optional<Rational> volume;
  std::optional<std::array<Rational3, 2>> box;
};
VolumeAndBox volume_and_bounding_box(const TiledPolyhedron& a, const Monitor& monitor = {});

/// The section of the set with a plane, as of a Polyhedron. Only the tiles that the plane meets are looked at and
/// glued.
Section section(const TiledPolyhedron& a, const Rational3& normal, const Rational& offset, const Monitor& monitor = {});

}  // namespace nef
