// SPDX-License-Identifier: Apache-2.0
#include "bench/generators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "nef/base/error.h"

namespace nef::bench {
namespace {

using Point = std::array<long, 3>;

// SplitMix64: the same numbers with every compiler and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Uniform in 0 .. bound-1 (bound far below 2^64: the bias does not matter).
  long below(long bound) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return static_cast<long>((z ^ (z >> 31U)) % static_cast<std::uint64_t>(bound));
  }

 private:
  std::uint64_t state_;
};

std::uint32_t add_vertex(Mesh& mesh, const Point& p) {
  mesh.vertices.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_box(Mesh& mesh, const Point& low, const Point& high) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i) {
    add_vertex(mesh,
               {(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1], (i & 4U) != 0 ? high[2] : low[2]});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::array<std::uint32_t, 4> face : kFaces) {
    for (std::uint32_t& corner : face) corner += base;
    mesh.push_face(face);
  }
}

long determinant(const std::array<Point, 4>& p) {
  std::array<Point, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) d[i][k] = p[i + 1][k] - p[0][k];
  }
  return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

void add_tetrahedron(Mesh& mesh, std::array<Point, 4> p) {
  if (determinant(p) < 0) std::swap(p[2], p[3]);
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Point& point : p) add_vertex(mesh, point);
  constexpr std::array<std::array<std::uint32_t, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  for (std::array<std::uint32_t, 3> face : kFaces) {
    for (std::uint32_t& corner : face) corner += base;
    mesh.push_face(face);
  }
}

// A right prism over a counterclockwise polygon.
Mesh prism(const std::vector<std::array<Rational, 2>>& polygon, const Rational& bottom, const Rational& top) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const auto& p : polygon) mesh.vertices.push_back({p[0], p[1], bottom});
  for (const auto& p : polygon) mesh.vertices.push_back({p[0], p[1], top});
  std::vector<std::uint32_t> low;
  std::vector<std::uint32_t> high;
  for (std::uint32_t i = 0; i < n; ++i) {
    low.push_back(n - 1 - i);
    high.push_back(n + i);
  }
  mesh.push_face(low);
  mesh.push_face(high);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.push_face(std::array<std::uint32_t, 4>{i, j, n + j, n + i});
  }
  return mesh;
}

// A regular n-gon with its corners rounded to a grid so fine that it stays convex.
std::vector<std::array<Rational, 2>> regular_polygon(int n, double radius, double start_degrees) {
  std::vector<std::array<Rational, 2>> polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n + start_degrees * std::numbers::pi / 180;
    polygon.push_back({Rational(std::round(radius * std::cos(angle))), Rational(std::round(radius * std::sin(angle)))});
  }
  return polygon;
}

// Splits every triangle into four and moves the new vertices onto the sphere.
Mesh sphere(const Mesh& seed, int level, double radius, const Point& shift) {
  std::vector<std::array<double, 3>> points;
  for (const Rational3& v : seed.vertices) points.push_back({v[0].get_d(), v[1].get_d(), v[2].get_d()});
  std::vector<std::uint32_t> triangles = seed.corners;
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto split = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, added] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (added) {
        points.push_back({points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2]});
        std::array<double, 3>& p = points.back();
        const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (double& x : p) x /= length;
      }
      return it->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const std::uint32_t a = triangles[t];
      const std::uint32_t b = triangles[t + 1];
      const std::uint32_t c = triangles[t + 2];
      const std::uint32_t ab = split(a, b);
      const std::uint32_t bc = split(b, c);
      const std::uint32_t ca = split(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    triangles = std::move(finer);
  }
  Mesh mesh;
  for (const std::array<double, 3>& p : points) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    add_vertex(mesh, {std::lround(radius * p[0] / length) + shift[0], std::lround(radius * p[1] / length) + shift[1],
                      std::lround(radius * p[2] / length) + shift[2]});
  }
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    mesh.push_face(std::array<std::uint32_t, 3>{triangles[t], triangles[t + 1], triangles[t + 2]});
  }
  return mesh;
}

