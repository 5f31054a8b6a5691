// SPDX-License-Identifier: Apache-2.0
//
// Sets from half-spaces. The planes cut space into cells of dimension 0 to 3, each given by its signs (on the negative
// side of, on, or on the positive side of every plane); a set made from the half-spaces holds a cell whole or not at
// all. So a set is a bit for each cell, Boolean operations are bitwise, and a cell lies in the closure of another one
// iff its signs are those of the other with some replaced by zero.
#include <algorithm>
#include <map>
#include <sstream>

#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/io/native/native_format.h"

namespace nef::fuzz {
namespace {

Rational3 moved(const Rational3& p, const Rational& t, const Rational3& d) {
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

  // Where a line meets the planes that do not hold it, in order.
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

using Bits = std::vector<bool>;

Bits closure_of(const Cells& cells, const Bits& bits) {
  Bits result(bits.size(), false);
  for (std::size_t d = 0; d < bits.size(); ++d) {
    if (!bits[d]) continue;
    for (const std::size_t c : cells.faces(d)) result[c] = true;
  }
  return result;
}

template <typename Function>
Bits combined(const Bits& a, const Bits& b, const Function& f) {
  Bits result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = f(a[i], b[i]);
  return result;
}
Bits complement_of(Bits bits) {
  bits.flip();
  return bits;
}
Bits interior_of(const Cells& cells, const Bits& bits) { return complement_of(closure_of(cells, complement_of(bits))); }

// A set in three ways: as the suite makes it, as the suite makes it after the laws of de Morgan and their like, and as
// bits.
struct Value {
  Polyhedron set;
  Polyhedron other;
  Bits bits;
  std::string text;
};

class Builder {
 public:
  Builder(const Case& the_case, const Cells& cells, std::size_t planes)
      : case_(the_case), cells_(cells), planes_(planes) {}

  Value build(unsigned depth) {
    const std::uint32_t kind = depth == 0 ? 0 : case_.choices().below(5);
    if (kind == 0) return leaf();
    if (kind == 4) return unary(build(depth - 1));
    const Value a = build(depth - 1);
    return binary(a, build(depth - 1));
  }

 private:
  Value leaf() {
    Choices& choices = case_.choices();
    const std::size_t i = choices.below(static_cast<std::uint32_t>(planes_));
    const std::uint32_t kind = choices.below(3);
    const Plane& p = cells_.plane(i);
    const Polyhedron closed = make_halfspace(p.normal[0], p.normal[1], p.normal[2], p.offset);
    const Polyhedron opposite = make_halfspace(-p.normal[0], -p.normal[1], -p.normal[2], -p.offset);
    Value value;
    value.bits.resize(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const int sign = cells_.sign(c, i);
      value.bits[c] = kind == 0 ? sign <= 0 : kind == 1 ? sign < 0 : sign == 0;
    }
    value.text = "halfspace(" + p.text() + ")";
    if (kind == 0) {
      value.set = closed;
      value.other = complement(interior(opposite));
    } else if (kind == 1) {
      value.set = make_halfspace(p.normal[0], p.normal[1], p.normal[2], p.offset, false);
      value.other = complement(opposite);
      value.text = "interior(" + value.text + ")";
    } else {
      value.set = boundary(closed);
      value.other = intersect(closed, opposite);
      value.text = "boundary(" + value.text + ")";
    }
    return checked(std::move(value));
  }

  Value unary(const Value& a) {
    const std::uint32_t kind = case_.choices().below(6);
    static constexpr std::array kNames{"!", "interior", "closure", "boundary", "exterior", "regularize"};
    Value value;
    value.text = kNames[kind] + ("(" + a.text) + ")";
    const Bits inside = interior_of(cells_, a.bits);
    const Bits closed = closure_of(cells_, a.bits);
    const auto other_interior = [](const Polyhedron& s) { return complement(closure(complement(s))); };
    switch (kind) {
      case 0:
        value = {complement(a.set), subtract(Polyhedron::everything(), a.other), complement_of(a.bits), value.text};
        break;
      case 1:
        value = {interior(a.set), other_interior(a.other), inside, value.text};
        break;
      case 2:
        value = {closure(a.set), complement(interior(complement(a.other))), closed, value.text};
        break;
      case 3:
        value = {boundary(a.set), subtract(closure(a.other), interior(a.other)),
                 combined(closed, inside, [](bool x, bool y) { return x && !y; }), value.text};
        break;
      case 4:
        value = {exterior(a.set), complement(closure(a.other)), complement_of(closed), value.text};
        break;
      default:
        value = {regularize(a.set), closure(interior(a.other)), closure_of(cells_, inside), value.text};
        break;
    }
    return checked(std::move(value));
  }

  Value binary(const Value& a, const Value& b) {
    const std::uint32_t kind = case_.choices().below(4);
    Value value;
    value.text = "(" + a.text + " " + "+*-^"[kind] + " " + b.text + ")";
    switch (kind) {
      case 0:
        value.set = unite(a.set, b.set);
        value.other = complement(intersect(complement(b.other), complement(a.other)));
        value.bits = combined(a.bits, b.bits, [](bool x, bool y) { return x || y; });
        break;
      case 1:
        value.set = intersect(a.set, b.set);
        value.other = subtract(b.other, complement(a.other));
        value.bits = combined(a.bits, b.bits, [](bool x, bool y) { return x && y; });
        break;
      case 2:
        value.set = subtract(a.set, b.set);
        value.other = intersect(complement(b.other), a.other);
        value.bits = combined(a.bits, b.bits, [](bool x, bool y) { return x && !y; });
        break;
      default:
        value.set = symmetric_difference(a.set, b.set);
        value.other = unite(subtract(b.other, a.other), subtract(a.other, b.other));
        value.bits = combined(a.bits, b.bits, [](bool x, bool y) { return x != y; });
        break;
    }
    return checked(std::move(value));
  }

  Value checked(Value value) {
    value.set = case_.valid(std::move(value.set), value.text);
    value.other = case_.valid(std::move(value.other), "a law applied to " + value.text);
    return value;
  }

  const Case& case_;
  const Cells& cells_;
  std::size_t planes_;
};

std::vector<Plane> random_planes(Choices& choices) {
  std::vector<Plane> planes(static_cast<std::size_t>(choices.between(1, 6)));
  const int slope = choices.between(1, 3);
  const int shift = choices.between(0, 3);
  for (Plane& plane : planes) {
    for (Rational& x : plane.normal) x = choices.below(2) == 0 ? 0 : choices.between(-slope, slope);
    if (is_zero(plane.normal)) plane.normal[choices.below(3)] = 1;
    plane.offset = choices.between(-shift, shift);
  }
  return planes;
}

std::string show(const Rational3& p) { return to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]); }

void check_points(const Case& the_case, const Cells& cells, const Polyhedron& set, const Bits& bits,
                  const AffineMap& map) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Rational3 p = map(cells.point(c));
    if (contains(set, p) == bits[c]) continue;
    Case::require(false, "membership: of point(" + show(p) + "), want " + (bits[c] ? "inside" : "outside"));
  }
  the_case.count("points of cells", cells.size());
}

