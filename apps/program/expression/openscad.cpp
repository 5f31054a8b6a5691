// SPDX-License-Identifier: Apache-2.0
//
// One function for each kind of node, each from its evaluated children. Two-dimensional models are prisms of height 1
// while they are evaluated, so that Booleans, hulls and sums need no second implementation; the result is cut with the
// plane z = 0 at the end. Extrusions with a scale, and rotations, cut the polygon into triangles and unite a convex
// hull for each.
#include "apps/program/expression/openscad.h"

#include <algorithm>
#include <cmath>

#include "apps/program/expression/openscad_text.h"
#include "nef/base/error.h"
#include "nef/construct/round_shapes.h"
#include "nef/export/to_mesh.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

// What a node makes. Something two-dimensional is a prism over it from z = 0 to z = 1, so that the operations on solids
// do for it, too.
struct Shape {
  int dimension = 0;  // 0: nothing
  Polyhedron set;
};

using Point2 = std::array<Rational, 2>;

class ModelEvaluator {
 public:
  explicit ModelEvaluator(const ExpressionOptions& options) : options_(options) {}

  Shape operator()(const OpenScadNode& node) const {
    Shape shape = [&] {
      try {
        return make(node);
      } catch (const Located&) {
        throw;
      } catch (const InputError& error) {
        throw Located("line " + std::to_string(node.line) + ": " + node.name + ": " + error.what());
      } catch (const UnsupportedError& error) {
        throw Located("line " + std::to_string(node.line) + ": " + node.name + ": " + error.what());
      }
    }();
    if (shape.set.is_empty()) shape.dimension = 0;
    return shape;
  }

 private:
  // An error that knows its line.
  struct Located : InputError {
    using InputError::InputError;
  };

  [[nodiscard]] Shape make(const OpenScadNode& node) const {
    const std::string& name = node.name;
    if (name == "group" || name == "union" || name == "render" || name == "color") return united(node);
    if (name == "multmatrix") return moved(node);
    if (name == "difference") return difference(node);
    if (name == "intersection") return intersection(node);
    if (name == "hull") return hull(node);
    if (name == "minkowski") return minkowski(node);
    if (name == "cube") return cube(node);
    if (name == "sphere") {
      const Rational r = number(node, "r", 0, 1);
      if (r <= 0) return nothing(node, "its radius is " + brief_text(r));
      const unsigned around = corners(node, r, kMostCornersOfBall);
      warn_of_corners(
          options_, "line " + std::to_string(node.line) + ": sphere of " + std::to_string(around) + " corners", around);
      return {3, make_sphere(r, around, options_.monitor)};
    }
    if (name == "cylinder") return cylinder(node);
    if (name == "polyhedron") return polyhedron(node);
    if (name == "square") return square(node);
    if (name == "circle") {
      const Rational r = number(node, "r", 0, 1);
      if (r <= 0) return nothing(node, "its radius is " + brief_text(r));
      return {2, make_cylinder(1, r, r, corners(node, r), options_.monitor)};
    }
    if (name == "polygon") return polygon(node);
    if (name == "linear_extrude") return linear_extrude(node);
    if (name == "rotate_extrude") return rotate_extrude(node);
    if (name == "import") return import(node);
    throw InputError("this is not supported (nef eval --help lists what is)");
  }

  // A shape that OpenSCAD takes for empty, with a warning: it does the same.
  [[nodiscard]] Shape nothing(const OpenScadNode& node, const std::string& why) const {
    if (options_.warn) {
      options_.warn("line " + std::to_string(node.line) + ": " + node.name + ": " + why + ", so it is empty");
    }
    return {};
  }

  // Arguments.

  static Rational number(const OpenScadNode& node, std::string_view name, std::size_t place,
                         const Rational& otherwise) {
    const OpenScadValue* value = node.find(name, place);
    if (value == nullptr) return otherwise;
    if (value->number() == nullptr) throw InputError("'" + std::string(name) + "' is not a number");
    return *value->number();
  }