Mesh icosahedron() {
  Mesh mesh;
  const Rational golden = Rational(16180339887L, 10000000000L);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int s : {-1, 1}) {
      for (const int t : {-1, 1}) {
        Rational3 p{0, 0, 0};
        p[(axis + 1) % 3] = s;
        p[(axis + 2) % 3] = t * golden;
        mesh.vertices.push_back(p);
      }
    }
  }
  // Faces: triples of vertices at the distance of an edge, turned outward.
  const auto at = [&](std::uint32_t i, std::size_t k) { return mesh.vertices[i][k].get_d(); };
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    double d = 0;
    for (std::size_t k = 0; k < 3; ++k) d += (at(i, k) - at(j, k)) * (at(i, k) - at(j, k));
    return d < 5;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const double det = at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) -
                           at(a, 1) * (at(b, 0) * at(c, 2) - at(b, 2) * at(c, 0)) +
                           at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0));
        mesh.push_face(det > 0 ? std::array<std::uint32_t, 3>{a, b, c} : std::array<std::uint32_t, 3>{a, c, b});
      }
    }
  }
  return mesh;
}

Mesh octahedron() {
  Mesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const long s : {1L, -1L}) {
      Point p{0, 0, 0};
      p[axis] = s;
      add_vertex(mesh, p);
    }
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1U;
    const std::uint32_t y = 2 + (octant >> 1U & 1U);
    const std::uint32_t z = 4 + (octant >> 2U);
    const bool mirrored = ((octant ^ (octant >> 1U) ^ (octant >> 2U)) & 1U) != 0;
    mesh.push_face(mirrored ? std::array<std::uint32_t, 3>{x, z, y} : std::array<std::uint32_t, 3>{x, y, z});
  }
  return mesh;
}

}  // namespace

