// SPDX-License-Identifier: Apache-2.0
//
// Readers under libFuzzer, in one program: `fuzz_readers --format=off FOLDER -max_total_time=60` looks for bytes that
// make the reader of a format crash, hang or break a promise, and leaves what it learns in FOLDER;
// `fuzz_readers --format=off FILE` runs one file. --examples=FOLDER writes a legal file of every format and stops.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz/formats.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/io/file_bytes.h"

namespace {

const nef::fuzz::Format* chosen = nullptr;

[[noreturn]] void usage() {
  std::fputs("fuzz_readers: --format=NAME or --examples=FOLDER, with one of these names:\n", stderr);
  for (const nef::fuzz::Format& format : nef::fuzz::formats()) std::fprintf(stderr, "  %s\n", format.name.c_str());
  std::exit(2);
}

[[noreturn]] void write_examples(const std::string& folder) {
  const nef::Polyhedron set = nef::unite(nef::make_box({0, 0, 0}, {2, 1, 1}), nef::make_point({3, 0, 0}));
  for (const nef::fuzz::Format& format : nef::fuzz::formats()) {
    nef::write_file(folder + "/" + std::string(format.name), format.write(set, "box(0,0,0,2,1,1) + point(3,0,0)"));
  }
  std::exit(0);
}

}  // namespace

// libFuzzer calls it once, and ignores arguments that begin with "--".
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    if (argument.starts_with("--examples=")) write_examples(std::string(argument.substr(11)));
    if (!argument.starts_with("--format=")) continue;
    for (const nef::fuzz::Format& format : nef::fuzz::formats()) {
      if (format.name == argument.substr(9)) chosen = &format;
    }
  }
  if (chosen == nullptr) usage();
  return 0;
}

// Whatever is no Error ends the program, which is what libFuzzer looks for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    chosen->read(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const nef::Error&) {
  }
  return 0;
}
