// SPDX-License-Identifier: Apache-2.0
//
// Geometry as short text for tests: "box(0,0,0,2,2,2) - point(1,1,1)".
//   solids     box(x0,y0,z0,x1,y1,z1)  hull(x,y,z, ...)  halfspace(a,b,c,d): ax+by+cz+d <= 0
//   flat       polygon(x,y,z, ...)  segment(x0,y0,z0,x1,y1,z1)  point(x,y,z)  nothing  everything
//   operators  ! (binds tightest), * (intersection), then + - ^ from left to right
//   functions  interior closure boundary exterior regularize
// Every value is validated as it is made, so a test names the first step that goes wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::test {

/// Returns the argument; throws if an invariant of its complex is broken.
inline Polyhedron valid(Polyhedron p, const std::string& what) {
  const std::string broken = validate(p.complex());
  if (!broken.empty()) throw std::logic_error("validate(" + what + "): " + broken);
  return p;
}

class LiteralParser {
 public:
  explicit LiteralParser(std::string_view text) : text_(text) {}

  Polyhedron parse() {
    Polyhedron result = sum();
    skip_space();
    if (at_ != text_.size()) fail("end of text");
    return result;
  }

 private:
  Polyhedron sum() {
    Polyhedron left = product();
    for (;;) {
      const char op = peek();
      if (op != '+' && op != '-' && op != '^') return left;
      ++at_;
      const Polyhedron right = product();
      left = checked(op == '+'   ? unite(left, right)
                     : op == '-' ? subtract(left, right)
                                 : symmetric_difference(left, right));
    }
  }
  Polyhedron product() {
    Polyhedron left = factor();
    while (peek() == '*') {
      ++at_;
      left = checked(intersect(left, factor()));
    }
    return left;
  }
  Polyhedron factor() {
    if (peek() == '!') {
      ++at_;
      return checked(complement(factor()));
    }
    if (peek() == '(') {
      ++at_;
      Polyhedron inner = sum();
      expect(')');
      return inner;
    }
    return call();
  }
  Polyhedron call() {
    const std::string name = word();
    if (name == "nothing") return checked(Polyhedron());
    if (name == "everything") return checked(Polyhedron::everything());
    expect('(');
    Polyhedron result;
    if (name == "interior" || name == "closure" || name == "boundary" || name == "exterior" || name == "regularize") {
      const Polyhedron a = sum();
      result = name == "interior"   ? interior(a)
               : name == "closure"  ? closure(a)
               : name == "boundary" ? boundary(a)
               : name == "exterior" ? exterior(a)
                                    : regularize(a);
    } else {
      result = primitive(name, numbers());
    }
    expect(')');
    return checked(std::move(result));
  }
  Polyhedron primitive(const std::string& name, const std::vector<Rational>& n) {
    if (name == "halfspace" && n.size() == 4) return make_halfspace(n[0], n[1], n[2], n[3]);
    if (n.size() % 3 != 0) fail("three numbers for each point");
    std::vector<Rational3> points;
    for (std::size_t i = 0; i < n.size(); i += 3) points.push_back({n[i], n[i + 1], n[i + 2]});
    if (name == "box" && points.size() == 2) return make_box(points[0], points[1]);
    if (name == "segment" && points.size() == 2) return make_segment(points[0], points[1]);
    if (name == "point" && points.size() == 1) return make_point(points[0]);
    if (name == "hull") return convex_hull(points);
    if (name == "polygon") {
      const std::vector<std::vector<Rational3>> rings{points};
      return make_polygon(rings);
    }
    fail("a known primitive");
  }
  std::vector<Rational> numbers() {
    std::vector<Rational> result;
    do {
      if (peek() == ',') ++at_;
      skip_space();
      const std::size_t first = at_;
      while (at_ < text_.size() && std::string_view("0123456789+-./e").find(text_[at_]) != std::string_view::npos)
        ++at_;
      result.push_back(parse_rational(text_.substr(first, at_ - first)));
    } while (peek() == ',');
    return result;
  }
  std::string word() {
    skip_space();
    std::string result;
    while (at_ < text_.size() && text_[at_] >= 'a' && text_[at_] <= 'z') result += text_[at_++];
    if (result.empty()) fail("a name");
    return result;
  }
  Polyhedron checked(Polyhedron p) { return valid(std::move(p), std::string(text_.substr(0, at_)) + " ..."); }
  char peek() {
    skip_space();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  void expect(char c) {
    if (peek() != c) fail(std::string(1, c));
    ++at_;
  }
  [[noreturn]] void fail(const std::string& expected) {
    throw std::logic_error("literal: expected " + expected + " at " + std::string(text_.substr(at_)));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// The set that the text spells.
inline Polyhedron set(std::string_view text) { return LiteralParser(text).parse(); }

/// "14/23/12/3": vertices, edges, facets, volumes.
inline std::string count_text(const Polyhedron& p) {
  const Counts n = counts(p);
  return std::to_string(n.vertices) + "/" + std::to_string(n.edges) + "/" + std::to_string(n.facets) + "/" +
         std::to_string(n.volumes);
}

}  // namespace nef::test
