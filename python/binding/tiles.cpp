// SPDX-License-Identifier: Apache-2.0
//
// Sets in tiles (docs/tiles.md): the class TiledPolyhedron with operators that also take a Polyhedron, and the
// functions that make, read and write such sets. Items of the whole have no numbers while it is in tiles, so locations
// have the index None.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <filesystem>

#include "binding/base/bindings.h"
#include "binding/base/errors.h"
#include "binding/base/mesh_options.h"
#include "binding/meshes.h"
#include "nef/query/location_name.h"
#include "nef/tiles/import/mesh_tiles.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/storage/tile_store.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::python {
namespace {

// work(monitor) for a set and what is combined with it, without Python's lock.
template <typename Work>
auto call_with(const Tiles& a, std::size_t others, const Work& work) {
  return call(items(a) + others,
              [work, threads = a.threads](const Monitor& monitor) { return work(monitor.on_threads(threads)); });
}

using TiledUnary = TiledPolyhedron (*)(const TiledPolyhedron&, const Monitor&);
using TiledBinary = TiledPolyhedron (*)(const TiledPolyhedron&, const TiledPolyhedron&, const Monitor&);
using TiledWithPlain = TiledPolyhedron (*)(const TiledPolyhedron&, const Polyhedron&, const Monitor&);

auto tiled_unary(TiledUnary operation) {
  return [operation](const Tiles& a) {
    return Tiles(call_with(a, 0, [=](const Monitor& monitor) { return operation(a, monitor); }), a.threads);
  };
}

auto tiled_binary(TiledBinary operation) {
  return [operation](const Tiles& a, const Tiles& b) {
    return Tiles(call_with(a, items(b), [=](const Monitor& monitor) { return operation(a, b, monitor); }), a.threads);
  };
}

auto with_plain(TiledWithPlain operation) {
  return [operation](const Tiles& a, const Polyhedron& b) {
    return Tiles(call_with(a, items(b), [=](const Monitor& monitor) { return operation(a, b, monitor); }), a.threads);
  };
}

// Without a limit, that which suits so many vertices.
Tiling tiling_of(std::optional<std::size_t> limit, std::size_t vertices) {
  constexpr std::size_t kFewest = 32;
  if (!limit) return tiling_for(vertices);
  if (*limit < kFewest) throw InputError("limit must be at least 32 vertices");
  return {.limit = *limit};
}

// Nothing is the empty set.
Tiles cut(const std::optional<Polyhedron>& given, std::optional<std::size_t> limit, unsigned threads) {
  const Polyhedron set = given.value_or(Polyhedron());
  const Tiling tiling = tiling_of(limit, set.complex().vertex_count());
  return {call(items(set),
               [=](const Monitor& monitor) { return TiledPolyhedron(set, tiling, monitor.on_threads(threads)); }),
          threads};
}

Tiles unite_in_tiles(const py::iterable& iterable, std::size_t limit, unsigned threads) {
  const Tiling tiling = tiling_of(limit, 0);
  const std::vector<Polyhedron> sets = sets_of(iterable);
  return {call(items(sets),
               [=](const Monitor& monitor) { return TiledPolyhedron(sets, tiling, monitor.on_threads(threads)); }),
          threads};
}

Tiles cut_mesh(py::handle vertices, py::handle faces, bool strict, bool surface, std::optional<std::size_t> limit,
               unsigned threads, const std::string& crossings, py::handle close) {
  auto mesh = std::make_shared<const Mesh>(mesh_from_arrays(vertices, faces));
  const Tiling tiling = tiling_of(limit, mesh->vertices.size());
  MeshOptions options = mesh_options(crossings, close);
  options.strict = strict;
  options.as_surface = surface;
  using Made = std::pair<TiledPolyhedron, Messages>;
  const Made made = call(mesh->face_count(), [=](const Monitor& monitor) mutable -> Made {
    if (mesh->vertices.empty() && mesh->face_count() == 0) return {TiledPolyhedron(Polyhedron(), tiling), {}};
    Messages messages;
    options.monitor = monitor.on_threads(threads);
    TiledPolyhedron set = tiles_from_mesh(*mesh, options, tiling, &messages);
    return {std::move(set), std::move(messages)};
  });
  warn(made.second);
  return {made.first, threads};
}

Tiles read_folder(py::handle path, const std::optional<std::uint64_t>& memory, unsigned threads) {
  const std::string folder = path_text(path);
  // Reading a folder is never small: its files tell only later how large they are.
  TiledPolyhedron set = call(kSmallCall, [=](const Monitor& monitor) {
    const auto store = memory ? std::make_shared<TileStore>(std::filesystem::temp_directory_path(), *memory) : nullptr;
    return read_tiles(folder, store, monitor.on_threads(threads));
  });
  return {std::move(set), threads};
}

void write_folder(const Tiles& a, py::handle path) {
  const std::string folder = path_text(path);
  call(items(a), [=](const Monitor&) {
    write_tiles(folder, a);
    return 0;
  });
}

// Items of the whole have no numbers while it is in tiles.
py::object tiled_location(const Location& location) {
  return result_of("Location", py::make_tuple(location_name(location.kind), py::none(), location.mark != 0 ? 1 : 0));
}

py::object locate_in_tiles(const Tiles& a, py::handle point) {
  const Rational3 p = to_triple(point, "a point");
  return tiled_location(call_with(a, 0, [=](const Monitor& monitor) { return locate(a, p, monitor); }));
}

py::object contained(const Tiles& a, py::handle points) {
  if (is_one_point(points)) {
    const Rational3 p = to_triple(points, "a point");
    return py::bool_(call_with(a, 0, [=](const Monitor& monitor) { return contains(a, p, monitor); }));
  }
  const auto all = std::make_shared<const std::vector<Rational3>>(to_points(points, "points"));
  const std::vector<bool> in = call_with(a, all->size(), [=](const Monitor& monitor) {
    std::vector<bool> result;
    for (const Rational3& p : *all) {
      monitor.check_interruption();
      result.push_back(contains(a, p, monitor));
    }
    return result;
  });
  py::array_t<bool> result(static_cast<py::ssize_t>(in.size()));
  std::copy(in.begin(), in.end(), result.mutable_data());
  return result;
}

py::object ray_in_tiles(const Tiles& a, py::handle origin, py::handle direction) {
  const Rational3 from = to_triple(origin, "an origin");
  const Rational3 towards = to_triple(direction, "a direction");
  const auto hit = call_with(a, 0, [=](const Monitor& monitor) { return shoot_ray(a, from, towards, {}, monitor); });
  if (!hit) return py::none();
  return result_of("RayHit", py::make_tuple(from_triple(hit->point), tiled_location(hit->location)));
}

py::object volume_of_tiles(const Tiles& a) {
  const std::optional<Rational> value = call_with(a, 0, [=](const Monitor& monitor) { return volume(a, monitor); });
  return value ? to_fraction(*value) : py::none();
}

py::object box_of_tiles(const Tiles& a) {
  const auto box = call_with(a, 0, [=](const Monitor& monitor) { return bounding_box(a, monitor); });
  if (!box) return py::none();
  return py::make_tuple(from_triple((*box)[0]), from_triple((*box)[1]));
}

void bind_tiled_operators(py::class_<Tiles>& c) {
  const auto both = [&c](const char* name, TiledBinary tiled, TiledWithPlain plain, const char* text) {
    c.def(name, tiled_binary(tiled), py::is_operator(), text);
    c.def(name, with_plain(plain), py::is_operator(), text);
  };
  both("__or__", unite, unite, "Union.");
  both("__add__", unite, unite, "Union, as ``|``.");
  both("__and__", intersect, intersect, "Intersection.");
  both("__sub__", subtract, subtract, "Difference.");
  both("__xor__", symmetric_difference, symmetric_difference, "Symmetric difference.");
  const auto same = [](const Tiles& a, const Tiles& b) {
    return call_with(a, items(b), [=](const Monitor& monitor) { return equal(a, b, monitor); });
  };
  c.def(
       "__invert__",
       [](const Tiles& a) { return Tiles(call(items(a), [=](const Monitor&) { return complement(a); }), a.threads); },
       py::is_operator(), "Complement. O(1).")
      .def("__eq__", same, py::is_operator(), "True if both are the same set, however they are cut.")
      .def(
          "__ne__", [same](const Tiles& a, const Tiles& b) { return !same(a, b); }, py::is_operator())
      .def("__bool__", [](const Tiles& a) { return !a.is_empty(); })
      .def("__copy__", [](const Tiles& a) { return a; })
      .def("__deepcopy__", [](const Tiles& a, const py::dict&) { return a; });
  c.attr("__hash__") = py::none();
}

void bind_tiled_methods(py::class_<Tiles>& c) {
  c.def(
       "polyhedron",
       [](const Tiles& a) { return call_with(a, 0, [=](const Monitor& monitor) { return a.polyhedron(monitor); }); },
       "The set as a Polyhedron: glued, in an order that depends on the set alone.")
      .def("is_empty", &Tiles::is_empty, "True for the set without points. O(1).")
      .def("is_everything", &Tiles::is_everything, "True for all of space. O(1).")
      .def("tile_count", &Tiles::tile_count, "How many tiles contain boundary of the set.")
      .def("vertex_count", &Tiles::vertex_count, "Vertices of all tiles, those in their walls included.")
      .def("contains", &contained, py::arg("points"),
           R"(Whether points are in the set, exactly: a bool for three numbers, a bool array of shape (N,) for an array
of shape (N, 3).)")
      .def(
          "__contains__",
          [](const Tiles& a, py::handle p) {
            const Rational3 point = to_triple(p, "a point");
            return call(items(a), [=](const Monitor&) { return contains(a, point); });
          },
          py::arg("point"))
      .def("locate", &locate_in_tiles, py::arg("point"),
           "The item of the whole set that contains a point, as Polyhedron.locate; the index is None.")
      .def("ray", &ray_in_tiles, py::arg("origin"), py::arg("direction"),
           "The first vertex, edge or facet of the whole set on an open ray, as of a Polyhedron; indices are None.")
      .def("volume", &volume_of_tiles, "The volume, a Fraction; None if it is infinite.")
      .def("bounding_box", &box_of_tiles, "Smallest and largest coordinates of the vertices, as of a Polyhedron.")
      .def("interior", tiled_unary(interior), "The largest open subset. Glues and cuts again.")
      .def("closure", tiled_unary(closure), "The smallest closed set that contains the set. Glues and cuts again.")
      .def("boundary", tiled_unary(boundary), "The boundary. Glues and cuts again.")
      .def("exterior", tiled_unary(exterior), "The interior of the complement. Glues and cuts again.")
      .def("regularize", tiled_unary(regularize), "The closure of the interior. Glues and cuts again.")
      .def(
          "transform",
          [](const Tiles& a, py::handle matrix) {
            const AffineMap map = map_from(matrix);
            return Tiles(call_with(a, 0, [=](const Monitor& monitor) { return transform(a, map, monitor); }),
                         a.threads);
          },
          py::arg("matrix"), "The image under an affine map; tile by tile if it takes axes to axes.")
      .def("write", &write_folder, py::arg("path"),
           R"(Writes the set to a folder, NAME.tiles by custom. Existing tiles are not written again; an
interrupted call leaves the old set.)");
}

}  // namespace

