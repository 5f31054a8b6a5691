// SPDX-License-Identifier: Apache-2.0
//
// Meshes of voxels, boxes and tetrahedra, turned outward or inward, that touch, nest, overlap or contradict each other,
// with faces left out or turned now and then. What they enclose is told by winding numbers: the sum over the components
// of +1 or -1 for those that hold a point. A mesh whose winding numbers are not all 0 and 1, or all 0 and -1, bounds
// nothing.
#include <algorithm>
#include <map>
#include <set>

#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/mesh/mesh_check.h"

namespace nef::fuzz {
namespace {

constexpr int kVoxelWidth = 4;
using Cell = std::array<int, 3>;

// A cell of the grid as a number, and back.
constexpr int kCells = kVoxelWidth * kVoxelWidth * kVoxelWidth;
Cell cell_at(int i) { return {i % kVoxelWidth, i / kVoxelWidth % kVoxelWidth, i / kVoxelWidth / kVoxelWidth}; }

struct Component {
  std::vector<std::vector<Cell>> faces;  // outward
  std::vector<bool> holds;               // by cell; what a tetrahedron holds is decided point by point
  std::array<Cell, 4> tetrahedron{};
  bool is_tetrahedron = false;
  bool inward = false;
};

// The four corners of the side of a box in direction +-axis, counterclockwise as seen from outside.
std::vector<Cell> side_of(const Cell& low, const Cell& high, std::size_t axis, bool positive) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  std::vector<Cell> face(4, positive ? high : low);
  face[0][u] = low[u], face[0][v] = low[v];
  face[1][u] = high[u], face[1][v] = low[v];
  face[2][u] = high[u], face[2][v] = high[v];
  face[3][u] = low[u], face[3][v] = high[v];
  if (!positive) std::reverse(face.begin(), face.end());
  return face;
}

Component random_box(Choices& choices) {
  Component result;
  Cell low;
  Cell high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = choices.between(0, kVoxelWidth - 1);
    high[i] = choices.between(low[i] + 1, kVoxelWidth);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool positive : {false, true}) result.faces.push_back(side_of(low, high, axis, positive));
  }
  result.holds.resize(kCells);
  for (int i = 0; i < kCells; ++i) {
    const Cell c = cell_at(i);
    result.holds[static_cast<std::size_t>(i)] =
        c[0] >= low[0] && c[0] < high[0] && c[1] >= low[1] && c[1] < high[1] && c[2] >= low[2] && c[2] < high[2];
  }
  return result;
}

Component random_voxels(Choices& choices) {
  Component result;
  result.holds.resize(kCells);
  const std::uint32_t density = 2 + choices.below(5);
  for (int i = 0; i < kCells; ++i) result.holds[static_cast<std::size_t>(i)] = choices.one_in(density);
  const auto holds = [&](const Cell& c) {
    for (const int x : c) {
      if (x < 0 || x >= kVoxelWidth) return false;
    }
    const int place = c[0] + kVoxelWidth * (c[1] + kVoxelWidth * c[2]);
    return static_cast<bool>(result.holds[static_cast<std::size_t>(place)]);
  };
  for (int i = 0; i < kCells; ++i) {
    const Cell c = cell_at(i);
    if (!holds(c)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Cell next = c;
        next[axis] += step;
        if (!holds(next)) result.faces.push_back(side_of(c, {c[0] + 1, c[1] + 1, c[2] + 1}, axis, step > 0));
      }
    }
  }
  return result;
}

// Six times the signed volume, with points in twelfths.
long volume(const std::array<std::array<long, 3>, 4>& p) {
  std::array<std::array<long, 3>, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = p[i + 1][k] - p[0][k];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}
std::array<std::array<long, 3>, 4> twelfths(const std::array<Cell, 4>& corners) {
  std::array<std::array<long, 3>, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i][k] = 12L * corners[i][k];
  }
  return result;
}

Component random_tetrahedron(Choices& choices) {
  Component result;
  result.is_tetrahedron = true;
  for (Cell& corner : result.tetrahedron) {
    for (int& x : corner) x = choices.between(0, kVoxelWidth);
  }
  std::array<Cell, 4>& t = result.tetrahedron;
  const long v = volume(twelfths(t));
  if (v == 0) return random_box(choices);
  if (v < 0) std::swap(t[0], t[1]);
  result.faces = {{t[0], t[2], t[1]}, {t[0], t[1], t[3]}, {t[1], t[2], t[3]}, {t[2], t[0], t[3]}};
  return result;
}

