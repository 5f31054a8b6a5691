// SPDX-License-Identifier: Apache-2.0
//
// The overlay of two sphere maps: the one place where local geometry happens. Every degeneracy of
// the 3D operations is an ordinary case here (thesis 4.3).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/arrangement.h"
#include "nef/sphere_map/label_function.h"

namespace nef {

/// Overlays sphere maps that use the planes of one table. Keeps its scratch memory between calls;
/// one object per thread.
class SphereOverlay {
 public:
  /// The sphere map, simplified, whose marks are f(mark in a, mark in b) everywhere.
  /// O(n m) sign tests for small maps; O((n + m + k) log(n + m)) expected for large ones with k
  /// crossings.
  void overlay(const PlaneTable& planes, const SphereMapView& a, const SphereMapView& b, const LabelFunction& f,
               SphereMapBuffer& out, const Monitor& monitor);

 private:
  enum class Support : std::uint8_t { kUnknown, kVertex, kArc, kFace };
  struct NodeSupport {
    std::array<Support, 2> kind{Support::kUnknown, Support::kUnknown};
    std::array<std::uint32_t, 2> index{kNone, kNone};
  };
  // An arc or sloop of an operand, in the orientation of its even half. source == kNone: sloop.
  struct InputArc {
    PlaneId plane;
    std::uint32_t source = kNone;  // node
    std::uint32_t target = kNone;
    std::uint32_t item = 0;  // even shalfedge or sloop 0 of its operand
    std::uint8_t operand = 0;
  };
  // For every arc of the drawing and both operands: the even or odd half of the operand's arc that
  // it is part of, in the direction of the drawing's half 2k; kNone if it is not part of one.
  using Owners = std::array<std::uint32_t, 2>;
  static constexpr std::uint32_t kLoopOwner = 0x80000000U;  // flag: the index is of a sloop

  void load(const SphereMapView& map, std::uint8_t operand);
  void merge_nodes(std::uint32_t first_of_b);
  void cross_arcs(std::uint32_t first_of_b);
  void cross_pair(std::uint32_t arc_a, std::uint32_t arc_b);
  void cross_coplanar(std::uint32_t arc_a, std::uint32_t arc_b);
  void hit(std::uint32_t node, std::uint32_t arc);
  void place_isolated(std::uint32_t first_of_b);
  struct EndSides {
    int from = 0;
    int to = 0;
  };
  [[nodiscard]] EndSides sides_of_ends(const InputArc& arc, const InputArc& other) const;
  [[nodiscard]] bool stays_aside(const InputArc& arc, const EndSides& sides) const;
  bool crosses_at(const InputArc& arc, const EndSides& sides, const Direction& crossing, bool first_crossing,
                  std::uint32_t& end_node) const;
  void cut_arcs();
  void add_piece(const InputArc& arc, std::uint32_t source, std::uint32_t target);
  void find_faces(int operand);
  void evaluate(const LabelFunction& f);
  [[nodiscard]] std::uint32_t face_left_of(int operand, std::uint32_t owner) const;
  [[nodiscard]] LabelId mark_of_owner(int operand, std::uint32_t owner) const;

  const PlaneTable* planes_ = nullptr;  // of the call, as the next
  Monitor monitor_;
  std::array<SphereMapView, 2> maps_;
  Arrangement drawing_;
  std::vector<NodeSupport> support_;
  std::vector<std::uint32_t> node_of_b_;  // svertex of b -> node
  std::vector<InputArc> input_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hits_;  // (input arc, node inside it)
  std::vector<Owners> owners_;
  std::vector<std::uint32_t> first_piece_;  // per node: pieces that start there, as a list
  std::vector<std::uint32_t> next_piece_;
  std::vector<std::array<std::uint32_t, 2>> face_;       // per half of the drawing: sface to its left
  std::vector<std::array<std::uint32_t, 2>> node_face_;  // per node: the sface that holds it, if one does
  std::vector<Owners> circle_owner_;                     // of the drawing's circle, if it has one
};

}  // namespace nef
