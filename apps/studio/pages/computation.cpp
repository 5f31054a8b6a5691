// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/pages/computation.h"

#include <unistd.h>

#include <fstream>

#include "nef/base/error.h"
#include "nef/base/interruption.h"

namespace nef::studio {
namespace {

constexpr double kBetweenLooksAtMemory = 0.05;  // seconds

}  // namespace

std::size_t resident_bytes() {
  std::ifstream pages("/proc/self/statm");
  std::size_t all = 0;
  std::size_t resident = 0;
  pages >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

bool Computation::must_stop() {
  if (cancelled_) return true;
  const double passed = watch_.seconds();
  if (passed > limits_.seconds) {
    reason_ = "it would take more than " + std::to_string(static_cast<int>(limits_.seconds)) +
              " s (--time); nef and the other programs have no limit";
    return true;
  }
  if (passed - memory_asked_s_ > kBetweenLooksAtMemory) {
    memory_asked_s_ = passed;
    if (resident_bytes() > limits_.bytes) {
      reason_ = "it would take more than " + std::to_string(limits_.bytes >> 20U) + " MiB of memory (--memory)";
      return true;
    }
  }
  return false;
}

void Computation::run(unsigned threads, const std::function<void(const Monitor&)>& work) {
  watch_ = Stopwatch();
  StopQuestion question([this] { return must_stop(); }, Monitor().on_threads(threads));
  const ProgressFunction tell = [this](const char* phase, std::size_t done, std::size_t total) {
    const std::lock_guard lock(mutex_);
    progress_.phase = phase;
    progress_.done = done;
    progress_.total = total;
  };
  try {
    work(question.monitor().telling(tell));
  } catch (const Interrupted&) {
    if (reason_.empty()) throw Cancelled();
    throw Error(reason_);
  } catch (const std::bad_alloc&) {
    throw Error("there is not enough memory for this");
  }
}

Computation::Progress Computation::progress() const {
  const std::lock_guard lock(mutex_);
  Progress progress = progress_;
  progress.seconds = watch_.seconds();
  return progress;
}

}  // namespace nef::studio
