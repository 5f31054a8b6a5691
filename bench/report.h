// SPDX-License-Identifier: Apache-2.0
//
// What one library did with one case, as the line of JSON that bench/run reads.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "nef/base/freed_memory.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::bench {

/// CPU seconds of this process since construction. Every engine runs on one thread, so on a quiet
/// machine this is the time on the clock, and on a busy one it is still comparable.
using Stopwatch = ProcessStopwatch;

/// The peak of resident memory since the program was loaded, in KiB. (The maximum that getrusage
/// tells includes what the parent had before it became this program.)
inline long peak_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long value = 0;
    if (word == "VmHWM:" && status >> value) return value;
  }
  return 0;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

struct Report {
  std::vector<double> build_s;       ///< mesh to operand, all operands, of each repetition
  std::vector<double> build_wall_s;  ///< the same on the clock, where an engine has used several threads
  std::vector<double> op_s;          ///< of each repetition
  std::vector<double> op_wall_s;     ///< the same on the clock, where an engine has used several threads
  std::vector<double> export_s;      ///< result to a mesh of triangles and doubles in memory, where the engine does it
  std::size_t triangles = 0;         ///< of that mesh
  std::size_t vertices = 0, edges = 0, facets = 0, volumes = 0;
  std::size_t inside = 0;  ///< of the located points
  std::size_t bytes = 0;   ///< that the result holds, if the engine tells

  void print() const {
    std::printf(
        "{\"build_s\": %.6g, \"build_wall_s\": %.6g, \"op_s\": %.6g, \"op_wall_s\": %.6g, \"best_s\": %.6g, "
        "\"export_s\": %.6g, \"triangles\": "
        "%zu, \"vertices\": "
        "%zu, \"edges\": %zu, "
        "\"facets\": %zu, \"volumes\": %zu, \"inside\": %zu, \"bytes\": %zu, \"peak_kb\": %ld}\n",
        median(build_s), median(build_wall_s), median(op_s), median(op_wall_s),
        op_s.empty() ? 0.0 : *std::min_element(op_s.begin(), op_s.end()), median(export_s), triangles, vertices, edges,
        facets, volumes, inside, bytes, peak_kb());
  }
};

/// The main program of an engine: `run(case_directory, repeat, threads)` makes the report, which is printed. Arguments
/// are CASE_DIRECTORY [REPEAT [THREADS]], each 1 if left out; what is thrown is printed, and the exit code is 2.
template <class Run>
int engine_main(const char* name, int argc, char** argv, const Run& run) {
  keep_freed_memory();
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s CASE_DIRECTORY [REPEAT [THREADS]]\n", name);
    return 2;
  }
  const auto number = [&](int i) { return argc > i ? std::max(1, std::atoi(argv[i])) : 1; };
  try {
    run(std::string(argv[1]), number(2), number(3)).print();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
  return 0;
}

}  // namespace nef::bench
