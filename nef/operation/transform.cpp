// SPDX-License-Identifier: Apache-2.0
//
// Exact affine maps. Planes and points are mapped, incidences stay; a reflection turns every
// sphere map inside out. The box of an unbounded set becomes a parallelepiped that no longer is
// the standard box: R, of which only "large enough" is known, is replaced by K R with K so large
// that the image contains the standard box, and the result is clipped to it.
#include "nef/base/error.h"
#include "nef/construct/solid.h"
#include "nef/polyhedron.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {
namespace {

// x -> (m x + t) / w in integers.
struct IntegerMap {
  std::array<Integer3, 3> m;
  Integer3 t;
  Integer w = 1;
  std::array<Integer3, 3> cofactor;
  Integer determinant;

  explicit IntegerMap(const AffineMap& map) {
    const auto include = [this](const Rational& value) {
      mpz_lcm(w.get_mpz_t(), w.get_mpz_t(), value.get_den_mpz_t());
    };
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) include(map.linear[i][j]);
      include(map.translation[i]);
    }
    const auto scale = [this](const Rational& value) { return Integer(value.get_num() * (w / value.get_den())); };
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = scale(map.linear[i][j]);
      t[i] = scale(map.translation[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const auto& r1 = m[(i + 1) % 3];
        const auto& r2 = m[(i + 2) % 3];
        cofactor[i][j] = r1[(j + 1) % 3] * r2[(j + 2) % 3] - r1[(j + 2) % 3] * r2[(j + 1) % 3];
      }
    }
    determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    if (determinant == 0) {
      throw InputError("the transformation is not invertible (its determinant is zero); use one that is");
    }
  }

  // n.x + d + e R = 0 becomes w (cof n).x' + (det d - (cof n).t) + det e R = 0, times sign(det) so
  // that positive sides stay positive.
  PlaneId map_plane(const PlaneTable& from, std::uint32_t row, const Integer& box_factor, PlaneTable& to) const {
    const PlaneId plane = PlaneId::of_row(row);
    Integer3 n;
    Integer d = determinant * from.oriented_coefficient(plane, 3);
    Integer e = determinant * from.oriented_coefficient(plane, 4) * box_factor;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) n[i] += cofactor[i][j] * from.oriented_coefficient(plane, j);
      d -= n[i] * t[i];
      n[i] *= w;
    }
    if (determinant < 0) return to.intern(-n[0], -n[1], -n[2], -d, -e);
    return to.intern(n[0], n[1], n[2], d, e);
  }

  void map_point(const PointTable& from, PointId point, const Integer& box_factor, PointTable& to) const {
    std::array<Integer, 7> h;
    std::array<Integer, 7> x;
    for (std::size_t i = 0; i < 7; ++i) mpz_set(x[i].get_mpz_t(), from.coordinate(point, i));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        h[i] += m[i][j] * x[j];
        h[4 + i] += m[i][j] * x[4 + j];
      }
      h[i] += t[i] * x[3];
      h[4 + i] *= box_factor;
    }
    h[3] = w * x[3];
    Integer divisor = h[3];
    for (const Integer& value : h) {
      if (divisor == 1) break;
      mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), value.get_mpz_t());
    }
    if (divisor != 1) {
      for (Integer& value : h) mpz_divexact(value.get_mpz_t(), value.get_mpz_t(), divisor.get_mpz_t());
    }
    to.push_homogeneous(h);
  }

  // A whole number greater than the largest row sum of |inverse|: then the image of the K-fold box
  // holds the box strictly, whatever the translation, which is finite.
  [[nodiscard]] Integer box_factor() const {
    Integer largest;
    for (std::size_t j = 0; j < 3; ++j) {
      Integer sum;
      for (std::size_t i = 0; i < 3; ++i) sum += abs(cofactor[i][j]);
      if (sum > largest) largest = sum;
    }
    const Integer magnitude = abs(determinant);
    return (largest * w) / magnitude + 2;
  }
};

// Sphere maps turned inside out. Their items keep their numbers.
PatternTable reflected(const PatternTable& patterns) {
  PatternTable result;
  SphereMapBuffer map;
  for (std::uint32_t i = 0; i < patterns.size(); ++i) {
    const SphereMapView old = patterns.view(PatternId{i});
    map.assign(old);
    for (SVertex& v : map.svertices) {
      // m (a x b) is det(m) times the cross product of the images of the normals.
      std::swap(v.p, v.q);
      if (v.out != kNone) v.out ^= 1U;
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      // The same arc with the same sface on the positive side of its plane runs the other way.
      map.shalfedges[e].source = old.target(e);
      std::swap(map.shalfedges[e].next, map.shalfedges[e].prev);
    }
    result.push(map);
  }
  return result;
}