  static bool flag(const OpenScadNode& node, std::string_view name, std::size_t place) {
    const OpenScadValue* value = node.find(name, place);
    const bool* found = value == nullptr ? nullptr : std::get_if<bool>(&value->is);
    return found != nullptr && *found;
  }

  static std::vector<Rational> numbers(const OpenScadValue& value, std::size_t count) {
    std::vector<Rational> result;
    if (value.list() != nullptr) {
      for (const OpenScadValue& x : *value.list()) {
        if (x.number() == nullptr) break;
        result.push_back(*x.number());
      }
    }
    if (value.list() == nullptr || result.size() != value.list()->size() || result.size() != count) {
      throw InputError("expected a list of " + std::to_string(count) + " numbers");
    }
    return result;
  }

  // A size in each direction: one number for all, or a list.
  static std::vector<Rational> sizes(const OpenScadNode& node, std::size_t count) {
    const OpenScadValue* value = node.find("size", 0);
    if (value == nullptr) return std::vector<Rational>(count, 1);
    if (value->number() != nullptr) return std::vector<Rational>(count, *value->number());
    return numbers(*value, count);
  }

  static const std::vector<OpenScadValue>& list(const OpenScadNode& node, std::string_view name, std::size_t place) {
    const OpenScadValue* value = node.find(name, place);
    if (value == nullptr || value->list() == nullptr)
      throw InputError("the list '" + std::string(name) + "' is missing");
    return *value->list();
  }

  static std::vector<std::uint32_t> indices(const OpenScadValue& value, std::size_t points) {
    if (value.list() == nullptr) throw InputError("expected a list of indices");
    std::vector<std::uint32_t> result;
    for (const OpenScadValue& x : *value.list()) {
      const Rational* n = x.number();
      if (n == nullptr || n->get_den() != 1 || *n < 0 || *n >= Rational(points)) {
        throw InputError("an index does not name a point (there are " + std::to_string(points) + ")");
      }
      result.push_back(static_cast<std::uint32_t>(n->get_num().get_ui()));
    }
    return result;
  }

