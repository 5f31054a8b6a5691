// SPDX-License-Identifier: Apache-2.0
//
// The cells of an arrangement of planes. The planes cut space into cells of dimension 0 to 3, each given by its signs
// (on the negative side of, on, or on the positive side of every plane), so that a set made from half-spaces is a bit
// for each cell.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "nef/geometry/vectors.h"
#include "nef/number/number.h"

namespace nef::fuzz {

inline Rational3 moved(const Rational3& p, const Rational& t, const Rational3& d) {
  return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

struct Plane {
  Rational3 normal;
  Rational offset;
  [[nodiscard]] Rational at(const Rational3& p) const { return dot(normal, p) + offset; }
  [[nodiscard]] std::string text() const {
    return to_string(normal[0]) + "," + to_string(normal[1]) + "," + to_string(normal[2]) + "," + to_string(offset);
  }
};

using Signs = std::vector<signed char>;

// All cells of the planes, a point for each.
class Cells {
 public:
  explicit Cells(std::vector<Plane> planes) : planes_(std::move(planes)) {
    for (std::size_t i = 0; i < planes_.size(); ++i) add_plane(i);
    for (const auto& [signs, point] : found_) {
      signs_.push_back(signs);
      points_.push_back(point);
    }
    faces_.resize(signs_.size());
    for (std::size_t d = 0; d < signs_.size(); ++d) {
      for (std::size_t c = 0; c < signs_.size(); ++c) {
        if (is_face(signs_[c], signs_[d])) faces_[d].push_back(c);
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const Rational3& point(std::size_t cell) const { return points_[cell]; }
  [[nodiscard]] const Plane& plane(std::size_t i) const { return planes_[i]; }
  [[nodiscard]] int sign(std::size_t cell, std::size_t plane) const { return signs_[cell][plane]; }
  [[nodiscard]] std::size_t planes() const { return planes_.size(); }
  /// The cell with these signs, one a plane. It must exist.
  [[nodiscard]] std::size_t with(const Signs& signs) const {
    const auto place = std::lower_bound(signs_.begin(), signs_.end(), signs);
    return static_cast<std::size_t>(place - signs_.begin());
  }
  [[nodiscard]] const Signs& signs(std::size_t cell) const { return signs_[cell]; }
  /// The cell that holds a point.
  [[nodiscard]] std::size_t at(const Rational3& p) const {
    Signs signs;
    for (const Plane& plane : planes_) signs.push_back(static_cast<signed char>(sgn(plane.at(p))));
    return with(signs);
  }
  /// Where a line meets the planes that do not hold it, in order: the factors of the direction.
  [[nodiscard]] std::vector<Rational> crossings(const Rational3& p, const Rational3& direction) const {
    std::vector<Rational> result;
    for (const Plane& plane : planes_) {
      const Rational speed = dot(plane.normal, direction);
      if (speed != 0) result.push_back(-plane.at(p) / speed);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
  /// The cells in the closure of a cell, itself included.
  [[nodiscard]] const std::vector<std::size_t>& faces(std::size_t cell) const { return faces_[cell]; }

 private:
  static bool is_face(const Signs& c, const Signs& d) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (c[i] != 0 && c[i] != d[i]) return false;
    }
    return true;
  }

  void add(const Rational3& p) {
    Signs signs;
    for (const Plane& plane : planes_) signs.push_back(static_cast<signed char>(sgn(plane.at(p))));
    found_.try_emplace(signs, p);
  }

  // A point beyond p in that direction, before anything else is met.
  [[nodiscard]] Rational3 just_beside(const Rational3& p, const Rational3& direction) const {
    Rational t = 1;
    for (const Rational& crossing : crossings(p, direction)) {
      if (crossing > 0) {
        t = crossing / 2;
        break;
      }
    }
    return moved(p, t, direction);
  }

  // A point of every cell in plane i, and of every cell beside its two-dimensional ones.
  void add_plane(std::size_t i) {
    const Plane& plane = planes_[i];
    bool lines = false;
    for (std::size_t j = 0; j < planes_.size(); ++j) {
      const Rational3 direction = cross(plane.normal, planes_[j].normal);
      if (is_zero(direction)) continue;
      lines = true;
      add_line(plane, planes_[j], direction);
    }
    if (!lines) add_both_sides(plane, moved({0, 0, 0}, -plane.offset / dot(plane.normal, plane.normal), plane.normal));
  }

  void add_line(const Plane& a, const Plane& b, const Rational3& direction) {
    // The point of the line nearest to the origin: a combination of the two normals.
    const Rational aa = dot(a.normal, a.normal);
    const Rational ab = dot(a.normal, b.normal);
    const Rational bb = dot(b.normal, b.normal);
    const Rational det = aa * bb - ab * ab;
    const Rational s = (ab * b.offset - bb * a.offset) / det;
    const Rational t = (ab * a.offset - aa * b.offset) / det;
    const Rational3 origin = moved(moved({0, 0, 0}, s, a.normal), t, b.normal);
    const std::vector<Rational> stops = crossings(origin, direction);
    for (const Rational& stop : stops) add(moved(origin, stop, direction));
    std::vector<Rational> between;
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) between.push_back((stops[k] + stops[k + 1]) / 2);
    between.push_back(stops.empty() ? Rational(0) : Rational(stops.front() - 1));
    if (!stops.empty()) between.push_back(stops.back() + 1);
    const Rational3 aside = cross(a.normal, direction);
    for (const Rational& place : between) {
      const Rational3 p = moved(origin, place, direction);
      add(p);
      add_both_sides(a, just_beside(p, aside));
      add_both_sides(a, just_beside(p, {-aside[0], -aside[1], -aside[2]}));
    }
  }

  void add_both_sides(const Plane& plane, const Rational3& p) {
    add(p);
    add(just_beside(p, plane.normal));
    add(just_beside(p, {-plane.normal[0], -plane.normal[1], -plane.normal[2]}));
  }

  std::vector<Plane> planes_;
  std::map<Signs, Rational3> found_;
  std::vector<Signs> signs_;
  std::vector<Rational3> points_;
  std::vector<std::vector<std::size_t>> faces_;
};

/// The cells that belong to a set.
using Bits = std::vector<bool>;

}  // namespace nef::fuzz
