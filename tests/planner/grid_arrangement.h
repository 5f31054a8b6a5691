// SPDX-License-Identifier: Apache-2.0
//
// Free space on a small grid, decided without the planner: the planes, lines and points of the grid cut space into
// cells that are free or not as a whole, and a breadth-first search over them finds components, reachability, T and J.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "apps/planner/free_space/free_space.h"

namespace nef::planner::test {

using Cell = std::array<int, 3>;  // even: a plane at half of it; odd: the open interval between two planes
struct GridBox {
  Cell low, high;  // in whole units
};

// Doubled coordinates of what is looked at. Everything happens from -8 to 14; around it is a layer of free cells, and
// around that a frame of cells that count as taken, so that no search has to ask where it is.
constexpr int kLow = -10;
constexpr int kHigh = 16;
constexpr int kSpan = kHigh - kLow + 1;

// The arrangement with the open boxes (closed ones if contact is forbidden) taken out.
class Arrangement {
 public:
  Arrangement(const std::vector<GridBox>& taken, bool closed) : Arrangement(ranges_of(taken, closed)) {}

  // A range of cells: all between a lowest and a highest one.
  using Range = std::array<Cell, 2>;
  // With these cells taken.
  explicit Arrangement(const std::vector<Range>& taken) : free_(kSpan * kSpan * kSpan, 0) {
    find_incident_cells();
    for_each({kLow + 1, kLow + 1, kLow + 1}, {kHigh - 1, kHigh - 1, kHigh - 1}, [&](int i) { free_[i] = 1; });
    for (const Range& range : taken) for_each(range[0], range[1], [&](int i) { free_[i] = 0; });
    local_.assign(free_.size(), -1);
    for_each(kWhole[0], kWhole[1], [&](int i) {
      if (free_[i] == 0) return;
      int best = kDimension[class_[i]];
      for (const int step : incident_[class_[i]]) {
        if (free_[i + step] != 0) best = std::max(best, kDimension[class_[i + step]]);
      }
      local_[i] = best;
    });
    freedom_.assign(free_.size(), -1);
    for_each(kWhole[0], kWhole[1], [&](int i) {
      if (free_[i] != 0) freedom_[i] = freedom_at(i);
    });
  }

  [[nodiscard]] bool is_free(const Cell& c) const { return free_[index(c)] != 0; }
  [[nodiscard]] int local_dimension(const Cell& c) const { return local_[index(c)]; }

  // Component of each cell whose free space is locally at least k-dimensional; -1 for others.
  [[nodiscard]] std::vector<int> components(int k, int& count) const {
    std::vector<int> component(free_.size(), -1);
    count = 0;
    std::vector<int> queue;
    for (int seed = 0; seed < static_cast<int>(free_.size()); ++seed) {
      if (local_[seed] < k || component[seed] >= 0) continue;
      queue.assign(1, seed);
      component[seed] = count;
      for (std::size_t next = 0; next < queue.size(); ++next) {
        const int i = queue[next];
        for (const int step : incident_[class_[i]]) {
          if (local_[i + step] < k || component[i + step] >= 0) continue;
          component[i + step] = count;
          queue.push_back(i + step);
        }
      }
      ++count;
    }
    return component;
  }

  // The dimension of the cell of the simplified complex that holds this one: in how many directions one can go a
  // little way without seeing any change. For unions of such cells the axes are enough.
  [[nodiscard]] int freedom(const Cell& c) const { return freedom_[index(c)]; }

  // True if a way leads from a to b through cells of that dimension or more and the simplified cells of a and b.
  [[nodiscard]] bool joined_by(int dimension, const Cell& a, const Cell& b) const {
    std::vector<char> open(free_.size(), 0);
    for (std::size_t i = 0; i < free_.size(); ++i) open[i] = freedom_[i] >= dimension ? 1 : 0;
    for (const Cell& end : {a, b}) {
      const int same = freedom(end);
      flood(
          static_cast<int>(index(end)), [&](int i) { return freedom_[i] == same; }, [&](int i) { open[i] = 1; });
    }
    bool found = false;
    const auto goal = static_cast<int>(index(b));
    flood(
        static_cast<int>(index(a)), [&](int i) { return open[i] != 0; }, [&](int i) { found = found || i == goal; });
    return found;
  }

