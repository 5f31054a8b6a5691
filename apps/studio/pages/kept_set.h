// SPDX-License-Identifier: Apache-2.0
//
// A set that a computation has left, whole or in tiles.
#pragma once

#include <utility>
#include <variant>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::studio {

class KeptSet {
 public:
  // Sets are given as either.
  // NOLINTNEXTLINE(google-explicit-constructor)
  KeptSet(Polyhedron set) : set_(std::move(set)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  KeptSet(TiledPolyhedron set) : set_(std::move(set)) {}

  /// The set in one complex. O(1), or O(n log n) if it is in tiles.
  [[nodiscard]] Polyhedron whole(const Monitor& monitor = {}) const {
    const auto* tiled = std::get_if<TiledPolyhedron>(&set_);
    return tiled != nullptr ? tiled->polyhedron(monitor) : std::get<Polyhedron>(set_);
  }

 private:
  std::variant<Polyhedron, TiledPolyhedron> set_;
};

}  // namespace nef::studio