Case tetgrid(int n) {
  Random random(0x7e76ULL + static_cast<std::uint64_t>(n));
  constexpr long kCell = 100;
  constexpr long kHalf = 49;  // cubes of side 98: neighbours keep apart
  Case result{"tetgrid-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(2)};
  for (int i = 0; i < n * n * n; ++i) {
    const Point cell{kCell * (i % n), kCell * (i / n % n), kCell * (i / n / n)};
    std::array<Point, 4> p;
    do {
      for (Point& q : p)
        q = {cell[0] + random.below(kCell), cell[1] + random.below(kCell), cell[2] + random.below(kCell)};
    } while (determinant(p) == 0);
    add_tetrahedron(result.operands[0].mesh, p);
  }
  for (long x = 1; x < n; ++x) {
    for (long y = 1; y < n; ++y) {
      for (long z = 1; z < n; ++z) {
        add_box(result.operands[1].mesh, {kCell * x - kHalf, kCell * y - kHalf, kCell * z - kHalf},
                {kCell * x + kHalf, kCell * y + kHalf, kCell * z + kHalf});
      }
    }
  }
  return result;
}

Case quadratic_wall_grid(int n) {
  Case result{"wall-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(2)};
  for (long i = 0; i < n; ++i) {
    add_box(result.operands[0].mesh, {0, 2 * i, 0}, {10000, 2 * i + 1, 100});
    add_box(result.operands[1].mesh, {2 * i, 0, 50}, {2 * i + 1, 10000, 150});
  }
  return result;
}

Case complex_facet(int n) {
  constexpr long kUnit = 1000;
  Random random(0xfaceULL + static_cast<std::uint64_t>(n));
  Case result{"facet-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(2)};
  const long side = n * kUnit;
  add_box(result.operands[0].mesh, {0, 0, 0}, {side, side, side});
  for (int i = 0; i < n * n; ++i) {
    const Point cell{kUnit * (i % n), kUnit * (i / n), side - kUnit / 2};
    std::array<Point, 4> p;
    bool low = false;
    bool high = false;
    do {
      low = high = false;
      for (Point& q : p) {
        // Inside the cell in x and y, so that no two tetrahedra meet and none leaves the top.
        q = {cell[0] + 1 + random.below(kUnit - 1), cell[1] + 1 + random.below(kUnit - 1),
             cell[2] + random.below(kUnit)};
        low = low || q[2] < side;
        high = high || q[2] > side;
      }
    } while (!low || !high || determinant(p) == 0);
    add_tetrahedron(result.operands[1].mesh, p);
  }
  return result;
}

Case complex_minus_simple(int n) {
  Case result = complex_facet(n);
  result.name = "minus-" + std::to_string(n);
  result.operation = Operation::kDifference;
  constexpr long kUnit = 1000;
  const long middle = (n / 2) * kUnit + kUnit / 2;
  Operand cube;
  add_box(cube.mesh, {middle - 2 * kUnit, middle - 2 * kUnit, n * kUnit - kUnit}, {middle, middle, n * kUnit + kUnit});
  result.operands.push_back(std::move(cube));
  return result;
}

Case complex_sphere_map(int n) {
  Case result{"sphere_map-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(2)};
  for (Operand& operand : result.operands) {
    operand.surface = true;
    add_vertex(operand.mesh, {0, 0, 0});
  }
  for (long i = 0; i <= n; ++i) {
    const long s = 2 * i - n;
    const std::uint32_t a = add_vertex(result.operands[0].mesh, {n, s, n});
    const std::uint32_t b = add_vertex(result.operands[0].mesh, {n, s, -n});
    result.operands[0].mesh.push_face(std::array<std::uint32_t, 3>{0, a, b});
    const std::uint32_t c = add_vertex(result.operands[1].mesh, {n, n, s});
    const std::uint32_t d = add_vertex(result.operands[1].mesh, {n, -n, s});
    result.operands[1].mesh.push_face(std::array<std::uint32_t, 3>{0, c, d});
  }
  return result;
}

Case rotated_cylinder(int n, double degrees) {
  constexpr double kRadius = 0x1p40;
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "cylinder-%d-%.0e", n, degrees);
  Case result{name.data(), Operation::kUnion, std::vector<Operand>(2)};
  const Rational height(kRadius);
  result.operands[0].mesh = prism(regular_polygon(n, kRadius, 0), Rational(0), height);
  result.operands[1].mesh = prism(regular_polygon(n, kRadius, degrees), Rational(0), height);
  return result;
}

Case growing_cylinder(int n, int i, bool both) {
  Case result{std::string(both ? "cascade2-" : "cascade-") + std::to_string(n) + "-" + std::to_string(i),
              Operation::kUnion, std::vector<Operand>(2)};
  Integer ten;
  mpz_ui_pow_ui(ten.get_mpz_t(), 10, static_cast<unsigned long>(i));
  const Integer denominator = ten * ten + 1;
  const Rational sine(Integer(2 * ten), denominator);
  const Rational cosine(Integer(ten * ten - 1), denominator);
  const std::vector<std::array<Rational, 2>> polygon = regular_polygon(n, 1e9, 0);
  const auto rotated = [&](const Rational& s) {
    std::vector<std::array<Rational, 2>> turned;
    for (const auto& p : polygon) turned.push_back({cosine * p[0] - s * p[1], s * p[0] + cosine * p[1]});
    return turned;
  };
  result.operands[0].mesh = prism(both ? rotated(-sine) : polygon, Rational(0), Rational(1000000000));
  result.operands[1].mesh = prism(rotated(sine), Rational(0), Rational(1000000000));
  return result;
}

Case worst_case_ray_shooting(int n) {
  constexpr long kSteps = 1L << 20;  // x = 1024 k, z = k: an inclination of 1/1024
  constexpr long kRadius = 1024 * kSteps;
  Case result{"ray-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(2)};
  Operand& polygon = result.operands[0];
  polygon.surface = true;
  std::vector<std::uint32_t> face;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / n;
    const long k = std::lround(static_cast<double>(kSteps) * std::cos(angle));
    face.push_back(
        add_vertex(polygon.mesh, {1024 * k, std::lround(static_cast<double>(kRadius) * std::sin(angle)), k}));
  }
  polygon.mesh.push_face(face);
  const long count = n / 4;
  const long step = 2 * kRadius / (count + 2);
  for (long i = 0; i < count; ++i) {
    const long y = -kRadius + (i + 1) * step;
    const long x = 2 * kRadius;
    const long z = i % 2 == 0 ? kSteps + 16 : -kSteps - 16;
    const long size = step / 4;
    add_tetrahedron(result.operands[1].mesh,
                    {{{x, y, z}, {x + size, y, z}, {x + size, y + size, z}, {x + size, y, z + size}}});
  }
  return result;
}

Case shifted_spheres(int level) {
  constexpr double kRadius = 0x1p30;
  Case result{"spheres-" + std::to_string(level), Operation::kUnion, std::vector<Operand>(2)};
  result.operands[0].mesh = sphere(icosahedron(), level, kRadius, {0, 0, 0});
  result.operands[1].mesh =
      sphere(icosahedron(), level, kRadius,
             {std::lround(.30 * kRadius), std::lround(.17 * kRadius), std::lround(.11 * kRadius)});
  return result;
}

namespace {

// Moves the vertices of a sphere along their rays, and mixes the order of vertices and triangles.
Mesh scan(const Mesh& sphere, double radius, std::uint64_t seed, const Point& shift) {
  Random random(seed);
  const auto count = static_cast<std::uint32_t>(sphere.vertices.size());
  std::vector<std::uint32_t> place(count);
  for (std::uint32_t i = 0; i < count; ++i) place[i] = i;
  for (std::uint32_t i = count; i-- > 1;) std::swap(place[i], place[static_cast<std::size_t>(random.below(i + 1))]);
  Mesh mesh;
  mesh.vertices.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = sphere.vertices[i][k].get_d() / radius;
    double factor = 1 + 1e-4 * (static_cast<double>(random.below(1 << 20)) / (1 << 20) - 0.5);
    for (const double wave : {3.0, 5.0, 11.0}) {
      factor += 0.1 / wave * std::sin(wave * d[0] + 1) * std::sin(wave * d[1] + 2) * std::cos(wave * d[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.vertices[place[i]][k] = Rational(std::round(radius * factor * d[k]) + static_cast<double>(shift[k]));
    }
  }
  std::vector<std::size_t> order(sphere.face_count());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  for (std::size_t f = order.size(); f-- > 1;) {
    std::swap(order[f], order[static_cast<std::size_t>(random.below(static_cast<long>(f) + 1))]);
  }
  for (const std::size_t f : order) {
    const std::span<const std::uint32_t> face = sphere.face(f);
    mesh.push_face(std::array<std::uint32_t, 3>{place[face[0]], place[face[1]], place[face[2]]});
  }
  return mesh;
}

}  // namespace

Case shifted_scans(int level) {
  constexpr double kRadius = 0x1p30;
  Case result{"scans-" + std::to_string(level), Operation::kUnion, std::vector<Operand>(2)};
  const Mesh whole = sphere(icosahedron(), level, kRadius, {0, 0, 0});
  result.operands[0].mesh = scan(whole, kRadius, 0x5ca1, {0, 0, 0});
  result.operands[1].mesh = scan(whole, kRadius, 0x5ca2,
                                 {std::lround(.30 * kRadius), std::lround(.17 * kRadius), std::lround(.11 * kRadius)});
  return result;
}

Case big_minus_small(int level) {
  constexpr double kRadius = 0x1p30;
  Case result{"bigsmall-" + std::to_string(level), Operation::kDifference, std::vector<Operand>(2)};
  result.operands[0].mesh = sphere(octahedron(), level, kRadius, {0, 0, 0});
  const long half = std::lround(kRadius / 2000);
  const Point at{std::lround(kRadius * 0.6), std::lround(kRadius * 0.48), std::lround(kRadius * 0.64)};
  add_box(result.operands[1].mesh, {at[0] - half, at[1] - half, at[2] - half},
          {at[0] + half, at[1] + half, at[2] + half});
  return result;
}

Case staircase(int n) {
  Case result{"staircase-" + std::to_string(n), Operation::kUnion, std::vector<Operand>(static_cast<std::size_t>(n))};
  for (long i = 0; i < n; ++i) {
    add_box(result.operands[static_cast<std::size_t>(i)].mesh, {2 * i, 2 * i, 2 * i},
            {2 * i + 3, 2 * i + 3, 2 * i + 3});
  }
  return result;
}

Case drill_holes(int n) {
  Case result{"holes-" + std::to_string(n), Operation::kSubtractAll, std::vector<Operand>(1)};
  constexpr long kUnit = 1000000;
  const auto columns = static_cast<long>(std::ceil(std::sqrt(n)));
  add_box(result.operands[0].mesh, {0, 0, 0}, {columns * kUnit, columns * kUnit, kUnit});
  for (long i = 0; i < n; ++i) {
    auto polygon = regular_polygon(64, 0.3 * kUnit, 0);
    for (auto& corner : polygon) {
      corner[0] += Rational(i % columns * kUnit + kUnit / 2);
      corner[1] += Rational(i / columns * kUnit + kUnit / 2);
    }
    result.operands.push_back({prism(polygon, Rational(-kUnit), Rational(2 * kUnit)), false});
  }
  return result;
}

Case random_boxes(int n) {
  Case result{"boxes-" + std::to_string(n), Operation::kUniteAll, std::vector<Operand>(static_cast<std::size_t>(n))};
  Random random(0xb0c5ULL);
  constexpr long kSide = 100000;  // of the largest boxes
  const auto space = static_cast<long>(std::cbrt(n) * kSide);
  for (Operand& operand : result.operands) {
    Point low;
    Point high;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = random.below(space);
      high[i] = low[i] + kSide / 2 + random.below(kSide / 2);
    }
    add_box(operand.mesh, low, high);
  }
  return result;
}

Case lattice(int n) {
  Case result{"lattice-" + std::to_string(n), Operation::kUniteAll, {}};
  for (long x = 0; x < n; ++x) {
    for (long y = 0; y < n; ++y) {
      for (long z = 0; z < n; ++z) {
        add_box(result.operands.emplace_back().mesh, {4 * x, 4 * y, 4 * z}, {4 * x + 5, 4 * y + 5, 4 * z + 5});
      }
    }
  }
  return result;
}

Case point_location(int n) {
  Case result = tetgrid(n);
  result.name = "locate-" + std::to_string(n);
  result.operation = Operation::kLocate;
  return result;
}

std::vector<Rational3> query_points(int n) {
  Random random(0x10caULL);
  std::vector<Rational3> points;
  for (int i = 0; i < 1000; ++i) {
    // On a grid of halves: some of them lie on facets.
    Rational3 p;
    for (Rational& x : p) x = Rational(random.below(200L * n), 2), x.canonicalize();
    points.push_back(p);
  }
  return points;
}

namespace {

int number_at(const std::vector<std::string>& words, std::size_t i, const std::string& name) {
  if (i >= words.size()) throw InputError("case " + name + ": a number is missing, as in tetgrid-12");
  const Rational value = parse_rational(words[i]);
  if (value.get_den() != 1 || value <= 0 || value > 100000)
    throw InputError("case " + name + ": bad number " + words[i]);
  return static_cast<int>(value.get_num().get_si());
}

}  // namespace

Case make_case(const std::string& name) {
  std::vector<std::string> words{""};
  for (const char c : name) {
    // "1e-6" is one word.
    if (c == '-' && (words.back().empty() || words.back().back() != 'e' || words.size() < 3)) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  const std::string& kind = words[0];
  const auto number = [&](std::size_t i) { return number_at(words, i, name); };
  if (kind == "tetgrid") return tetgrid(number(1));
  if (kind == "wall") return quadratic_wall_grid(number(1));
  if (kind == "facet") return complex_facet(number(1));
  if (kind == "minus") return complex_minus_simple(number(1));
  if (kind == "sphere_map") return complex_sphere_map(number(1));
  if (kind == "ray") return worst_case_ray_shooting(number(1));
  if (kind == "spheres") return shifted_spheres(number(1));
  if (kind == "scans") return shifted_scans(number(1));
  if (kind == "bigsmall") return big_minus_small(number(1));
  if (kind == "staircase") return staircase(number(1));
  if (kind == "holes") return drill_holes(number(1));
  if (kind == "boxes") return random_boxes(number(1));
  if (kind == "lattice") return lattice(number(1));
  if (kind == "locate") return point_location(number(1));
  if (kind == "cascade" || kind == "cascade2") return growing_cylinder(number(1), number(2), kind == "cascade2");
  if (kind == "cylinder" && words.size() == 3) return rotated_cylinder(number(1), parse_rational(words[2]).get_d());
  throw InputError("no benchmark case is called " + name + "; see bench/README.md");
}

}  // namespace nef::bench
