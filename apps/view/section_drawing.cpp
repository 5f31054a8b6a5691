// SPDX-License-Identifier: Apache-2.0
//
// Points are projected to two unit vectors across the normal, in doubles: this is output, and nothing is decided by it.
// Areas are half the length of the vector area of a ring, summed relative to its first corner so that far away sections
// lose no digits.
#include "apps/view/section_drawing.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "nef/io/number_text.h"

namespace nef::view {
namespace {

using Eigen::Vector3d;
using Point2 = std::array<double, 2>;

Vector3d nearest_vector(const Rational3& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

// Two unit vectors across the normal, such that the three are right-handed.
class Frame {
 public:
  explicit Frame(const Rational3& normal) {
    const Vector3d n = nearest_vector(normal).stableNormalized();
    const double flat = std::hypot(n[0], n[1]);
    // Looking along z the drawing has x to the right, if from below to the left.
    u_ = flat > 0 ? Vector3d(-n[1] / flat, n[0] / flat, 0) : Vector3d(n[2], 0, 0);
    v_ = n.cross(u_);
  }
  [[nodiscard]] Point2 operator()(const Rational3& p) const {
    const Vector3d x = nearest_vector(p);
    return {x.dot(u_), x.dot(v_)};
  }

 private:
  Vector3d u_, v_;
};

// The length of the vector area.
double ring_area(std::span<const Rational3> ring) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d origin = nearest_vector(ring[0]);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += (nearest_vector(ring[i]) - origin).cross(nearest_vector(ring[i + 1]) - origin);
  }
  return sum.stableNorm() / 2;
}

struct Bounds {
  Point2 low{HUGE_VAL, HUGE_VAL};
  Point2 high{-HUGE_VAL, -HUGE_VAL};
  void add(const Point2& p) {
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
};

template <typename Visit>
void for_each_ring(const Section& section, Visit visit) {
  for (const SectionPolygon& polygon : section.polygons) {
    visit(std::span(polygon.outer));
    for (const std::vector<Rational3>& hole : polygon.holes) visit(std::span(hole));
  }
}

Bounds bounds_of(const Section& section, const Frame& frame) {
  Bounds bounds;
  for_each_ring(section, [&](std::span<const Rational3> ring) {
    for (const Rational3& p : ring) bounds.add(frame(p));
  });
  for (const auto& segment : section.segments) {
    for (const Rational3& p : segment) bounds.add(frame(p));
  }
  for (const Rational3& p : section.points) bounds.add(frame(p));
  if (bounds.low[0] > bounds.high[0]) bounds.low = bounds.high = {0, 0};
  return bounds;
}

// y points down in SVG.
void append_svg_point(std::string& text, const Point2& p) {
  append_number(text, p[0]);
  text += ' ';
  append_number(text, -p[1]);
}

std::string svg_path(const SectionPolygon& polygon, const Frame& frame) {
  std::string text = "<path d=\"";
  const auto add = [&](std::span<const Rational3> ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      text += i == 0 ? "M" : "L";
      append_svg_point(text, frame(ring[i]));
    }
    text += "Z";
  };
  add(polygon.outer);
  for (const std::vector<Rational3>& hole : polygon.holes) add(hole);
  return text + "\"/>\n";
}

// Group codes and values, a line each.
class Dxf {
 public:
  void add(int code, const std::string& value) { text_ += std::to_string(code) + "\n" + value + "\n"; }
  void add(int code, double value) {
    std::string number;
    append_number(number, value);
    add(code, number);
  }
  void entity(const std::string& name) {
    add(0, name);
    add(8, "section");
  }
  void point(const Point2& p, int offset = 0) {
    add(10 + offset, p[0]);
    add(20 + offset, p[1]);
    add(30 + offset, 0.0);
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace

double section_area(const Section& section) {
  double area = 0;
  for (const SectionPolygon& polygon : section.polygons) {
    area += ring_area(polygon.outer);
    for (const std::vector<Rational3>& hole : polygon.holes) area -= ring_area(hole);
  }
  return area;
}

std::string section_svg(const Section& section, const Rational3& normal) {
  const Frame frame(normal);
  const Bounds bounds = bounds_of(section, frame);
  const double width = bounds.high[0] - bounds.low[0];
  const double height = bounds.high[1] - bounds.low[1];
  // A drawing of nothing, or of one point, is one unit wide: readers with floats know no box of less than 1e-38.
  const double size = std::max(width, height) > 0 ? std::max({width, height, 1e-30}) : 1;
  const double margin = size / 50;
  // One unit is a millimetre, as in 3MF, so that laser cutters and editors get the size right.
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"";
  append_number(text, width + 2 * margin);
  text += "mm\" height=\"";
  append_number(text, height + 2 * margin);
  text += "mm\" viewBox=\"";
  for (const double x : {bounds.low[0] - margin, -bounds.high[1] - margin, width + 2 * margin}) {
    append_number(text, x);
    text += ' ';
  }
  append_number(text, height + 2 * margin);
  text +=
      "\">\n"
      "<g fill=\"#b8c8d8\" fill-rule=\"evenodd\" stroke=\"#203040\" stroke-linecap=\"round\" stroke-width=\"";
  append_number(text, size / 500);
  text += "\">\n";
  for (const SectionPolygon& polygon : section.polygons) text += svg_path(polygon, frame);
  for (const auto& segment : section.segments) {
    text += "<path d=\"M";
    append_svg_point(text, frame(segment[0]));
    text += "L";
    append_svg_point(text, frame(segment[1]));
    text += "\"/>\n";
  }
  for (const Rational3& p : section.points) {
    text += "<path d=\"M";
    append_svg_point(text, frame(p));
    text += "h0\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

std::string section_dxf(const Section& section, const Rational3& normal) {
  const Frame frame(normal);
  Dxf dxf;
  dxf.add(0, "SECTION");
  dxf.add(2, "ENTITIES");
  for_each_ring(section, [&](std::span<const Rational3> ring) {
    dxf.entity("POLYLINE");
    dxf.add(66, "1");  // vertices follow
    dxf.point({0, 0});
    dxf.add(70, "1");  // closed
    for (const Rational3& p : ring) {
      dxf.entity("VERTEX");
      dxf.point(frame(p));
    }
    dxf.add(0, "SEQEND");
  });
  for (const auto& segment : section.segments) {
    dxf.entity("LINE");
    dxf.point(frame(segment[0]));
    dxf.point(frame(segment[1]), 1);
  }
  for (const Rational3& p : section.points) {
    dxf.entity("POINT");
    dxf.point(frame(p));
  }
  dxf.add(0, "ENDSEC");
  dxf.add(0, "EOF");
  return dxf.take();
}

}  // namespace nef::view
