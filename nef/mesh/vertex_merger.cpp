// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/vertex_merger.h"

#include <bit>

#include "nef/base/threads/first_equal.h"

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
  return first_equal(
      points.size(), Monitor(), [points](std::size_t i) { return mixed_bits(hash_of(points[i])); },
      [points](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; });
}

std::vector<std::uint32_t> merge_equal(std::span<const std::array<double, 3>> points) {
  const auto hash = [points](std::size_t i) {
    std::uint64_t result = 0;
    // -0 equals 0.
    for (const double x : points[i]) result = mixed_bits(result ^ std::bit_cast<std::uint64_t>(x + 0.0));
    return result;
  };
  return first_equal(points.size(), Monitor(), hash,
                     [points](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; });
}

}  // namespace nef
