// SPDX-License-Identifier: Apache-2.0
//
// Links that are known before a complex is synthesized, since its vertices were copied together with them.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/complex/complex.h"

namespace nef {

/// Twins and facets of a complex, as far as they are known. What is said here must be what synthesis would find: then
/// the complex is the same, item for item, with or without it. Where nothing is said of facets, neither known nor
/// loose, all are to be found.
struct KnownLinks {
  IndexedVector<HalfedgeId, HalfedgeId> twin;  ///< not valid where it is to be found
  std::vector<VertexId> loose_vertices;        ///< the vertices of such svertices, ascending

  std::vector<Facet> facets;  ///< in the order of their planes; only planes and ranges are set
  IndexedVector<CycleId, std::uint32_t> cycle_begin{0};  ///< of the cycles of these facets
  std::vector<SHalfedgeId> corners;                      ///< of these cycles, each cycle from its smallest corner on
  std::vector<VertexId> isolated_vertices;               ///< inside these facets
  std::vector<std::uint32_t>
      mixed_rows;  ///< of planes whose facets come from several complexes: their order is not known

  std::vector<SHalfedgeId> loose_corners;  ///< the corners of all other facets, ascending
  std::vector<VertexId> loose_isolated;    ///< the vertices inside other facets
};

}  // namespace nef
