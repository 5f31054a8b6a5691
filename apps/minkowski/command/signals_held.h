// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>

namespace nef::minkowski {

/// Ctrl-C ends the program at once, except while a file is written: then it waits until the file is
/// whole (files are written beside their targets and renamed). A handler and not a mask, since a mask of this
/// thread would leave the others to take the signal.
class SignalsHeld {
 public:
  SignalsHeld() {
    held_signal_ = 0;
    struct sigaction action {};
    action.sa_handler = [](int signal) { held_signal_ = signal; };
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
  }
  ~SignalsHeld() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
    if (held_signal_ != 0) raise(held_signal_);
  }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  static inline volatile std::sig_atomic_t held_signal_ = 0;
  std::array<struct sigaction, 3> before_{};
};

}  // namespace nef::minkowski
