// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// True if the text begins as a file of OpenCV's FileStorage does (YAML 1.0 or XML).
bool is_opencv_storage(const std::string& text);

/// Reads cameras from a file of OpenCV's FileStorage. Names are compared without case and underscores. Understood are
///  - the calibration sample's output: `camera_matrix`, `distortion_coefficients`, `extrinsic_parameters` (a row of
///  rvec
///    and tvec, or of R and t, for each view);
///  - a list of maps (`cameras`, `views`, `frames`), each with `P`, or `K` (`camera_matrix`, `intrinsics`), `R` (or
///  `rvec`)
///    and `t` (`tvec`), perhaps `D` (`distortion_coefficients`), `image` and `name`;
///  - numbered nodes: P0, P1, ... or K0, R0, t0, D0, ...; what has no number is for all views;
///  - one camera in the file itself;
///  - with `matrices`, a name with one `*` for a number or a name: all 3x4 or 4x4 matrices of such names.
/// World to camera, x right, y down, z ahead; whole image coordinates are centres of pixels, as everywhere in
/// OpenCV. OpenCV parses the text under limits (foreign_parser.h). `file` is what messages call it. Throws InputError.
Scene read_opencv_storage(const std::string& text, const std::filesystem::path& file, const std::string& matrices);

}  // namespace nef::visual_hull
