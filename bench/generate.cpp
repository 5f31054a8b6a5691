// SPDX-License-Identifier: Apache-2.0
//
// nef_bench_generate DIRECTORY CASE...: writes each case into a folder of its name.
#include <cstdio>
#include <exception>

#include "bench/generators.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: nef_bench_generate DIRECTORY CASE...\n");
    return 2;
  }
  try {
    for (int i = 2; i < argc; ++i) {
      nef::bench::write_case(nef::bench::make_case(argv[i]), std::string(argv[1]) + "/" + argv[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nef_bench_generate: %s\n", error.what());
    return 2;
  }
  return 0;
}
