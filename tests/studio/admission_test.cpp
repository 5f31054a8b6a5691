// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/server/admission.h"

#include <catch2/catch.hpp>
#include <set>

namespace nef::studio {
namespace {

constexpr char kToken[] = "0123456789abcdef0123456789abcdef";
constexpr std::uint16_t kPort = 4321;

RequestHead own_head() {
  RequestHead head;
  head.method = "POST";
  head.path = "/api/start";
  head.host = "127.0.0.1:4321";
  head.origin = "http://127.0.0.1:4321";
  head.token = kToken;
  head.content_length = "2";
  return head;
}

int status_of(const RequestHead& head) {
  const auto refusal = refuse(head, kToken, kPort, {});
  if (!refusal) return 200;
  CHECK(!refusal->line.empty());
  CHECK(refusal->line.find('\n') == std::string::npos);
  return refusal->status;
}

TEST_CASE("A page of the server itself is let in") {
  RequestHead head = own_head();
  CHECK(status_of(head) == 200);
  head.origin = std::nullopt;  // as scripts of the user send no Origin
  CHECK(status_of(head) == 200);
  head.host = "localhost:4321";
  head.origin = "http://localhost:4321";
  CHECK(status_of(head) == 200);
}

TEST_CASE("Other sites, other hosts and wrong tokens are refused") {
  for (const char* origin : {"http://evil.example", "https://127.0.0.1:4321", "http://127.0.0.1:4322", "null", ""}) {
    RequestHead head = own_head();
    head.origin = origin;
    CHECK(status_of(head) == 403);
  }
  for (const char* host : {"evil.example:4321", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:4321.evil.example", ""}) {
    RequestHead head = own_head();
    head.host = host;
    CHECK(status_of(head) == 421);
  }
  RequestHead head = own_head();
  head.host = std::nullopt;
  CHECK(status_of(head) == 421);
  for (const char* token : {"", "0123456789abcdef0123456789abcdee", "0123456789abcdef", kToken + 1}) {
    head = own_head();
    head.token = token;
    CHECK(status_of(head) == 403);
  }
  head = own_head();
  head.token = std::nullopt;
  CHECK(status_of(head) == 403);
}

TEST_CASE("Bodies need a length within the limit, and no encoding") {
  RequestHead head = own_head();
  head.content_length = std::nullopt;
  CHECK(status_of(head) == 411);
  for (const char* length : {"", "-1", "1e9", "99999999999999999999999999", " 5"}) {
    head.content_length = length;
    CHECK(status_of(head) == 411);
  }
  head.content_length = std::to_string(ServerLimits().most_body);
  CHECK(status_of(head) == 200);
  head.content_length = std::to_string(ServerLimits().most_body + 1);
  CHECK(status_of(head) == 413);
  head = own_head();
  head.has_encoding = true;  // a body that is small when it is packed
  CHECK(status_of(head) == 415);
  head = own_head();
  head.method = "GET";
  CHECK(status_of(head) == 400);
  head = own_head();
  head.method = "DELETE";
  CHECK(status_of(head) == 405);
  head = own_head();
  head.path = std::string(5000, 'a');
  CHECK(status_of(head) == 414);
}

TEST_CASE("Tokens are 32 hexadecimal digits, each time others") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    const std::string token = random_token();
    CHECK(token.size() == 32);
    CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
    tokens.insert(token);
  }
  CHECK(tokens.size() == 100);
}

}  // namespace
}  // namespace nef::studio
