// SPDX-License-Identifier: Apache-2.0
#include "apps/program/reports/run_report.h"

#include <sys/resource.h>

namespace nef {

Json run_report(const std::string& command, const Json& found, const std::vector<ReportPhase>& phases,
                const std::vector<std::string>& messages) {
  Json report{{"command", command}};
  report.update(found);
  PredicateCounts total;
  Json seconds = Json::object();
  Json by_phase = Json::object();
  for (const ReportPhase& phase : phases) {
    seconds[phase.name + "_s"] = phase.seconds;
    if (!phase.predicates) continue;
    total += *phase.predicates;
    by_phase[phase.name] = predicates_json(*phase.predicates);
  }
  report["phases"] = std::move(seconds);
  if (!by_phase.empty()) {
    report["predicates"] = predicates_json(total);
    report["predicates_by_phase"] = std::move(by_phase);
  }
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["messages"] = messages;
  return report;
}

std::string report_text(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json predicates_json(const PredicateCounts& counts) {
  return {{"identity", counts.identity}, {"filter", counts.filter}, {"exact", counts.exact}};
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace nef
