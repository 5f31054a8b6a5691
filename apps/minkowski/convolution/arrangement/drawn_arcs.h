// SPDX-License-Identifier: Apache-2.0
//
// The arrangement of arcs and great circles on a sphere, all at once.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/arrangement.h"

namespace nef::minkowski {

/// Takes arcs of at most half a circle, and whole great circles, whose marks are sets of bits, and makes a sphere map
/// of them. Where several lie upon each other, all of their bits are set; between them are none. Keeps its memory from
/// one map to the next. Not to be shared between threads.
class DrawnArcs {
 public:
  /// The end of an arc. Ends with the same key, unless it is 0, have the same direction.
  struct End {
    Direction direction;
    LabelId mark = 0;
    std::uint64_t key = 0;
  };

  /// Begins a map. The table must outlive `finish`.
  void begin(const PlaneTable& planes, const Monitor& monitor);
  /// An arc from `source` to `target`, counterclockwise about a plane through both; at most half of its circle.
  void add_arc(PlaneId plane, const End& source, const End& target, LabelId mark);
  /// A whole circle.
  void add_circle(PlaneId plane, LabelId mark);
  /// The map, simplified. O(k^2 + m log m) expected sign tests for k arcs and m crossings.
  void finish(LabelId centre, SphereMapBuffer& out);

 private:
  struct Input {
    PlaneId plane;
    std::uint32_t source = kNone, target = kNone;  // nodes; kNone: a circle
    LabelId mark = 0;

    [[nodiscard]] bool is_circle() const { return source == kNone; }
  };
  // Where an arc meets another circle than its own: in the direction (0) of the cross product of both normals, and
  // against it (1). The node is kNone inside of the arc.
  struct Meeting {
    bool meets = false;
    std::uint32_t node = kNone;
  };
  using Meetings = std::array<Meeting, 2>;

  std::uint32_t node_of(const End& end);
  std::uint32_t node_at(const Direction& direction);
  void file(std::uint32_t node);
  void cross(std::uint32_t i, std::uint32_t j);
  void cross_on_circle(std::uint32_t i, std::uint32_t j);
  [[nodiscard]] Meetings meetings(const Input& arc, const Input& other, const Direction& crossing) const;
  void hit(std::uint32_t arc, std::uint32_t node);
  void cut();
  void add_piece(const Input& arc, std::uint32_t source, std::uint32_t target);

  const PlaneTable* planes_ = nullptr;
  Monitor monitor_;
  Arrangement drawing_;
  std::vector<std::uint64_t> keys_;                             // per node
  std::unordered_multimap<std::uint64_t, std::uint32_t> cell_;  // cells of a grid -> nodes, once there are many
  std::vector<std::uint32_t> first_piece_, next_piece_;         // per node, the pieces that start there, as a list
  std::vector<Input> input_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hits_;  // (arc, node inside it)
};

}  // namespace nef::minkowski
