// SPDX-License-Identifier: Apache-2.0
//
// What a leaf has in its walls.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nef/complex/complex.h"

namespace nef {

/// A vertex of a leaf in a wall.
struct SeamVertex {
  VertexId vertex{0};
  std::uint32_t point = kNone;  ///< among those of all seams; none if the set has no boundary there
  std::uint8_t walls = 0;       ///< a bit for each
  std::uint32_t facet = kNone;  ///< cut there by several walls: among those of the leaf
  bool straight = false;        ///< an edge that was cut there and goes on in the leaf on the other side

  /// True if a vertex of the whole may be there.
  [[nodiscard]] bool joins() const { return point != kNone && !straight; }
};

/// The inside of a facet: its plane, and marks on it and on both sides of the unflipped plane.
struct FacetInside {
  std::uint32_t row = kNone;
  LabelId mark = 0;
  LabelId above = 0;
  LabelId below = 0;
  bool operator==(const FacetInside&) const = default;
};

/// A seam vertex in one wall where an edge was cut, until it is known whether that goes on: its facets' two smallest
/// planes.
struct CutEdge {
  std::uint32_t seam = 0;
  std::array<std::uint32_t, 2> planes{};
};

/// An edge of a leaf in a wall, between two of its seam vertices.
struct LeafEdge {
  std::uint32_t wall = 0;
  std::array<std::uint32_t, 2> seam{};
  HalfedgeId halfedge{0};
};

/// What a leaf has in its walls.
struct LeafSeam {
  std::vector<SeamVertex> seam;
  std::vector<CutEdge> cut_edges;
  std::vector<LeafEdge> edges;
  std::vector<FacetInside> facets;  ///< that several walls cut
};

/// Reads leaves, one after the other. Keeps scratch: one for each thread.
class SeamReader {
 public:
  SeamReader();
  ~SeamReader();
  SeamReader(const SeamReader&) = delete;
  SeamReader& operator=(const SeamReader&) = delete;

  /// Fills what a leaf has in its walls. `rows` are those of its planes in a table that leaves have in common, `walls`
  /// the rows of its walls there, kNone where there is none. Vertices with boundary get `point` 0. O(n).
  void read(const Complex& leaf, std::span<const std::uint32_t> rows, const std::array<std::uint32_t, 6>& walls,
            LeafSeam& seam);

 private:
  class Patterns;
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace nef
