// SPDX-License-Identifier: Apache-2.0
//
// The file of a hull, whole or decimated.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/remeshing/decimate.h"
#include "apps/visual_hull/color/vertex_colors.h"
#include "apps/visual_hull/command/arguments.h"
#include "nef/io/polyhedron_file.h"

namespace nef::visual_hull {

/// Throws nef::InputError if what is asked of the output cannot be had.
void check_output(const Arguments& arguments);

/// What is reported of a texture.
struct TextureFigures {
  int width = 0;  ///< of the image
  int height = 0;
  std::size_t charts = 0;  ///< pieces of the image
  double unseen = 0;       ///< share of the surface
};

/// The colours of a mesh of the hull, by its photographs: of its vertices. Notes are added to `messages`.
std::vector<Color> colors_of_hull(const nef::Mesh& mesh, const Result& result, const nef::Monitor& monitor,
                                  nef::Messages& messages);
/// An image on its surface.
nef::MeshTexture texture_of_hull(const nef::Mesh& mesh, const Result& result, const nef::Monitor& monitor,
                                 nef::Messages& messages, TextureFigures* figures = nullptr);

/// What was written: the file, its mesh if that has been decimated, and what there is to say of its texture.
struct WrittenHull {
  nef::WrittenFile file;
  std::optional<nef::DecimatedMesh> decimated;
  std::optional<TextureFigures> texture;
};

/// Writes the hull as the arguments have it: whole, or with --decimate as a mesh of fewer triangles, with --color in
/// colours, with --texture with an image. `format` is what the session says of files (Session::write_options). Notes
/// about what was done are added to `messages`.
WrittenHull write_hull(const std::string& path, const Result& result, const Arguments& arguments,
                       nef::PolyhedronWriteOptions format, nef::Messages& messages);

/// For the report: `triangles`, `vertices`, and `distance` from the hull (bounds of Hausdorff's, `low` and `high`).
nlohmann::ordered_json decimation_json(const nef::DecimatedMesh& decimated);
/// For the report: `width` and `height` of the image, `charts`, and the share `unseen` of the surface.
nlohmann::ordered_json texture_json(const TextureFigures& figures);
/// decimation_json in a line.
std::string decimation_text(const nef::DecimatedMesh& decimated);

}  // namespace nef::visual_hull
