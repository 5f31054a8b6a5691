// SPDX-License-Identifier: Apache-2.0
//
// The part of the extension module nef._planner that nef.assemblies is made of: disassembly and free directions. It
// gives tuples, which Python makes into the public classes.
#include <pybind11/stl.h>

#include <numeric>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/assembly/free_directions.h"
#include "apps/planner/clearance/clear_disassembly.h"
#include "apps/planner/proofs/inseparable_proof.h"
#include "binding/apps/planner.h"
#include "binding/base/bindings.h"
#include "nef/base/text/in_quotes.h"
#include "nef/base/timing/time_limit.h"

namespace nef::python {

namespace plan = nef::planner;

plan::Assembly assembly_of(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts) {
  plan::Assembly assembly;
  assembly.names = names;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Polyhedron& part = parts[i];
    if (part.is_empty() || !part.is_bounded() || !part.is_regular()) {
      throw InputError("part " + in_quotes(names[i]) +
                       " must be a bounded solid without surfaces, curves or points sticking out");
    }
    assembly.parts.push_back(part);
  }
  if (parts.empty()) throw InputError("parts must not be empty");
  return assembly;
}

plan::Assembly closed(plan::Assembly assembly, const Monitor& monitor) {
  for (Polyhedron& part : assembly.parts) part = closure(part, monitor);
  return assembly;
}

py::tuple from_triple(const Integer3& triple) {
  return py::make_tuple(to_int(triple[0]), to_int(triple[1]), to_int(triple[2]));
}

py::list stops_of(const std::vector<plan::FreeDirections::Stop>& stops) {
  py::list result;
  for (const plan::FreeDirections::Stop& stop : stops) {
    py::list normals;
    for (const Integer3& n : stop.directions) normals.append(from_triple(n));
    result.append(py::make_tuple(stop.part, normals));
  }
  return result;
}

namespace {

// How parts turn: (pivot, quaternions), or None.
py::object turning_of(const plan::DisassemblyStep& step) {
  if (!step.turning) return py::none();
  py::list quaternions;
  for (const plan::RigidPose& pose : step.turning->poses) {
    const auto& q = pose.quaternion;
    quaternions.append(py::make_tuple(to_fraction(q[0]), to_fraction(q[1]), to_fraction(q[2]), to_fraction(q[3])));
  }
  return py::make_tuple(from_triple(step.turning->pivot), quaternions);
}

// (steps, inseparable, undecided, overlap); a step is (parts, stay, path, straight, unrounded, turning, vectors), what
// is inseparable (parts, nothing_moves, blocked_by, interlocked, interlocked_is_least), what is undecided (parts,
// proved_below). `axis` may be None.
py::tuple take_apart(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts,
                     const std::optional<unsigned>& digits, const std::optional<double>& seconds, bool turns_freely,
                     const py::object& axis, bool simultaneous, const py::object& clearance, std::size_t max_cells) {
  plan::Assembly assembly = assembly_of(names, parts);
  assembly.turns_freely = turns_freely;
  if (!axis.is_none()) assembly.turning_axis = to_triple(axis, "rotation");
  std::optional<Rational> distance;
  if (!clearance.is_none()) distance = to_rational(clearance);
  const plan::DisassemblyOptions options{digits, simultaneous, max_cells};
  const plan::Disassembly found = call(kSmallCall, [=](const Monitor& monitor) {
    const TimeLimit limit(seconds, monitor);
    const plan::Assembly solids = closed(assembly, monitor);
    plan::Disassembly answer = distance ? plan::take_apart_clear(solids, *distance, options, limit.monitor())
                                        : plan::take_apart(solids, options, limit.monitor());
    monitor.check_interruption();
    return answer;
  });
  py::list steps;
  for (const plan::DisassemblyStep& step : found.steps) {
    py::list path;
    for (const Rational3& point : step.path) path.append(from_triple(point));
    py::list vectors;
    for (const Rational3& vector : step.vectors) vectors.append(from_triple(vector));
    steps.append(py::make_tuple(step.parts, step.stay, path, step.straight, step.unrounded, turning_of(step), vectors));
  }
  py::list inseparable;
  for (const plan::Inseparable& stuck : found.inseparable) {
    inseparable.append(py::make_tuple(stuck.parts, stuck.nothing_moves, stuck.blocked_by, stuck.interlocked,
                                      stuck.interlocked_is_least));
  }
  py::list undecided;
  for (const plan::Undecided& open : found.undecided) undecided.append(py::make_tuple(open.parts, open.proved_below));
  return py::make_tuple(steps, inseparable, undecided, found.overlap);
}

// (cone, dimension, everything, rays, stops)
py::tuple free_directions(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts,
                          std::size_t part) {
  const plan::Assembly assembly = assembly_of(names, parts);
  const plan::FreeDirections free = call(items(parts), [assembly, part](const Monitor& monitor) {
    plan::Blocking blocking(closed(assembly, monitor).parts, monitor);
    if (const auto overlap = blocking.overlapping()) {
      throw InputError("parts " + in_quotes(assembly.names[overlap->first]) + " and " +
                       in_quotes(assembly.names[overlap->second]) + " overlap");
    }
    return plan::free_directions(blocking, part, monitor);
  });
  py::list rays;
  for (const Integer3& ray : free.rays) rays.append(from_triple(ray));
  return py::make_tuple(free.cone, free.dimension, free.everything, rays, stops_of(free.stops));
}

// The text of the proof that none of these parts can begin to move; None if some can.
py::object prove_inseparable(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts) {
  const plan::Assembly assembly = assembly_of(names, parts);
  const std::optional<plan::InseparableProof> proof = call(kSmallCall, [assembly](const Monitor& monitor) {
    plan::PartSet all(assembly.parts.size());
    std::iota(all.begin(), all.end(), 0);
    return plan::make_inseparable_proof(closed(assembly, monitor), all, monitor);
  });
  return proof ? py::object(py::str(plan::proof_text(*proof))) : py::none();
}

// What is wrong with the text of such a proof, by itself and as one about these parts; None if it holds.
py::object complaint_about_inseparable(const std::vector<std::string>& names, const std::vector<Polyhedron>& parts,
                                       const std::string& text) {
  const plan::InseparableProof proof = plan::parse_inseparable_proof(text, "the proof");
  const plan::Assembly assembly = assembly_of(names, parts);
  const std::optional<std::string> found = call(kSmallCall, [assembly, proof](const Monitor& monitor) {
    const std::optional<std::string> complaint = plan::complaint_about(proof);
    return complaint ? complaint : plan::complaint_about(proof, closed(assembly, monitor), monitor);
  });
  return found ? py::object(py::str(*found)) : py::none();
}

}  // namespace

void bind_assemblies(py::module_& m) {
  m.def("take_apart", &take_apart);
  m.def("free_directions", &free_directions);
  m.def("prove_inseparable", &prove_inseparable);
  m.def("complaint_about_inseparable", &complaint_about_inseparable);
}

}  // namespace nef::python
