// SPDX-License-Identifier: Apache-2.0
//
// CGAL's Minkowski sum of two solids in OFF files, written as a Nef polyhedron.
//   sum_peer exact A B OUT.nef3     minkowski_sum_3 over rationals, of the numbers as they are spelled
//   sum_peer rounded A B OUT.nef3   as OpenSCAD 2021.01 uses CGAL: coordinates cut to multiples of 2^-20, convex parts
//                                   summed in doubles, the hulls of sums cut to the same grid and united exactly
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/IO/Nef_polyhedron_iostream_3.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>

#include <array>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Number = CGAL::Gmpq;
using Kernel = CGAL::Cartesian<Number>;
using Point = Kernel::Point_3;
using Surface = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Numbers = std::array<double, 3>;

namespace {

constexpr double kGrid = 0x1p-20;

double cut(double x) { return static_cast<double>(static_cast<long>(x / kGrid)) * kGrid; }

Numbers doubles(const Point& p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}; }

Point exact_point(const Numbers& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }

// The rational that a fraction or a decimal spells.
Number spelled(std::string text) {
  if (text.find('/') != std::string::npos) return Number(text);
  std::size_t decimals = 0;
  const std::size_t dot = text.find('.');
  if (dot != std::string::npos) {
    decimals = text.size() - dot - 1;
    text.erase(dot, 1);
  }
  const bool negative = text[0] == '-';
  if (negative) text.erase(0, 1);
  const std::size_t digit = text.find_first_not_of('0');
  text = digit == std::string::npos ? "0" : text.substr(digit);
  const Number size(text + "/1" + std::string(decimals, '0'));
  return negative ? Number(-size) : size;
}

class OffReader : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  OffReader(const char* path, bool rounded) : rounded_(rounded) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(std::string("cannot read ") + path);
    std::string line;
    while (std::getline(file, line)) text_ += line.substr(0, line.find('#')) + '\n';
  }

  void operator()(Surface::HalfedgeDS& target) override {
    std::istringstream in(text_);
    std::string word;
    std::size_t vertices = 0, faces = 0, edges = 0;
    in >> word >> vertices >> faces >> edges;
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(target, true);
    builder.begin_surface(vertices, faces);
    for (std::size_t v = 0; v < vertices; ++v) {
      std::array<std::string, 3> p;
      in >> p[0] >> p[1] >> p[2];
      builder.add_vertex(rounded_ ? exact_point({cut(std::stod(p[0])), cut(std::stod(p[1])), cut(std::stod(p[2]))})
                                  : Point(spelled(p[0]), spelled(p[1]), spelled(p[2])));
    }
    for (std::size_t f = 0; f < faces; ++f) {
      std::size_t corners = 0;
      in >> corners;
      builder.begin_facet();
      for (std::size_t k = 0, v = 0; k < corners && in >> v; ++k) builder.add_vertex_to_facet(v);
      builder.end_facet();
    }
    builder.end_surface();
  }

 private:
  bool rounded_;
  std::string text_;
};

Nef read(const char* path, bool rounded) {
  Surface surface;
  OffReader reader(path, rounded);
  surface.delegate(reader);
  return Nef(surface);
}

// The vertices of the convex parts, as doubles.
std::vector<std::vector<Numbers>> convex_parts(Nef solid) {
  CGAL::convex_decomposition_3(solid);
  std::vector<std::vector<Numbers>> parts;
  for (auto volume = ++solid.volumes_begin(); volume != solid.volumes_end(); ++volume) {
    if (!volume->mark()) continue;
    Surface surface;
    solid.convert_inner_shell_to_polyhedron(volume->shells_begin(), surface);
    parts.emplace_back();
    for (auto v = surface.vertices_begin(); v != surface.vertices_end(); ++v) {
      parts.back().push_back(doubles(v->point()));
    }
  }
  return parts;
}

Nef rounded_sum(const Nef& a, const Nef& b) {
  std::multimap<std::size_t, Nef> waiting;  // small ones first
  for (const std::vector<Numbers>& p : convex_parts(a)) {
    for (const std::vector<Numbers>& q : convex_parts(b)) {
      std::vector<Point> sums;
      for (const Numbers& x : p) {
        for (const Numbers& y : q) {
          sums.push_back(exact_point({x[0] + y[0], x[1] + y[1], x[2] + y[2]}));
        }
      }
      Surface hull;
      CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
      sums.clear();
      for (auto v = hull.vertices_begin(); v != hull.vertices_end(); ++v) {
        const Numbers n = doubles(v->point());
        sums.push_back(exact_point({cut(n[0]), cut(n[1]), cut(n[2])}));
      }
      hull.clear();
      CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
      waiting.emplace(hull.size_of_facets(), Nef(hull));
    }
  }
  while (waiting.size() > 1) {
    const Nef first = waiting.extract(waiting.begin()).mapped();
    const Nef both = first + waiting.extract(waiting.begin()).mapped();
    waiting.emplace(both.number_of_facets(), both);
  }
  return waiting.begin()->second;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: sum_peer exact|rounded A.off B.off OUT.nef3\n";
    return 2;
  }
  try {
    const bool rounded = std::string(argv[1]) == "rounded";
    Nef a = read(argv[2], rounded);
    Nef b = read(argv[3], rounded);
    Nef sum =  // writing wants it changeable
        rounded ? rounded_sum(a, b) : CGAL::minkowski_sum_3(a, b);
    std::ofstream file(argv[4]);
    file << sum;
    return file.flush() ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "sum_peer: " << error.what() << '\n';
    return 2;
  }
}
