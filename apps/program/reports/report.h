// SPDX-License-Identifier: Apache-2.0
//
// Sets and measurements as JSON and as text.
#pragma once

#include <functional>

#include "apps/program/session.h"
#include "nef/polyhedron.h"

namespace nef {

/// What reports tell about a set (see set_info): counts, properties, measures without moments. Numbers that are
/// infinite, undefined or longer than a line are null.
Json info_json(const Polyhedron& set, const Monitor& monitor = {});

/// "8 vertices, 12 edges, 6 facets, 2 volumes, 2 shells"
std::string summary(const Polyhedron& set);

/// A point as three numbers: "x,y,z", those of many digits shortened (see brief_text), and as a JSON array of exact
/// strings.
std::string point_text(const Rational3& point);
Json point_json(const Rational3& point);

/// A result with the median time of its computation and the predicates of the last one.
struct Measured {
  Polyhedron set;
  double seconds = 0;
  PredicateCounts predicates;
};

/// Computes `repeat` times. The operation's monitor watches as `monitor` does, and counts what is measured.
Measured measure(int repeat, const Monitor& monitor, const std::function<Polyhedron(const Monitor&)>& operation);

/// Writes the result and prints what the flags ask for: a summary, or a report with the members of `more` and the set
/// under `result`.
void finish(Session& session, const std::string& command, const Measured& measured, const Json& more = Json::object());

}  // namespace nef