  static std::size_t index(const Cell& c) {
    const int i = ((c[0] - kLow) * kSpan + (c[1] - kLow)) * kSpan + (c[2] - kLow);
    return static_cast<std::size_t>(i);
  }

 private:
  static constexpr std::array<Cell, 2> kWhole{Cell{kLow, kLow, kLow}, Cell{kHigh, kHigh, kHigh}};
  // By the parities of the three coordinates: the number of odd ones.
  static constexpr std::array<int, 8> kDimension{0, 1, 1, 2, 1, 2, 2, 3};

  template <typename Visit>
  static void for_each(const Cell& low, const Cell& high, const Visit& visit) {
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) visit(static_cast<int>(index({x, y, z})));
      }
    }
  }

  static std::vector<Range> ranges_of(const std::vector<GridBox>& taken, bool closed) {
    std::vector<Range> ranges;
    for (const GridBox& box : taken) {
      Range& range = ranges.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        range[0][i] = 2 * box.low[i] + (closed ? 0 : 1);
        range[1][i] = 2 * box.high[i] - (closed ? 0 : 1);
      }
    }
    return ranges;
  }

  // Cells of which one lies in the closure of the other: all coordinates that change go from odd to even, or all from
  // even to odd.
  void find_incident_cells() {
    class_.resize(free_.size());
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const auto at = static_cast<int>(i);
      const std::array<int, 3> c{at / (kSpan * kSpan) + kLow, at / kSpan % kSpan + kLow, at % kSpan + kLow};
      class_[i] = static_cast<std::uint8_t>((c[0] & 1) | (c[1] & 1) << 1 | (c[2] & 1) << 2);
    }
    for (int parity = 0; parity < 8; ++parity) {
      for (int code = 0; code < 27; ++code) {
        const std::array<int, 3> d{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
        bool down = code != 13;
        bool up = code != 13;
        for (int k = 0; k < 3; ++k) {
          if (d[static_cast<std::size_t>(k)] != 0) ((parity >> k & 1) != 0 ? up : down) = false;
        }
        if (down || up) incident_[static_cast<std::size_t>(parity)].push_back((d[0] * kSpan + d[1]) * kSpan + d[2]);
      }
    }
  }

  [[nodiscard]] int freedom_at(int i) const {
    constexpr std::array<int, 3> kStep{kSpan * kSpan, kSpan, 1};
    int dimension = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bool same = true;
      // Compare everything around the cell with its copies one step up and down along axis k.
      for (int code = 0; code < 9 && same && (class_[i] >> k & 1) == 0; ++code) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const int du = code / 3 - 1;
        const int dv = code % 3 - 1;
        // Along an odd coordinate there is nothing new one step away.
        if ((du != 0 && (class_[i] >> u & 1) != 0) || (dv != 0 && (class_[i] >> v & 1) != 0)) continue;
        const int at = i + du * kStep[u] + dv * kStep[v];
        same = free_[at] == free_[at - kStep[k]] && free_[at] == free_[at + kStep[k]];
      }
      dimension += same ? 1 : 0;
    }
    return dimension;
  }

  template <typename Inside, typename Visit>
  void flood(int seed, const Inside& inside, const Visit& visit) const {
    std::vector<char> seen(free_.size(), 0);
    std::vector<int> queue{seed};
    seen[seed] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const int i = queue[next];
      visit(i);
      for (const int step : incident_[class_[i]]) {
        if (seen[i + step] != 0 || !inside(i + step)) continue;
        seen[i + step] = 1;
        queue.push_back(i + step);
      }
    }
  }

  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> class_;
  std::vector<int> local_;
  std::vector<int> freedom_;
  std::array<std::vector<int>, 8> incident_;
};

// What both sides say about every cell of the grid: free or not, its dimension and the local one, and components that
// are the same up to their numbers, which is reachability between any two cells. Returns the cells where it is tight or
// enclosed.
std::vector<Cell> compare_all(const FreeSpace& free, const Arrangement& truth, const std::vector<int>& component,
                              int count);

}  // namespace nef::planner::test
