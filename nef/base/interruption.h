// SPDX-License-Identifier: Apache-2.0
//
// How a long computation ends that was stopped from outside: by the thread that waits for it, a user interface, a
// signal.
#pragma once

#include "nef/base/error.h"

namespace nef {

/// Thrown out of a computation that was stopped (nef/base/monitor.h). Nothing is left half done: results are made whole
/// or not at all.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace nef
