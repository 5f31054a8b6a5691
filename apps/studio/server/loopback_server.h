// SPDX-License-Identifier: Apache-2.0
//
// A server of HTTP for one user of this machine: on the loopback only, for those who know its token (admission.h), and
// within limits (limits.h). One request a connection. Built on cpp-httplib, which nobody else needs to know.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/studio/server/limits.h"

namespace nef::studio {

/// A request that was let in.
struct WebRequest {
  std::string method;  ///< "GET" or "POST"
  std::string path;
  std::string body;
};

/// What a client gets.
struct WebReply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// A line of text with a status of HTTP.
inline WebReply line_reply(int status, const std::string& line) { return {.status = status, .body = line + '\n'}; }

using WebHandler = std::function<WebReply(const WebRequest&)>;

class LoopbackServer {
 public:
  /// Binds 127.0.0.1 at a port, or at any free one for 0. `handler` is called by several threads at once; what it
  /// throws becomes a reply of status 500. Throws InputError if the port is taken.
  LoopbackServer(std::uint16_t port, std::string token, const ServerLimits& limits, WebHandler handler);
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// What to open in a browser: the address with the token.
  [[nodiscard]] std::string address() const;

  /// Serves until `stop`, then waits for the requests that are being served.
  void run();
  /// May be called by any thread, more than once, before `run`, too.
  void stop();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nef::studio
