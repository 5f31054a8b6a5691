// SPDX-License-Identifier: Apache-2.0
//
// Soups of closed surfaces that cross, overlap, double and undo each other, and what the rules for crossings make of
// them, against winding numbers in fractions: the faces of a closed mesh and any apex span tetrahedra, and a point is
// wound around by the sum of the signs of those that hold it. The sum of winding number times volume has to be the
// signed volume of the faces.
#include <algorithm>
#include <map>

#include "fuzz/fuzzer.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"
#include "nef/import/resolve_mesh.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/native/native_binary.h"

namespace nef::fuzz {
namespace {

using FaceRing = std::vector<std::uint32_t>;

// Six times the signed volume of a, b, c, d.
Rational volume6(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
  return dot(minus(a, d), cross(minus(b, d), minus(c, d)));
}

class Soup {
 public:
  explicit Soup(Choices& choices) : choices_(choices) {}

  Mesh make() {
    size_ = 1 + choices_.below(4);
    for (std::uint32_t parts = 1 + choices_.below(5); parts > 0; --parts) add_part();
    if (choices_.one_in(3)) share_vertices();
    if (choices_.one_in(3)) shear();
    Mesh mesh;
    mesh.vertices = vertices_;
    for (const FaceRing& ring : rings_) mesh.push_face(ring);
    return mesh;
  }

 private:
  Rational3 on_grid() {
    const int last = static_cast<int>(size_);
    return {choices_.between(0, last), choices_.between(0, last), choices_.between(0, last)};
  }

  void add_part() {
    const std::size_t first = rings_.size();
    switch (choices_.below(6)) {
      case 0:
        add_box();
        break;
      case 1:
      case 2:
        add_tetrahedron(on_grid(), on_grid(), on_grid(), on_grid());  // flat ones are folds
        break;
      case 3:
        add_slit();
        break;
      case 4:
        add_pyramid();
        break;
      default:
        copy_some();
    }
    if (!choices_.one_in(4)) return;
    for (std::size_t f = first; f < rings_.size(); ++f) std::reverse(rings_[f].begin(), rings_[f].end());
  }

  std::uint32_t push(const Rational3& p) {
    vertices_.push_back(p);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  void add_box() {
    const Rational3 low = on_grid();
    Rational3 high;
    for (std::size_t i = 0; i < 3; ++i) high[i] = low[i] + 1 + choices_.below(size_);
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    for (unsigned i = 0; i < 8; ++i) {
      push({(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1], (i & 4U) != 0 ? high[2] : low[2]});
    }
    for (const FaceRing& side :
         {FaceRing{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
      rings_.push_back({v + side[0], v + side[1], v + side[2], v + side[3]});
    }
  }

  void add_tetrahedron(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
    const std::uint32_t v = push(a);
    push(b), push(c), push(d);
    rings_.insert(rings_.end(), {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v, v + 3, v + 2}, {v + 1, v + 2, v + 3}});
    const bool inward = volume6(b, c, d, a) < 0;
    for (std::size_t f = rings_.size() - 4; inward && f < rings_.size(); ++f) {
      std::reverse(rings_[f].begin(), rings_[f].end());
    }
  }

  void add_slit() {
    FaceRing ring;
    for (int i = 0; i < 3; ++i) ring.push_back(push(on_grid()));
    rings_.push_back(ring);
    std::reverse(ring.begin(), ring.end());
    rings_.push_back(ring);
  }

  // Over a planar polygon that may cross itself or come to a point twice.
  void add_pyramid() {
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    const std::uint32_t n = 3 + choices_.below(4);
    FaceRing base;
    for (std::uint32_t i = 0; i < n; ++i) {
      Rational3 p = on_grid();
      p[2] = 0;
      base.insert(base.begin(), push(p));
    }
    const std::uint32_t apex = push({choices_.between(0, 2), choices_.between(0, 2), 1 + choices_.below(size_)});
    for (std::uint32_t i = 0; i < n; ++i) rings_.push_back({v + i, v + (i + 1) % n, apex});
    rings_.push_back(base);
  }

  // All that is there so far, again.
  void copy_some() {
    if (rings_.empty()) return add_box();
    const std::vector<FaceRing> again = rings_;
    if (again.size() < 40) rings_.insert(rings_.end(), again.begin(), again.end());
  }

  // Vertices at equal places get one number.
  void share_vertices() {
    std::map<Rational3, std::uint32_t> first;
    for (FaceRing& ring : rings_) {
      for (std::uint32_t& v : ring) v = first.emplace(vertices_[v], v).first->second;
    }
  }

  // Small integers no more.
  void shear() {
    for (Rational3& v : vertices_) v = {(v[0] + v[2] / 7) / 3, v[1] + v[0] / 11, v[2]};
  }

  Choices& choices_;
  std::uint32_t size_ = 1;
  std::vector<Rational3> vertices_;
  std::vector<FaceRing> rings_;
};

class CrossingsCase {
 public:
  CrossingsCase(const Case& the_case, const Mesh& mesh) : case_(the_case), mesh_(mesh) {
    for_each_triangle(
        [this](const Rational3& a, const Rational3& b, const Rational3& c) { volume_ += dot(a, cross(b, c)) / 6; });
  }

  void run() const {
    const Crossings rule = case_.choices().element(std::array{Crossings::kUnion, Crossings::kNonzero, Crossings::kOdd});
    case_.tell(std::string("crossings: ") + name(rule));
    case_.count(name(rule));
    ResolvedMesh made;
    try {
      made = resolve_mesh(mesh_, {.crossings = rule});
    } catch (const InputError& error) {
      const std::string why = error.what();
      // Faces of two corners at one place are no faces.
      if (why.find("enclose nothing") == std::string::npos) return case_.count("refused");
      case_.count("nothing");
      return check_points(rule, Polyhedron());
    }
    const Polyhedron set = case_.valid(made.set, "resolve_mesh");
    Case::require(set.is_regular(), "regular: the solid is not");
    Case::require(native_binary(from_mesh(mesh_, {.crossings = rule, .threads = 2})) == native_binary(set),
                  "threads: another solid on two");
    check_volumes(rule, made);
    check_points(rule, set);
  }

 private:
  template <typename Visit>
  void for_each_triangle(Visit visit) const {
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto ring = mesh_.face(f);
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        visit(mesh_.vertices[ring[0]], mesh_.vertices[ring[i]], mesh_.vertices[ring[i + 1]]);
      }
    }
  }

