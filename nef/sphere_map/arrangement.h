// SPDX-License-Identifier: Apache-2.0
//
// A drawing on the sphere that becomes a sphere map: nodes and arcs with marks, sorted around the
// nodes, simplified to the unique form (thesis 4.4) and assembled. Everything that makes a sphere
// map goes through here: overlays, meshes, changes of marks.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

class Arrangement {
 public:
  struct Node {
    Direction direction;
    LabelId mark = 0;
    LabelId around = 0;            ///< mark of the region around a node without arcs
    std::uint32_t first_half = 0;  ///< range in halves(), after sort_around_nodes
    std::uint32_t degree = 0;
  };
  /// Half 2k of arc k runs counterclockwise about `plane` from source to target; half 2k+1 back.
  struct Arc {
    PlaneId plane;
    std::uint32_t source = kNone;
    std::uint32_t target = kNone;
    LabelId mark = 0;
    LabelId left = 0;  ///< mark of the region on the positive side of the plane
    LabelId right = 0;
  };
  struct Circle {
    bool present = false;
    PlaneId plane;
    LabelId mark = 0;
    LabelId left = 0;
    LabelId right = 0;
  };

  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  Circle circle;           ///< a great circle without nodes; there is never room for two
  LabelId background = 0;  ///< mark of the sphere if there are neither nodes, arcs nor circle
  LabelId centre = 0;      ///< mark of the centre

  void clear();

  /// Draws a finished map anew, with its marks, so that these can be changed before it is
  /// simplified again.
  void load(const PlaneTable& planes, const SphereMapView& map);

  /// Step 1: orders the halves that leave each node counterclockwise. Interiors of arcs must be
  /// disjoint and free of nodes.
  void sort_around_nodes(const PlaneTable& planes, const Monitor& monitor);

  /// The halves that leave `node`, counterclockwise.
  [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t node) const {
    return {halves_.data() + nodes[node].first_half, nodes[node].degree};
  }
  [[nodiscard]] std::uint32_t source(std::uint32_t half) const {
    return (half & 1U) != 0 ? arcs[half >> 1U].target : arcs[half >> 1U].source;
  }
  [[nodiscard]] std::uint32_t target(std::uint32_t half) const { return source(half ^ 1U); }
  [[nodiscard]] PlaneId plane(std::uint32_t half) const {
    const PlaneId p = arcs[half >> 1U].plane;
    return (half & 1U) != 0 ? p.opposite() : p;
  }
  [[nodiscard]] LabelId left(std::uint32_t half) const {
    return (half & 1U) != 0 ? arcs[half >> 1U].right : arcs[half >> 1U].left;
  }

  /// Step 2: removes what does not separate: arcs with one mark on both sides and in between,
  /// nodes like what surrounds them; joins arcs that continue through a node of their own mark.
  /// Then builds the sphere map into `out`. The marks must be consistent around every node.
  void simplify_and_assemble(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor);

 private:
  void drop_redundant_arcs();
  bool passes_through(std::uint32_t node) const;
  void trace_chains();
  void build_incidences(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor);
  bool assemble_ring(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor) const;
  void choose_planes(const PlaneTable& planes, std::uint32_t node, SVertex& v, const Monitor& monitor) const;
  void collect_cycles(const SphereMapBuffer& out);
  void build_faces(const PlaneTable& planes, SphereMapBuffer& out, const Monitor& monitor);

  struct Cycle {
    SFaceEntry entry;
    LabelId mark = 0;
  };

  std::vector<std::uint32_t> halves_;
  // Scratch of step 2, kept to spare allocations when one object builds thousands of maps.
  enum class Role : std::uint8_t { kPassed, kEssential, kInChain };  // a passed node may be found in a chain
  std::vector<Role> role_;
  [[nodiscard]] bool essential(std::uint32_t node) const { return role_[node] == Role::kEssential; }
  std::vector<std::uint32_t> final_half_;  // half of the drawing -> shalfedge that starts with it
  std::vector<std::uint32_t> chain_end_;   // first half of a chain -> its last half
  std::vector<std::uint32_t> node_svertex_;
  std::vector<Cycle> cycles_;
  std::vector<std::uint32_t> cycle_of_half_;
  std::vector<std::uint32_t> cycle_of_vertex_;
  std::vector<std::uint32_t> cycle_of_loop_;
  std::vector<std::uint32_t> face_of_cycle_;
};

}  // namespace nef
