// SPDX-License-Identifier: Apache-2.0
#include "nef/export/mesh_losses.h"

#include "nef/base/counted.h"

namespace nef {
namespace {

std::string listed(const ItemCounts& items) {
  std::string text;
  const auto add = [&text](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text += counted(count, one, many);
  };
  add(items.facets, "facet", "facets");
  add(items.edges, "edge", "edges");
  add(items.vertices, "vertex", "vertices");
  return text;
}

}  // namespace

std::vector<std::string> MeshLosses::lines() const {
  std::vector<std::string> lost;
  if (volumes > 0) {
    lost.push_back(counted(volumes, "unbounded volume is", "unbounded volumes are") + " not in the mesh");
  }
  if (flat.any()) lost.push_back("parts outside the solids are not in the mesh: " + listed(flat));
  if (open.any()) {
    lost.push_back(std::string(kOpenPartsClosed) + listed(open));
  }
  if (cracks.any()) lost.push_back("missing parts inside the solids were filled: " + listed(cracks));
  return lost;
}

}  // namespace nef
