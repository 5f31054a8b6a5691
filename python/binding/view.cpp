// SPDX-License-Identifier: Apache-2.0
//
// Pictures and pages.
#include <pybind11/stl.h>

#include "apps/view/page.h"
#include "apps/view/picture.h"
#include "binding/base/bindings.h"

namespace nef::python {
namespace {

std::vector<view::Layer> layers_of(const std::vector<Polyhedron>& sets, const std::vector<std::string>& names,
                                   bool indices, const Monitor& monitor,
                                   const std::optional<std::array<Rational, 4>>& section = {}) {
  view::SceneOptions options;
  options.section = section;
  options.box = view::visible_box(sets);
  options.indices = indices;
  std::vector<view::Layer> layers;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    monitor.check_interruption();
    view::Layer& layer = layers.emplace_back();
    layer.name = i < names.size() ? names[i] : "set " + std::to_string(i + 1);
    layer.scene = view::build_scene(sets[i], options, monitor);
  }
  return layers;
}

py::bytes picture(const std::vector<Polyhedron>& sets, std::uint32_t width, std::uint32_t height, py::handle direction,
                  py::handle section) {
  view::PictureOptions options;
  options.width = width;
  options.height = height;
  if (!direction.is_none()) {
    const Rational3 from = to_triple(direction, "a direction");
    options.from = {nearest_double(from[0]), nearest_double(from[1]), nearest_double(from[2])};
  }
  std::optional<std::array<Rational, 4>> plane;
  if (!section.is_none()) {
    std::vector<Rational> numbers;
    for (const py::handle number : to_items(section, "a section")) numbers.push_back(to_rational(number));
    if (numbers.size() != 4) throw InputError("a section needs four numbers a, b, c, d, as in (0, 0, 1, -2)");
    plane = {numbers[0], numbers[1], numbers[2], numbers[3]};
  }
  return call(items(sets), [=](const Monitor& monitor) {
    return view::png_bytes(view::draw_picture(layers_of(sets, {}, false, monitor, plane), options));
  });
}

void write_page(const std::vector<Polyhedron>& sets, const std::vector<std::string>& names, const std::string& path,
                const std::string& title) {
  call(items(sets), [=](const Monitor& monitor) {
    view::PageOptions options;
    options.title = title;
    view::write_page(layers_of(sets, names, true, monitor), path, options);
    return true;
  });
}

}  // namespace

void bind_view(py::module_& m) {
  m.def("_picture", &picture, py::arg("sets"), py::arg("width"), py::arg("height"), py::arg("direction"),
        py::arg("section"));
  m.def("_write_page", &write_page, py::arg("sets"), py::arg("names"), py::arg("path"), py::arg("title"));
  m.def("_has_pages", &view::has_viewer_bundle);
}

}  // namespace nef::python
