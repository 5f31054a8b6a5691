// SPDX-License-Identifier: Apache-2.0
//
// Sets from half-spaces. A set made from them holds a cell of the planes' arrangement whole or not at all, so it is a
// bit for each cell, Boolean operations are bitwise, and a cell lies in the closure of another one iff its signs are
// those of the other with some replaced by zero. What kinds of items it has, and how many, follows from the bits around
// each cell.
#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

#include "fuzz/fuzzer.h"
#include "fuzz/fuzzers/sets/plane_cells.h"
#include "fuzz/fuzzers/sets/plane_items.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/io/native/native_format.h"
#include "nef/query/location_name.h"

namespace nef::fuzz {
namespace {

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

// Next to where integers cease to be doubles, words, two words, and doubles at all.
Integer landmark(Choices& choices) {
  Integer result;
  const std::size_t which = choices.below(4);
  constexpr std::array<unsigned long, 3> kBits{53, 62, 127};
  if (which == 3) {
    mpz_ui_pow_ui(result.get_mpz_t(), 10, 400);
  } else {
    mpz_ui_pow_ui(result.get_mpz_t(), 2, kBits[which]);
  }
  return result + choices.between(-2, 2);
}

// Moves planes far away or makes them nearly parallel, by numbers next to a landmark.
void enlarge(std::vector<Plane>& planes, Choices& choices) {
  const Integer size = landmark(choices);
  const std::size_t how = choices.below(3);
  for (Plane& plane : planes) {
    if (how == 0) plane.offset = plane.offset * size + choices.between(-1, 1);
    if (how == 1) plane.offset /= size;
    if (how == 2) {
      for (Rational& x : plane.normal) x = x * size + choices.between(-1, 1);
      if (is_zero(plane.normal)) plane.normal[choices.below(3)] = 1;
    }
  }
}

std::vector<Plane> random_planes(Choices& choices) {
  std::vector<Plane> planes(static_cast<std::size_t>(choices.between(1, 6)));
  const int slope = choices.between(1, 3);
  const int shift = choices.between(0, 3);
  for (Plane& plane : planes) {
    for (Rational& x : plane.normal) x = choices.below(2) == 0 ? 0 : choices.between(-slope, slope);
    if (is_zero(plane.normal)) plane.normal[choices.below(3)] = 1;
    plane.offset = choices.between(-shift, shift);
  }
  if (choices.one_in(3)) enlarge(planes, choices);
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

void check_items(const Case& the_case, const Cells& cells, const Polyhedron& set, const Bits& bits) {
  const PlaneItems items(cells, bits);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Location::Kind kind = locate(set, cells.point(c)).kind;
    if (kind == items.kind(c)) continue;
    Case::require(false, "locations: point(" + show(cells.point(c)) + ") is in a " + std::string(location_name(kind)) +
                             ", want a " + std::string(location_name(items.kind(c))));
  }
  const Counts count = counts(set);
  Case::require(count.vertices == items.count(Location::Kind::kVertex), "counts: vertices");
  Case::require(count.edges == items.count(Location::Kind::kEdge), "counts: edges");
  Case::require(count.facets == items.count(Location::Kind::kFacet), "counts: facets");
  Case::require(count.volumes == items.count(Location::Kind::kVolume), "counts: volumes");
  Case::require(euler_numbers(set).size() == count.shells, "counts: an Euler number for each shell");
  Case::require(volume(set) == items.volume(), "measures: volume");
  the_case.count("kinds of locations", cells.size());
}

void check_rays(const Case& the_case, const Cells& cells, const Polyhedron& set, const Bits& bits) {
  Choices& choices = the_case.choices();
  const PlaneItems items(cells, bits);
  for (int i = 0; i < 4; ++i) {
    const Rational3& origin = cells.point(choices.below(cells.size()));
    Rational3 direction = minus(cells.point(choices.below(cells.size())), origin);
    if (is_zero(direction)) direction = {1, choices.between(-1, 1), choices.between(-1, 1)};
    const std::optional<Rational> first = items.first_hit(origin, direction);
    if (first && *first == 0) continue;  // it begins in a facet or an edge
    const std::optional<RayHit> hit = shoot_ray(set, origin, direction);
    const std::string ray = "point(" + show(origin) + "), direction " + show(direction);
    Case::require(hit.has_value() == first.has_value(), "rays: whether something is hit from " + ray);
    if (!hit) continue;
    Case::require(hit->point == moved(origin, *first, direction), "rays: where something is hit from " + ray);
    Case::require(hit->location.kind == items.kind(cells.at(hit->point)), "rays: what is hit from " + ray);
  }
  the_case.count("rays", 4);
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
  check_items(the_case, cells, a.set, a.bits);
  check_rays(the_case, cells, a.set, a.bits);
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