void check_predicates(const Cells& cells, const Polyhedron& set, const Bits& bits) {
  const Bits inside = interior_of(cells, bits);
  const Bits closed = closure_of(cells, bits);
  const auto any = [](const Bits& b) { return std::find(b.begin(), b.end(), true) != b.end(); };
  Case::require(set.is_empty() == !any(bits), "predicate: is_empty");
  Case::require(set.is_everything() == !any(complement_of(bits)), "predicate: is_everything");
  Case::require(set.is_open() == (inside == bits), "predicate: is_open");
  Case::require(set.is_closed() == (closed == bits), "predicate: is_closed");
  Case::require(set.is_regular() == (closure_of(cells, inside) == bits), "predicate: is_regular");
}

AffineMap random_map(Choices& choices) {
  AffineMap map = AffineMap::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) map.linear[i][k] += choices.between(-1, 1);
    map.translation[i] = Rational(choices.between(-3, 3), 2);
    map.translation[i].canonicalize();
  }
  return map.determinant() == 0 ? AffineMap::identity() : map;
}

}  // namespace

void fuzz_arrangement(const Case& the_case) {
  Choices& choices = the_case.choices();
  const std::vector<Plane> planes = random_planes(choices);
  const Cells cells(planes);
  the_case.count("cells", cells.size());
  Builder builder(the_case, cells, planes.size());
  const Value a = builder.build(4);
  the_case.tell(a.text);
  check_points(the_case, cells, a.set, a.bits, AffineMap::identity());
  check_predicates(cells, a.set, a.bits);
  Case::require(equal(a.set, a.other), "equality: a set and the same by other operations differ");

  const Value b = builder.build(2);
  the_case.tell("compared with " + b.text);
  Case::require(equal(a.set, b.set) == (a.bits == b.bits), "equality: wrong answer for two sets");
  if (choices.one_in(3)) {
    const AffineMap map = random_map(choices);
    the_case.tell("then transformed");
    check_points(the_case, cells, the_case.valid(transform(a.set, map), "transform"), a.bits, map);
  }
  if (choices.one_in(3)) {
    Case::require(equal(read_native(native_text(a.set), "text"), a.set), "native: another set comes back from text");
    the_case.count("round trips");
  }
}

}  // namespace nef::fuzz