  // How many corners a circle of this radius has. A few characters can ask for more than any memory holds.
  static unsigned corners(const OpenScadNode& node, const Rational& radius, unsigned most = kMostCornersOfCircle) {
    constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);  // these have names always
    const unsigned count = openscad_fragments(nearest_double(radius), nearest_double(number(node, "$fn", kNowhere, 0)),
                                              nearest_double(number(node, "$fa", kNowhere, 12)),
                                              nearest_double(number(node, "$fs", kNowhere, 2)));
    if (count > most) {
      throw InputError(std::to_string(count) + " corners around ($fn, $fa, $fs) exceed the limit of " +
                       std::to_string(most) + " that are made");
    }
    return count;
  }

  // Combinations.

  // Everything that is there, of one dimension.
  [[nodiscard]] std::vector<Shape> children(const OpenScadNode& node) const {
    std::vector<Shape> shapes;
    int dimension = 0;
    for (const OpenScadNode& child : node.children) {
      shapes.push_back((*this)(child));
      const int d = shapes.back().dimension;
      if (d != 0 && dimension != 0 && d != dimension) throw InputError("it mixes 2D and 3D objects");
      if (d != 0) dimension = d;
    }
    return shapes;
  }

  static int dimension_of(const std::vector<Shape>& shapes) {
    int result = 0;
    for (const Shape& shape : shapes) result = std::max(result, shape.dimension);
    return result;
  }

  static std::vector<Polyhedron> sets_of(const std::vector<Shape>& shapes) {
    std::vector<Polyhedron> sets;
    for (const Shape& shape : shapes) sets.push_back(shape.set);
    return sets;
  }

  [[nodiscard]] Shape united(const OpenScadNode& node) const {
    const std::vector<Shape> shapes = children(node);
    if (shapes.size() == 1) return shapes[0];
    return {dimension_of(shapes), unite_all(sets_of(shapes), options_.monitor)};
  }

  [[nodiscard]] Shape difference(const OpenScadNode& node) const {
    const std::vector<Shape> shapes = children(node);
    if (shapes.empty() || shapes[0].dimension == 0) return {};
    const std::vector<Polyhedron> sets = sets_of(shapes);
    const Polyhedron rest = unite_all(std::span(sets).subspan(1), options_.monitor);
    return {shapes[0].dimension, regularize(subtract(sets[0], rest, options_.monitor), options_.monitor)};
  }

  [[nodiscard]] Shape intersection(const OpenScadNode& node) const {
    const std::vector<Shape> shapes = children(node);
    if (shapes.empty()) return {};
    const Polyhedron common = intersect_all(sets_of(shapes), options_.monitor);
    return {dimension_of(shapes), regularize(common, options_.monitor)};
  }

  [[nodiscard]] Shape hull(const OpenScadNode& node) const {
    const std::vector<Shape> shapes = children(node);
    return {dimension_of(shapes), convex_hull_of_sets(sets_of(shapes), options_.monitor)};
  }

  [[nodiscard]] Shape minkowski(const OpenScadNode& node) const {
    if (!options_.minkowski) throw InputError("Minkowski sums cannot be computed here");
    std::vector<Shape> shapes = children(node);
    std::erase_if(shapes, [](const Shape& shape) { return shape.dimension == 0; });
    if (shapes.empty()) return {};
    Shape result = shapes[0];
    for (std::size_t i = 1; i < shapes.size(); ++i) {
      const Polyhedron sum = options_.minkowski(result.set, shapes[i].set, options_.monitor);
      result.set = regularize(sum, options_.monitor);
      if (result.dimension != 2) continue;
      result.set = transform(result.set, AffineMap::scale({1, 1, Rational(1, 2)}), options_.monitor);
    }
    return result;
  }

  [[nodiscard]] Shape moved(const OpenScadNode& node) const {
    Shape shape = united(node);
    if (shape.dimension == 0) return shape;
    std::vector<Rational> matrix;
    for (const OpenScadValue& row : list(node, "m", 0)) {
      for (Rational& x : numbers(row, 4)) matrix.push_back(std::move(x));
    }
    AffineMap map = affine_map_of(matrix);
    if (shape.dimension == 2) {
      map.linear[2] = {0, 0, 1};
      map.linear[0][2] = map.linear[1][2] = map.translation[2] = 0;
    }
    return {shape.dimension, transform(shape.set, map, options_.monitor)};
  }

  // Solids.

  [[nodiscard]] Shape cube(const OpenScadNode& node) const {
    const std::vector<Rational> s = sizes(node, 3);
    if (const Rational least = std::min({s[0], s[1], s[2]}); least <= 0) {
      return nothing(node, "one of its sizes is " + brief_text(least));
    }
    const Polyhedron box = make_box({0, 0, 0}, {s[0], s[1], s[2]}, options_.monitor);
    if (!flag(node, "center", 1)) return {3, box};
    return {3, transform(box, AffineMap::translate({-s[0] / 2, -s[1] / 2, -s[2] / 2}), options_.monitor)};
  }

  [[nodiscard]] Shape cylinder(const OpenScadNode& node) const {
    const Rational height = number(node, "h", 0, 1);
    const Rational both = number(node, "r", static_cast<std::size_t>(-1), 1);
    const Rational bottom = number(node, "r1", 1, both);
    const Rational top = number(node, "r2", 2, both);
    if (height <= 0) return nothing(node, "its height is " + brief_text(height));
    if (const Rational least = std::min(bottom, top); least < 0) {
      return nothing(node, "one of its radii is " + brief_text(least));
    }
    if (bottom == 0 && top == 0) return nothing(node, "both its radii are 0");
    const Polyhedron set = make_cylinder(height, bottom, top, corners(node, std::max(bottom, top)), options_.monitor);
    if (!flag(node, "center", 3)) return {3, set};
    return {3, transform(set, AffineMap::translate({0, 0, -height / 2}), options_.monitor)};
  }

  [[nodiscard]] Shape polyhedron(const OpenScadNode& node) const {
    Mesh mesh;
    for (const OpenScadValue& point : list(node, "points", 0)) {
      const std::vector<Rational> p = numbers(point, 3);
      mesh.vertices.push_back({p[0], p[1], p[2]});
    }
    for (const OpenScadValue& face : list(node, "faces", 1)) {
      std::vector<std::uint32_t> corners = indices(face, mesh.vertices.size());
      std::reverse(corners.begin(), corners.end());  // clockwise there
      if (corners.size() >= 3) mesh.push_face(corners);
    }
    if (mesh.face_count() == 0) return {};
    return {3, from_mesh(mesh, {.monitor = options_.monitor})};
  }

  [[nodiscard]] Shape import(const OpenScadNode& node) const {
    const OpenScadValue* file = node.find("file", 0);
    const std::string* path = file == nullptr ? nullptr : std::get_if<std::string>(&file->is);
    if (path == nullptr || path->empty()) throw InputError("the name of the file is missing");
    if (!options_.load) throw InputError("files cannot be read here");
    return {3, options_.load(*path, options_.monitor)};
  }

  // What is flat.

  [[nodiscard]] Shape square(const OpenScadNode& node) const {
    const std::vector<Rational> s = sizes(node, 2);
    if (const Rational least = std::min(s[0], s[1]); least <= 0) {
      return nothing(node, "one of its sizes is " + brief_text(least));
    }
    const Polyhedron box = make_box({0, 0, 0}, {s[0], s[1], 1}, options_.monitor);
    if (!flag(node, "center", 1)) return {2, box};
    return {2, transform(box, AffineMap::translate({-s[0] / 2, -s[1] / 2, 0}), options_.monitor)};
  }

  [[nodiscard]] Polyhedron prism(const std::vector<Point2>& ring) const {
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(ring.size());
    std::vector<std::uint32_t> bottom;
    std::vector<std::uint32_t> top;
    for (const int z : {0, 1}) {
      for (const Point2& p : ring) mesh.vertices.push_back({p[0], p[1], z});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      bottom.push_back(n - 1 - i);
      top.push_back(n + i);
      mesh.push_face(std::array{i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    mesh.push_face(bottom);
    mesh.push_face(top);
    // Inside out if the ring runs clockwise, which is mended.
    return from_mesh(mesh, {.monitor = options_.monitor});
  }

  [[nodiscard]] Shape polygon(const OpenScadNode& node) const {
    std::vector<Point2> points;
    for (const OpenScadValue& point : list(node, "points", 0)) {
      const std::vector<Rational> p = numbers(point, 2);
      points.push_back({p[0], p[1]});
    }
    std::vector<std::vector<Point2>> rings;
    if (const OpenScadValue* paths = node.find("paths", 1); paths != nullptr && paths->list() != nullptr) {
      for (const OpenScadValue& path : *paths->list()) {
        std::vector<Point2>& ring = rings.emplace_back();
        for (const std::uint32_t i : indices(path, points.size())) ring.push_back(points[i]);
      }
    } else {
      rings.push_back(points);
    }
    Polyhedron region;
    for (const std::vector<Point2>& ring : rings) {
      if (ring.size() >= 3) region = symmetric_difference(region, prism(ring), options_.monitor);
    }
    return {2, regularize(region, options_.monitor)};
  }

  // The triangles of a flat shape.
  [[nodiscard]] std::vector<std::array<Point2, 3>> triangles(const Polyhedron& set) const {
    MeshExportOptions options;
    options.keep_polygons = false;
    const Mesh mesh = to_mesh(set, options, options_.monitor).mesh;
    std::vector<std::array<Point2, 3>> result;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      const auto low = [&mesh](std::uint32_t v) { return mesh.vertices[v][2] == 0; };
      if (!std::all_of(face.begin(), face.end(), low)) continue;
      std::array<Point2, 3>& t = result.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) t[i] = {mesh.vertices[face[i]][0], mesh.vertices[face[i]][1]};
    }
    return result;
  }

  [[nodiscard]] Polyhedron flat_content(const OpenScadNode& node) const {
    const Shape shape = united(node);
    if (shape.dimension == 3) throw InputError("it needs a 2D object");
    return shape.set;
  }

  [[nodiscard]] Shape linear_extrude(const OpenScadNode& node) const {
    const Polyhedron flat = flat_content(node);
    const Rational height = number(node, "height", 0, 100);
    if (number(node, "twist", static_cast<std::size_t>(-1), 0) != 0) throw InputError("twist is not supported");
    Rational scale = 1;
    if (const OpenScadValue* value = node.find("scale", static_cast<std::size_t>(-1))) {
      const std::vector<Rational> s =
          value->number() != nullptr ? std::vector<Rational>(2, *value->number()) : numbers(*value, 2);
      if (s[0] != s[1]) throw InputError("different scales in x and y are not supported");
      scale = s[0];
    }
    if (height <= 0) return nothing(node, "its height is " + brief_text(height));
    if (scale < 0) return nothing(node, "its scale is " + brief_text(scale));
    if (flat.is_empty()) return {};
    Polyhedron set;
    if (scale == 1) {
      set = transform(flat, AffineMap::scale({1, 1, height}), options_.monitor);
    } else {
      std::vector<Polyhedron> pieces;
      for (const auto& triangle : triangles(flat)) {
        std::vector<Rational3> points;
        for (const Point2& p : triangle) {
          points.push_back({p[0], p[1], 0});
          points.push_back({p[0] * scale, p[1] * scale, height});
        }
        pieces.push_back(convex_hull(points, options_.monitor));
      }
      set = unite_all(pieces, options_.monitor);
    }
    if (!flag(node, "center", static_cast<std::size_t>(-1))) return {3, set};
    return {3, transform(set, AffineMap::translate({0, 0, -height / 2}), options_.monitor)};
  }

  // The polygon's x goes around the z axis, its y becomes z. A whole turn begins in the direction of -x, a part of one
  // at x, as OpenSCAD's do.
  [[nodiscard]] Shape rotate_extrude(const OpenScadNode& node) const {
    const std::vector<std::array<Point2, 3>> flat = triangles(flat_content(node));
    Rational widest = 0;
    bool left = false;
    bool right = false;
    for (const auto& triangle : flat) {
      for (const Point2& p : triangle) {
        widest = std::max<Rational>(widest, abs(p[0]));
        left = left || p[0] < 0;
        right = right || p[0] > 0;
      }
    }
    if (left && right) throw InputError("all points must have the same sign of x");
    const std::vector<std::array<Rational, 2>> directions = directions_around(
        number(node, "angle", static_cast<std::size_t>(-1), 360), corners(node, widest, kMostCornersOfBall));
    std::vector<Polyhedron> wedges;
    for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
      for (const auto& triangle : flat) {
        std::vector<Rational3> points;
        for (const auto& [cosine, sine] : {directions[i], directions[i + 1]}) {
          for (const Point2& p : triangle) points.push_back({p[0] * cosine, p[0] * sine, p[1]});
        }
        wedges.push_back(convex_hull(points, options_.monitor));
      }
    }
    return {3, unite_all(wedges, options_.monitor)};
  }

  static std::vector<std::array<Rational, 2>> directions_around(const Rational& angle, unsigned fragments) {
    const double degrees = nearest_double(angle);
    std::vector<std::array<Rational, 2>> result;
    if (degrees == 360 || std::abs(degrees) > 360) {
      result = unit_circle(fragments);
      for (auto& [x, y] : result) x = -x;
      result.push_back(result.front());
      return result;
    }
    const auto steps = std::max(static_cast<unsigned>(fragments * std::abs(degrees) / 360), 1U);
    for (unsigned i = 0; i <= steps; ++i) {
      const double radians = degrees * i / steps * M_PI / 180;
      result.push_back({exact_rational(std::cos(radians)), exact_rational(std::sin(radians))});
    }
    return result;
  }

  const ExpressionOptions& options_;
};

}  // namespace

Polyhedron evaluate_openscad(std::string_view text, const ExpressionOptions& options) {
  const Shape shape = ModelEvaluator(options)(parse_openscad(text));
  if (shape.dimension != 2) return shape.set;
  return intersect(shape.set, make_halfspace(0, 0, 1, 0, true, options.monitor), options.monitor);
}

}  // namespace nef
