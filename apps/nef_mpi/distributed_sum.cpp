// SPDX-License-Identifier: Apache-2.0
#include "apps/nef_mpi/distributed_sum.h"

#include <utility>

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/complex/item_boxes.h"
#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"
#include "nef/tiles/cuts/region_division.h"

namespace nef::mpi {
namespace {

std::string piece_name(std::size_t piece) { return "piece-" + std::to_string(piece) + ".nef"; }

// Coordinates of the vertices, with room for what rounding has moved.
RegionDivision divided_at_vertices(const Complex& c, std::size_t most) {
  std::vector<Box> places;
  for (const VertexId v : c.vertex_ids()) places.push_back(vertex_box(c, v));
  return {static_cast<std::uint32_t>(places.size()),
          [&places](std::uint32_t v, std::size_t axis) {
            return std::array<double, 2>{places[v].low[axis], places[v].high[axis]};
          },
          most};
}

Polyhedron part_in(const Polyhedron& set, const Region& region) {
  Polyhedron result = set;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Rational3 n;
    n[axis] = 1;
    if (const AxisPlane* wall = region.high[axis]) {
      result = intersect(result, make_halfspace(n[0], n[1], n[2], -wall->at));
    }
    n[axis] = -1;
    if (const AxisPlane* wall = region.low[axis]) {
      result = intersect(result, make_halfspace(n[0], n[1], n[2], wall->at));
    }
  }
  return result;
}

}  // namespace

PieceSource sums_of_parts(const Environment& mpi, const WorkFolder& work, const Polyhedron& a, const Polyhedron& b,
                          std::size_t most, const Watcher& watcher) {
  NEF_ASSERT(a.is_bounded());
  const RegionDivision parts = divided_at_vertices(a.complex(), most);
  const std::size_t count = parts.parts().size();
  do_tasks(mpi,
           {.name = "sums",
            .count = count,
            .finished = [&](std::size_t part) { return work.has(piece_name(part)); },
            .name_of_task = [](std::size_t part) { return "part " + std::to_string(part + 1); },
            .task =
                [&](std::size_t part) {
                  const Polyhedron sum = minkowski::minkowski_sum(part_in(a, parts.parts()[part].region), b);
                  write_file(work / piece_name(part), native_binary(sum));
                  return std::string();
                }},
           watcher);
  return {.count = static_cast<std::uint32_t>(count), .set = [&work](std::uint32_t part, const Monitor&) {
            const std::string path = work / piece_name(part);
            return read_native_binary(read_file(path), path);
          }};
}

}  // namespace nef::mpi