void bind_tiles(py::module_& m) {
  py::class_<Tiles> c(m, "TiledPolyhedron", R"(An exact set that is kept in tiles.

The cost of an operation depends on the tiles that it touches, and versions share the rest: for many small steps on a large
set whose results are needed one by one, and for sets larger than memory. Immutable. Operators are those of Polyhedron; the second
operand may be a Polyhedron. Labels other than 0 are taken as 1. Not hashable.)");
  c.def(py::init(&cut), py::arg("set") = py::none(), py::arg("limit") = py::none(), py::arg("threads") = 1,
        "Cuts a set (None: the empty set) into tiles of at most `limit` vertices (None: a 256th of the set's, but at "
        "least 128; small tiles are for very many small steps). threads: of this and of all operations; 0: as many as "
        "the machine has.");
  bind_tiled_operators(c);
  bind_tiled_methods(c);
  m.def("unite_in_tiles", &unite_in_tiles, py::arg("sets"), py::arg("limit") = kVerticesOfTileInFile,
        py::arg("threads") = 1, "The union of many sets, region by region: a TiledPolyhedron.");
  m.def("tiles_from_mesh", &cut_mesh, py::arg("vertices"), py::arg("faces"), py::arg("strict") = false,
        py::arg("surface") = false, py::arg("limit") = py::none(), py::arg("threads") = 1,
        py::arg("crossings") = "refuse", py::arg("close") = 0.0,
        R"(The solid that a mesh bounds, cut before it is made a complex: a TiledPolyhedron.

vertices, faces, strict, surface, crossings and close: as of from_mesh.)");
  m.def("read_tiles", &read_folder, py::arg("path"), py::arg("memory") = py::none(), py::arg("threads") = 1,
        R"(Reads a folder that TiledPolyhedron.write, or the program `nef`, wrote.

memory: bytes of tiles that stay in memory; tiles are read when they are needed. None: all are read at once.)");
}

}  // namespace nef::python
