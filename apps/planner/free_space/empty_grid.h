// SPDX-License-Identifier: Apache-2.0
//
// Cubes of space that no boundary enters. Whoever is in one may go anywhere in it, and from one to the next: where free
// space is wide, that is a way without any exact question.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "nef/base/monitor.h"
#include "nef/complex/complex.h"

namespace nef::planner {

/// A grid of closed cubes around the boundary of a complex without infimaximal box. Its outermost cubes count as
/// entered, so that all 26 neighbours of an empty one are there; those next to them are empty.
class EmptyGrid {
 public:
  using Cube = std::array<std::uint32_t, 3>;

  /// As many cubes as the complex has items, some times over. Without vertices, or where doubles cannot hold the
  /// corners exactly, it has none.
  EmptyGrid(const Complex& complex, const Monitor& monitor);

  [[nodiscard]] std::size_t size() const { return entered_.size(); }
  [[nodiscard]] const Cube& counts() const { return counts_; }
  [[nodiscard]] std::uint32_t index(const Cube& cube) const {
    return (cube[2] * counts_[1] + cube[1]) * counts_[0] + cube[0];
  }
  [[nodiscard]] Cube cube(std::uint32_t index) const {
    return {index % counts_[0], index / counts_[0] % counts_[1], index / counts_[0] / counts_[1]};
  }
  /// True if no vertex, edge or facet has a point in the closed cube: it lies in one volume. So do neighbours, those
  /// at corners included.
  [[nodiscard]] bool is_empty(std::uint32_t index) const { return entered_[index] == 0; }

  /// True if the cube is one of the outermost.
  [[nodiscard]] bool is_rim(std::uint32_t index) const;

  /// The nearest cube. There must be one.
  [[nodiscard]] Cube nearest(const Vector3d& point) const;
  /// The exact centre of a cube.
  [[nodiscard]] Vector3d centre(const Cube& cube) const;
  /// The length of a cube's side.
  [[nodiscard]] double side() const { return side_; }

 private:
  void choose_cubes(const std::array<double, 3>& low, const std::array<double, 3>& high, std::size_t wanted);
  void enter_rim();
  void enter(const Complex& complex, const Facet& facet);
  void enter_edge(const std::array<double, 3>& a, const std::array<double, 3>& b);
  void enter_box(const std::array<double, 3>& low, const std::array<double, 3>& high);
  [[nodiscard]] std::array<Cube, 2> range(const std::array<double, 3>& low, const std::array<double, 3>& high) const;

  double side_ = 0;
  std::array<double, 3> low_{};
  Cube counts_{};
  std::vector<std::uint8_t> entered_;
};

}  // namespace nef::planner
