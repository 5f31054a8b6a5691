// SPDX-License-Identifier: Apache-2.0
//
// All of the library that keeps its meaning between versions (CONTRIBUTING.md, "What is stable"), for those who would
// rather include one header: sets and Booleans, constructions, files, meshes, questions, distances and parts.
#pragma once

// IWYU pragma: begin_exports
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/distance/distance.h"
#include "nef/distance/intersects.h"
#include "nef/export/to_mesh.h"
#include "nef/io/polyhedron_file.h"
#include "nef/labeled_polyhedron.h"
#include "nef/number/number.h"
#include "nef/operators.h"
#include "nef/parts/section.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/validation/validate.h"
#include "nef/version.h"
// IWYU pragma: end_exports
