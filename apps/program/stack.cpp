// SPDX-License-Identifier: Apache-2.0
#include "apps/program/stack.h"

#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "nef/base/error.h"

namespace nef {
namespace {

constexpr rlim_t kUsual = rlim_t{8} << 20U;
// Twice of what expressions and models take that are nested as deeply as they may be.
constexpr rlim_t kLeast = rlim_t{4} << 20U;

// The limit of the main thread, whose stack grows up to what the limit is at that time.
rlim_t raised_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUsual;
  if (limit.rlim_cur >= kUsual) return limit.rlim_cur;
  rlimit raised{kUsual, limit.rlim_max == RLIM_INFINITY ? limit.rlim_max : std::max(kUsual, limit.rlim_max)};
  if (setrlimit(RLIMIT_STACK, &raised) == 0) return kUsual;
  raised = {limit.rlim_max, limit.rlim_max};  // only a superuser may raise that one
  return setrlimit(RLIMIT_STACK, &raised) == 0 ? raised.rlim_cur : limit.rlim_cur;
}

// Other threads take what the limit was when the program began.
void raise_stack_of_threads() {
  pthread_attr_t attributes;
  std::size_t size = 0;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  if (pthread_attr_getstacksize(&attributes, &size) == 0 && size < kUsual &&
      pthread_attr_setstacksize(&attributes, kUsual) == 0) {
    pthread_setattr_default_np(&attributes);
  }
  pthread_attr_destroy(&attributes);
}

}  // namespace

void require_stack() {
  const rlim_t limit = raised_limit();
  raise_stack_of_threads();
  if (limit < kLeast) {
    throw Error("the stack of this process is limited to " + std::to_string(limit >> 10U) + " KB, but " +
                std::to_string(kLeast >> 10U) + " KB are needed; raise the limit (ulimit -s 8192)");
  }
}

}  // namespace nef
