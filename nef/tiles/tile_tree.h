// SPDX-License-Identifier: Apache-2.0
//
// The tree of tiles behind a TiledPolyhedron. Nodes never change, so that any number of trees share them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"
#include "nef/tiles/region.h"
#include "nef/tiles/storage/tile_store.h"

namespace nef {

struct TileNode;

/// A subtree, or the complement of one: that costs nothing.
struct TileRef {
  std::shared_ptr<const TileNode> node;
  bool complemented = false;

  [[nodiscard]] TileRef complement() const;
  bool operator==(const TileRef&) const = default;
};

/// A leaf without boundary, a leaf with a complex, or a cut. Which region it stands for is told by the way to it.
struct TileNode {
  enum class Kind : std::uint8_t { kUniform, kTile, kCut };
  Kind kind = Kind::kUniform;
  LabelId mark = 0;  ///< uniform leaf: 0 or 1

  /// Tile: the set in the closed region, kOutside beyond it; in memory, or kept by a store. The one tile of all space
  /// is an ordinary complex.
  Polyhedron in_memory;
  std::shared_ptr<const StoredTile> stored;
  Box box;             ///< Tile: of the set's boundary in the region.
  bool uncut = false;  ///< Tile: an operation that touches a small part of it cuts it first, around that part

  AxisPlane plane;  ///< Cut: inside the region.
  TileRef low;
  TileRef high;

  std::size_t vertices = 0;  ///< of all tiles of the subtree
  std::size_t tiles = 0;     ///< leaves that are no uniform ones

  /// The set of a tile. Throws FileError if it has to be read from a file and cannot.
  [[nodiscard]] Polyhedron set() const { return stored ? stored->load() : in_memory; }
};

/// What of a complex tells whether and where it is cut. Needs its sphere maps only.
struct TileMeasure {
  Box box;              ///< of the vertices where the set has boundary
  bool uniform = true;  ///< no boundary at all
  LabelId mark = 0;     ///< then: of every point
};
TileMeasure measure_tile(const Complex& complex);

/// True if the set has boundary at a point with this map: not all marks other than kOutside are the same.
bool has_boundary(const SphereMapView& map);

/// The same for the vertices of a complex, which must outlive it. Marks are those of patterns, each of which is looked
/// at once.
class BoundaryVertices {
 public:
  explicit BoundaryVertices(const Complex& complex) : c_(complex), known_(complex.patterns.size(), kUnknown) {}
  bool operator()(VertexId vertex);

 private:
  static constexpr std::uint8_t kUnknown = 2;

  const Complex& c_;
  std::vector<std::uint8_t> known_;  // of each pattern
};

/// Leaves with these contents; `set` must be in its region. It is kept by the store, if there is one.
TileRef uniform_leaf(LabelId mark);
TileRef tile_leaf(Polyhedron set, const std::shared_ptr<TileStore>& store, bool uncut = false);

/// The node of a cut, or what is there instead: one leaf if both sides are the same mark.
TileRef cut_node(const AxisPlane& plane, TileRef low, TileRef high);

/// The parts below and above the plane of a cut, complemented where the tree is.
std::array<TileRef, 2> children(const TileRef& cut);

/// The set of a leaf, in its region.
Polyhedron leaf_set(const TileRef& leaf, const Region& region, const Monitor& monitor);

/// The mark beyond a plane of a tile whose boundary lies strictly on one side of it: above for side = +1, below for -1.
LabelId mark_beyond(const TileNode& tile, const AxisPlane& plane, int side);

}  // namespace nef