// Planes, points and sphere maps. The orientation of a plane's row may change: a flipped image swaps the parity of
// every use.
Complex map_complex(const Complex& c, const IntegerMap& map, const Integer& box_factor) {
  Complex result;
  const bool reflect = map.determinant < 0;
  result.vertices = c.vertices;
  result.patterns = reflect ? reflected(c.patterns) : c.patterns;
  result.shalfedge_plane = c.shalfedge_plane;
  result.other_planes = c.other_planes;
  result.sloops = c.sloops;
  std::vector<PlaneId> image(c.planes.size());
  for (std::uint32_t row = 0; row < c.planes.size(); ++row) {
    image[row] = map.map_plane(c.planes, row, box_factor, result.planes);
  }
  for (const VertexId v : c.vertex_ids()) map.map_point(c.points, point_of(v), box_factor, result.points);
  for_each_plane_of(result, [&image](PlaneId& plane) {
    const PlaneId to = image[plane.row()];
    plane = plane.flipped() ? to.opposite() : to;
  });
  return result;
}

// A translation keeps normals, up to a factor that clears denominators, sphere maps and links: only offsets and points
// are new. Scratch numbers keep their limbs from row to row.
class Translation {
 public:
  explicit Translation(const IntegerMap& map) : t_(map.t), w_(map.w) {}

  static bool is_one(const IntegerMap& map) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (map.m[i][j] != (i == j ? map.w : Integer(0))) return false;
      }
    }
    return true;
  }

  Complex operator()(const Complex& c) {
    Complex result = c;
    result.planes = PlaneTable();
    result.planes.reserve(c.planes.size());
    for (std::uint32_t row = 0; row < c.planes.size(); ++row) move_plane(c.planes, row, result.planes);
    result.planes.trim();
    result.points = PointTable();
    result.points.reserve(c.points.size());
    for (const VertexId v : c.vertex_ids()) move_point(c.points, point_of(v), result.points);
    return result;
  }

 private:
  // n.x + d = 0 becomes w n.x + (w d - n.t) = 0.
  void move_plane(const PlaneTable& from, std::uint32_t row, PlaneTable& to) {
    const PlaneId plane = PlaneId::of_row(row);
    NEF_ASSERT(!from.infimaximal(plane));
    mpz_mul(new_[3].get_mpz_t(), from.coefficient(plane, 3), w_.get_mpz_t());
    mpz_set_ui(divisor_.get_mpz_t(), 0);
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_submul(new_[3].get_mpz_t(), from.coefficient(plane, i), t_[i].get_mpz_t());
      mpz_gcd(divisor_.get_mpz_t(), divisor_.get_mpz_t(), from.coefficient(plane, i));
      mpz_mul(new_[i].get_mpz_t(), from.coefficient(plane, i), w_.get_mpz_t());
    }
    mpz_mul(divisor_.get_mpz_t(), divisor_.get_mpz_t(), w_.get_mpz_t());
    mpz_gcd(divisor_.get_mpz_t(), divisor_.get_mpz_t(), new_[3].get_mpz_t());
    if (divisor_ != 1) divide();
    const PlaneId moved =
        to.intern_primitive({new_[0].get_mpz_t(), new_[1].get_mpz_t(), new_[2].get_mpz_t(), new_[3].get_mpz_t()});
    NEF_ASSERT(moved == plane);
  }

  void move_point(const PointTable& from, PointId point, PointTable& to) {
    NEF_ASSERT(from.finite(point));
    const IntegerView unit = from.coordinate(point, 3);
    mpz_mul(new_[3].get_mpz_t(), unit, w_.get_mpz_t());
    mpz_set(divisor_.get_mpz_t(), new_[3].get_mpz_t());
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_mul(new_[i].get_mpz_t(), from.coordinate(point, i), w_.get_mpz_t());
      mpz_addmul(new_[i].get_mpz_t(), t_[i].get_mpz_t(), unit);
      if (divisor_ != 1) mpz_gcd(divisor_.get_mpz_t(), divisor_.get_mpz_t(), new_[i].get_mpz_t());
    }
    if (divisor_ != 1) divide();
    to.push_homogeneous(new_);
  }

  // All four by their common divisor.
  void divide() {
    for (std::size_t i = 0; i < 4; ++i) {
      mpz_divexact(new_[i].get_mpz_t(), new_[i].get_mpz_t(), divisor_.get_mpz_t());
    }
  }

  const Integer3& t_;
  const Integer& w_;
  std::array<Integer, 7> new_;
  Integer divisor_;
};

Complex synthesized(Complex&& image, LabelId outer, const Monitor& monitor) {
  PlaneTable planes = std::move(image.planes);
  ComplexBuilder builder(planes, monitor);
  builder.take_vertices(std::move(image));
  return builder.finish(outer);
}

}  // namespace

Polyhedron transform(const Polyhedron& a, const AffineMap& map, const Monitor& monitor) {
  const IntegerMap exact(map);
  const Complex& c = a.complex();
  if (!c.has_box() && Translation::is_one(exact)) return Polyhedron(Translation(exact)(c));
  if (!c.has_box()) return Polyhedron(synthesized(map_complex(c, exact, 1), c.volumes[kOuterVolume].mark, monitor));
  return Polyhedron(
      clip_to_infimaximal_box(synthesized(map_complex(c, exact, exact.box_factor()), kOutside, monitor), monitor));
}

}  // namespace nef
