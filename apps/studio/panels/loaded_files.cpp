// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/loaded_files.h"

#include <algorithm>

#include "nef/io/polyhedron_file.h"

namespace nef::studio {

Polyhedron LoadedFiles::load(const std::string& path, const Monitor& monitor, Messages& messages) {
  namespace fs = std::filesystem;
  Entry entry{.path = path, .written = {}, .bytes = 0, .set = {}, .messages = {}};
  std::error_code error;
  const std::string file = fs::exists(path, error) ? path : path.substr(0, path.rfind('#'));
  entry.written = fs::last_write_time(file, error);
  entry.bytes = fs::file_size(file, error);
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&entry](const Entry& e) {
      return e.path == entry.path && e.written == entry.written && e.bytes == entry.bytes;
    });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
      messages.insert(messages.end(), found->messages.begin(), found->messages.end());
      return found->set;
    }
  }
  MeshOptions options{.crossings = Crossings::kUnion, .monitor = monitor};
  entry.set = read_polyhedron(path, options, &entry.messages);
  messages.insert(messages.end(), entry.messages.begin(), entry.messages.end());
  Polyhedron set = entry.set;
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&path](const Entry& e) { return e.path == path; });
  entries_.push_front(std::move(entry));
  if (entries_.size() > kMost) entries_.pop_back();
  return set;
}

}  // namespace nef::studio