// A general point of each cell: no plane through grid points of a tetrahedron is likely to hold it, and if one does,
// the point is skipped.
std::array<long, 3> sample(const Cell& c) { return {12L * c[0] + 5, 12L * c[1] + 7, 12L * c[2] + 4}; }

// 1: inside, 0: outside, -1: on the surface.
int inside(const std::array<Cell, 4>& tetrahedron, const std::array<long, 3>& p) {
  int result = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<std::array<long, 3>, 4> replaced = twelfths(tetrahedron);
    replaced[i] = p;
    const long v = volume(replaced);
    if (v == 0) return -1;
    if (v < 0) result = 0;
  }
  return result;
}

class MeshCase {
 public:
  explicit MeshCase(const Case& the_case) : case_(the_case) {}

  void run() {
    Choices& choices = case_.choices();
    for (std::uint32_t i = 1 + choices.below(3); i > 0; --i) add_component();
    wind();
    stretch();
    make_mesh();
    tell_mesh();
    const std::uint32_t damage = choices.below(6);
    if (mesh_.face_count() > 0 && damage == 5) return check_damaged();
    check();
  }

 private:
  void add_component() {
    Choices& choices = case_.choices();
    const std::uint32_t kind = choices.below(5);
    components_.push_back(kind < 2   ? random_box(choices)
                          : kind < 4 ? random_voxels(choices)
                                     : random_tetrahedron(choices));
    components_.back().inward = choices.one_in(3);
    if (components_.back().is_tetrahedron) only_cells_ = false;
  }

  void wind() {
    winding_.assign(kCells, 0);
    unknown_.assign(kCells, false);
    for (const Component& component : components_) {
      for (int i = 0; i < kCells; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const int in = component.is_tetrahedron ? inside(component.tetrahedron, sample(cell_at(i)))
                                                : static_cast<int>(component.holds[at]);
        if (in < 0) unknown_[at] = true;
        if (in > 0) winding_[at] += component.inward ? -1 : 1;
      }
    }
  }

