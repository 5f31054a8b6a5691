// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/caches/loaded_files.h"

#include <optional>

#include "nef/io/polyhedron_file.h"

namespace nef::studio {

Polyhedron LoadedFiles::load(const std::string& path, Crossings crossings, const Monitor& monitor, Messages& messages) {
  std::optional<Value> value = used_.find({path, crossings});
  if (!value) {
    const FileState state = state_of_mesh(path);
    value.emplace();
    const MeshOptions options{.crossings = crossings, .monitor = monitor};
    value->set = read_polyhedron(path, options, &value->messages);
    used_.keep({path, crossings}, {state}, *value);
  }
  messages.insert(messages.end(), value->messages.begin(), value->messages.end());
  return value->set;
}

}  // namespace nef::studio
