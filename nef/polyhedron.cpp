// SPDX-License-Identifier: Apache-2.0
#include "nef/polyhedron.h"

#include <mutex>

#include "nef/complex/synthesis.h"
#include "nef/query/predicates_of_sets.h"
#include "nef/query/query_structure.h"

namespace nef {

struct Polyhedron::Body {
  Complex complex;
  // Built when first asked for; call_once makes that safe for readers in several threads.
  mutable std::once_flag once;
  mutable std::unique_ptr<const QueryStructure> queries;
};

namespace {

Complex constant(LabelId mark) {
  Complex complex;
  synthesize(complex, mark);
  return complex;
}

}  // namespace

Polyhedron::Polyhedron() : Polyhedron(constant(0)) {}

Polyhedron Polyhedron::everything() { return Polyhedron(constant(1)); }

Polyhedron::Polyhedron(Complex&& complex) {
  auto body = std::make_shared<Body>();
  body->complex = std::move(complex);
  body_ = std::move(body);
}

const Complex& Polyhedron::complex() const { return body_->complex; }

bool Polyhedron::is_empty() const { return complex().vertex_count() == 0 && complex().volumes[0].mark == 0; }

bool Polyhedron::is_everything() const { return complex().vertex_count() == 0 && complex().volumes[0].mark == 1; }

bool Polyhedron::is_bounded() const { return complex().volumes[0].mark == 0; }

bool Polyhedron::is_open() const { return is_open_set(complex()); }

bool Polyhedron::is_closed() const { return is_closed_set(complex()); }

bool Polyhedron::is_regular() const { return is_regular_set(complex()); }

const QueryStructure& Polyhedron::queries() const {
  std::call_once(body_->once, [this] { body_->queries = std::make_unique<const QueryStructure>(body_->complex); });
  return *body_->queries;
}

}  // namespace nef
