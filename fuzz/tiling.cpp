// SPDX-License-Identifier: Apache-2.0
#include "fuzz/tiling.h"

#include <algorithm>

namespace nef::fuzz {
namespace {

// Twice the area of the triangle a, b, p, in quarters of the grid's unit for p.
int side(const std::array<int, 2>& a, const std::array<int, 2>& b, const std::array<int, 2>& p) {
  return (b[0] - a[0]) * (p[1] - 4 * a[1]) - (b[1] - a[1]) * (p[0] - 4 * a[0]);
}

// 2: in the relative interior, 1: on the relative border, 0: outside.
int place(const std::vector<std::array<int, 2>>& base, const std::array<int, 2>& p) {
  if (base.size() == 1) return p[0] == 4 * base[0][0] && p[1] == 4 * base[0][1] ? 2 : 0;
  if (base.size() == 2) {
    if (side(base[0], base[1], p) != 0) return 0;
    bool inside = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const int low = 4 * std::min(base[0][k], base[1][k]);
      const int high = 4 * std::max(base[0][k], base[1][k]);
      if (p[k] < low || p[k] > high) return 0;
      if (low < high) inside = inside && p[k] > low && p[k] < high;
    }
    return inside ? 2 : 1;
  }
  int result = 2;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const int turn = side(base[i], base[(i + 1) % base.size()], p);
    if (turn < 0) return 0;
    if (turn == 0) result = 1;
  }
  return result;
}

}  // namespace

Tiling::Tiling(int width, int height) : width_(width), height_(height) {
  const auto side_length = 4 * static_cast<std::size_t>(width) + 1;
  number_.assign(side_length * side_length, 0);
  // Vertices, then edges, then triangles, so that faces have numbers already.
  for (int x = 0; x <= 4 * width; x += 2) {
    for (int y = x % 4; y <= 4 * width; y += 4) add(x, y, {});
  }
  for (int x = 0; x <= 4 * width; ++x) {
    for (int y = 0; y <= 4 * width; ++y) {
      if (x % 4 == 2 && y % 4 == 0) add(x, y, {{x - 2, y}, {x + 2, y}});
      if (x % 4 == 0 && y % 4 == 2) add(x, y, {{x, y - 2}, {x, y + 2}});
      if (x % 2 == 1 && y % 2 == 1) {
        const int tilt = x % 4 == y % 4 ? 1 : -1;
        add(x, y, {{x - 1, y - tilt}, {x + 1, y + tilt}});
      }
    }
  }
  for (int x = 2; x < 4 * width; x += 4) {
    for (int y = 2; y < 4 * width; y += 4) {
      for (const std::array<int, 2>& d : {std::array{0, -1}, std::array{0, 1}, std::array{-1, 0}, std::array{1, 0}}) {
        // The outer edge with its ends, the two edges to the centre, the centre.
        const std::array<int, 2> e{d[1], d[0]};
        add(x + d[0], y + d[1],
            {{x + 2 * d[0], y + 2 * d[1]},
             {x + 2 * d[0] + 2 * e[0], y + 2 * d[1] + 2 * e[1]},
             {x + 2 * d[0] - 2 * e[0], y + 2 * d[1] - 2 * e[1]},
             {x + d[0] + e[0], y + d[1] + e[1]},
             {x + d[0] - e[0], y + d[1] - e[1]},
             {x, y}});
      }
    }
  }
}

void Tiling::add(int x, int y, const std::vector<std::array<int, 2>>& faces) {
  FlatCell cell{{x, y}, {}};
  for (const std::array<int, 2>& face : faces) cell.faces.push_back(at(face[0], face[1]));
  at(x, y) = static_cast<std::uint32_t>(flat_.size());
  flat_.push_back(std::move(cell));
}

Rational3 Tiling::point(std::size_t cell) const {
  const std::array<int, 2>& p = flat_[cell % flat_.size()].point;
  Rational3 result{Rational(p[0], 4), Rational(p[1], 4), Rational(layer(cell), 2)};
  for (Rational& x : result) x.canonicalize();
  return result;
}

Tiling::Marks Tiling::marks_of(const Prism& prism, bool open) const {
  Marks marks(size(), 0);
  const int needed = open ? 2 : 1;
  for (std::size_t c = 0; c < flat_.size(); ++c) {
    if (place(prism.base, flat_[c].point) < needed) continue;
    const bool flat = prism.bottom == prism.top;
    const int low = 2 * prism.bottom + (open && !flat ? 1 : 0);
    const int high = 2 * prism.top - (open && !flat ? 1 : 0);
    for (int layer = low; layer <= high; ++layer) marks[static_cast<std::size_t>(layer) * flat_.size() + c] = 1;
  }
  return marks;
}

Tiling::Marks Tiling::closure(const Marks& marks) const {
  Marks result(marks.size(), 0);
  const std::size_t n = flat_.size();
  for (std::size_t layer = 0; layer < layers(); ++layer) {
    for (std::size_t c = 0; c < n; ++c) {
      if (marks[layer * n + c] == 0) continue;
      const std::size_t low = layer % 2 == 0 ? layer : layer - 1;
      const std::size_t high = layer % 2 == 0 ? layer : layer + 1;
      for (std::size_t l = low; l <= high; ++l) {
        result[l * n + c] = 1;
        for (const std::uint32_t face : flat_[c].faces) result[l * n + face] = 1;
      }
    }
  }
  return result;
}

}  // namespace nef::fuzz
