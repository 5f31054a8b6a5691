// SPDX-License-Identifier: Apache-2.0
#include "nef/io/native/binary_file.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>

#include "nef/io/file_bytes.h"
#include "nef/io/native/native_binary.h"

namespace nef {

BinaryFile::BinaryFile(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {
  const std::size_t least = kNativeMagic.size() + 14 * sizeof(std::uint32_t) + sizeof(std::uint64_t);
  if (bytes_.size() < least) {
    throw FileError(FileProblem::kTruncated, path_ + ": the file ends early; it is truncated");
  }
  at_ = kNativeMagic.size();
  const auto version = column<std::uint32_t>(1)[0];
  if (version != kNativeBinaryVersion) {
    throw FileError(FileProblem::kUnsupported, path_ + ": the file has version " + std::to_string(version) +
                                                   " of the binary form; this program reads version 1");
  }
  const std::size_t end = bytes_.size() - sizeof(std::uint64_t);
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes_.data() + end, sizeof(checksum));
  if (checksum != XXH3_64bits(bytes_.data(), end)) {
    throw FileError(FileProblem::kSyntax, path_ + ": the file is damaged or truncated: its checksum does not match");
  }
  bytes_ = bytes_.substr(0, end);
  width_ = column<std::uint32_t>(1)[0];
  demand(width_ == 1 || width_ == 2 || width_ == 4, "an index has neither 1, 2 nor 4 bytes");
  const auto counts = column<std::uint32_t>(12);
  std::size_t i = 0;
  for (std::uint32_t* count :
       {&counts_.planes, &counts_.vertices, &counts_.svertices, &counts_.shalfedges, &counts_.sloops, &counts_.sfaces,
        &counts_.entries, &counts_.facets, &counts_.cycles, &counts_.isolated, &counts_.shells, &counts_.volumes}) {
    *count = counts[i++];
    // Every item takes a byte at least, so that nothing larger than the file is ever made.
    demand(*count <= bytes_.size(), "its numbers of items do not fit its length");
  }
}

void BinaryFile::corrupt(const std::string& what) const {
  throw FileError(FileProblem::kSyntax, path_ + ": the file is not a valid polyhedron: " + what);
}

}  // namespace nef
