// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/nef_mpi/distributed_union.h"

namespace nef::mpi {

/// Collective. The Minkowski sum of two sets: A is cut into closed parts whose union it is, so that the sum is the
/// union of theirs with B; each is a task. `most`: vertices of A in a part. A must be bounded.
TiledPolyhedron distributed_sum(const Environment& mpi, const WorkFolder& work, const Polyhedron& a,
                                const Polyhedron& b, std::size_t most, const Tiling& tiling, const Watcher& watcher);

}  // namespace nef::mpi
