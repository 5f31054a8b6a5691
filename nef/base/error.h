// SPDX-License-Identifier: Apache-2.0
//
// The one family of exceptions that this library throws. What went wrong is in what() as one
// line fit for a user: what, where in the file, how to mend it. Broken invariants of the library
// itself are not reported this way: they are assertions (NEF_ASSERT).
#pragma once

#include <stdexcept>
#include <string>

namespace nef {

/// Base of every exception of the suite: bad data or bad use, never a bug.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input (a file, a mesh, a number, an expression) cannot mean what it should.
class InputError : public Error {
 public:
  using Error::Error;
};

/// The request is well formed but cannot be represented: an unbounded solid as a mesh, say.
class UnsupportedError : public Error {
 public:
  using Error::Error;
};

namespace detail {
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);
}  // namespace detail

}  // namespace nef

/// A broken invariant of the library. On unless NEF_NO_ASSERTIONS is defined; every check behind
/// it is O(1) beside the work around it.
#ifdef NEF_NO_ASSERTIONS
// Never evaluated, but still compiled: what only an assertion reads stays used.
#define NEF_ASSERT(condition) (false ? static_cast<void>(condition) : static_cast<void>(0))
#else
#define NEF_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::nef::detail::assertion_failed(#condition, __FILE__, __LINE__))
#endif
