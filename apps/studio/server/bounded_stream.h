// SPDX-License-Identifier: Apache-2.0
//
// The bytes of one connection, with a bound on how many come in and on how long that may take as a whole: a client that
// sends a byte now and then is cut off like one that sends nothing.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "apps/studio/server/limits.h"

namespace nef::studio {

/// A connected socket, which it does not close.
class BoundedStream : public httplib::Stream {
 public:
  /// At first only a head may come in.
  BoundedStream(socket_t socket, const ServerLimits& limits);

  /// Lets a body of so many bytes come in behind the head.
  void expect_body(std::size_t bytes);

  // As httplib wants them. Reading and writing return -1 beyond a bound.
  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool wait(short event, Clock::time_point until) const;

  socket_t socket_;
  ServerLimits limits_;
  std::size_t left_;  // bytes that may still be read
  Clock::time_point read_until_;
  Clock::time_point write_until_{};  // set by the first byte of the reply
  std::array<char, 4096> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace nef::studio
