// SPDX-License-Identifier: Apache-2.0
//
// What subcommands on photographs have in common: the files that words name, and folders that are made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nef::visual_hull {

/// The photographs that words name: files, and folders for all images in them, in the order of list_images.
std::vector<std::filesystem::path> photographs_of(const std::vector<std::string>& words);

/// Makes a folder if it is not there. Throws InputError, with `option` in front.
void make_folder(const std::string& option, const std::filesystem::path& folder);

}  // namespace nef::visual_hull
