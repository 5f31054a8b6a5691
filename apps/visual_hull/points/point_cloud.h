// SPDX-License-Identifier: Apache-2.0
//
// Points of a hull's surface, as programs that begin with points take them (COLMAP, Gaussian splatting).
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/visual_hull/color/vertex_colors.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// A point of a surface.
struct SurfacePoint {
  std::array<double, 3> position{};
  std::array<double, 3> normal{};  ///< outward, of length 1
  Color color{128, 128, 128};
};

/// Points, evenly spread by area.
struct PointCloud {
  std::vector<SurfacePoint> points;
  nef::Messages notes;  ///< on their colours
};

/// So many points of the surface of a mesh, by area: the i-th lies in the triangle at which the (i + 1/2)-th part of
/// the whole area is reached, at a place of a sequence that covers triangles evenly (Roberts 2018). Always the same,
/// without chance. The colours are grey. None if the mesh has no area. O(n log n) for n faces and points.
std::vector<SurfacePoint> sample_surface(const nef::Mesh& mesh, std::size_t count);

/// Samples of a hull, with the mean colours of the views that see them (vertex_colors.h); what no view sees has colours
/// of its neighbours. Grey if views have no images. Throws InputError if an image cannot be read.
PointCloud sample_hull(const Result& result, std::size_t count, const nef::Monitor& monitor);

/// The text of COLMAP's points3D.txt: number, position, colour, error (-1: unknown), no track.
std::string colmap_points(const std::vector<SurfacePoint>& points);

/// A binary PLY file of vertices with x, y, z, nx, ny, nz in single precision and red, green, blue.
std::string ply_points(const std::vector<SurfacePoint>& points);

/// Writes them, by extension: .txt as COLMAP has it, else PLY. Throws FileError if the file cannot be written.
void write_points(const PointCloud& cloud, const std::filesystem::path& file);

}  // namespace nef::visual_hull
