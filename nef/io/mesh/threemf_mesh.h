// SPDX-License-Identifier: Apache-2.0
//
// Meshes in 3MF (3D Manufacturing Format, core specification 1.3): a zip archive of XML.
#pragma once

#include <string>
#include <string_view>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef {

/// The triangles of everything that the file builds: meshes and components of objects, also in other parts of the
/// archive, with their transformations done exactly; mirrored ones are turned over. Objects of support are left out.
/// Numbers mean the decimals that they spell, in the file's unit. Equal points are one vertex. Colours, materials and
/// textures are skipped. Throws FileError for a damaged archive, XML that is not well formed or has a document type, an
/// index of nothing, a required extension that may hold shapes (beams, slices), and for archives or components that
/// grow beyond all measure when they are unpacked.
Mesh read_3mf(std::string_view bytes, const std::string& path);

/// One object with the mesh's triangles, in the fewest decimals that tell the nearest doubles, moved by `offset` where
/// it is built.
std::string threemf_bytes(const Mesh& mesh, const Rational3& offset = {}, const Monitor& monitor = {});

}  // namespace nef
