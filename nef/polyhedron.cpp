// SPDX-License-Identifier: Apache-2.0
#include "nef/polyhedron.h"

#include <atomic>
#include <mutex>
#include <utility>

#include "nef/complex/predicates_of_sets.h"
#include "nef/location/query_structure.h"
#include "nef/synthesis/complex_builder.h"

namespace nef {

namespace {

Complex constant(LabelId mark) {
  PlaneTable none;
  return ComplexBuilder(none, {}).finish(mark);
}

}  // namespace

struct Polyhedron::Body {
  explicit Body(Complex&& from) : complex(std::move(from)) {}

  Complex complex;
  // Built when first asked for; call_once makes that safe for readers in several threads.
  mutable std::once_flag once;
  mutable std::unique_ptr<const QueryStructure> queries;

  // The empty set has none, so that making one, or moving from a set, costs nothing.
  static const Body& of(const std::shared_ptr<const Body>& body) {
    if (body) return *body;
    static const Body empty(constant(0));
    return empty;
  }
};

Polyhedron::Polyhedron() = default;

Polyhedron Polyhedron::everything() { return Polyhedron(constant(1)); }

Polyhedron::Polyhedron(Complex&& complex) : body_(std::make_shared<Body>(std::move(complex))) {}

Complex Polyhedron::take_complex() && {
  const std::shared_ptr<const Body> body = std::exchange(body_, nullptr);
  // Bodies are made as what may change, and nobody else sees one that is held once.
  if (body.use_count() != 1) return Body::of(body).complex;
  std::atomic_thread_fence(std::memory_order_acquire);  // after what the last other holder did
  return std::move(const_cast<Body&>(*body).complex);
}

const Complex& Polyhedron::complex() const { return Body::of(body_).complex; }

bool Polyhedron::is_empty() const { return complex().vertex_count() == 0 && complex().volumes[kOuterVolume].mark == 0; }

bool Polyhedron::is_everything() const {
  return complex().vertex_count() == 0 && complex().volumes[kOuterVolume].mark == 1;
}

bool Polyhedron::is_bounded() const { return complex().volumes[kOuterVolume].mark == 0; }

bool Polyhedron::is_open() const { return is_open_set(complex()); }

bool Polyhedron::is_closed() const { return is_closed_set(complex()); }

bool Polyhedron::is_regular() const { return is_regular_set(complex()); }

const QueryStructure& Polyhedron::queries() const {
  const Body& own = Body::of(body_);
  std::call_once(own.once, [&own] { own.queries = std::make_unique<const QueryStructure>(own.complex); });
  return *own.queries;
}

}  // namespace nef
