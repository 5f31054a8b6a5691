// SPDX-License-Identifier: Apache-2.0
//
// Groups of faces that can be built without an arrangement: no two faces in contact in one, and components whole where
// that costs few groups.
#include "nef/import/contact_groups.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "nef/geometry/ids.h"

namespace nef {
namespace {

using Faces = std::vector<std::uint32_t>;

FaceContact contact(std::uint32_t f, std::uint32_t g) {
  return {std::min(f, g), std::max(f, g), SurfaceContacts::Kind::kCross, false};
}

// Of each face, the group that it is in; kNone if it is in none. Each is in one at most, and in order.
Faces group_of(const std::vector<Faces>& groups, std::size_t faces) {
  Faces result(faces, kNone);
  for (std::uint32_t group = 0; group < groups.size(); ++group) {
    CHECK_FALSE(groups[group].empty());
    CHECK(std::is_sorted(groups[group].begin(), groups[group].end()));
    for (const std::uint32_t f : groups[group]) {
      CHECK(result[f] == kNone);
      result[f] = group;
    }
  }
  return result;
}

// Components of four faces, each in contact with the next one.
struct Chain {
  Faces component;
  std::vector<FaceContact> contacts;

  explicit Chain(std::uint32_t count) {
    for (std::uint32_t f = 0; f < 4 * count; ++f) component.push_back(f / 4 * 4);
    for (std::uint32_t c = 0; c + 1 < count; ++c) contacts.push_back(contact(4 * c + 3, 4 * c + 4));
  }
};

}  // namespace

TEST_CASE("components in a chain come into two groups, each of them whole") {
  const Chain chain(10);
  const std::vector<Faces> groups = contact_groups(chain.contacts, chain.component);
  REQUIRE(groups.size() == 2);
  const Faces group = group_of(groups, chain.component.size());
  for (std::uint32_t f = 0; f < group.size(); ++f) CHECK(group[f] == f / 4 % 2);
}

TEST_CASE("of a component that meets itself only the faces in contact come into other groups") {
  Chain chain(3);
  chain.contacts = {contact(5, 7)};
  const std::vector<Faces> groups = contact_groups(chain.contacts, chain.component);
  REQUIRE(groups.size() == 2);
  CHECK(groups[1] == Faces{7});
}

TEST_CASE("many components that all meet each other do not take a group each") {
  // Each has a face of its own for every other one.
  constexpr std::uint32_t kCount = 40;
  Faces component;
  std::vector<FaceContact> contacts;
  for (std::uint32_t f = 0; f < kCount * kCount; ++f) component.push_back(f / kCount * kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (std::uint32_t j = i + 1; j < kCount; ++j) contacts.push_back(contact(i * kCount + j, j * kCount + i));
  }
  const std::vector<Faces> groups = contact_groups(contacts, component);
  CHECK(groups.size() <= 10);
}

TEST_CASE("no two faces in contact come into one group") {
  std::mt19937 random(7);
  const auto below = [&random](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int round = 0; round < 200; ++round) {
    const std::uint32_t count = 1 + below(60);
    const std::uint32_t size = 1 + below(6);  // of a component
    Faces component(count);
    for (std::uint32_t f = 0; f < count; ++f) component[f] = below(8) == 0 ? kNone : f / size * size;
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = below(4 * count); i > 0; --i) {
      const std::uint32_t f = below(count);
      const std::uint32_t g = below(count);
      if (f != g) pairs.insert(std::minmax(f, g));
    }
    std::vector<FaceContact> contacts;
    for (const auto& [f, g] : pairs) contacts.push_back(contact(f, g));
    const Faces group = group_of(contact_groups(contacts, component), count);
    for (std::uint32_t f = 0; f < count; ++f) CHECK((group[f] == kNone) == (component[f] == kNone));
    for (const auto& [f, g] : pairs) CHECK((group[f] == kNone || group[f] != group[g]));
  }
}

TEST_CASE("common vertices, by index or by coordinates, join faces to components") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5},
                   {6, 5, 5}, {5, 6, 5}, {0, 0, 0}, {9, 9, 9}, {9, 8, 9}};
  for (const Faces& face : {Faces{0, 1, 2}, Faces{4, 5, 6}, Faces{1, 3, 2}, Faces{7, 8, 9}}) mesh.push_face(face);
  CHECK(face_components(mesh, MeshSurface(mesh, {})) == Faces{0, 1, 0, 0});
}

}  // namespace nef
