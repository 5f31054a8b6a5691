// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/vertex_merger.h"

namespace nef {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15U + (hash << 6U) + (hash >> 2U);
  hash *= 0xbf58476d1ce4e5b9U;
  return hash ^ (hash >> 29U);
}

std::uint64_t mix(std::uint64_t hash, mpz_srcptr value) {
  hash = mix(hash, static_cast<std::uint64_t>(mpz_sgn(value) + 1));
  for (std::size_t i = 0; i < mpz_size(value); ++i) hash = mix(hash, mpz_getlimbn(value, static_cast<mp_size_t>(i)));
  return hash;
}

std::uint64_t hash_of(const Rational3& point) {
  std::uint64_t hash = 0;
  for (const Rational& x : point) hash = mix(mix(hash, x.get_num_mpz_t()), x.get_den_mpz_t());
  return hash;
}

}  // namespace

std::uint32_t VertexMerger::add(const Rational3& point) {
  if (2 * (points_.size() + 1) > slots_.size()) grow();
  const std::uint64_t hash = hash_of(point);
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash & mask;
  for (; slots_[slot] != kFree; slot = (slot + 1) & mask) {
    const std::uint32_t index = slots_[slot];
    if (hashes_[index] == hash && points_[index] == point) return index;
  }
  const auto index = static_cast<std::uint32_t>(points_.size());
  slots_[slot] = index;
  points_.push_back(point);
  hashes_.push_back(hash);
  return index;
}

void VertexMerger::grow() {
  slots_.assign(slots_.size() * 4, kFree);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t i = 0; i < hashes_.size(); ++i) {
    std::size_t slot = hashes_[i] & mask;
    while (slots_[slot] != kFree) slot = (slot + 1) & mask;
    slots_[slot] = i;
  }
}

std::vector<std::uint32_t> merge_equal(std::span<const Rational3> points) {
  std::size_t size = 64;
  while (size < 2 * points.size()) size *= 2;
  constexpr std::uint32_t kFree = 0xffffffffU;
  std::vector<std::uint32_t> slots(size, kFree);
  std::vector<std::uint32_t> first(points.size());
  std::vector<std::uint64_t> hashes(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    hashes[i] = hash_of(points[i]);
    std::size_t slot = hashes[i] & (size - 1);
    while (slots[slot] != kFree && (hashes[slots[slot]] != hashes[i] || points[slots[slot]] != points[i])) {
      slot = (slot + 1) & (size - 1);
    }
    if (slots[slot] == kFree) slots[slot] = i;
    first[i] = slots[slot];
  }
  return first;
}

}  // namespace nef
