// SPDX-License-Identifier: Apache-2.0
//
// Cases in processes of their own, so that a crash or a hang is a failure like any other, and the run goes on.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/fuzzer.h"

namespace nef::fuzz {

/// A case that fails.
struct Finding {
  std::string fuzzer;
  std::string complaint;  ///< one line
  std::string story;      ///< what the case told about itself
  std::vector<std::uint32_t> choices;
};

using Counters = std::map<std::string, std::uint64_t>;

struct SharedNotes;

/// A process that runs cases of one fuzzer for a while. All calls come from one thread.
class Worker {
 public:
  /// Starts it: cases `first`, `first` + 1, ... of a seed until `seconds` are over, `most` cases are done, or one
  /// fails.
  Worker(const Fuzzer& fuzzer, std::uint64_t seed, std::uint64_t first, double seconds, std::uint64_t most);
  /// Runs one given case.
  Worker(const Fuzzer& fuzzer, const std::vector<std::uint32_t>& choices);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] const Fuzzer& fuzzer() const { return fuzzer_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Waits until the process has ended. Returns the case that failed, if one did.
  std::optional<Finding> wait();
  /// Takes note of an end that was waited for elsewhere.
  std::optional<Finding> ended(int status);
  /// What was counted, the cases themselves under "cases". Valid after the end.
  [[nodiscard]] Counters counters() const;
  /// CPU seconds of the case that took longest. Valid after the end.
  [[nodiscard]] double slowest() const;

 private:
  const Fuzzer& fuzzer_;
  SharedNotes* notes_;
  pid_t pid_ = -1;
};

}  // namespace nef::fuzz
