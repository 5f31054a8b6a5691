// SPDX-License-Identifier: Apache-2.0
#include "nef/io/content_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <system_error>

#include "nef/io/file_bytes.h"

namespace nef {
namespace {

namespace fs = std::filesystem;

std::string digits_of(XXH128_hash_t hash) {
  std::array<char, 33> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return digits.data();
}

struct StateDeleter {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

std::string hash_of_regular_file(const std::string& path) {
  const std::unique_ptr<XXH3_state_t, StateDeleter> state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  read_blocks(path, [&](std::string_view block) { XXH3_128bits_update(state.get(), block.data(), block.size()); });
  return digits_of(XXH3_128bits_digest(state.get()));
}

std::string hash_of_folder(const std::string& path) {
  std::set<std::string> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) files.insert(entry->path().string());
  }
  if (error) throw FileError(FileProblem::kUnreadable, path + ": the folder cannot be read (" + error.message() + ")");
  std::string text;
  for (const std::string& file : files) {
    const std::string name = file.substr(path.size());
    text += std::to_string(name.size()) + " " + name + " " + hash_of_regular_file(file) + "\n";
  }
  return content_hash(text);
}

}  // namespace

std::string content_hash(std::string_view bytes) { return digits_of(XXH3_128bits(bytes.data(), bytes.size())); }

std::string content_hash_of_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? hash_of_folder(path) : hash_of_regular_file(path);
}

}  // namespace nef
