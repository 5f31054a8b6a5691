// SPDX-License-Identifier: Apache-2.0
//
// Running the command `planner` as users do.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/paths.h"

namespace nef::planner::test {

/// A folder of its own that goes away with the test.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("planner_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator{}));
  }

 private:
  std::filesystem::path path_;
};

/// What is in a file.
inline std::string text_of(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What a run of the program left.
struct Run {
  int code;
  std::string out;
  std::string err;
};

/// Runs the program with these arguments, as a shell reads them.
inline Run planner(const Folder& folder, const std::string& arguments) {
  const std::string command =
      program_folder() + "/planner " + arguments + " > " + folder.file("out") + " 2> " + folder.file("err");
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), text_of(folder.file("out")), text_of(folder.file("err"))};
}

/// The path of a scene of data/planner.
inline std::string scene(const std::string& name) { return source_folder() + "/data/planner/" + name + ".json"; }

}  // namespace nef::planner::test
