// SPDX-License-Identifier: Apache-2.0
//
// CGAL's answer to a recipe: folds primitives from left to right and prints the counts.
//   oracle_peer (OP COMPLEMENTED SHAPE 12-NUMBERS)...
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_hull_3.h>

#include <cstdlib>
#include <iostream>
#include <list>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

namespace {

Nef solid(const std::vector<Point>& points) {
  CGAL::Polyhedron_3<Kernel> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return Nef(hull);
}

Nef box(const int* n) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(n[(i & 1) * 3], n[(i >> 1 & 1) * 3 + 1], n[(i >> 2) * 3 + 2]);
  return solid(corners);
}

Nef segment(std::vector<Point>& ends) {
  using Iterator = std::vector<Point>::iterator;
  std::list<std::pair<Iterator, Iterator>> lines{{ends.begin(), ends.end()}};
  return Nef(lines.begin(), lines.end(), Nef::Polylines_tag());
}

Nef primitive(const std::string& shape, const int* n) {
  std::vector<Point> points;
  for (int i = 0; i < 4; ++i) points.emplace_back(n[3 * i], n[3 * i + 1], n[3 * i + 2]);
  if (shape == "box") return box(n);
  if (shape == "open_box") return box(n).interior();
  if (shape == "tetrahedron") return solid(points);
  if (shape == "triangle") return Nef(points.begin(), points.begin() + 3);
  if (shape == "segment") {
    points.resize(2);
    return segment(points);
  }
  if (shape == "point") {
    // A point: where two segments cross.
    std::vector<Point> a{Point(n[0] - 1, n[1], n[2]), Point(n[0] + 1, n[1], n[2])};
    std::vector<Point> b{Point(n[0], n[1] - 1, n[2]), Point(n[0], n[1] + 1, n[2])};
    return segment(a) * segment(b);
  }
  std::cerr << "oracle_peer: unknown shape " << shape << '\n';
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  Nef result(Nef::EMPTY);
  for (int i = 1; i + 14 < argc; i += 15) {
    int n[12];
    for (int k = 0; k < 12; ++k) n[k] = std::atoi(argv[i + 3 + k]);
    Nef other = primitive(argv[i + 2], n);
    if (argv[i + 1][0] == '1') other = other.complement();
    switch (argv[i][0]) {
      case '+':
        result = result + other;
        break;
      case '*':
        result = result * other;
        break;
      case '-':
        result = result - other;
        break;
      default:
        result = result ^ other;
    }
  }
  std::cout << result.number_of_vertices() << '/' << result.number_of_edges() << '/' << result.number_of_facets() << '/'
            << result.number_of_volumes() << '\n';
  return 0;
}
