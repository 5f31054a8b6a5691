// SPDX-License-Identifier: Apache-2.0
//
// The program `minkowski`: sums, decompositions and configuration spaces of sets in files. The work
// is in the library and in command/; here errors become one line on stderr and the exit code 2.
#include <iostream>
#include <new>

#include "apps/minkowski/command/run.h"
#include "nef/base/error.h"

namespace {

int complain(const std::string& line) {
  std::cerr << "minkowski: " << line << "\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Exact Minkowski sums of any two polyhedral sets: minkowski A B -o OUT");
  app.name("minkowski");
  app.set_version_flag("--version", std::string("minkowski ") + NEF_VERSION);
  app.footer("Exit codes: 0 done, 2 bad input or usage.");
  nef::minkowski::Arguments arguments;
  nef::minkowski::declare(app, arguments);
  try {
    app.parse(argc, argv);
    nef::minkowski::run(arguments);
    std::cout.flush();
    return std::cout ? 0 : complain("stdout cannot be written to");
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" with the code 0.
    if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);
    return complain(std::string(error.what()) + " (see minkowski --help)");
  } catch (const nef::Error& error) {
    return complain(error.what());
  } catch (const std::bad_alloc&) {
    return complain("out of memory");
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what());
  }
}
