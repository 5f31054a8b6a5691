// SPDX-License-Identifier: Apache-2.0
//
// A state has a pointer to three rationals beside its doubles, only where the doubles are not the position themselves.
// Rationals are valid as long as each rounds to the double beside it, which is tested whenever they are read. A
// serialized state reserves 32 bytes for each numerator and denominator, a length with the sign before the digits; a
// denominator of 0 says that there are none.
#include "apps/planner/ompl/exact_translation_space.h"

#include <ompl/base/spaces/RealVectorStateProjections.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "apps/planner/ompl/cell_sampler.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

// An integer in a serialized state: its length with the sign in the highest bit, then its bytes, the lowest first.
constexpr std::size_t kIntegerBytes = 32;
constexpr std::size_t kRationalBytes = 3 * 2 * kIntegerBytes;
constexpr unsigned char kNegative = 0x80;

bool fits(const Integer& value) { return mpz_sizeinbase(value.get_mpz_t(), 256) < kIntegerBytes; }

void put(const Integer& value, unsigned char* to) {
  std::size_t count = 0;
  mpz_export(to + 1, &count, -1, 1, 0, 0, value.get_mpz_t());
  *to = static_cast<unsigned char>(count | (value < 0 ? kNegative : 0U));
}

Integer get(const unsigned char* from) {
  Integer value;
  mpz_import(value.get_mpz_t(), *from & ~kNegative, -1, 1, 0, 0, from + 1);
  return (*from & kNegative) != 0 ? Integer(-value) : value;
}

}  // namespace

void ExactTranslationSpace::StateType::setExact(const Rational3& position) {
  bool plain = true;
  for (std::size_t i = 0; i < 3; ++i) {
    values[i] = nearest_double(position[i]);
    plain = plain && exact_rational(values[i]) == position[i];
  }
  if (plain) {
    exact_.reset();
  } else {
    exact_ = std::make_unique<Rational3>(position);
  }
}

bool ExactTranslationSpace::StateType::isFinite() const {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

bool ExactTranslationSpace::StateType::hasExact() const {
  if (!exact_) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (nearest_double((*exact_)[i]) != values[i]) return false;
  }
  return true;
}

Rational3 ExactTranslationSpace::StateType::exact() const {
  if (hasExact()) return *exact_;
  return {exact_rational(values[0]), exact_rational(values[1]), exact_rational(values[2])};
}

void ExactTranslationSpace::StateType::copyFrom(const StateType& other) {
  std::copy(other.values, other.values + 3, values);
  if (other.exact_) {
    exact_ = std::make_unique<Rational3>(*other.exact_);
  } else {
    exact_.reset();
  }
}

ExactPoint ExactTranslationSpace::StateType::point() const {
  if (hasExact()) return ExactPoint(*exact_);
  return ExactPoint(std::array<double, 3>{values[0], values[1], values[2]});
}

ExactTranslationSpace::ExactTranslationSpace(std::shared_ptr<const FreeSpace> freeSpace)
    : ob::RealVectorStateSpace(3), freeSpace_(std::move(freeSpace)) {
  setName("ExactTranslation" + getName());
}

// The position itself, in cells of a share of the bounds. OMPL's own choice in three dimensions is a random plane, and
// draws a thousand samples to find out how large its cells must be, each time the bounds or the free space change.
void ExactTranslationSpace::registerProjections() {
  registerDefaultProjection(
      std::make_shared<ob::RealVectorOrthogonalProjectionEvaluator>(this, std::vector<unsigned int>{0, 1, 2}));
}

ob::State* ExactTranslationSpace::allocState() const {
  auto* state = new StateType();
  state->values = new double[3]{};
  return state;
}

void ExactTranslationSpace::freeState(ob::State* state) const {
  auto* exact = static_cast<StateType*>(state);
  delete[] exact->values;
  delete exact;
}

void ExactTranslationSpace::copyState(ob::State* destination, const ob::State* source) const {
  if (destination == source) return;
  auto* to = static_cast<StateType*>(destination);
  const auto* from = static_cast<const StateType*>(source);
  to->copyFrom(*from);
}

