// SPDX-License-Identifier: Apache-2.0
//
// Rows are words of bits. A sum unites copies of one grid, moved by the cells of the other one: runs of cells along x
// and equal runs in layers upon each other are one copy, stretched by doubling.
#include "apps/minkowski/cells/bit_grid.h"

#include <algorithm>

#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

// A row with its bits moved up, added to another one. They may be the same.
void add_moved(std::uint64_t* to, const std::uint64_t* from, std::size_t words, std::uint32_t by) {
  const std::size_t whole = by / 64;
  const std::uint32_t rest = by % 64;
  for (std::size_t w = words; w-- > whole;) {
    std::uint64_t moved = from[w - whole] << rest;
    if (rest != 0 && w > whole) moved |= from[w - whole - 1] >> (64 - rest);
    to[w] |= moved;
  }
}

// The same moved by 0, 1, ..., length - 1.
void stretch(std::uint64_t* row, std::size_t words, std::uint32_t length) {
  for (std::uint32_t done = 1; done < length;) {
    const std::uint32_t step = std::min(done, length - done);
    add_moved(row, row, words, step);
    done += step;
  }
}

// Cells from first to first + length - 1 of the rows y in the layers z to z + layers - 1.
struct Slab {
  std::uint32_t first = 0, length = 0, y = 0, z = 0, layers = 1;
};

std::vector<Slab> slabs_of(const BitGrid& grid) {
  std::vector<Slab> result;
  const auto& [width, height, depth] = grid.size();
  for (std::uint32_t y = 0; y < height; ++y) {
    std::size_t of_layer_below = result.size();  // slabs that may go on begin here
    for (std::uint32_t z = 0; z < depth; ++z) {
      std::size_t candidate = of_layer_below;
      const std::size_t end = result.size();
      std::vector<Slab> here;
      for (std::uint32_t x = 0; x < width;) {
        const std::uint32_t first = x;
        while (x < width && grid.has(x, y, z)) ++x;
        if (x == first) {
          ++x;
          continue;
        }
        while (candidate < end && result[candidate].first < first) ++candidate;
        Slab slab{first, x - first, y, z, 1};
        if (candidate < end && result[candidate].first == first && result[candidate].length == slab.length &&
            result[candidate].z + result[candidate].layers == z) {
          slab.z = result[candidate].z;
          slab.layers = result[candidate].layers + 1;
          result[candidate].layers = 0;  // continued
        }
        here.push_back(slab);
      }
      of_layer_below = result.size();
      result.insert(result.end(), here.begin(), here.end());
    }
  }
  result.erase(std::remove_if(result.begin(), result.end(), [](const Slab& s) { return s.layers == 0; }), result.end());
  return result;
}

}  // namespace

void BitGrid::add(const BitGrid& moved, std::uint32_t y, std::uint32_t z, std::uint32_t x) {
  for (std::uint32_t layer = 0; layer < moved.size_[2]; ++layer) {
    for (std::uint32_t row_of = 0; row_of < moved.size_[1]; ++row_of) {
      const std::uint64_t* from = moved.row(row_of, layer);
      if (!moved.row_is_empty(row_of, layer)) add_moved(row(row_of + y, layer + z), from, words_, x);
    }
  }
}

std::optional<BitGrid> BitGrid::sum(const BitGrid& p, const BitGrid& q, std::size_t budget) {
  const bool is_planar = p.size_[2] == 1 && q.size_[2] == 1;
  std::vector<Slab> slabs_p = slabs_of(p);
  std::vector<Slab> slabs = slabs_of(q);
  const BitGrid* other = &p;
  if (slabs_p.size() < slabs.size()) {
    slabs.swap(slabs_p);
    other = &q;
  }
  BitGrid result(p.size_[0] + q.size_[0], p.size_[1] + q.size_[1], is_planar ? 1 : p.size_[2] + q.size_[2]);
  if (slabs.size() * std::size_t{other->size_[1]} * other->size_[2] * result.words_ > budget) return std::nullopt;
  // The other grid stretched by a slab and the cells after it; those that differ in layers only share what is along x.
  std::sort(slabs.begin(), slabs.end(), [](const Slab& a, const Slab& b) {
    return a.length != b.length ? a.length < b.length : a.layers < b.layers;
  });
  BitGrid stretched;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const Slab& slab = slabs[i];
    if (i == 0 || slab.length != slabs[i - 1].length || slab.layers != slabs[i - 1].layers)
      stretched = other->stretched(slab.length + 1, is_planar ? 1 : slab.layers + 1, result.words_);
    result.add(stretched, slab.y, slab.z, slab.first);
  }
  return result;
}

// Moved by 0 to along - 1 along x, by 0 or 1 along y, by 0 to layers - 1 along z.
BitGrid BitGrid::stretched(std::uint32_t along, std::uint32_t layers, std::size_t words) const {
  BitGrid result;
  result.size_ = {static_cast<std::uint32_t>(64 * words), size_[1] + 1, size_[2] + layers - 1};
  result.words_ = words;
  result.bits_.assign(words * result.size_[1] * result.size_[2], 0);
  for (std::uint32_t z = 0; z < size_[2]; ++z) {
    for (std::uint32_t y = 0; y < size_[1]; ++y) {
      if (row_is_empty(y, z)) continue;
      std::uint64_t* to = result.row(y, z);
      std::copy(row(y, z), row(y, z) + words_, to);
      stretch(to, words, along);
    }
    for (std::uint32_t y = size_[1]; y > 0; --y) add_moved(result.row(y, z), result.row(y - 1, z), words, 0);
  }
  const std::size_t layer = words * result.size_[1];
  for (std::uint32_t done = 1; done < layers;) {
    const std::uint32_t step = std::min(done, layers - done);
    for (std::size_t i = result.bits_.size(); i-- > step * layer;) result.bits_[i] |= result.bits_[i - step * layer];
    done += step;
  }
  return result;
}

BitGrid cells_inside(const BitGrid& border, std::vector<std::vector<double>> crossed) {
  const auto& [width, height, depth] = border.size();
  BitGrid inside(width, height, depth);
  for (std::uint32_t z = 0; z < depth; ++z) {
    for (std::uint32_t y = 0; y < height; ++y) {
      std::vector<double>& row = crossed[std::size_t{z} * height + y];
      std::sort(row.begin(), row.end());
      std::size_t behind = 0;
      for (std::uint32_t x = 0; x < width; ++x) {
        while (behind < row.size() && row[behind] < x + 0.5) ++behind;
        if (behind % 2 == 1 && !border.has(x, y, z)) inside.set(x, y, z);
      }
    }
  }
  return inside;
}

void BitGrid::unite(const BitGrid& other) {
  NEF_ASSERT(size_ == other.size_);
  for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] |= other.bits_[i];
}

bool BitGrid::row_is_empty(std::uint32_t y, std::uint32_t z) const {
  return std::all_of(row(y, z), row(y, z) + words_, [](std::uint64_t word) { return word == 0; });
}

}  // namespace nef::minkowski
