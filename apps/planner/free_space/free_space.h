// SPDX-License-Identifier: Apache-2.0
//
// The free space of a translating robot: the cells of a Nef polyhedron, how they touch, which of
// them make up its components, and where it is as thin as a facet, an edge or a point.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/free_space/empty_grid.h"
#include "apps/planner/free_space/incidences.h"
#include "apps/planner/intersection/item_tree.h"
#include "apps/planner/partition/cells.h"
#include "apps/planner/partition/roadmap.h"
#include "apps/planner/partition/space_tree.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// A connected component of free space.
struct Component {
  int dimension = 0;  ///< of its largest cell
  bool bounded = true;
  std::size_t cells = 0;
};

/// How thin free space gets on the way between two points.
struct Thinness {
  int piece = 0;     ///< T: the largest k so that a path stays where F is locally at least k-dimensional
  int junction = 0;  ///< J: the largest j so that a path crosses only cells of dimension j or more, the
                     ///< cells of start and goal exempt
};

/// Different volumes that touch without any passage between them: a connected set of free edges and
/// vertices, around each of which lie at least two of the volumes.
struct TouchingVolumes {
  int dimension = 0;  ///< of its largest cell: 1 or 0
  std::uint32_t component = 0;
  std::vector<CellId> cells;
  std::vector<CellId> volumes;  ///< the volumes
};

/// A tight passage: a component of F \ closure(interior(F)). The robot touches obstacles on
/// opposite sides everywhere in it (thesis 1.1: lower-dimensional features of the configuration
/// space).
struct TightPassage {
  int dimension = 0;  ///< of its largest cell: 2, 1 or 0
  /// The best way through it, from one volume to another: T and J of its cells and mouths. Nothing where it joins fewer
  /// than two volumes.
  std::optional<Thinness> bottleneck;
  std::uint32_t component = 0;
  std::vector<CellId> cells;
  std::vector<CellId> mouths;   ///< cells of the rest of F that touch it, from which one enters
  std::vector<CellId> volumes;  ///< the volumes that the mouths belong to
};

/// The truth about where the reference point may be, in two stages: the cells, how they touch, components and passages
/// are there from the beginning (O(n log n) for n items of the complex); what paths and fast checks need, trees, the
/// partition of space and its roadmap, is made when first asked for, or by build_roadmap. Its answers never change, and
/// any number of threads may ask.
class FreeSpace {
 public:
  /// `free` is the set of free positions; marks other than 0 are free. Throws UnsupportedError for
  /// a set that is bounded by infinitely long edges or facets.
  explicit FreeSpace(Polyhedron free);
  // Share it by pointer.
  FreeSpace(const FreeSpace&) = delete;
  FreeSpace& operator=(const FreeSpace&) = delete;

  /// The set of free positions, its complex, and how its items are numbered.
  /// @{
  [[nodiscard]] const Polyhedron& set() const { return free_; }
  [[nodiscard]] const Complex& complex() const { return free_.complex(); }
  [[nodiscard]] const CellNumbering& cells() const { return cells_; }
  /// @}
  /// Makes the partition and the roadmap unless they are there. O(n log n) expected. If it is interrupted, nothing is
  /// kept.
  void build_roadmap(const Monitor& monitor = {}) const { static_cast<void>(partition(monitor)); }
  /// Whether the roadmap was made.
  [[nodiscard]] bool has_roadmap() const { return ready_.load(std::memory_order_acquire) != nullptr; }
  /// What making it has taken; 0 without it.
  [[nodiscard]] double roadmap_seconds() const {
    const Partition* ready = ready_.load(std::memory_order_acquire);
    return ready == nullptr ? 0 : ready->seconds;
  }
  /// The partition of space and the roadmap through its cells, made when first asked for.
  /// @{
  [[nodiscard]] const SpaceTree& tree() const { return partition({}).tree; }
  [[nodiscard]] const Roadmap& roadmap() const { return partition({}).roadmap; }
  /// @}
  /// The boundary's items by where they are, made when first asked for: O(n log n), far cheaper than the partition.
  [[nodiscard]] const ItemTree& items() const;
  /// Cubes of space that no boundary enters, made when first asked for: O(n).
  [[nodiscard]] const EmptyGrid& grid(const Monitor& monitor = {}) const;

