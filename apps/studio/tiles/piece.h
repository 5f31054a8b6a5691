// SPDX-License-Identifier: Apache-2.0
//
// Parts of what is drawn that stay as they are from one computation to the next, so that a page gets each of them once.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "nef/polyhedron.h"

namespace nef::studio {

/// One layer, or a part of it.
struct Piece {
  std::uint64_t id = 0;                      ///< of no other piece of this program, ever
  std::shared_ptr<const std::string> scene;  ///< as page_scene writes it, with one layer and without details
  Polyhedron source;                         ///< that the indices of its items refer to
};

/// Gives numbers, each once. Any number of threads may ask.
class PieceNumbers {
 public:
  std::uint64_t next() { return ++last_; }

 private:
  std::atomic<std::uint64_t> last_ = 0;
};

}  // namespace nef::studio
