// SPDX-License-Identifier: Apache-2.0
#include "nef/import/repair/winding_report.h"

#include <cstdlib>

#include "nef/number/brief_text.h"

namespace nef {
namespace {

// "3 parts (volume 0.01, 0.02 %) ", and the verb for them.
std::string parts_text(const WindingVolume& entry, double total) {
  std::string text = std::to_string(entry.parts) + (entry.parts == 1 ? " part (volume " : " parts (volume ");
  text += short_text(entry.measured.value, 3);
  if (total > 0) text += ", " + short_text(100 * entry.measured.value / total, 3) + " %";
  return text + (entry.parts == 1 ? ") is" : ") are");
}

std::string times_text(int count) {
  if (count == 1) return "once";
  if (count == 2) return "twice";
  return std::to_string(count) + " times";
}

std::string line_about(int winding, const WindingVolume& entry, bool taken, double total) {
  const std::string parts = parts_text(entry, total);
  const std::string verb = entry.parts == 1 ? "is" : "are";
  if (winding > 1) {
    return parts + " enclosed " + times_text(winding) + (entry.parts == 1 ? " and counts once" : " and count once");
  }
  const std::string times = winding < -1 ? ", enclosed " + times_text(std::abs(winding)) + "," : "";
  return parts + " inside out" + times + " and " + verb + (taken ? " taken" : " left out");
}

}  // namespace

std::vector<std::string> lines_about(const ResolvedMesh& resolved, Crossings rule) {
  std::vector<std::string> result;
  if (resolved.crossing_pairs > 0 || resolved.is_unpaired || rule == Crossings::kGuess) {
    result.push_back(note_about(resolved, rule));
  }
  double total = 0;
  for (const auto& [winding, entry] : resolved.volumes) {
    if (is_taken(rule, winding)) total += entry.measured.value;
  }
  for (const auto& [winding, entry] : resolved.volumes) {
    const bool counted_evenly = rule == Crossings::kOdd && winding == 0;
    if (entry.parts == 0 || winding == 1 || (winding == 0 && !counted_evenly)) continue;
    result.push_back(counted_evenly ? parts_text(entry, total) + " enclosed an even number of times and left out"
                                    : line_about(winding, entry, is_taken(rule, winding), total));
  }
  return result;
}

}  // namespace nef
