// SPDX-License-Identifier: Apache-2.0
#include "nef/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

namespace nef {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw FileError(FileProblem::kUnreadable, path + ": " + what);
}

std::string last_error() { return std::generic_category().message(errno); }

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

void write_all(std::FILE* file, std::string_view bytes, const std::string& path) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fflush(file) != 0) {
    refuse(path, "cannot be written (" + last_error() + ")");
  }
}

}  // namespace

const char* name(FileProblem problem) {
  switch (problem) {
    case FileProblem::kUnreadable:
      return "unreadable file";
    case FileProblem::kEmpty:
      return "empty file";
    case FileProblem::kSyntax:
      return "syntax error";
    case FileProblem::kWrongCount:
      return "wrong count";
    case FileProblem::kTruncated:
      return "truncated file";
    case FileProblem::kNotANumber:
      return "not a number";
    case FileProblem::kBadIndex:
      return "bad index";
    case FileProblem::kUnsupported:
      return "unsupported content";
  }
  return "unknown problem";
}

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension;
}

std::string read_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) refuse(path, "is a directory; name a file in it");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    refuse(path, errno == ENOENT ? "no such file; check the path" : "cannot be opened (" + last_error() + ")");
  }
  std::string bytes;
  const auto size = fs::file_size(path, ignored);
  if (!ignored) bytes.reserve(static_cast<std::size_t>(size) + 1);
  ignored.clear();
  constexpr std::size_t kBlock = std::size_t{1} << 16U;
  for (;;) {
    const std::size_t old = bytes.size();
    const std::size_t want = std::max(kBlock, bytes.capacity() - old);
    bytes.resize(old + want);
    const std::size_t got = std::fread(bytes.data() + old, 1, want, file.get());
    bytes.resize(old + got);
    if (got < want) break;
  }
  if (std::ferror(file.get()) != 0) refuse(path, "cannot be read (" + last_error() + ")");
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw FileError(FileProblem::kEmpty, path + ": the file is empty");
  }
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) refuse(path, "is a directory; name a file in it");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    const File device(std::fopen(path.c_str(), "wb"));
    if (!device) refuse(path, "cannot be opened for writing (" + last_error() + ")");
    write_all(device.get(), bytes, path);
    return;
  }
  std::string temporary = path + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) refuse(path, "cannot be written (" + last_error() + "); does its folder exist?");
  // mkstemp makes files that only their owner may read; a result gets the ordinary rights.
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  try {
    File file(fdopen(descriptor, "wb"));
    if (!file) refuse(path, "cannot be written (" + last_error() + ")");
    write_all(file.get(), bytes, path);
    if (std::fclose(file.release()) != 0) refuse(path, "cannot be written (" + last_error() + ")");
    if (std::rename(temporary.c_str(), path.c_str()) != 0) refuse(path, "cannot be replaced (" + last_error() + ")");
  } catch (...) {
    std::remove(temporary.c_str());
    throw;
  }
}

}  // namespace nef