  // Uneven distances between the grid's planes, in sixths.
  void stretch() {
    Choices& choices = case_.choices();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rational at = 0;
      for (int i = 0; i <= kVoxelWidth; ++i) {
        places_[axis].push_back(at);
        at += only_cells_ ? Rational(6 + choices.below(3) * 4, 6) : Rational(1);
      }
      for (Rational& x : places_[axis]) x.canonicalize();
    }
    if (choices.one_in(3)) shear_ = Rational(1, 3);
  }

  [[nodiscard]] Rational3 placed(const Rational3& p) const {
    return {Rational(p[0] + shear_ * p[1]), Rational(p[1] - shear_ * p[2]), p[2]};
  }
  [[nodiscard]] Rational3 corner(const Cell& c) const {
    return placed({places_[0][static_cast<std::size_t>(c[0])], places_[1][static_cast<std::size_t>(c[1])],
                   places_[2][static_cast<std::size_t>(c[2])]});
  }
  // The sample of a cell where the suite sees it.
  [[nodiscard]] Rational3 sample_point(const Cell& c) const {
    const std::array<long, 3> p = sample(c);
    Rational3 result;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(c[k]);
      result[k] = places_[k][i] + (places_[k][i + 1] - places_[k][i]) * Rational(p[k] - 12L * c[k]) / 12;
    }
    return placed(result);
  }

  void make_mesh() {
    Choices& choices = case_.choices();
    const bool shared = choices.below(3) != 2;  // one vertex for equal coordinates, or one for each corner
    const bool triangles = choices.below(2) == 1;
    std::map<Cell, std::uint32_t> numbers;
    const auto number = [&](const Cell& c) {
      const auto [at, added] = numbers.try_emplace(c, static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (!added && shared) return at->second;
      mesh_.vertices.push_back(corner(c));
      return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    };
    for (const Component& component : components_) {
      for (std::vector<Cell> face : component.faces) {
        if (component.inward) std::reverse(face.begin(), face.end());
        std::vector<std::uint32_t> corners;
        for (const Cell& c : face) corners.push_back(number(c));
        if (triangles && corners.size() == 4) {
          if (choices.below(2) == 1) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
          mesh_.push_face(std::vector{corners[0], corners[1], corners[2]});
          mesh_.push_face(std::vector{corners[0], corners[2], corners[3]});
        } else {
          mesh_.push_face(corners);
        }
        note_squares(face);
      }
    }
  }

  // Faces overlap iff they have a unit square of the grid in common.
  void note_squares(const std::vector<Cell>& face) {
    Cell low = face[0];
    Cell high = face[0];
    for (const Cell& c : face) {
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (low[axis] != high[axis]) continue;
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (int i = low[u]; i < high[u]; ++i) {
        for (int k = low[v]; k < high[v]; ++k) {
          overlap_ = !squares_.insert({static_cast<int>(axis), low[axis], i, k}).second || overlap_;
        }
      }
    }
  }

  void tell_mesh() const {
    MeshWriteOptions options;
    options.exact = true;
    case_.tell("the mesh as OFF:");
    case_.tell(off_bytes(mesh_, options));
  }

  [[nodiscard]] MeshOptions options() const {
    return MeshOptions{.monitor = Monitor().on_threads(1 + case_.choices().below(2))};
  }

  // A face left out or turned: every edge of it is run through once too often or too seldom.
  void check_damaged() {
    Choices& choices = case_.choices();
    const std::uint32_t victim = choices.below(static_cast<std::uint32_t>(mesh_.face_count()));
    const bool turned = choices.below(2) == 1;
    Mesh damaged;
    damaged.vertices = mesh_.vertices;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      std::vector<std::uint32_t> face(mesh_.face(f).begin(), mesh_.face(f).end());
      if (f == victim && turned) std::reverse(face.begin(), face.end());
      if (f != victim || turned) damaged.push_face(face);
    }
    if (damaged.face_count() == 0) return;
    case_.tell("without face " + std::to_string(victim) + (turned ? ", but with it turned" : ""));
    case_.count("damaged meshes");
    try {
      static_cast<void>(from_mesh(damaged, options()));
    } catch (const Error&) {
      return;
    }
    Case::require(false, "damaged: a mesh with a face left out or turned is accepted");
  }

  void check() {
    const int least = *std::min_element(winding_.begin(), winding_.end());
    const int most = *std::max_element(winding_.begin(), winding_.end());
    const bool consistent = most - least <= 1 && most <= 1 && least >= -1;
    if (mesh_.face_count() == 0) return;
    for (const MeshProblem& problem : check_mesh(mesh_)) {
      Case::require(problem.text.find('\n') == std::string::npos, "message: of several lines");
    }
    Polyhedron set;
    try {
      set = from_mesh(mesh_, options());
    } catch (const Error& error) {
      case_.count("refused");
      const bool legal = consistent && only_cells_ && !overlap_;
      Case::require(!legal, std::string("refused: a legal mesh: ") + error.what());
      return;
    }
    case_.count("accepted");
    set = case_.valid(set, "from_mesh");
    Case::require(consistent, "contradiction: a mesh with winding numbers from " + std::to_string(least) + " to " +
                                  std::to_string(most) + " is accepted");
    compare(set);
  }

  void compare(const Polyhedron& set) {
    std::vector<Polyhedron> cubes;
    for (int i = 0; i < kCells; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Cell c = cell_at(i);
      if (unknown_[at]) continue;
      Case::require(contains(set, sample_point(c)) == (winding_[at] != 0),
                    "membership: of a point of cell " + std::to_string(c[0]) + "," + std::to_string(c[1]) + "," +
                        std::to_string(c[2]));
      if (winding_[at] == 0 || !only_cells_) continue;
      std::vector<Rational3> corners;
      for (int k = 0; k < 8; ++k) corners.push_back(corner({c[0] + k % 2, c[1] + k / 2 % 2, c[2] + k / 4}));
      cubes.push_back(convex_hull(corners));
    }
    if (only_cells_) Case::require(equal(set, unite_all(cubes)), "equality: with the union of the cells");
    case_.count("points", kCells);
    round_trip(set);
  }

  void round_trip(const Polyhedron& set) {
    if (set.is_empty()) return;
    MeshWriteOptions options;
    options.exact = true;
    const Mesh again = read_off(off_bytes(to_mesh(set).mesh, options), "text");
    Case::require(equal(case_.valid(from_mesh(again), "from_mesh of to_mesh"), set),
                  "round trip: through a mesh gives another set");
    case_.count("round trips");
  }

  const Case& case_;
  std::vector<Component> components_;
  std::vector<int> winding_;
  std::vector<bool> unknown_;
  std::array<std::vector<Rational>, 3> places_;
  Rational shear_ = 0;
  Mesh mesh_;
  std::set<std::array<int, 4>> squares_;
  bool overlap_ = false;
  bool only_cells_ = true;
};

}  // namespace

void fuzz_voxels(const Case& the_case) { MeshCase(the_case).run(); }

}  // namespace nef::fuzz
