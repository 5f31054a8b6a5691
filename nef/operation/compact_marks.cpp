// SPDX-License-Identifier: Apache-2.0
#include "nef/operation/compact_marks.h"

#include <algorithm>

#include "nef/operation/for_each_mark.h"

namespace nef {

CompactMarks compact_marks(const Polyhedron& a) {
  const Complex& c = a.complex();
  std::vector<bool> used(c.label_count, false);
  for_each_mark(c, [&used](LabelId mark) {
    if (mark != kOutside) used[mark] = true;
  });
  CompactMarks result{a, {}};
  std::vector<LabelId> renamed(used.size(), 0);
  for (std::size_t mark = 0; mark < used.size(); ++mark) {
    if (!used[mark]) continue;
    renamed[mark] = static_cast<LabelId>(result.old.size());
    result.old.push_back(static_cast<LabelId>(mark));
  }
  if (result.old.empty() || result.old.back() + std::size_t{1} == result.old.size()) return result;
  Complex copy = c;
  for_each_mark(copy, [&renamed](LabelId& mark) {
    if (mark != kOutside) mark = renamed[mark];
  });
  copy.label_count = static_cast<LabelId>(std::max<std::size_t>(2, result.old.size()));
  result.set = Polyhedron(std::move(copy));
  return result;
}

}  // namespace nef
