// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nef/polyhedron.h"

namespace nef {

/// A set whose marks are 0, 1, ... without gaps, and what they were.
struct CompactMarks {
  Polyhedron set;
  std::vector<LabelId> old;  ///< of each mark of `set`, increasing
};

/// The same set with only those marks that some item carries, numbered anew in their old order. kOutside stays what it
/// is. O(n); the set itself if there are no gaps.
CompactMarks compact_marks(const Polyhedron& a);

}  // namespace nef
