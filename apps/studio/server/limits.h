// SPDX-License-Identifier: Apache-2.0
//
// What the studio's server grants to whoever connects, so that nobody can make it grow or wait without bounds.
#pragma once

#include <chrono>
#include <cstddef>

namespace nef::studio {

/// Bounds of one connection, and of all together.
struct ServerLimits {
  std::size_t most_head = std::size_t{16} << 10U;  ///< bytes of a request line and its headers
  std::size_t most_body = std::size_t{64} << 20U;  ///< bytes of a body, which must state its length
  std::size_t most_connections = 32;               ///< served at once; more are refused
  std::chrono::milliseconds head_time{5'000};      ///< for a client to send its head
  std::chrono::milliseconds body_time{30'000};     ///< for a client to send its body, from the first byte on
  std::chrono::milliseconds reply_time{30'000};    ///< for a client to take its reply
};

}  // namespace nef::studio
