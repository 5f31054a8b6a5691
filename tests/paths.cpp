// SPDX-License-Identifier: Apache-2.0
#include "tests/support/paths.h"

const std::string& source_folder() {
  static const std::string folder = NEF_SOURCE_DIR;
  return folder;
}

const std::string& program_folder() {
  static const std::string folder = NEF_BINARY_DIR;
  return folder;
}
