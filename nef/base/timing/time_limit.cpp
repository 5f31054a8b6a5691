// SPDX-License-Identifier: Apache-2.0
#include "nef/base/timing/time_limit.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <system_error>

#include "nef/base/error.h"

namespace nef {
namespace {

constexpr double kLongest = 1e9;  // seconds, more than thirty years: what clocks can add to the time of day

}  // namespace

// There is nothing to ask: the timer says when to stop.
TimeLimit::TimeLimit(std::optional<double> seconds, const Monitor& outer)
    : question_(seconds ? std::function<bool()>([] { return false; }) : nullptr, outer) {
  if (!seconds) return;
  if (*seconds <= 0) {
    question_.stop();
    return;
  }
  const auto most =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(std::min(kLongest, *seconds)));
  try {
    timer_ = std::jthread([this, most](const std::stop_token& is_needless) {
      std::mutex mutex;
      std::unique_lock lock(mutex);
      std::condition_variable_any().wait_for(lock, is_needless, most, [] { return false; });
      if (!is_needless.stop_requested()) question_.stop();
    });
  } catch (const std::system_error& failure) {
    throw Error(std::string("the thread of a time limit cannot be started (") + failure.what() +
                "); leave the limit out, or raise the limits of processes and memory (ulimit -u, -v)");
  }
}

}  // namespace nef
