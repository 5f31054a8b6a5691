// SPDX-License-Identifier: Apache-2.0
//
// What is broken in a complex or sphere map, as a value. Checks deep inside synthesis and validation throw it as
// BrokenInvariant to the function that was asked, which returns it; so it leaves that function as an exception only
// where no data of anybody's could be wrong: then it is a bug, and reported as one.
#pragma once

#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nef/base/id.h"

namespace nef {

struct GuiltyItem {
  GuiltyItem(const char* name, std::size_t number) : kind(name), index(number) {}
  template <typename Tag>
  GuiltyItem(const char* name, Id<Tag> id) : kind(name), index(id.index()) {}

  const char* kind;
  std::size_t index;
};

/// A broken invariant by name, with the items that break it.
struct Defect {
  enum class Kind {
    kStructure,  ///< items do not fit together
    kMarks,      ///< all would fit together, but parts of one region have different marks
  };
  Kind kind = Kind::kStructure;
  std::string invariant;  ///< in words, as it should hold
  std::vector<GuiltyItem> items;

  /// The name and the guilty items in one line.
  [[nodiscard]] std::string text() const;
};

namespace detail {

/// How a check tells of a defect. It is a bug if this leaves the core.
class BrokenInvariant : public std::logic_error {
 public:
  explicit BrokenInvariant(Defect found)
      : std::logic_error("internal error, please report: " + found.text()), defect(std::move(found)) {}
  Defect defect;
};

[[noreturn]] void break_invariant(Defect::Kind kind, const char* name, std::initializer_list<GuiltyItem> guilty);

/// Throws BrokenInvariant unless `holds`. Always on: this is for what somebody's data may break.
inline void require(bool holds, const char* name, std::initializer_list<GuiltyItem> guilty) {
  if (!holds) break_invariant(Defect::Kind::kStructure, name, guilty);
}

/// The same for marks of one region that must be equal.
inline void require_one_mark(bool holds, const char* name, std::initializer_list<GuiltyItem> guilty) {
  if (!holds) break_invariant(Defect::Kind::kMarks, name, guilty);
}

/// What `step()` finds broken, if anything.
template <typename Step>
std::optional<Defect> defect_in(Step&& step) {
  try {
    step();
  } catch (BrokenInvariant& broken) {
    return std::move(broken.defect);
  }
  return std::nullopt;
}

}  // namespace detail
}  // namespace nef
