// SPDX-License-Identifier: Apache-2.0
//
// The one shape that the reports of the four programs have (docs/reports.md).
#pragma once

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace nef::test {

/// The frame around what a command found, and seconds under keys that say so.
inline void check_report_shape(const nlohmann::json& report, const std::string& command) {
  CHECK(report["command"] == command);
  REQUIRE(report["phases"].is_object());
  CHECK_FALSE(report["phases"].empty());
  for (const auto& [key, value] : report["phases"].items()) {
    CAPTURE(key);
    CHECK(key.size() > 2);
    CHECK(key.substr(key.size() - 2) == "_s");
    CHECK(value.get<double>() >= 0);
  }
  CHECK(report["peak_memory_bytes"].get<double>() > 1e6);
  CHECK(report["messages"].is_array());
  CHECK(report.contains("predicates") == report.contains("predicates_by_phase"));
  if (!report.contains("predicates")) return;
  for (const char* stage : {"identity", "filter", "exact"}) {
    std::uint64_t sum = 0;
    for (const auto& [phase, counts] : report["predicates_by_phase"].items()) {
      CHECK(report["phases"].contains(phase + "_s"));
      sum += counts[stage].get<std::uint64_t>();
    }
    CHECK(report["predicates"][stage] == sum);
  }
}

}  // namespace nef::test
