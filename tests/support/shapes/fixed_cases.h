// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <functional>
#include <sstream>
#include <string>

namespace nef::test {

/// How many of so many cases are tried: all; under the sanitizers, where each takes some twenty times as long, a fifth.
constexpr unsigned fewer(unsigned cases) {
#ifdef NEF_SANITIZED
  return (cases + 4) / 5;
#else
  return cases;
#endif
}

/// Checks a property in a fixed number of cases: few of large sets say more than many of small ones, and the time stays
/// within bounds. Under the sanitizers, where each takes some twenty times as long, in a twentieth of them.
inline void check(const std::string& what, int cases, const std::function<void()>& property) {
  rc::detail::TestParams parameters = rc::detail::configuration().testParams;
#ifdef NEF_SANITIZED
  cases = (cases + 19) / 20;
#endif
  parameters.maxSuccess = cases;
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata{what, what}, parameters);
  INFO(what);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  INFO(text.str());
  CHECK(result.is<rc::detail::SuccessResult>());
}

}  // namespace nef::test
