// SPDX-License-Identifier: Apache-2.0
//
// Whole files in and out: one read, one write beside the target and a rename.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "nef/base/error.h"

namespace nef {

/// What is wrong with a file, for programs that want to tell the kinds apart.
enum class FileProblem {
  kUnreadable,   ///< missing, a directory, no permission, unknown extension
  kEmpty,        ///< no bytes, or nothing but white space
  kSyntax,       ///< a word that the format does not allow there
  kWrongCount,   ///< the header promises another number of items than there are
  kTruncated,    ///< the file ends in the middle of an item
  kNotANumber,   ///< NaN, infinity, or no number at all
  kBadIndex,     ///< an index that names no element
  kUnsupported,  ///< legal in the format, but nothing that this library can hold
};

/// "bad index", "not a number", ...
const char* name(FileProblem problem);

/// The element of a mesh that a file gets wrong, if it is one; counted from 0, whatever the format counts from.
struct FileElement {
  enum class Kind : std::uint8_t { kNone, kVertex, kFace };
  Kind kind = Kind::kNone;
  std::size_t index = 0;
  static FileElement vertex(std::size_t index) { return {Kind::kVertex, index}; }
  static FileElement face(std::size_t index) { return {Kind::kFace, index}; }
};

/// An InputError with the kind of the problem. what() is "path:line: what is wrong; how to mend it".
class FileError : public InputError {
 public:
  FileError(FileProblem problem, const std::string& what, FileElement element = {})
      : InputError(what), problem_(problem), element_(element) {}
  [[nodiscard]] FileProblem problem() const { return problem_; }
  [[nodiscard]] FileElement element() const { return element_; }

 private:
  FileProblem problem_;
  FileElement element_;
};

/// Throws FileError (kUnreadable) unless the path names a regular file that may be read (most_bytes_read), or what is
/// open as standard input, as /dev/stdin does: reading devices and named pipes may never end. For code that has another
/// library read the file; the functions below ask it themselves.
void require_readable_file(const std::string& path);

/// The most bytes that are read from a file or from standard input: a quarter of the memory of the machine.
std::size_t most_bytes_read();

/// All bytes of a regular file, or of standard input for "-" and for what names it, such as /dev/stdin. Throws
/// FileError (kUnreadable, kEmpty), also for files of more than most_bytes_read().
std::string read_file(const std::string& path);

/// The same bytes, block after block in order, without keeping them; an empty file is none.
void read_blocks(const std::string& path, const std::function<void(std::string_view block)>& sink);

/// The extension of a path in lower case without the dot; empty if there is none.
std::string lower_extension(const std::string& path);

/// Makes a folder and those around it, if it is not there. Throws FileError (kUnreadable).
void make_folder(const std::string& path);

/// Writes `bytes` to a new file beside `path` that gets its name when it is whole, so that readers see the old file or
/// the whole new one. The new file has no name while it is written, where the file system can do that (O_TMPFILE);
/// elsewhere it is called .NAME.partial, and what a killed run left under that name is used again. It keeps the
/// permissions of the file that it replaces. A symbolic link stays and its target is written; a device such as
/// /dev/stdout is written directly, and "-" is standard output. Throws FileError (kUnreadable).
void write_file(const std::string& path, std::string_view bytes);

}  // namespace nef
