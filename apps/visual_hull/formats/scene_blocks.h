// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// True if a text has a comment line that announces extrinsic parameters.
bool has_parameter_blocks(const std::string& text);

/// Reads cameras that share their intrinsics, as calibration programs print them:
///   #Intrinsic parameter
///   (K: three lines of three numbers)
///   #Extrinsic parameter for NAME
///   ([R | t]: three lines of four numbers), once for each image
/// What stands before the first of these comments is passed over. Throws InputError.
Scene read_parameter_blocks(const std::string& text, const std::filesystem::path& file);

/// Reads a folder of cameras: every file NAME.pa, in the order of the names, is the 3x4 matrix of an image NAME; or, as
/// PMVS has them (Furukawa and Ponce), every file NAME.txt that begins with CONTOUR, in the folder or in its subfolders
/// txt, calib or cameras. Throws InputError.
Scene read_camera_folder(const std::filesystem::path& folder);

}  // namespace nef::visual_hull
