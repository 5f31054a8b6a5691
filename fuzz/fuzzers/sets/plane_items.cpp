// SPDX-License-Identifier: Apache-2.0
#include "fuzz/fuzzers/sets/plane_items.h"

#include <algorithm>

#include "nef/base/union_find.h"

namespace nef::fuzz {

PlaneItems::PlaneItems(const Cells& cells, const Bits& bits) : cells_(cells), bits_(bits), star_(cells.size()) {
  for (std::size_t d = 0; d < cells.size(); ++d) {
    for (const std::size_t c : cells.faces(d)) star_[c].push_back(d);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) kinds_.push_back(kind_around(c));
}

Location::Kind PlaneItems::kind_around(std::size_t cell) const {
  const std::vector<std::size_t>& star = star_[cell];
  if (std::all_of(star.begin(), star.end(), [&](std::size_t d) { return bits_[d] == bits_[cell]; })) {
    return Location::Kind::kVolume;
  }
  // Directions in two planes through the cell at once, and, if there is none, in one: all that a cone can be constant
  // along are among them.
  std::vector<Rational3> normals;
  for (std::size_t i = 0; i < cells_.planes(); ++i) {
    if (cells_.sign(cell, i) == 0) normals.push_back(cells_.plane(i).normal);
  }
  for (const Rational3& n : normals) {
    const Rational3 u = n[0] == 0 && n[1] == 0 ? Rational3{1, 0, 0} : Rational3{Rational(-n[1]), n[0], 0};
    if (unchanged_along(cell, u) && unchanged_along(cell, cross(n, u))) return Location::Kind::kFacet;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Rational3 line = cross(normals[i], normals[j]);
      if (!is_zero(line) && unchanged_along(cell, line)) return Location::Kind::kEdge;
    }
  }
  return Location::Kind::kVertex;
}

// Whether moving any point next to the cell along a direction, however far in the cone, meets one bit only.
bool PlaneItems::unchanged_along(std::size_t cell, const Rational3& direction) const {
  std::vector<std::size_t> through;
  for (std::size_t i = 0; i < cells_.planes(); ++i) {
    if (cells_.sign(cell, i) == 0) through.push_back(i);
  }
  for (const std::size_t d : star_[cell]) {
    const Rational3 from = minus(cells_.point(d), cells_.point(cell));
    std::vector<Rational> stops;
    for (const std::size_t i : through) {
      const Rational3& n = cells_.plane(i).normal;
      if (const Rational speed = dot(n, direction); speed != 0) stops.push_back(-dot(n, from) / speed);
    }
    std::sort(stops.begin(), stops.end());
    std::vector<Rational> places = stops;
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) places.push_back((stops[k] + stops[k + 1]) / 2);
    if (!stops.empty()) {
      places.push_back(stops.front() - 1);
      places.push_back(stops.back() + 1);
    }
    for (const Rational& t : places) {
      const Rational3 there = moved(from, t, direction);
      Signs signs = cells_.signs(cell);
      for (const std::size_t i : through) signs[i] = static_cast<signed char>(sgn(dot(cells_.plane(i).normal, there)));
      if (bits_[cells_.with(signs)] != bits_[d]) return false;
    }
  }
  return true;
}

std::size_t PlaneItems::count(Location::Kind kind) const {
  UnionFind sets(cells_.size());
  for (std::size_t d = 0; d < cells_.size(); ++d) {
    for (const std::size_t c : cells_.faces(d)) {
      if (kinds_[c] == kind && kinds_[d] == kind) {
        sets.unite(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(d));
      }
    }
  }
  std::size_t result = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (kinds_[c] == kind && sets.find(static_cast<std::uint32_t>(c)) == c) ++result;
  }
  return result;
}

// 3 less the rank of the normals of the planes that hold the cell.
std::size_t PlaneItems::dimension(std::size_t cell) const {
  std::vector<Rational3> normals;
  for (std::size_t i = 0; i < cells_.planes(); ++i) {
    if (cells_.sign(cell, i) == 0) normals.push_back(cells_.plane(i).normal);
  }
  if (normals.empty()) return 3;
  for (const Rational3& n : normals) {
    const Rational3 line = cross(normals[0], n);
    if (is_zero(line)) continue;
    const bool is_line =
        std::all_of(normals.begin(), normals.end(), [&](const Rational3& m) { return dot(m, line) == 0; });
    return is_line ? 1 : 0;
  }
  return 2;
}

// A cell is made of tetrahedra: one of its points, one of a face, and both ends of an edge of that face.
std::optional<Rational> PlaneItems::volume() const {
  Rational sum = 0;
  for (std::size_t d = 0; d < cells_.size(); ++d) {
    if (!bits_[d] || dimension(d) != 3) continue;
    std::size_t edges = 0;
    for (const std::size_t face : cells_.faces(d)) {
      if (dimension(face) != 2) continue;
      for (const std::size_t edge : cells_.faces(face)) {
        if (dimension(edge) != 1) continue;
        std::vector<Rational3> corners{cells_.point(face)};
        for (const std::size_t end : cells_.faces(edge)) {
          if (dimension(end) == 0) corners.push_back(cells_.point(end));
        }
        if (corners.size() != 3) return std::nullopt;
        for (Rational3& p : corners) p = minus(p, cells_.point(d));
        sum += abs(dot(corners[0], cross(corners[1], corners[2]))) / 6;
        ++edges;
      }
    }
    if (edges == 0) return std::nullopt;
  }
  return sum;
}

std::optional<Rational> PlaneItems::first_hit(const Rational3& origin, const Rational3& direction) const {
  const auto is_item = [&](const Rational& t) {
    return kind(cells_.at(moved(origin, t, direction))) != Location::Kind::kVolume;
  };
  std::vector<Rational> stops = cells_.crossings(origin, direction);
  stops.erase(stops.begin(), std::upper_bound(stops.begin(), stops.end(), Rational(0)));
  if (is_item(stops.empty() ? Rational(1) : Rational(stops.front() / 2))) return Rational(0);
  const auto found = std::find_if(stops.begin(), stops.end(), is_item);
  return found == stops.end() ? std::nullopt : std::optional<Rational>(*found);
}

}  // namespace nef::fuzz
