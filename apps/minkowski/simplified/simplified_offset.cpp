// SPDX-License-Identifier: Apache-2.0
//
// If surfaces are within a distance of each other, simplifying an offset by a radius that is larger by more than that
// distance leaves a set around the offset by the radius itself, as a rule: parts may be lost or filled. So this is no
// proof, but a good guess, which is checked exactly.
#include "apps/minkowski/simplified/simplified_offset.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/remeshing/decimate.h"
#include "nef/base/error.h"
#include "nef/export/to_mesh.h"
#include "nef/number/floor.h"

namespace nef::minkowski {
namespace {

struct Simplified {
  Polyhedron set;
  double distance = 0;  // of the surfaces, about
  Messages notes;
};

void round_to(int digits, Mesh& mesh) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(digits));
  const Rational scale(power);
  for (Rational3& vertex : mesh.vertices) {
    for (Rational& x : vertex) x = Rational(floor_of(x * scale + Rational(1, 2))) / scale;
  }
}

Simplified simplified(const Polyhedron& set, const SimplifyOptions& wanted, const Monitor& monitor) {
  Simplified result;
  Mesh mesh;
  if (wanted.triangles) {
    DecimatedMesh made = decimate(set, *wanted.triangles, monitor);
    mesh = std::move(made.mesh);
    result.distance = made.distance.high;
    result.notes = std::move(made.notes);
  } else {
    MeshExport made = to_mesh(set, {}, monitor);
    if (made.mesh.face_count() == 0)
      throw InputError("the offset has no bounded solid part, so there is no mesh of it");
    mesh = std::move(made.mesh);
    result.notes = std::move(made.lost);
  }
  if (wanted.digits) {
    round_to(*wanted.digits, mesh);
    result.distance += std::sqrt(3.0) / 2 * std::pow(10.0, -*wanted.digits);
  }
  // Where rounded faces cross, what they enclose is the solid.
  result.set = from_mesh(mesh, {.crossings = Crossings::kUnion, .monitor = monitor}, &result.notes);
  return result;
}

// A short number that is a quarter larger or a little more.
Rational with_room(double distance) {
  int exponent = 0;
  const double fraction = std::frexp(1.25 * distance, &exponent);
  return exact_rational(std::ldexp(std::ceil(std::ldexp(fraction, 4)), exponent - 4));
}

bool is_within(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  return subtract(a, b, monitor).is_empty();
}

Rational error_of(const Rational& radius, int splits, Side side, const Monitor& monitor) {
  if (sgn(radius) == 0) return 0;
  return ball_approximation(abs(radius), splits, ball_side(sgn(radius), side), monitor).error;
}

}  // namespace

SimplifiedOffset simplified_offset(const Polyhedron& a, const Rational& radius, int splits, Side side,
                                   const SimplifyOptions& simplify, const MinkowskiOptions& options,
                                   MinkowskiReport* report) {
  if (!simplify.triangles && !simplify.digits) throw InputError("give a number of triangles, or of digits, or both");
  if (simplify.digits && (*simplify.digits < 0 || *simplify.digits > 300)) {
    throw InputError("coordinates have from 0 to 300 decimals, not " + std::to_string(*simplify.digits));
  }
  const Monitor& monitor = options.monitor;
  const auto by = [&](const Rational& r) { return offset(a, r, splits, side, options, report); };
  const Polyhedron near = by(radius);
  Simplified simple = simplified(near, simplify, monitor);
  if (simple.distance == 0) return {near, error_of(radius, splits, side, monitor), std::move(simple.notes)};
  Rational amount = with_room(simple.distance);
  const bool is_outer = side == Side::kOuter;
  const auto radius_beyond = [&](const Rational& more) -> Rational { return radius + (is_outer ? 1 : -1) * more; };
  const auto reaches_no_farther = [&](const Polyhedron& far) {
    return is_outer ? is_within(simple.set, far, monitor) : is_within(far, simple.set, monitor);
  };
  constexpr int kAttempts = 5;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    simple = simplified(by(radius_beyond(amount)), simplify, monitor);
    Rational most = 2 * amount;
    const bool holds_all = is_outer ? is_within(near, simple.set, monitor) : is_within(simple.set, near, monitor);
    if (holds_all && reaches_no_farther(by(radius_beyond(most)))) {
      // Collapsed edges often stay within half as much beyond what was simplified; rounding is small as it is.
      const Rational less = Rational(3, 2) * amount;
      if (simplify.triangles && reaches_no_farther(by(radius_beyond(less)))) most = less;
      return {std::move(simple.set), Rational(most + error_of(radius_beyond(most), splits, side, monitor)),
              std::move(simple.notes)};
    }
    amount = std::max(Rational(2 * amount), with_room(simple.distance));
  }
  throw InputError("no simplified offset with proven bounds was found: give more triangles or more digits");
}

}  // namespace nef::minkowski
