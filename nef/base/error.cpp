// SPDX-License-Identifier: Apache-2.0
#include "nef/base/error.h"

namespace nef::detail {

void assertion_failed(const char* condition, const char* file, int line) {
  throw std::logic_error(std::string("internal error, please report: invariant ") + condition + " broken at " + file +
                         ":" + std::to_string(line));
}

}  // namespace nef::detail
