// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace nef {

/// Marks of sphere maps that can not belong to one set: the two ends of a region disagree. Sphere maps that come from
/// sets never do, so that this is an internal error, unless they were made from somebody's data (a mesh with components
/// turned the wrong way); whoever does that catches it.
class ContradictingMarks : public std::logic_error {
 public:
  explicit ContradictingMarks(const char* region)
      : std::logic_error(std::string("internal error, please report: the boundary of ") + region +
                         " has different marks on its inside") {}
};

}  // namespace nef
