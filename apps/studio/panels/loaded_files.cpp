// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/panels/loaded_files.h"

#include <filesystem>
#include <optional>

#include "nef/io/polyhedron_file.h"

namespace nef::studio {

Polyhedron LoadedFiles::load(const std::string& path, const Monitor& monitor, Messages& messages) {
  namespace fs = std::filesystem;
  std::error_code error;
  const std::string file = fs::exists(path, error) ? path : path.substr(0, path.rfind('#'));
  std::optional<Value> value = used_.find(path);
  if (!value) {
    const FileState state(file);
    value.emplace();
    const MeshOptions options{.crossings = Crossings::kUnion, .monitor = monitor};
    value->set = read_polyhedron(path, options, &value->messages);
    used_.keep(path, {state}, *value);
  }
  messages.insert(messages.end(), value->messages.begin(), value->messages.end());
  return value->set;
}

}  // namespace nef::studio
