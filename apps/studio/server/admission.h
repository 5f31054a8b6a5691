// SPDX-License-Identifier: Apache-2.0
//
// Who is let in. A page of another site must not use the server, whatever it makes a browser send: it does not know the
// token, its Origin is another one, and a name of its own that leads to the loopback is not a Host of the server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/studio/server/limits.h"

namespace nef::studio {

/// What of a request decides whether it is let in; nothing for a header that is not there.
struct RequestHead {
  std::string method;
  std::string path;  ///< without the query
  std::optional<std::string> host;
  std::optional<std::string> origin;
  std::optional<std::string> token;           ///< of the header X-Nef-Token, or of the query
  std::optional<std::string> content_length;  ///< as it was sent
  bool has_encoding = false;                  ///< Content-Encoding or Transfer-Encoding
};

/// Why a request is refused: the status of HTTP, and a line.
struct Refusal {
  int status = 0;
  std::string line;
};

/// Nothing if the request is let in. O(size of the head).
std::optional<Refusal> refuse(const RequestHead& head, std::string_view token, std::uint16_t port,
                              const ServerLimits& limits);

/// The number of a Content-Length; nothing unless it is digits, few enough for a std::size_t.
std::optional<std::size_t> body_length(const std::optional<std::string>& content_length);

/// 128 random bits of the system as hexadecimal digits. Throws Error if the system gives none.
std::string random_token();

}  // namespace nef::studio
