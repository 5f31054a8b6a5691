// SPDX-License-Identifier: Apache-2.0
//
// What --version prints: the program's version and commit, and the libraries that it runs with.
#pragma once

#include <string>
#include <vector>

namespace nef {

/// Three lines: "PROGRAM VERSION (commit COMMIT)", the libraries (GMP and oneTBB as found at run time, and `more`), and
/// the compiler. The commit is that of the build, with "-dirty" if sources differed from it, and left out if they were
/// not in a repository.
std::string version_text(const std::string& program, const std::vector<std::string>& more = {});

}  // namespace nef
