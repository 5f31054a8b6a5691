// SPDX-License-Identifier: Apache-2.0
//
// Layers as a picture, without a browser or a graphics card.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/view/image.h"
#include "apps/view/layer.h"

namespace nef::view {

/// From where a picture is taken, and how large it is.
struct PictureOptions {
  /// The direction from the middle of the scene to the eye, of any length; from the right, the front and above if not
  /// given. z is up.
  std::optional<Point> from;
  std::uint32_t width = 1200;
  std::uint32_t height = 900;
};

/// Draws the visible layers in perspective, as large as they fit, on white. Facets by a depth buffer with nine samples
/// a pixel; edges of the complex (not of the triangulation) and vertices where no facet hides them; transparent layers
/// are blended in order of depth. Selected and unselected items look as on the pages. Photos are not drawn, their lines
/// are. A layer with colours of its surface is drawn without edges and
/// vertices. Throws InputError for a size of zero or above 16384 and a direction of length zero.
/// O(n + samples covered), and about 20 bytes of memory for each sample of a band of at most 16 million.
Image draw_picture(const std::vector<Layer>& layers, const PictureOptions& options = {});

/// Draws and writes a PNG file. Throws FileError if it cannot be written.
void write_picture(const std::vector<Layer>& layers, const std::string& path, const PictureOptions& options = {});

}  // namespace nef::view
