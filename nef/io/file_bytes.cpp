// SPDX-License-Identifier: Apache-2.0
#include "nef/io/file_bytes.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

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

// An open file that is closed, and gives up its locks, with the object.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  [[nodiscard]] int get() const { return value_; }
  explicit operator bool() const { return value_ >= 0; }

 private:
  int value_;
};

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(path, "cannot be written (" + last_error() + ")");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Where a chain of symbolic links ends, which need not exist.
fs::path behind_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel allows
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

// Writes a new file beside its target and gives it the target's name.
class Replacement {
 public:
  Replacement(const std::string& path, const std::string& target)
      : path_(path), target_(target), folder_(target_.parent_path().empty() ? "." : target_.parent_path()) {
    const std::string name = target_.filename().string();
    constexpr std::size_t kLongest = 240;  // of the 255 bytes that a name may have
    partial_ = folder_ / ("." + name.substr(0, kLongest) + ".partial");
  }

  void write(std::string_view bytes) {
    drop_partial_of_dead();
    Descriptor file(open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    const bool unnamed = static_cast<bool>(file);
    if (!unnamed) file = create_named();
    try {
      write_all(file.get(), bytes, path_);
      if (unnamed && link(file.get(), target_)) return;
      if (unnamed) name_it(file.get());
      if (std::rename(partial_.c_str(), target_.c_str()) != 0) refuse_to_replace();
    } catch (...) {
      if (named_) unlink(partial_.c_str());
      throw;
    }
  }

 private:
  [[noreturn]] void refuse_to_replace() const { refuse(path_, "cannot be replaced (" + last_error() + ")"); }

  // Who writes a partial file holds a lock on it; nobody does if the writer was killed.
  void drop_partial_of_dead() const {
    const Descriptor left(open(partial_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW));
    if (left && flock(left.get(), LOCK_EX | LOCK_NB) == 0) unlink(partial_.c_str());
  }

  static bool link(int descriptor, const fs::path& to) {
    const std::string self = "/proc/self/fd/" + std::to_string(descriptor);
    return linkat(AT_FDCWD, self.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0;
  }

  // Another name, for when somebody else writes the same file at this moment.
  void use_other_name() {
    const fs::path usual = partial_;
    static std::atomic<unsigned> counter{0};
    partial_ = usual.string() + "-" + std::to_string(getpid()) + "-" + std::to_string(++counter);
  }

  // A name beside the target, since links cannot replace files.
  void name_it(int descriptor) {
    flock(descriptor, LOCK_EX | LOCK_NB);
    named_ = link(descriptor, partial_);
    if (!named_ && errno == EEXIST) {
      use_other_name();
      named_ = link(descriptor, partial_);
    }
    if (!named_) refuse_to_replace();
  }

  Descriptor create_named() {
    Descriptor file(open(partial_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
    if (!file && errno == EEXIST) {
      use_other_name();
      file = Descriptor(open(partial_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
    }
    if (!file) refuse(path_, "cannot be written (" + last_error() + "); does its folder exist?");
    named_ = true;
    flock(file.get(), LOCK_EX | LOCK_NB);
    return file;
  }

  const std::string& path_;  // as the user gave it
  fs::path target_;
  fs::path folder_;
  fs::path partial_;
  bool named_ = false;
};

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
  const File file(path == "-" ? fdopen(dup(STDIN_FILENO), "rb") : std::fopen(path.c_str(), "rb"));
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
  if (path == "-") {
    write_all(STDOUT_FILENO, bytes, "standard output");
    return;
  }
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) refuse(path, "is a directory; name a file in it");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    const Descriptor device(open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!device) refuse(path, "cannot be opened for writing (" + last_error() + ")");
    write_all(device.get(), bytes, path);
    return;
  }
  Replacement(path, behind_links(path).string()).write(bytes);
}

}  // namespace nef
