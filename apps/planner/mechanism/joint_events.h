// SPDX-License-Identifier: Apache-2.0
//
// The values of a joint at which contact may begin or end, in order.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "apps/planner/mechanism/contact_events.h"
#include "apps/planner/mechanism/range_of_motion.h"
#include "apps/planner/mechanism/screw_contact.h"

namespace nef::planner {

/// Two pieces, by their numbers: one of the moving part, one of the others.
using PiecePair = std::array<std::uint32_t, 2>;

/// The pieces of a mechanism.
struct MechanismPieces {
  std::vector<ContactPiece> moving;
  std::vector<ContactPiece> fixed;
};

/// A value at which something may change.
struct JointEvent {
  QuadraticRoot value;                                    ///< or a lower bound, if it is not known exactly
  std::vector<std::pair<PiecePair, ContactItems>> items;  ///< that may touch there
  std::optional<std::array<Rational, 2>> between;         ///< of a screw, if the value is not known exactly
  std::optional<QuadraticRoot> algebraic;                 ///< that value, if it is known to be this one
  bool single = true;                                     ///< exactly one value, whatever it is

  /// The value is between these, which differ by 2^-bits at most where it is known exactly.
  [[nodiscard]] std::array<Rational, 2> bounds(unsigned bits) const {
    return between ? *between : enclosure(value, bits);
  }
  /// A part of the range that begins or ends there.
  [[nodiscard]] RangeEnd end(std::vector<ContactPair> stops = {}) const {
    if (algebraic) return {*algebraic, std::nullopt, std::move(stops)};
    return {value, between, std::move(stops)};
  }
};

/// An end of a cell of values, at which nothing need change.
JointEvent end_of_cell(const Rational& value);

/// A short rational between two events, of which the first is below the second.
Rational value_between(const JointEvent& a, const JointEvent& b);

/// The events of pairs of pieces in a cell of a hinge or slider, each known exactly. `from` < `to`, in one of the parts
/// that Joint::breaks() separates.
std::vector<JointEvent> exact_events(const Joint& joint, const MechanismPieces& pieces,
                                     const std::vector<PiecePair>& pairs, const Rational& from, const Rational& to);

/// Events of a screw, and the different products whose zeros they are.
struct ScrewEvents {
  std::vector<JointEvent> events;
  std::vector<ScrewProduct> products;
};

/// The same for a screw. Products that are multiples of each other have the same zeros; zeros of others that are not
/// known to be apart are one event, which may be several values.
ScrewEvents screw_events(const Joint& joint, const MechanismPieces& pieces, const std::vector<PiecePair>& pairs,
                         const Rational& from, const Rational& to, const Monitor& monitor);

}  // namespace nef::planner
