// SPDX-License-Identifier: Apache-2.0
//
// The parts of the extension module nef._nef.
#pragma once

#include "binding/base/call.h"
#include "binding/base/numbers.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::python {

/// The size of a set, for call().
inline std::size_t items(const Polyhedron& set) { return set.complex().vertex_count(); }
inline std::size_t items(const TiledPolyhedron& set) { return set.vertex_count(); }
inline std::size_t items(const std::vector<Polyhedron>& sets) {
  std::size_t sum = 0;
  for (const Polyhedron& set : sets) sum += items(set) + 100;
  return sum;
}

/// A set that may wait for steps (Polyhedron::waiting). All other functions are given sets that wait no more.
struct MaybeWaiting {
  Polyhedron set;
};

/// Enough for a call of its own if steps wait, since nobody knows how much they are.
inline std::size_t items(const MaybeWaiting& a) { return a.set.waits() ? kSmallCall : items(a.set); }

/// The class TiledPolyhedron: a set in tiles, and how many threads operations on it use.
struct Tiles : TiledPolyhedron {
  Tiles(TiledPolyhedron set, unsigned threads_of_operations)
      : TiledPolyhedron(std::move(set)), threads(threads_of_operations) {}

  unsigned threads;
};

/// The sets of a list, a generator or any other iterable. Throws TypeError for what is not a Polyhedron.
std::vector<Polyhedron> sets_of(const py::iterable& sets);

/// A named tuple of the module nef.results.
inline py::object result_of(const char* type, const py::args& values) {
  return py::module_::import("nef.results").attr(type)(*values);
}

/// The map of a matrix as Polyhedron.transform takes it. Throws what says why it is none.
AffineMap map_from(py::handle matrix);
/// True for three numbers that are no rows.
bool is_one_point(py::handle points);
/// The text of a str or a path.
std::string path_text(py::handle path);

using PolyhedronClass = py::class_<Polyhedron>;

void bind_operations(PolyhedronClass& polyhedron);
void bind_queries(py::module_& module, PolyhedronClass& polyhedron);
void bind_measures(py::module_& module, PolyhedronClass& polyhedron);
void bind_files(py::module_& module, PolyhedronClass& polyhedron);
void bind_construction(py::module_& module);
void bind_view(py::module_& module);
void bind_tiles(py::module_& module);

}  // namespace nef::python

namespace pybind11::detail {

/// Steps that wait are computed when a function is given their set, by a call of their own: a look within the function
/// would compute them with the interpreter's lock held, for which those who are told of progress may be waiting.
template <>
class type_caster<nef::Polyhedron> : public type_caster_base<nef::Polyhedron> {
 public:
  bool load(handle source, bool convert) {
    if (!type_caster_base<nef::Polyhedron>::load(source, convert)) return false;
    const auto* set = static_cast<const nef::Polyhedron*>(value);
    if (set != nullptr && set->waits()) {
      nef::python::call(nef::python::kSmallCall, [own = *set](const nef::Monitor& monitor) {
        own.compute(monitor);
        return true;
      });
    }
    return true;
  }
};

template <>
class type_caster<nef::python::MaybeWaiting> {
 public:
  static constexpr auto name = type_caster_base<nef::Polyhedron>::name;
  template <typename T>
  using cast_op_type = nef::python::MaybeWaiting&;

  bool load(handle source, bool convert) {
    type_caster_base<nef::Polyhedron> any;
    if (!any.load(source, convert)) return false;
    own_.set = static_cast<nef::Polyhedron&>(any);
    return true;
  }
  operator nef::python::MaybeWaiting&() { return own_; }  // NOLINT(google-explicit-constructor): pybind11 asks for it

 private:
  nef::python::MaybeWaiting own_;
};

}  // namespace pybind11::detail
