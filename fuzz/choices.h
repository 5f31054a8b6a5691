// SPDX-License-Identifier: Apache-2.0
//
// All that is random in a case, as a list of small numbers. A generator draws every decision from it, so a case is its
// list: it can be written to a file, replayed and made smaller without knowing what it means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nef::fuzz {

class Choices {
 public:
  /// Draws at random; equal seeds draw equal numbers.
  explicit Choices(std::uint64_t seed) : state_(seed), random_(true) {}
  /// Draws what is written there (the largest allowed number if that is too large), and zeros after the end.
  explicit Choices(std::vector<std::uint32_t> script) : script_(std::move(script)) {}

  /// A number of 0 .. n - 1; 0 is what should stand for the simplest case. n > 0.
  std::uint32_t below(std::uint32_t n);
  /// A number of low .. high.
  int between(int low, int high);
  /// True in one of n cases.
  bool one_in(std::uint32_t n) { return below(n) == n - 1; }
  /// One of the items of a container that is not empty.
  template <typename Container>
  const typename Container::value_type& element(const Container& items) {
    return *(std::begin(items) + below(static_cast<std::uint32_t>(std::size(items))));
  }

  /// What was drawn so far.
  [[nodiscard]] const std::vector<std::uint32_t>& drawn() const { return drawn_; }
  /// Called with each number drawn: the way out of a process that may not live to tell.
  void on_draw(std::function<void(std::uint32_t)> listener) { listener_ = std::move(listener); }

 private:
  std::vector<std::uint32_t> script_;
  std::vector<std::uint32_t> drawn_;
  std::function<void(std::uint32_t)> listener_;
  std::uint64_t state_ = 0;
  bool random_ = false;
};

/// A well mixed number for a pair of numbers: seeds of cases from the seed of a run (splitmix64, Steele et al. 2014).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b);

}  // namespace nef::fuzz
