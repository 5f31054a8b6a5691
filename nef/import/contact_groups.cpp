// SPDX-License-Identifier: Apache-2.0
#include "nef/import/contact_groups.h"

#include "nef/base/union_find.h"
#include "nef/geometry/ids.h"

namespace nef {
namespace {

// Up to so many groups components stay whole. Many that all cross each other, as rods in a bundle do, would need a
// group each, and faces one by one fewer.
constexpr std::size_t kGroupsOfComponents = 8;

class ContactGroups {
 public:
  ContactGroups(std::span<const FaceContact> contacts, std::span<const std::uint32_t> component)
      : component_(component), group_of_(component.size(), kNone) {
    collect_neighbours(contacts);
    collect_members();
    meets_itself_.assign(component.size(), false);
    for (const FaceContact& contact : contacts) {
      if (component[contact.f] != kNone && component[contact.f] == component[contact.g]) {
        meets_itself_[component[contact.f]] = true;
      }
    }
  }

  std::vector<std::vector<std::uint32_t>> run() {
    for (std::uint32_t c = 0; c < component_.size(); ++c) {
      const std::span<const std::uint32_t> faces = members_of(c);
      if (faces.empty() || (!meets_itself_[c] && place(faces, kGroupsOfComponents))) continue;
      for (std::size_t i = 0; i < faces.size(); ++i) place(faces.subspan(i, 1), component_.size());
    }
    std::vector<std::vector<std::uint32_t>> groups(taken_in_.size());
    for (std::uint32_t f = 0; f < group_of_.size(); ++f) {
      if (group_of_[f] != kNone) groups[group_of_[f]].push_back(f);
    }
    return groups;
  }

 private:
  // Of each face, those in contact with it.
  void collect_neighbours(std::span<const FaceContact> contacts) {
    neighbour_begin_.assign(component_.size() + 1, 0);
    for (const FaceContact& contact : contacts) {
      ++neighbour_begin_[contact.f + 1];
      ++neighbour_begin_[contact.g + 1];
    }
    for (std::size_t f = 1; f < neighbour_begin_.size(); ++f) neighbour_begin_[f] += neighbour_begin_[f - 1];
    neighbours_.resize(neighbour_begin_.back());
    std::vector<std::uint32_t> at(neighbour_begin_.begin(), neighbour_begin_.end() - 1);
    for (const FaceContact& contact : contacts) {
      neighbours_[at[contact.f]++] = contact.g;
      neighbours_[at[contact.g]++] = contact.f;
    }
  }

  void collect_members() {
    member_begin_.assign(component_.size() + 1, 0);
    for (const std::uint32_t first : component_) {
      if (first != kNone) ++member_begin_[first + 1];
    }
    for (std::size_t f = 1; f < member_begin_.size(); ++f) member_begin_[f] += member_begin_[f - 1];
    members_.resize(member_begin_.back());
    std::vector<std::uint32_t> at(member_begin_.begin(), member_begin_.end() - 1);
    for (std::uint32_t f = 0; f < component_.size(); ++f) {
      if (component_[f] != kNone) members_[at[component_[f]]++] = f;
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> members_of(std::uint32_t component) const {
    return std::span(members_).subspan(member_begin_[component],
                                       member_begin_[component + 1] - member_begin_[component]);
  }

  // Puts faces into the first group that nothing in contact with them is in, if that is among the first `limit`.
  bool place(std::span<const std::uint32_t> faces, std::size_t limit) {
    ++round_;
    for (const std::uint32_t f : faces) {
      for (std::uint32_t i = neighbour_begin_[f]; i < neighbour_begin_[f + 1]; ++i) {
        const std::uint32_t group = group_of_[neighbours_[i]];
        if (group != kNone) taken_in_[group] = round_;
      }
    }
    std::uint32_t group = 0;
    while (group < taken_in_.size() && taken_in_[group] == round_) ++group;
    if (group >= limit) return false;
    if (group == taken_in_.size()) taken_in_.push_back(0);
    for (const std::uint32_t f : faces) group_of_[f] = group;
    return true;
  }

  std::span<const std::uint32_t> component_;
  std::vector<std::uint32_t> neighbour_begin_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint32_t> member_begin_;  // of each component, by its first face
  std::vector<std::uint32_t> members_;
  std::vector<bool> meets_itself_;
  std::vector<std::uint32_t> group_of_;
  std::vector<std::uint64_t> taken_in_;  // of each group, the last round in which it was taken
  std::uint64_t round_ = 0;
};

}  // namespace

std::vector<std::uint32_t> face_components(const Mesh& mesh, const MeshSurface& surface) {
  UnionFind places(mesh.vertices.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t v : mesh.face(f)) places.unite(surface.place[v], surface.place[mesh.face(f)[0]]);
  }
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNone);  // face of the set that a place stands for
  std::vector<std::uint32_t> result(mesh.face_count(), kNone);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).empty()) continue;
    std::uint32_t& least = first[places.find(surface.place[mesh.face(f)[0]])];
    if (least == kNone) least = f;
    result[f] = least;
  }
  return result;
}

std::vector<std::vector<std::uint32_t>> contact_groups(std::span<const FaceContact> contacts,
                                                       std::span<const std::uint32_t> component) {
  return ContactGroups(contacts, component).run();
}

}  // namespace nef
