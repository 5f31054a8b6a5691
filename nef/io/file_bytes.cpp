// SPDX-License-Identifier: Apache-2.0
//
// Reading: a path is looked at before it is opened, since opening a named pipe may wait for ever, and again afterwards,
// since it may have been replaced meanwhile. Standard input is whatever has its device and inode, whatever its name.
//
// Writing: the new file has no name (O_TMPFILE) until it is whole. A link gives it the target's name if there is no
// such file yet; links replace nothing, so an existing file is replaced by a link to .NAME.partial and a rename. A
// writer holds a lock on its partial file, so an unlocked one belongs to a run that was killed, and is removed.
#include "nef/io/file_bytes.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace nef {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw FileError(FileProblem::kUnreadable, path + ": " + what);
}

std::string last_error() { return std::generic_category().message(errno); }

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

[[noreturn]] void refuse_kind(const std::string& path) {
  refuse(path, "is a device or a pipe, which may never end; name a regular file, or use standard input ('-')");
}

[[noreturn]] void refuse_size(const std::string& path) {
  refuse(path, "is larger than a quarter of the memory of this machine (" + std::to_string(most_bytes_read() >> 20U) +
                   " MB), the limit; use a machine with more memory, or a smaller file");
}

// Standard input may be a pipe, a socket or a terminal; of other devices (/dev/zero) nobody wants to read all.
bool is_wanted_as_input(const struct stat& about, int descriptor) {
  return !S_ISCHR(about.st_mode) || isatty(descriptor) != 0 || about.st_rdev == makedev(1, 3);  // /dev/null
}

Descriptor open_standard_input(const std::string& path) {
  struct stat about {};
  if (fstat(STDIN_FILENO, &about) != 0) refuse(path, "standard input is closed; name a file");
  if (S_ISDIR(about.st_mode)) refuse(path, "standard input is a directory; name a file in it");
  if (!is_wanted_as_input(about, STDIN_FILENO)) refuse_kind(path);
  return Descriptor(fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0));
}

// Whether a path names what is open as standard input, as /dev/stdin and /proc/self/fd/0 do.
bool names_standard_input(const struct stat& about) {
  struct stat input {};
  return !S_ISREG(about.st_mode) && fstat(STDIN_FILENO, &input) == 0 && input.st_dev == about.st_dev &&
         input.st_ino == about.st_ino;
}

// A file that may be read; what else there is is not even opened, since that may wait for ever.
Descriptor open_for_reading(const std::string& path) {
  if (path == "-") return open_standard_input(path);
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) {
    refuse(path, errno == ENOENT ? "no such file; check the path" : "cannot be opened (" + last_error() + ")");
  }
  if (S_ISDIR(about.st_mode)) refuse(path, "is a directory; name a file in it");
  if (names_standard_input(about)) return open_standard_input(path);
  if (!S_ISREG(about.st_mode)) refuse_kind(path);
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // it may have become a pipe meanwhile
  if (!file) refuse(path, "cannot be opened (" + last_error() + ")");
  if (fstat(file.get(), &about) != 0 || !S_ISREG(about.st_mode)) refuse_kind(path);
  if (static_cast<std::uintmax_t>(about.st_size) > most_bytes_read()) refuse_size(path);
  return file;
}

// Fills the block unless the file ends; returns how many bytes there were.
std::size_t read_some(int descriptor, char* block, std::size_t size, const std::string& path) {
  std::size_t count = 0;
  while (count < size) {
    const ssize_t got = ::read(descriptor, block + count, size - count);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, "cannot be read (" + last_error() + ")");
    if (got == 0) break;
    count += static_cast<std::size_t>(got);
  }
  return count;
}

constexpr std::size_t kBlock = std::size_t{1} << 16U;

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
      keep_permissions(file.get());
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

  // Those of the file that is replaced: what only its owner may read stays so. Before anything is written.
  void keep_permissions(int descriptor) const {
    struct stat old {};
    struct stat fresh {};
    constexpr mode_t kPermissions = 0777;
    if (stat(target_.c_str(), &old) != 0 || fstat(descriptor, &fresh) != 0) return;
    if (((old.st_mode ^ fresh.st_mode) & kPermissions) == 0) return;  // where a file system knows only one kind, too
    if (fchmod(descriptor, old.st_mode & kPermissions) != 0) {
      refuse(path_, "cannot be given the permissions of the file that it replaces (" + last_error() + ")");
    }
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

void require_readable_file(const std::string& path) { static_cast<void>(open_for_reading(path)); }

std::size_t most_bytes_read() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGESIZE);
  constexpr std::size_t kUnknown = std::size_t{1} << 33U;
  return pages <= 0 || page <= 0 ? kUnknown : static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) / 4;
}

std::string read_file(const std::string& path) {
  const Descriptor file = open_for_reading(path);
  std::string bytes;
  struct stat about {};
  if (fstat(file.get(), &about) == 0 && S_ISREG(about.st_mode)) {
    bytes.reserve(static_cast<std::size_t>(about.st_size) + 1);
  }
  const std::size_t most = most_bytes_read();
  for (;;) {
    const std::size_t old = bytes.size();
    if (old > most) refuse_size(path);
    const std::size_t want = std::max(kBlock, bytes.capacity() - old);
    bytes.resize(old + want);
    const std::size_t got = read_some(file.get(), bytes.data() + old, want, path);
    bytes.resize(old + got);
    if (got < want) break;
  }
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw FileError(FileProblem::kEmpty, path + ": the file is empty");
  }
  return bytes;
}

void read_blocks(const std::string& path, const std::function<void(std::string_view)>& sink) {
  const Descriptor file = open_for_reading(path);
  std::string block(kBlock, '\0');
  for (;;) {
    const std::size_t got = read_some(file.get(), block.data(), block.size(), path);
    sink(std::string_view(block).substr(0, got));
    if (got < block.size()) return;
  }
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

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw FileError(FileProblem::kUnreadable, path + ": the folder cannot be created (" + error.message() + ")");
  }
}

}  // namespace nef
