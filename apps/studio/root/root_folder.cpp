// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/root/root_folder.h"

#include <algorithm>
#include <system_error>

#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestFolder = 4;

bool is_hidden(const fs::path& name) { return name.string().starts_with('.'); }

bool is_below(const fs::path& path, const fs::path& root) {
  const auto [in_root, in_path] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return in_root == root.end();
}

}  // namespace

RootFolder::RootFolder(const fs::path& folder) {
  std::error_code error;
  path_ = fs::canonical(folder, error);
  if (error || !fs::is_directory(path_, error)) {
    throw InputError(folder.string() + ": there is no such folder; give one with --root");
  }
}

fs::path RootFolder::inside(const std::string& name, const std::string& folder) const {
  const auto refuse = [&name] {
    return InputError(name + ": this is not below the folder that the studio was started with (--root)");
  };
  if (name.empty()) throw InputError("the name of the file is empty");
  if (name.find('\0') != std::string::npos || name.size() > 1000) throw InputError("the name of the file is none");
  const fs::path relative = fs::path(folder) / name;
  if (fs::path(name).is_absolute() || fs::path(folder).is_absolute()) throw refuse();
  // ".." in the name is judged by where it leads, as links are.
  std::error_code error;
  fs::path found = fs::weakly_canonical(path_ / relative, error);
  if (error || !is_below(found, path_)) throw refuse();
  return found;
}

fs::path RootFolder::file(const std::string& name, const std::string& folder) const {
  fs::path found = inside(name, folder);
  std::error_code error;
  if (!fs::is_regular_file(found, error)) throw InputError(name + ": there is no such file below the studio's folder");
  return found;
}

fs::path RootFolder::target(const std::string& name) const {
  fs::path found = inside(name, {});
  std::error_code error;
  if (is_hidden(found.filename())) throw InputError(name + ": hidden files are not written");
  if (!fs::is_directory(found.parent_path(), error)) throw InputError(name + ": its folder is not there");
  if (fs::exists(found, error) && !fs::is_regular_file(found, error)) throw InputError(name + ": this is not a file");
  return found;
}

std::string RootFolder::mesh(const std::string& name, const std::string& folder) const {
  std::error_code error;
  const std::size_t mark = name.rfind('#');
  if (mark == std::string::npos || fs::exists(inside(name, folder), error)) return file(name, folder).string();
  return file(name.substr(0, mark), folder).string() + name.substr(mark);
}

std::string RootFolder::read(const std::string& name, std::size_t most) const {
  const fs::path found = file(name);
  std::error_code error;
  if (fs::file_size(found, error) > most) {
    throw InputError(name + ": the file has more than " + std::to_string(most >> 20U) + " MiB");
  }
  return fs::file_size(found, error) == 0 ? std::string() : read_file(found.string());
}

void RootFolder::write(const std::string& name, std::string_view bytes) const {
  write_file(target(name).string(), bytes);
}

std::vector<RootFile> RootFolder::list(std::size_t most) const {
  std::vector<RootFile> files;
  std::error_code error;
  fs::recursive_directory_iterator at(path_, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (files.size() >= 20 * most) break;  // before they are sorted
    std::error_code ignored;
    if (is_hidden(at->path().filename())) {
      at.disable_recursion_pending();
    } else if (at->is_directory(ignored)) {
      if (at.depth() >= kDeepestFolder) at.disable_recursion_pending();
    } else if (!at->is_symlink(ignored) && at->is_regular_file(ignored)) {
      files.push_back({at->path().lexically_relative(path_).generic_string(), at->file_size(ignored)});
    }
  }
  std::sort(files.begin(), files.end(), [](const RootFile& a, const RootFile& b) { return a.name < b.name; });
  if (files.size() > most) files.resize(most);
  return files;
}

}  // namespace nef::studio
