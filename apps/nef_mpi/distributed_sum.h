// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/nef_mpi/distributed_union.h"

namespace nef::mpi {

/// Collective. Parts of the Minkowski sum of two sets, which is their union: A is cut into closed parts, and the sum of
/// each with B is a task. `most`: vertices of A in a part. A must be bounded; `work` must outlive the result.
PieceSource sums_of_parts(const Environment& mpi, const WorkFolder& work, const Polyhedron& a, const Polyhedron& b,
                          std::size_t most, const Watcher& watcher);

}  // namespace nef::mpi
