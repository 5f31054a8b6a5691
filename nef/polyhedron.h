// SPDX-License-Identifier: Apache-2.0
//
// The value type of the library: a Nef polyhedron, i.e. any set made from half-spaces by
// intersection and complement. Open or closed, bounded or not, of mixed dimension, non-manifold:
// nothing is excluded and nothing is rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"
#include "nef/number/number.h"

namespace nef {

class QueryStructure;

/// An exact point set. Copies share one immutable complex, so copying is O(1). One that was moved from is the empty
/// set. A const Polyhedron may be read from several threads at once.
class Polyhedron {
 public:
  /// The empty set.
  Polyhedron();
  /// All of space.
  static Polyhedron everything();
  /// Takes over a synthesized complex.
  explicit Polyhedron(Complex&& complex);

  /// What a step of a loop does with one set after the other.
  enum class Step : std::uint8_t { kUnite, kSubtract };

  /// unite(a, b) or subtract(a, b) for a loop that adds small sets to a large one or takes them away: the result waits
  /// until somebody looks at it, and is computed then together with the steps before it that wait. n such steps cost
  /// about as much as one with the union of the n small sets, instead of n copies of a; their items may be numbered in
  /// another order. Nothing, if the step is better computed at once: b has more than an eighth of a's vertices, or
  /// those of all that waits would be more than a has. O(1) if both are computed.
  static std::optional<Polyhedron> waiting(Step kind, const Polyhedron& a, const Polyhedron& b);

  /// True if steps wait. Any look at the set computes them, on the thread that looks.
  [[nodiscard]] bool waits() const;
  /// Computes them on the threads of `monitor`, which may stop it: then they wait as before.
  void compute(const Monitor& monitor) const;

  [[nodiscard]] const Complex& complex() const;
  /// The complex out of a set that is given up: moved if no other set shares it, else copied.
  [[nodiscard]] Complex take_complex() &&;

  /// The representation is unique, so these are O(1). The set is that of the points whose mark is not 0; if some have
  /// others than 1, is_everything may cost as a Boolean.
  [[nodiscard]] bool is_empty() const;
  [[nodiscard]] bool is_everything() const;
  /// True if the set (not its complement) fits into some ball.
  [[nodiscard]] bool is_bounded() const;
  /// O(number of items).
  [[nodiscard]] bool is_open() const;
  [[nodiscard]] bool is_closed() const;
  /// True if the set is the closure of its interior.
  [[nodiscard]] bool is_regular() const;

  /// The structure for point location and ray shooting; built at the first call, thread-safe.
  [[nodiscard]] const QueryStructure& queries() const;

 private:
  struct Body;
  class WaitingStep;

  explicit Polyhedron(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  [[nodiscard]] const std::shared_ptr<const Body>& body(const Monitor& monitor = {}) const;

  std::shared_ptr<const Body> body_;  // null for the empty set, and while steps wait
  std::shared_ptr<const WaitingStep> step_;
};

// Boolean operations (thesis chapter 5): exact, total, O((n + k) log n) for n items and k
// crossings on well-shaped input. On the threads of `monitor` where the sets are large
// enough to gain by it; the result is the same, item for item, for any number of them. What may take long is given a
// monitor: who stops it, is told how far it has come, and counts its predicates.
Polyhedron unite(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
Polyhedron intersect(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
Polyhedron subtract(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});
Polyhedron symmetric_difference(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});

/// The union (intersection) of any number of sets: nothing (everything) for none. Pairs of sets are
/// combined smallest first on the threads of `monitor`.
Polyhedron unite_all(std::span<const Polyhedron> sets, const Monitor& monitor = {});
Polyhedron intersect_all(std::span<const Polyhedron> sets, const Monitor& monitor = {});

/// A \ B etc. for marks of any kind: the result is marked f(mark in a, mark in b) everywhere.
/// f is asked once for each pair of labels that occur, maybe for others; InputError if it gives kOutside.
/// With several threads f is called by any of them, one at a time.
Polyhedron overlay(const Polyhedron& a, const Polyhedron& b, const std::function<LabelId(LabelId, LabelId)>& f,
                   const Monitor& monitor = {});

/// The points whose mark is not 0, with the marks 0 and 1. O(1) if there are no other marks, else as a Boolean. This is
/// the set that all operations mean, whatever the marks; only `overlay`, `transform`, `split` and `component_of` keep
/// them, and questions about items (`locate`, `counts`, `surface_area`) are about the complex as it is.
Polyhedron without_labels(const Polyhedron& a, const Monitor& monitor = {});

// Unary operations: O(n).
Polyhedron complement(const Polyhedron& a);
Polyhedron interior(const Polyhedron& a, const Monitor& monitor = {});
Polyhedron closure(const Polyhedron& a, const Monitor& monitor = {});
Polyhedron boundary(const Polyhedron& a, const Monitor& monitor = {});
/// The interior of the complement.
Polyhedron exterior(const Polyhedron& a, const Monitor& monitor = {});
/// The closure of the interior.
Polyhedron regularize(const Polyhedron& a, const Monitor& monitor = {});

/// True if the two are the same set.
bool equal(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor = {});

/// An affine map x -> m x + t with rational entries.
struct AffineMap {
  std::array<Rational3, 3> linear;
  Rational3 translation;

