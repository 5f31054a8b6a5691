// SPDX-License-Identifier: Apache-2.0
//
// A set that a computation has left, whole or in tiles, with the colours of its surface if it has any.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::studio {

/// What a mesh of the set is coloured by in a file: its vertices, an image, or nothing. Found when a file is written;
/// notes are added to the messages.
struct ColorsOfFile {
  std::function<std::vector<std::array<std::uint8_t, 3>>(const Mesh&, const Monitor&, Messages&)> vertices;
  std::function<MeshTexture(const Mesh&, const Monitor&, Messages&)> texture;
};

class KeptSet {
 public:
  // Sets are given as either.
  // NOLINTNEXTLINE(google-explicit-constructor)
  KeptSet(Polyhedron set, ColorsOfFile colors = {}) : set_(std::move(set)), colors_(std::move(colors)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  KeptSet(TiledPolyhedron set) : set_(std::move(set)) {}

  /// The set in one complex. O(1), or O(n log n) if it is in tiles.
  [[nodiscard]] Polyhedron whole(const Monitor& monitor = {}) const {
    const auto* tiled = std::get_if<TiledPolyhedron>(&set_);
    return tiled != nullptr ? tiled->polyhedron(monitor) : std::get<Polyhedron>(set_);
  }

  /// Writes the set to a file, in its colours if the format stores them in the file itself; else the messages say which
  /// ones do. Throws what write_polyhedron does.
  void write(const std::string& path, PolyhedronWriteOptions options, Messages& messages) const;

 private:
  std::variant<Polyhedron, TiledPolyhedron> set_;
  ColorsOfFile colors_;
};

}  // namespace nef::studio
