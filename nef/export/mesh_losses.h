// SPDX-License-Identifier: Apache-2.0
//
// What a mesh can not say of a set: counted, and in words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nef {

/// What kinds of volumes an item sees.
struct SeenVolumes {
  bool selected = false;    ///< a volume that goes into the mesh
  bool unselected = false;  ///< one that does not belong to the set
  bool other = false;       ///< one that is lost as a whole, or lies beyond an infimaximal box

  void add(const SeenVolumes& volume) {
    selected = selected || volume.selected;
    unselected = unselected || volume.unselected;
    other = other || volume.other;
  }
  bool operator==(const SeenVolumes&) const = default;
};

/// How many facets, edges and vertices there are of something.
struct ItemCounts {
  std::size_t facets = 0;
  std::size_t edges = 0;
  std::size_t vertices = 0;

  [[nodiscard]] bool any() const { return facets + edges + vertices > 0; }
  ItemCounts& operator+=(const ItemCounts& more) {
    facets += more.facets;
    edges += more.edges;
    vertices += more.vertices;
    return *this;
  }
};

/// How the line about `MeshLosses::open` begins. Mesh files cannot store open boundaries, so every difference of two
/// closed sets has this line: programs keep it for reports, and do not print it.
inline constexpr std::string_view kOpenPartsClosed = "open parts of the boundary were written as closed: ";

/// What a mesh of the closure of a set's bounded solid parts does not say.
struct MeshLosses {
  std::size_t volumes = 0;  ///< unbounded ones
  ItemCounts flat;          ///< outside the solids
  ItemCounts open;          ///< of their boundary, without belonging to the set
  ItemCounts cracks;        ///< missing inside of them

  MeshLosses& operator+=(const MeshLosses& more) {
    volumes += more.volumes;
    flat += more.flat;
    open += more.open;
    cracks += more.cracks;
    return *this;
  }

  /// A line for each kind that there is.
  [[nodiscard]] std::vector<std::string> lines() const;
};

}  // namespace nef
