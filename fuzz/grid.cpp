// SPDX-License-Identifier: Apache-2.0
#include "fuzz/grid.h"

#include <algorithm>

#include "nef/construct/construct.h"

namespace nef::fuzz {

bool GridSet::in_range(const GridCell& c) const {
  return std::all_of(c.begin(), c.end(), [this](int x) { return x >= low() && x <= high(); });
}

void GridSet::for_each(const std::function<void(const GridCell&)>& visit) const {
  for (int x = low(); x <= high(); ++x) {
    for (int y = low(); y <= high(); ++y) {
      for (int z = low(); z <= high(); ++z) visit({x, y, z});
    }
  }
}

std::vector<GridCell> GridSet::cells() const {
  std::vector<GridCell> result;
  for_each([&](const GridCell& c) {
    if (bits_[index(c)] != 0) result.push_back(c);
  });
  return result;
}

GridSet GridSet::sum(const GridSet& a, const GridSet& b) {
  GridSet result(a.low() + b.low(), a.high() + b.high());
  const std::vector<GridCell> others = b.cells();
  for (const GridCell& c : a.cells()) {
    for (const GridCell& d : others) {
      GridCell low;
      GridCell high;
      for (std::size_t k = 0; k < 3; ++k) {
        // (i, i+1) + (j, j+1) = (i+j, i+j+2), which is three cells; everything else is one.
        const int spread = c[k] % 2 != 0 && d[k] % 2 != 0 ? 1 : 0;
        low[k] = c[k] + d[k] - spread;
        high[k] = c[k] + d[k] + spread;
      }
      for (int x = low[0]; x <= high[0]; ++x) {
        for (int y = low[1]; y <= high[1]; ++y) {
          for (int z = low[2]; z <= high[2]; ++z) result.set({x, y, z}, true);
        }
      }
    }
  }
  return result;
}

GridSet GridSet::negated() const {
  GridSet result(-high(), -low());
  for (const GridCell& c : cells()) result.set({-c[0], -c[1], -c[2]}, true);
  return result;
}

Rational3 point_of(const GridCell& c) {
  Rational3 p{Rational(c[0], 2), Rational(c[1], 2), Rational(c[2], 2)};
  for (Rational& x : p) x.canonicalize();
  return p;
}

void GridPolyhedron::combine(char op, const std::array<int, 3>& low, const std::array<int, 3>& high, bool open) {
  const auto corner = [](const std::array<int, 3>& p) {
    return std::to_string(p[0]) + "," + std::to_string(p[1]) + "," + std::to_string(p[2]);
  };
  Polyhedron box = make_box({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
  if (open) box = interior(box);
  const std::string name = "box(" + corner(low) + "," + corner(high) + ")";
  text = "(" + text + " " + op + " " + (open ? "interior(" + name + ")" : name) + ")";
  set = op == '+' ? unite(set, box) : op == '-' ? subtract(set, box) : symmetric_difference(set, box);
  const int margin = open ? 1 : 0;
  cells.for_each([&](const GridCell& c) {
    bool in = true;
    for (std::size_t k = 0; k < 3; ++k) in = in && c[k] >= 2 * low[k] + margin && c[k] <= 2 * high[k] - margin;
    const bool was = cells.holds(c);
    cells.set(c, op == '+' ? was || in : op == '-' ? was && !in : was != in);
  });
}

GridPolyhedron random_grid_set(Choices& choices, int width, bool closed) {
  GridPolyhedron result(width);
  const std::uint32_t steps = 1 + choices.below(4);
  for (std::uint32_t i = 0; i < steps; ++i) {
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = choices.between(0, width);
      high[k] = choices.between(low[k], width);
    }
    const bool open = !closed && choices.one_in(3);
    result.combine(i == 0 || closed ? '+' : choices.element(std::array{'+', '-', '^'}), low, high, open);
  }
  if (result.set.is_empty()) result.combine('+', {0, 0, 0}, {1, 1, 1}, false);
  return result;
}

void label_some_sets(Choices& choices, GridPolyhedron& set) {
  if (!choices.one_in(4)) return;
  GridPolyhedron part = random_grid_set(choices, set.cells.high() / 2, false);
  set.set = overlay(set.set, part.set, [](LabelId x, LabelId y) { return static_cast<LabelId>(x == 0 ? 0 : 2 - y); });
  part = random_grid_set(choices, set.cells.high() / 2, false);
  set.set =
      overlay(set.set, part.set, [](LabelId x, LabelId y) { return static_cast<LabelId>(x == 0 ? 0 : x + 2 * y); });
  set.text += " with labels";
}

}  // namespace nef::fuzz
