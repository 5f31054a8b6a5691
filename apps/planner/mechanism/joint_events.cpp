// SPDX-License-Identifier: Apache-2.0
//
// Events of a hinge or slider are roots of quadratic equations, which are compared exactly where doubles do not tell
// them apart. Those of a screw are enclosed in intervals, and told to be the same only where that is proved.
#include "apps/planner/mechanism/joint_events.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "nef/number/interval.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

// The value in doubles. A nearest double is off by 2^-53 of it, a root by as much again.
Interval enclosure_of(const QuadraticRoot& value) {
  const double rational = nearest_double(value.rational);
  const double root = value.sign * std::sqrt(nearest_double(value.square));
  return Interval::around(rational + root, 0x1p-50 * (std::fabs(rational) + std::fabs(root)) + MotionCell::kVanished);
}

// A product, and the items of which it is one or a multiple of one.
struct ProductItems {
  ScrewProduct product;
  std::vector<std::pair<PiecePair, ContactItems>> items;
};
using Products = std::map<std::array<Rational, 6>, ProductItems>;  // by what multiples have in common

Products products_of(const Joint& joint, const MechanismPieces& pieces, const std::vector<PiecePair>& pairs,
                     const Rational& from, const Rational& to) {
  const EventCell cell(joint, from, to);
  Products products;
  for (const PiecePair& pair : pairs) {
    std::vector<ScrewContact> of_pair;
    append_products(pieces.moving[pair[0]], pieces.fixed[pair[1]], cell, of_pair);
    for (ScrewContact& contact : of_pair) {
      ProductItems& same = products[contact.product.normalized()];
      same.product = std::move(contact.product);
      same.items.emplace_back(pair, contact.items);
    }
  }
  return products;
}

// A zero of one product.
struct FoundRoot {
  JointEvent event;
  std::size_t product = 0;
};

constexpr unsigned kOrderBits = 80;

// All zeros, by their lower bounds. Moves the products to `products`.
std::vector<FoundRoot> roots_in(Products&& by_quotient, const Rational& from, const Rational& to,
                                std::vector<ScrewProduct>& products, const Monitor& monitor) {
  std::vector<FoundRoot> found;
  for (auto& [key, same] : by_quotient) {
    monitor.check_interruption();
    for (const ScrewRoot& root : roots_of(same.product, {from, to})) {
      JointEvent event{root.exact ? *root.exact : QuadraticRoot(root.low), same.items, std::nullopt, root.algebraic,
                       root.single};
      if (!root.exact) event.between = {root.low, root.high};
      found.push_back({std::move(event), products.size()});
    }
    products.push_back(std::move(same.product));
  }
  std::stable_sort(found.begin(), found.end(), [](const FoundRoot& a, const FoundRoot& b) {
    return a.event.bounds(kOrderBits)[0] < b.event.bounds(kOrderBits)[0];
  });
  return found;
}

// Are two zeros proved to be one value?
bool is_same(const FoundRoot& a, const FoundRoot& b, const std::vector<ScrewProduct>& products) {
  if (!a.event.between || !b.event.between) {
    return !a.event.between && !b.event.between && compare(a.event.value, b.event.value) == 0;
  }
  const auto& [x, y] = std::tie(a.event.algebraic, b.event.algebraic);
  if (x || y) return x && y && compare(*x, *y) == 0;
  return a.product != b.product && have_equal_quotients(products[a.product], products[b.product]);
}

// Zeros that are not known to be apart become one event.
std::vector<JointEvent> merged(const std::vector<FoundRoot>& found, const std::vector<ScrewProduct>& products) {
  std::vector<JointEvent> events;
  std::vector<const FoundRoot*> of_last;  // zeros of the last event
  for (const FoundRoot& next : found) {
    if (events.empty() || events.back().bounds(kOrderBits)[1] < next.event.bounds(kOrderBits)[0]) {
      events.push_back(next.event);
      of_last = {&next};
      continue;
    }
    JointEvent& last = events.back();
    last.items.insert(last.items.end(), next.event.items.begin(), next.event.items.end());
    const bool twice = std::any_of(of_last.begin(), of_last.end(), [&](const FoundRoot* other) {
      return other->product == next.product && !is_same(*other, next, products);
    });
    const bool same = last.single && next.event.single && !twice && is_same(*of_last.front(), next, products);
    of_last.push_back(&next);
    if (same && !last.between) continue;
    const std::array<Rational, 2> before = last.bounds(kOrderBits);
    const std::array<Rational, 2> now = next.event.bounds(kOrderBits);
    if (same) {
      last.between = {std::max(before[0], now[0]), std::min(before[1], now[1])};
    } else {
      last.between = {std::min(before[0], now[0]), std::max(before[1], now[1])};
      last.single = false;
      last.algebraic.reset();
    }
    last.value = (*last.between)[0];
  }
  for (JointEvent& event : events)
    std::sort(event.items.begin(), event.items.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return events;
}

}  // namespace

JointEvent end_of_cell(const Rational& value) { return {value, {}, std::nullopt, std::nullopt, true}; }

Rational value_between(const JointEvent& a, const JointEvent& b) {
  for (unsigned bits = 20;; bits *= 2) {
    const Rational low = a.bounds(bits)[1];
    const Rational high = b.bounds(bits)[0];
    if (low >= high) continue;
    const Rational room = (high - low) / 4;
    return simplest_between(low + room, high - room);
  }
}

std::vector<JointEvent> exact_events(const Joint& joint, const MechanismPieces& pieces,
                                     const std::vector<PiecePair>& pairs, const Rational& from, const Rational& to) {
  struct Found {
    QuadraticRoot value;
    Interval rough;
    PiecePair pair;
    ContactItems items;
  };
  const EventCell cell(joint, from, to);
  std::vector<Found> found;
  for (const PiecePair& pair : pairs) {
    std::vector<ContactEvent> of_pair;
    append_events(pieces.moving[pair[0]], pieces.fixed[pair[1]], cell, of_pair);
    for (ContactEvent& event : of_pair) {
      const Interval rough = enclosure_of(event.value);
      found.push_back({std::move(event.value), rough, pair, event.items});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    if (a.rough.high() < b.rough.low()) return true;
    if (b.rough.high() < a.rough.low()) return false;
    return compare(a.value, b.value) < 0;
  });
  std::vector<JointEvent> events;
  for (Found& event : found) {
    if (events.empty() || compare(events.back().value, event.value) != 0) {
      events.push_back({std::move(event.value), {}, std::nullopt, std::nullopt, true});
    }
    events.back().items.emplace_back(event.pair, event.items);
  }
  return events;
}

ScrewEvents screw_events(const Joint& joint, const MechanismPieces& pieces, const std::vector<PiecePair>& pairs,
                         const Rational& from, const Rational& to, const Monitor& monitor) {
  ScrewEvents result;
  const std::vector<FoundRoot> found =
      roots_in(products_of(joint, pieces, pairs, from, to), from, to, result.products, monitor);
  result.events = merged(found, result.products);
  return result;
}

}  // namespace nef::planner
