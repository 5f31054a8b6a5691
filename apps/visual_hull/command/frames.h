// SPDX-License-Identifier: Apache-2.0
//
// Video from files: one hull a frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/visual_hull/command/arguments.h"

namespace visual_hull {

/// A path with a place for a number: "frame_%04d/" or "hull_%d.ply".
class NumberedPath {
 public:
  /// Throws InputError, with `option` in front, unless there is exactly one %d or %0Nd.
  NumberedPath(const std::string& pattern, const std::string& option);

  /// The path of a number that is not negative.
  [[nodiscard]] std::filesystem::path of(std::size_t number) const { return with(digits(number)); }

  /// The path with a word in place of the number.
  [[nodiscard]] std::filesystem::path with(const std::string& word) const;

  /// The numbers for which the path exists, in their order.
  [[nodiscard]] std::vector<std::size_t> existing() const;

 private:
  [[nodiscard]] std::string digits(std::size_t number) const;

  std::string before_, after_;
  std::size_t width_ = 0;
};

/// The hulls of all frames that --frames names, on all threads frame by frame. A manifest beside them, of one JSON
/// value a line (first the settings, then a line a frame as it is done), says what was made from what; frames whose
/// line has the same settings and images, and whose output is there, are not made again. A frame that fails does not
/// stop the others. Returns the exit code: 0, 1 if a hull is empty or flat or not inside its views, 2 if a frame could
/// not be computed. Throws InputError for options that do not go together, or if there is no frame.
int make_frames(const Arguments& arguments);

}  // namespace visual_hull
