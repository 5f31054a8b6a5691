// SPDX-License-Identifier: Apache-2.0
//
// One sphere map in the order that depends on the set alone.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/sphere_map/sphere_map.h"

namespace nef {

/// The planes that name the line of an svertex at which less than two planes of facets arrive.
struct BareLine {
  std::uint32_t place = 0;    ///< of the vertex in the canonical order
  std::uint32_t svertex = 0;  ///< local
  std::array<std::uint32_t, 2> rows{kNone, kNone};
};

/// Writes sphere maps with items in canonical order and planes renamed. Keeps scratch: one for each thread.
class CanonicalMapWriter {
 public:
  /// `planes` are those that maps mean, `ordered` those of the result, of which row[r] is row r of `planes`.
  CanonicalMapWriter(const PlaneTable& planes, const PlaneTable& ordered, std::span<const std::uint32_t> row,
                     const Monitor& monitor)
      : planes_(planes), ordered_(ordered), row_(row), monitor_(monitor) {}

  /// Maps that follow name rows of `planes` by rows[r], which become ordered[r]; `rows` is empty if by themselves.
  void set_rows(std::span<const std::uint32_t> rows, std::span<const std::uint32_t> ordered) {
    rows_ = rows;
    renamed_ = ordered;
  }

  /// The canonical map of one; valid until the next call.
  SphereMapView write(const SphereMapView& map, std::span<const BareLine> lines);

  /// The new numbers of the svertices of the map written last.
  [[nodiscard]] std::span<const std::uint32_t> svertex_numbers() const { return svertex_; }

 private:
  // An svertex by the values of its planes, and its old number.
  struct NamedVertex {
    PlaneId p, q;
    std::uint32_t old = 0;
    auto operator<=>(const NamedVertex&) const = default;
  };
  // An unflipped shalfedge, and its old number.
  struct NamedHalfedge {
    std::uint32_t row = 0;
    std::uint32_t source = 0;
    std::uint32_t target = 0;
    std::uint32_t old = 0;
    auto operator<=>(const NamedHalfedge&) const = default;
  };
  struct Face {
    std::vector<std::pair<SFaceEntry::Kind, std::uint32_t>> entries;
    std::uint32_t old = 0;
  };

  [[nodiscard]] PlaneId renamed(PlaneId plane) const { return plane.in_row(renamed_[plane.row()]); }
  [[nodiscard]] PlaneId common(PlaneId plane) const { return rows_.empty() ? plane : plane.in_row(rows_[plane.row()]); }

  void write_svertices(const SphereMapView& map, std::span<const BareLine> lines);
  void turn_along(const SVertex& old, SVertex& svertex) const;
  void write_shalfedges();
  void write_sfaces(const SphereMapView& map);
  [[nodiscard]] std::uint32_t smallest_of_cycle(std::uint32_t first) const;

  const PlaneTable& planes_;
  const PlaneTable& ordered_;
  std::span<const std::uint32_t> row_;
  Monitor monitor_;
  std::span<const std::uint32_t> rows_;
  std::span<const std::uint32_t> renamed_;
  SphereMapBuffer out_;
  std::vector<SHalfedge> old_;  // in the old order, planes renamed
  std::vector<SVertex> named_;
  std::vector<NamedVertex> vertices_;
  std::vector<NamedHalfedge> halfedges_;
  std::vector<Face> faces_;
  // From old items to new ones.
  std::vector<std::uint32_t> svertex_, shalfedge_, sface_;
};

}  // namespace nef
