// SPDX-License-Identifier: Apache-2.0
#include "fuzz/fuzzers/meshes/soups.h"

#include <algorithm>
#include <array>
#include <map>

#include "nef/geometry/vectors.h"

namespace nef::fuzz {
namespace {

using FaceRing = std::vector<std::uint32_t>;

// Six times the signed volume of a, b, c, d.
Rational volume6(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
  return dot(minus(a, d), cross(minus(b, d), minus(c, d)));
}

class Soup {
 public:
  Soup(Choices& choices, SoupParts parts) : choices_(choices), parts_(parts) {}

  Mesh make() {
    size_ = 1 + choices_.below(4);
    for (std::uint32_t parts = 1 + choices_.below(5); parts > 0; --parts) add_part();
    if (choices_.one_in(3)) share_vertices();
    if (choices_.one_in(3)) shear();
    if (choices_.one_in(3)) round();
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
    if (parts_ == SoupParts::kSolid) return add_solid();
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

  void add_solid() {
    if (choices_.one_in(2)) return add_box();
    std::array<Rational3, 4> corners;
    for (Rational3& corner : corners) corner = on_grid();
    if (volume6(corners[0], corners[1], corners[2], corners[3]) == 0) return add_box();
    add_tetrahedron(corners[0], corners[1], corners[2], corners[3]);
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

  // Turned by a map that keeps no grid, then to multiples of 1/64, as a file in few digits would have it. Faces become
  // triangles first: a square bends.
  void round() {
    std::vector<FaceRing> triangles;
    for (const FaceRing& ring : rings_) {
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) triangles.push_back({ring[0], ring[i], ring[i + 1]});
    }
    rings_ = std::move(triangles);
    const Rational turn(choices_.between(1, 9), 17);
    for (Rational3& v : vertices_) {
      const Rational3 turned{v[0] - turn * v[1], v[1] + turn * v[0], v[2] + v[0] / 5};
      for (std::size_t i = 0; i < 3; ++i) v[i] = rounded(turned[i]);
    }
  }

  static Rational rounded(const Rational& x) {
    const Rational scaled = 64 * x + Rational(1, 2);
    Integer below;
    mpz_fdiv_q(below.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
    return Rational(below) / 64;
  }

  Choices& choices_;
  SoupParts parts_;
  std::uint32_t size_ = 1;
  std::vector<Rational3> vertices_;
  std::vector<FaceRing> rings_;
};

}  // namespace

Mesh random_soup(Choices& choices, SoupParts parts) { return Soup(choices, parts).make(); }

FaceWindings::FaceWindings(const Mesh& mesh) : mesh_(mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto ring = mesh.face(f);
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const Rational3& a = mesh.vertices[ring[0]];
      const Rational3& b = mesh.vertices[ring[i]];
      const Rational3& c = mesh.vertices[ring[i + 1]];
      if (is_zero(cross(minus(b, a), minus(c, a)))) continue;
      triangles_.push_back({ring[0], ring[i], ring[i + 1]});
      volume_ += dot(a, cross(b, c)) / 6;
    }
  }
}

std::optional<int> FaceWindings::around(const Rational3& p) const {
  const Rational3 apex{Rational(-1000003, 7919), Rational(-998244353, 104729), Rational(-15485863, 1299709)};
  int sum = 0;
  for (const auto& t : triangles_) {
    const Rational3& a = mesh_.vertices[t[0]];
    const Rational3& b = mesh_.vertices[t[1]];
    const Rational3& c = mesh_.vertices[t[2]];
    const std::array<int, 4> sides{sgn(volume6(a, b, c, p)), sgn(volume6(b, a, apex, p)), sgn(volume6(c, b, apex, p)),
                                   sgn(volume6(a, c, apex, p))};
    const int least = *std::min_element(sides.begin(), sides.end());
    const int most = *std::max_element(sides.begin(), sides.end());
    if (least == most) sum += least;
    if (least * most >= 0 && std::count(sides.begin(), sides.end(), 0) > 0) return std::nullopt;
  }
  return sum;
}

Rational3 FaceWindings::sample(Choices& choices) const {
  Rational3 sum{Rational(1, 1009), Rational(1, 1013), Rational(1, 1019)};
  for (const Rational& weight : {Rational(2, 5), Rational(3, 11), Rational(3, 13), Rational(69, 715)}) {
    const Rational3& v = mesh_.vertices[choices.below(static_cast<std::uint32_t>(mesh_.vertices.size()))];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * v[k];
  }
  return sum;
}

}  // namespace nef::fuzz
