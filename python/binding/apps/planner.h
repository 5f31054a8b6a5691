// SPDX-License-Identifier: Apache-2.0
//
// The parts of the extension module nef._planner.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/assembly/parts.h"
#include "apps/planner/rigid/motion_checker.h"
#include "binding/base/call.h"
#include "nef/base/timing/time_limit.h"

namespace nef::python {

/// Parts with their names. Throws InputError unless each is a bounded solid, and if there are none.
planner::Assembly assembly_of(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts);

/// The assembly of the closures of parts.
planner::Assembly closed(planner::Assembly assembly, const Monitor& monitor);

/// What certify(monitor) says of a path, or that it is undecided if that takes longer than so many seconds. `progress`
/// is told how far it has come.
template <typename Path, typename Certify>
Path certified_in_time(const std::optional<double>& seconds, const ProgressFunction& progress, const Monitor& monitor,
                       Certify&& certify) {
  const TimeLimit limit(seconds, monitor);
  const nef::ProgressFunction tell = told_by(progress, monitor);
  try {
    return certify(progress ? limit.monitor().telling(tell) : limit.monitor());
  } catch (const Interrupted&) {
    monitor.check_interruption();
    Path unknown;
    unknown.status = planner::MotionVerdict::Status::kUndecided;
    return unknown;
  }
}

/// Three ints.
pybind11::tuple from_triple(const Integer3& triple);

/// (part, normals) for each stop.
pybind11::list stops_of(const std::vector<planner::FreeDirections::Stop>& stops);

/// Adds what nef.mechanisms is made of.
void bind_mechanisms(pybind11::module_& m);

/// Adds what nef.assemblies is made of.
void bind_assemblies(pybind11::module_& m);

}  // namespace nef::python
