// SPDX-License-Identifier: Apache-2.0
#include "fuzz/shrink.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace nef::fuzz {
namespace {

std::string kind(const std::string& complaint) { return complaint.substr(0, complaint.find(':')); }

class Shrinker {
 public:
  Shrinker(const Fuzzer& fuzzer, Finding finding, double seconds)
      : fuzzer_(fuzzer),
        best_(std::move(finding)),
        end_(Clock::now() + std::chrono::milliseconds(std::lround(1000 * seconds))) {}

  Finding run() {
    for (bool better = true; better && !late();) {
      better = leave_out();
      better = lower() || better;
    }
    return std::move(best_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  using List = std::vector<std::uint32_t>;

  [[nodiscard]] bool late() const { return Clock::now() >= end_; }

  bool attempt(const List& choices) {
    Worker worker(fuzzer_, choices);
    std::optional<Finding> finding = worker.wait();
    if (!finding || kind(finding->complaint) != kind(best_.complaint)) return false;
    // What was drawn may be shorter than what was offered; trailing zeros are drawn anyway.
    while (!finding->choices.empty() && finding->choices.back() == 0) finding->choices.pop_back();
    const bool smaller = finding->choices.size() < best_.choices.size() ||
                         (finding->choices.size() == best_.choices.size() && finding->choices < best_.choices);
    if (smaller) best_ = *std::move(finding);
    return smaller;
  }

  // Runs of choices, long ones first; from the end, where they matter least.
  bool leave_out() {
    bool better = false;
    for (std::size_t length = std::max<std::size_t>(best_.choices.size() / 2, 1); length > 0; length /= 2) {
      const std::size_t step = length > 8 ? length / 2 : 1;
      for (std::size_t end = best_.choices.size(); end >= length && !late(); end -= std::min(step, end)) {
        end = std::min(end, best_.choices.size());
        if (end < length) break;
        const auto from = [&](std::size_t at) { return best_.choices.begin() + static_cast<std::ptrdiff_t>(at); };
        List choices(best_.choices.begin(), from(end - length));
        choices.insert(choices.end(), from(end), best_.choices.end());
        better = attempt(choices) || better;
      }
    }
    return better;
  }

  bool lower() {
    bool better = false;
    for (std::size_t i = 0; i < best_.choices.size() && !late(); ++i) {
      for (const std::uint32_t divisor : {0U, 2U, 1U}) {
        if (i >= best_.choices.size() || best_.choices[i] == 0) break;
        List choices = best_.choices;
        choices[i] = divisor == 0 ? 0 : divisor == 2 ? choices[i] / 2 : choices[i] - 1;
        if (attempt(choices)) {
          better = true;
          break;
        }
      }
    }
    return better;
  }

  const Fuzzer& fuzzer_;
  Finding best_;
  Clock::time_point end_;
};

}  // namespace

Finding shrunk(const Fuzzer& fuzzer, Finding finding, double seconds) {
  return Shrinker(fuzzer, std::move(finding), seconds).run();
}

}  // namespace nef::fuzz