  static AffineMap identity();
  static AffineMap translate(const Rational3& by);
  static AffineMap scale(const Rational3& factors);
  /// A rotation about an axis through the origin by an angle within `tolerance` degrees of the
  /// given one, exactly orthogonal with rational entries. The axis must be one whose length is
  /// rational (a coordinate axis, (1,2,2), ...); otherwise it is approximated likewise.
  static AffineMap rotate(const Rational3& axis, double degrees, double tolerance = 1e-9);
  [[nodiscard]] Rational determinant() const;
  [[nodiscard]] Rational3 operator()(const Rational3& p) const;
  /// First `first`, then this.
  [[nodiscard]] AffineMap after(const AffineMap& first) const;
};

/// The image under an invertible map. Throws InputError if the determinant is zero. O(n) for
/// bounded sets; unbounded ones are clipped to their box anew, by one Boolean operation.
Polyhedron transform(const Polyhedron& a, const AffineMap& map, const Monitor& monitor = {});

/// What holds a point.
struct Location : ItemRef {  // never none
  Location() : ItemRef(kOuterVolume) {}
  Location(ItemRef item, LabelId label) : ItemRef(item), mark(label) {}

  LabelId mark = 0;
};

/// Exact point location. O(log n) expected after the structure is built.
Location locate(const Polyhedron& a, const Rational3& point, const Monitor& monitor = {});
bool contains(const Polyhedron& a, const Rational3& point, const Monitor& monitor = {});

/// The local pyramid of the set at any point of space, in the planes of a.complex().
SphereMapBuffer local_pyramid(const Polyhedron& a, const Rational3& point, const Monitor& monitor = {});

/// What an open ray meets first. `location` never is a volume.
struct RayHit {
  Location location;
  Rational3 point;
};
/// The first vertex, edge or facet on the ray from `origin` (excluded) in `direction` (not zero)
/// that `accept` takes; all are if it is empty.
std::optional<RayHit> shoot_ray(const Polyhedron& a, const Rational3& origin, const Rational3& direction,
                                const std::function<bool(const Location&)>& accept = {}, const Monitor& monitor = {});

/// Volume of the set, if finite.
std::optional<Rational> volume(const Polyhedron& a);
/// Area of the facets of the set's boundary (each facet once), in double precision; infinite for
/// unbounded facets.
double surface_area(const Polyhedron& a);
/// Smallest and largest coordinates of the vertices; nothing for a set without finite vertices.
/// The box of infimaximal vertices is ignored.
std::optional<std::array<Rational3, 2>> bounding_box(const Polyhedron& a, const Monitor& monitor = {});
/// V - E + F of each shell, in the order of complex().shells (a facet with h holes and i
/// isolated vertices counts 1 - h - i).
std::vector<long> euler_numbers(const Polyhedron& a);

/// Checks every invariant of the complex. Returns the name of the first broken one with the
/// guilty items, or an empty string.
std::string validate(const Complex& complex, const Monitor& monitor = {});

/// Vertices, edges, facets, volumes, shells without the items of an infimaximal box (as CGAL
/// counts: each edge and facet once, the outer volume included).
struct Counts {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t facets = 0;
  std::size_t volumes = 0;
  std::size_t shells = 0;
};
Counts counts(const Polyhedron& a);

}  // namespace nef
