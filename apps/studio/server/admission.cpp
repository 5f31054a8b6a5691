// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/server/admission.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "nef/base/error.h"

namespace nef::studio {
namespace {

constexpr std::size_t kLongestPath = 200;

// In a time that does not tell how many characters are right.
bool equal_secrets(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

bool is_own_host(const std::string& host, std::uint16_t port) {
  const std::string number = ':' + std::to_string(port);
  return host == "127.0.0.1" + number || host == "localhost" + number;
}

}  // namespace

std::optional<Refusal> refuse(const RequestHead& head, std::string_view token, std::uint16_t port,
                              const ServerLimits& limits) {
  if (head.path.size() > kLongestPath) return Refusal{414, "the path is too long"};
  if (head.method != "GET" && head.method != "POST") return Refusal{405, "only GET and POST are understood"};
  if (!head.host || !is_own_host(*head.host, port)) {
    return Refusal{421, "Host is not this server: open the address that nef studio printed"};
  }
  if (head.origin && *head.origin != "http://" + *head.host) {
    return Refusal{403, "Origin is another site, which may not use this server"};
  }
  if (!head.token || !equal_secrets(*head.token, token)) {
    return Refusal{403, "the token is missing or wrong: open the address that nef studio printed"};
  }
  if (head.has_encoding) return Refusal{415, "bodies must be sent plain, with their length"};
  if (head.method == "POST") {
    const std::optional<std::size_t> length = body_length(head.content_length);
    if (!length) return Refusal{411, "the length of the body is missing (Content-Length)"};
    if (*length > limits.most_body) {
      return Refusal{413, "the body has more than " + std::to_string(limits.most_body >> 20U) + " MiB"};
    }
  } else if (head.content_length && *head.content_length != "0") {
    return Refusal{400, "GET has no body"};
  }
  return std::nullopt;
}

std::optional<std::size_t> body_length(const std::optional<std::string>& content_length) {
  if (!content_length || content_length->empty()) return std::nullopt;
  std::size_t length = 0;
  const char* end = content_length->data() + content_length->size();
  const auto [stop, error] = std::from_chars(content_length->data(), end, length);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return length;
}

std::string random_token() {
  std::array<unsigned char, 16> bits{};
  if (::getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size())) {
    throw Error("the system gives no random bits for the token");
  }
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bits) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

}  // namespace nef::studio
