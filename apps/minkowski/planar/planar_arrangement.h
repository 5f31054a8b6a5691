// SPDX-License-Identifier: Apache-2.0
//
// The arrangement of segments in a plane, which know what is on their left.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "apps/minkowski/planar/planar_polygon.h"
#include "nef/base/monitor.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/mesh_points.h"

namespace nef::minkowski {

/// Segments cut where they meet: atoms, and the cycles of half-atoms around faces.
class PlanarArrangement {
 public:
  using Segment = std::array<std::uint32_t, 2>;  ///< different points, from and to; the inside is on its left

  /// O((n + k) log n) exact signs for k pairs of segments whose boxes overlap; most signs are doubles. Equal points may
  /// be there several times.
  PlanarArrangement(std::vector<Rational3> points, std::vector<Segment> segments, const PlanarFrame& frame,
                    const Monitor& monitor);

  /// The points, sorted, each one once; and for each of those that were given its number now.
  [[nodiscard]] const std::vector<Rational3>& points() const { return points_; }
  [[nodiscard]] std::uint32_t number_of_given(std::uint32_t point) const { return given_[point]; }

  /// Rings around what is inside, which have it on their left. A face is inside if it is on the left of a segment; of
  /// others, `is_inside` is asked for a point that is on no segment. Where rings touch, each turns so that the inside
  /// next to it is connected there. What is far away is outside.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> rings(
      const std::function<bool(const Rational3&)>& is_inside) const;

 private:
  // Half-atom 2k runs from the smaller point of atom k to the larger one, and 2k + 1 back.
  struct Atom {
    std::uint32_t low = 0, high = 0;
    bool inside_left = false, inside_right = false;
  };
  struct Cut {
    std::uint32_t segment = 0, point = 0;
  };
  void cut_segments();
  void cut_pair(const MeshPoints& known, std::uint32_t s, std::uint32_t t, std::vector<Cut>& cuts);
  void cross(std::uint32_t s, std::uint32_t t, std::vector<Cut>& cuts);
  void sort_points(std::vector<Cut>& cuts);
  void make_atoms(std::vector<Cut> cuts);
  void link_atoms();
  [[nodiscard]] bool between(const MeshPoints& known, std::uint32_t s, std::uint32_t point) const;
  [[nodiscard]] std::uint32_t source(std::uint32_t half) const {
    return half % 2 == 0 ? atoms_[half / 2].low : atoms_[half / 2].high;
  }
  [[nodiscard]] std::uint32_t target(std::uint32_t half) const { return source(half ^ 1U); }
  [[nodiscard]] bool inside_of(std::uint32_t half) const {
    return half % 2 == 0 ? atoms_[half / 2].inside_left : atoms_[half / 2].inside_right;
  }
  [[nodiscard]] std::optional<Rational3> point_left_of(std::uint32_t half, const BoxTree& tree) const;
  [[nodiscard]] std::vector<std::uint8_t> insides(const std::function<bool(const Rational3&)>& is_inside) const;

  std::vector<Rational3> points_;
  std::vector<std::uint32_t> given_;
  std::vector<Segment> segments_;
  PlanarFrame frame_;
  Monitor monitor_;
  std::vector<Atom> atoms_;
  std::vector<std::uint32_t> next_;  // of each half-atom, the next one around the face on its left
};

}  // namespace nef::minkowski