void ExactTranslationSpace::copyFromReals(ob::State* destination, const std::vector<double>& reals) const {
  ob::RealVectorStateSpace::copyFromReals(destination, reals);
  // Rationals that were there and happen to round to these doubles are not what was asked for.
  static_cast<StateType*>(destination)->dropExact();
}

bool ExactTranslationSpace::equalStates(const ob::State* state1, const ob::State* state2) const {
  const auto* a = static_cast<const StateType*>(state1);
  const auto* b = static_cast<const StateType*>(state2);
  for (std::size_t i = 0; i < 3; ++i) {
    if (a->values[i] != b->values[i]) return false;
  }
  if (!a->hasExact() && !b->hasExact()) return true;
  return a->exact() == b->exact();
}

void ExactTranslationSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const {
  const auto* a = static_cast<const StateType*>(from);
  const auto* b = static_cast<const StateType*>(to);
  auto* result = static_cast<StateType*>(state);
  if (t == 0 || t == 1) {
    copyState(result, t == 0 ? a : b);
    return;
  }
  if (!a->hasExact() && !b->hasExact()) {
    ob::RealVectorStateSpace::interpolate(from, to, t, state);
    result->dropExact();
    return;
  }
  const Rational3 x = a->exact();
  const Rational3 y = b->exact();
  const Rational s = exact_rational(t);
  result->setExact({x[0] + s * (y[0] - x[0]), x[1] + s * (y[1] - x[1]), x[2] + s * (y[2] - x[2])});
}

void ExactTranslationSpace::printState(const ob::State* state, std::ostream& out) const {
  const auto* exact = static_cast<const StateType*>(state);
  if (exact == nullptr || !exact->hasExact()) {
    ob::RealVectorStateSpace::printState(state, out);
    return;
  }
  const Rational3 position = exact->exact();
  out << "ExactTranslationState [" << to_string(position[0]) << ' ' << to_string(position[1]) << ' '
      << to_string(position[2]) << "]\n";
}

unsigned int ExactTranslationSpace::getSerializationLength() const {
  return ob::RealVectorStateSpace::getSerializationLength() + kRationalBytes;
}

void ExactTranslationSpace::serialize(void* serialization, const ob::State* state) const {
  ob::RealVectorStateSpace::serialize(serialization, state);
  auto* at = static_cast<unsigned char*>(serialization) + ob::RealVectorStateSpace::getSerializationLength();
  std::fill(at, at + kRationalBytes, static_cast<unsigned char>(0));
  const auto* exact = static_cast<const StateType*>(state);
  if (!exact->hasExact()) return;
  const Rational3 position = exact->exact();
  for (const Rational& value : position) {
    if (!fits(value.get_num()) || !fits(value.get_den())) return;
  }
  for (const Rational& value : position) {
    put(value.get_num(), at);
    put(value.get_den(), at + kIntegerBytes);
    at += 2 * kIntegerBytes;
  }
}

void ExactTranslationSpace::deserialize(ob::State* state, const void* serialization) const {
  ob::RealVectorStateSpace::deserialize(state, serialization);
  auto* exact = static_cast<StateType*>(state);
  exact->dropExact();
  const auto* at =
      static_cast<const unsigned char*>(serialization) + ob::RealVectorStateSpace::getSerializationLength();
  Rational3 position;
  for (Rational& value : position) {
    const Integer denominator = get(at + kIntegerBytes);
    if (denominator == 0) return;  // no rationals were written
    value = Rational(get(at), denominator);
    value.canonicalize();
    at += 2 * kIntegerBytes;
  }
  exact->setExact(position);
}

ob::StateSamplerPtr ExactTranslationSpace::allocDefaultStateSampler() const {
  if (!freeSpace_) return ob::RealVectorStateSpace::allocDefaultStateSampler();
  return std::make_shared<CellSampler>(this, freeSpace_, cellShare_);
}

}  // namespace nef::planner