  static bool takes(Crossings rule, int winding) {
    return rule == Crossings::kUnion ? winding > 0 : rule == Crossings::kOdd ? winding % 2 != 0 : winding != 0;
  }

  void check_volumes(Crossings rule, const ResolvedMesh& made) const {
    Rational sum;
    Rational taken;
    for (const auto& [winding, entry] : made.volumes) {
      sum += winding * entry.volume;
      if (takes(rule, winding)) taken += entry.volume;
    }
    Case::require(volume(made.set) == taken, "volume: not that of the winding numbers taken");
    if (rule != Crossings::kOdd) Case::require(sum == abs(volume_), "volume: winding numbers do not add up");
  }

  void check_points(Crossings rule, const Polyhedron& set) const {
    for (int i = 0; i < 8; ++i) {
      const Rational3 p = sample();
      const std::optional<int> winding = winding_of(p);
      if (!winding) continue;
      case_.count("points");
      Case::require(contains(set, p) == takes(rule, volume_ < 0 ? -*winding : *winding),
                    "membership: of a point with winding number " + std::to_string(*winding));
    }
  }

  // Between three vertices of the mesh and a place off the grid.
  [[nodiscard]] Rational3 sample() const {
    Choices& choices = case_.choices();
    Rational3 sum{Rational(1, 1009), Rational(1, 1013), Rational(1, 1019)};
    for (const Rational& weight : {Rational(2, 5), Rational(3, 11), Rational(3, 13), Rational(69, 715)}) {
      const Rational3& v = mesh_.vertices[choices.below(static_cast<std::uint32_t>(mesh_.vertices.size()))];
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * v[k];
    }
    return sum;
  }

  // Nothing if the point or the apex lies in the plane of a triangle of the sum.
  [[nodiscard]] std::optional<int> winding_of(const Rational3& p) const {
    const Rational3 apex{Rational(-1000003, 7919), Rational(-998244353, 104729), Rational(-15485863, 1299709)};
    int sum = 0;
    bool generic = true;
    for_each_triangle([&](const Rational3& a, const Rational3& b, const Rational3& c) {
      const std::array<int, 4> sides{sgn(volume6(a, b, c, p)), sgn(volume6(b, a, apex, p)), sgn(volume6(c, b, apex, p)),
                                     sgn(volume6(a, c, apex, p))};
      const int least = *std::min_element(sides.begin(), sides.end());
      const int most = *std::max_element(sides.begin(), sides.end());
      if (least == most) sum += least;
      generic = generic && (least * most < 0 || std::count(sides.begin(), sides.end(), 0) == 0);
    });
    return generic ? std::optional(sum) : std::nullopt;
  }

  const Case& case_;
  const Mesh& mesh_;
  Rational volume_;  // with the sign of the faces
};

}  // namespace

void fuzz_crossings(const Case& the_case) {
  const Mesh mesh = Soup(the_case.choices()).make();
  MeshWriteOptions exact;
  exact.exact = true;
  the_case.tell("OFF:");
  the_case.tell(off_bytes(mesh, exact));
  CrossingsCase(the_case, mesh).run();
}

}  // namespace nef::fuzz