  /// Whether a cell is free. O(1).
  [[nodiscard]] bool is_free(CellId cell) const { return component_[cell] != kNoComponent; }
  /// Component of a free cell.
  [[nodiscard]] std::uint32_t component(CellId cell) const { return component_[cell]; }
  /// The largest dimension of free cells that hold the cell in their closure (itself included).
  [[nodiscard]] int local_dimension(CellId cell) const { return local_dimension_[cell]; }
  /// The free cells that touch a free cell (one lies in the closure of the other).
  [[nodiscard]] std::span<const CellId> neighbours(CellId cell) const { return incidences_.of(cell); }
  /// Index of the tight passage that the cell belongs to; nothing if it is in none.
  [[nodiscard]] std::optional<std::uint32_t> passage_of(CellId cell) const;

  /// The components of the free positions, the passages that are tight, and pairs of volumes that touch. O(1).
  /// @{
  [[nodiscard]] std::span<const Component> components() const { return components_; }
  [[nodiscard]] std::span<const TightPassage> passages() const { return passages_; }
  [[nodiscard]] std::span<const TouchingVolumes> touching_volumes() const { return touching_; }
  /// @}

  /// The corners of a box that holds the boundary with room to spare. O(n).
  [[nodiscard]] std::array<Rational3, 2> bounds() const { return padded_box(complex()); }

  /// The cell of a point: O(log n) expected; with the roadmap about a microsecond or less for doubles.
  [[nodiscard]] CellId locate(const ExactPoint& point) const;
  /// Whether a point is free; as locate.
  [[nodiscard]] bool is_free(const ExactPoint& point) const { return is_free(locate(point)); }

  /// T and J between two free cells; nothing if they are not connected. O(cells).
  [[nodiscard]] std::optional<Thinness> thinness(CellId start, CellId goal) const;

  /// Vertices of a cell, in boundary order of the first cycle for a facet; none for a volume.
  [[nodiscard]] std::vector<Rational3> vertices(CellId cell) const;

  /// A point of a free cell. Needs the roadmap, unless the cell is a vertex or all of space.
  [[nodiscard]] Rational3 point_in(CellId cell, const Monitor& monitor) const;

  /// A cell as people read it: "edge 3".
  [[nodiscard]] std::string name(CellId cell) const;

 private:
  static constexpr std::uint32_t kNoComponent = 0xffffffffU;

  struct Partition {
    Partition(const FreeSpace& free, const Monitor& monitor);
    Stopwatch watch;
    SpaceTree tree;
    Roadmap roadmap;
    double seconds;
  };
  const Partition& partition(const Monitor& monitor) const;
  void find_components(const std::vector<bool>& free_cells);
  void find_passages();
  void find_mouths(TightPassage& passage) const;
  [[nodiscard]] std::optional<Thinness> bottleneck(const TightPassage& passage) const;
  template <typename Allowed>
  [[nodiscard]] bool joins_volumes(const TightPassage& passage, const Allowed& allowed) const;
  void find_touching_volumes();
  template <typename Allowed>
  [[nodiscard]] bool connected(CellId start, CellId goal, const Allowed& allowed) const;

  Polyhedron free_;
  CellNumbering cells_;
  Incidences incidences_;
  std::vector<std::uint32_t> component_;
  std::vector<int> local_dimension_;
  std::vector<std::uint32_t> passage_;
  std::vector<Component> components_;
  std::vector<TightPassage> passages_;
  std::vector<TouchingVolumes> touching_;
  mutable std::mutex building_;
  mutable std::unique_ptr<const Partition> partition_;
  mutable std::atomic<const Partition*> ready_{nullptr};
  mutable std::once_flag items_once_;
  mutable std::unique_ptr<const ItemTree> items_;
  mutable std::once_flag grid_once_;
  mutable std::unique_ptr<const EmptyGrid> grid_;
};

}  // namespace nef::planner
