// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/photographs.h"

#include <system_error>

#include "apps/visual_hull/scene/images.h"
#include "nef/base/error.h"

namespace nef::visual_hull {

namespace fs = std::filesystem;

std::vector<fs::path> photographs_of(const std::vector<std::string>& words) {
  std::vector<fs::path> files;
  for (const std::string& path : words) {
    if (std::error_code unknown; !fs::is_directory(path, unknown)) {
      files.emplace_back(path);
      continue;
    }
    for (fs::path& file : list_images(path)) files.push_back(std::move(file));
  }
  return files;
}

void make_folder(const std::string& option, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error))
    throw nef::InputError(option + ": cannot make the directory " + folder.string());
}

}  // namespace nef::visual_hull
