// SPDX-License-Identifier: Apache-2.0
//
// Hashes of what files hold: two files with the same hash are taken for equal.
#pragma once

#include <string>
#include <string_view>

namespace nef {

/// The XXH3 of the bytes with 128 bits, as 32 hexadecimal digits. Not for use against people who forge files.
std::string content_hash(std::string_view bytes);

/// The hash of all bytes of a file. Of a folder: that of the paths and bytes of all files in it and its subfolders,
/// whatever their order on disk. Files are read in blocks, so large ones take no memory. Throws FileError
/// (kUnreadable).
std::string content_hash_of_file(const std::string& path);

}  // namespace nef
