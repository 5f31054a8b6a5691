// SPDX-License-Identifier: Apache-2.0
//
// A folder that goes away.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace nef::visual_hull::testing {

/// A fresh folder for one test, removed at its end.
class Scratch {
 public:
  Scratch() {
    static int counter = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("visual_hull_test_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace nef::visual_hull::testing
