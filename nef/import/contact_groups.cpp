// SPDX-License-Identifier: Apache-2.0
#include "nef/import/contact_groups.h"

#include "nef/geometry/ids.h"

namespace nef {

std::vector<std::vector<std::uint32_t>> contact_groups(std::span<const FaceContact> contacts,
                                                       const std::vector<bool>& left_out) {
  const auto count = static_cast<std::uint32_t>(left_out.size());
  // Of each face, the earlier faces that it is in contact with. The contacts are sorted by their first face, so those
  // of each second face come in order, too.
  std::vector<std::uint32_t> begin(count + 1, 0);
  for (const FaceContact& contact : contacts) ++begin[contact.g + 1];
  for (std::uint32_t f = 0; f < count; ++f) begin[f + 1] += begin[f];
  std::vector<std::uint32_t> earlier(contacts.size());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for (const FaceContact& contact : contacts) earlier[at[contact.g]++] = contact.f;

  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> group_of(count, kNone);
  std::vector<std::uint32_t> taken_by;  // the last face that found the group taken
  for (std::uint32_t f = 0; f < count; ++f) {
    if (left_out[f]) continue;
    for (std::uint32_t i = begin[f]; i < begin[f + 1]; ++i) {
      const std::uint32_t group = group_of[earlier[i]];
      if (group != kNone) taken_by[group] = f;
    }
    std::uint32_t group = 0;
    while (group < taken_by.size() && taken_by[group] == f) ++group;
    if (group == taken_by.size()) {
      taken_by.push_back(kNone);
      groups.emplace_back();
    }
    groups[group].push_back(f);
    group_of[f] = group;
  }
  return groups;
}

}  // namespace nef
