// SPDX-License-Identifier: Apache-2.0
//
// Layers as one HTML page that needs no network and no server.
#pragma once

#include <string>
#include <vector>

#include "apps/view/layer.h"

namespace nef::view {

/// What is on a page.
struct PageOptions {
  std::string title = "nef view";
  /// Exact coordinates and planes of a layer are left out (and the page says so) if they need more bytes than this.
  std::size_t exact_text_limit = std::size_t{48} << 20U;
  /// Sphere maps and exact texts. Scenes without them are a fraction as large; the page must get them item by item
  /// (page/item_details.h).
  bool details = true;
};

/// Writes the page, viewer and scene inside. Throws UnsupportedError if the viewer bundle was not built (npm was
/// missing when CMake configured), FileError if the file cannot be written. O(size of the scenes and their sphere
/// maps).
void write_page(const std::vector<Layer>& layers, const std::string& path, const PageOptions& options = {});

/// True if the viewer bundle was built, so that pages can be written.
bool has_viewer_bundle();

/// The scene of a page as the viewer reads it: a little-endian 32-bit length, JSON of that length, and the arrays that
/// it refers to as [type, offset, count]; offsets count from the first multiple of four behind the JSON.
std::string page_scene(const std::vector<Layer>& layers, const PageOptions& options = {});

}  // namespace nef::view
