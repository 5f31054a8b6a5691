// SPDX-License-Identifier: Apache-2.0
//
// What one library did with one case, as the line of JSON that bench/run reads.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace nef::bench {

/// Seconds since construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

struct Report {
  double build_s = 0;        ///< mesh to operand, all operands
  std::vector<double> op_s;  ///< of each repetition
  std::size_t vertices = 0, edges = 0, facets = 0, volumes = 0;
  std::size_t inside = 0;  ///< of the located points

  void print() const {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf(
        "{\"build_s\": %.6g, \"op_s\": %.6g, \"best_s\": %.6g, \"vertices\": %zu, \"edges\": %zu, "
        "\"facets\": %zu, \"volumes\": %zu, \"inside\": %zu, \"peak_kb\": %ld}\n",
        build_s, median(op_s), op_s.empty() ? 0.0 : *std::min_element(op_s.begin(), op_s.end()), vertices, edges,
        facets, volumes, inside, usage.ru_maxrss);
  }
};

}  // namespace nef::bench
