// SPDX-License-Identifier: Apache-2.0
//
// The one shape that the reports of all programs have.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "nef/base/timing/predicate_counts.h"

namespace nef {

using Json = nlohmann::ordered_json;

/// What a program spent on one phase of its work.
struct ReportPhase {
  std::string name;                           ///< without a unit: "load"
  double seconds = 0;                         ///< on the wall
  std::optional<PredicateCounts> predicates;  ///< where they are counted
};

/// The report of a run: `command`, the members of `found` (what the command is for; a set under `result`, with the keys
/// of set_info), `phases` (seconds, so each key ends in _s), `predicates` (signs answered by identity, filter and
/// exactly, in all) and `predicates_by_phase` where they are counted, `peak_memory_bytes`, `messages`. Units stand in
/// keys (_s, _bytes, _px); lengths, areas and volumes without one are in the units of the input.
Json run_report(const std::string& command, const Json& found, const std::vector<ReportPhase>& phases,
                const std::vector<std::string>& messages = {});

/// As reports are printed and written. Bytes of paths that are no UTF-8 are replaced rather than refused.
std::string report_text(const Json& report);

/// How many answers each stage of the predicates gave.
Json predicates_json(const PredicateCounts& counts);

/// The most memory that this process has held.
std::size_t peak_memory_bytes();

}  // namespace nef
