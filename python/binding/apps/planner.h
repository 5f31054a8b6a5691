// SPDX-License-Identifier: Apache-2.0
//
// The parts of the extension module nef._planner.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/assembly/parts.h"

namespace nef::python {

/// Parts with their names. Throws InputError unless each is a bounded solid, and if there are none.
planner::Assembly assembly_of(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts);

/// The assembly of the closures of parts.
planner::Assembly closed(planner::Assembly assembly, const Monitor& monitor);

/// Three ints.
pybind11::tuple from_triple(const Integer3& triple);

/// (part, normals) for each stop.
pybind11::list stops_of(const std::vector<planner::FreeDirections::Stop>& stops);

/// Adds what nef.mechanisms is made of.
void bind_mechanisms(pybind11::module_& m);

/// Adds what nef.assemblies is made of.
void bind_assemblies(pybind11::module_& m);

}  // namespace nef::python
