// SPDX-License-Identifier: Apache-2.0
#include "apps/program/version.h"

#include <gmp.h>
#include <oneapi/tbb/version.h>

#include <CLI/Version.hpp>

#include "nef/version.h"
#include "nef_commit.h"  // made by cmake/Commit.cmake

namespace nef {

std::string version_text(const std::string& program, const std::vector<std::string>& more) {
  const std::string commit = NEF_COMMIT;
  std::string text = program + " " NEF_VERSION + (commit.empty() ? "" : " (commit " + commit + ")");
  text +=
      std::string("\nlibraries: GMP ") + gmp_version + ", oneTBB " + TBB_runtime_version() + ", CLI11 " CLI11_VERSION;
  for (const std::string& library : more) text += ", " + library;
#ifdef __clang__
  return text + "\ncompiler: " __VERSION__;
#else
  return text + "\ncompiler: GCC " __VERSION__;
#endif
}

}  // namespace nef
