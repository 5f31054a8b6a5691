// SPDX-License-Identifier: Apache-2.0
//
// Names for headers that only hand sets on. Whoever makes, holds or asks one includes nef/polyhedron.h.
#pragma once

namespace nef {

class Polyhedron;
struct Complex;

}  // namespace nef
