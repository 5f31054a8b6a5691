// SPDX-License-Identifier: Apache-2.0
//
// Zip archives in memory, through libzip.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nef/io/bounded_process.h"

namespace nef {

/// The files in the bytes of a zip archive. Throws FileError for bytes that are none.
class ZipArchive {
 public:
  /// `bytes` and `path`, which is for error messages only, must outlive the archive. `seconds`: see read.
  ZipArchive(std::string_view bytes, const std::string& path, unsigned seconds);
  ZipArchive(std::string_view bytes, const std::string& path)
      : ZipArchive(bytes, path, parser_limits(bytes.size()).seconds) {}
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  [[nodiscard]] bool contains(const std::string& name) const;

  /// Gives the file of this name to `sink`, piece after piece in order. Throws FileError if there is none, if it is
  /// damaged (its checksum differs), encrypted, or packed by another method than deflate, or if all that was read from
  /// this archive is more than kMostGrowth times the archive, 64 MiB at least: such archives are made to exhaust
  /// memory. Throws it, too, if this thread has used more than `seconds` of processor time since the archive was
  /// opened, be it here or in `sink`.
  void read(const std::string& name, const std::function<void(std::string_view piece)>& sink);

  static constexpr std::size_t kMostGrowth = 200;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  std::size_t left_;  // bytes that may still be read
  unsigned seconds_;
  std::chrono::nanoseconds begin_;  // of processor time
};

/// A zip archive with these files (name and content), the same bytes for the same files at any time.
std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace nef
