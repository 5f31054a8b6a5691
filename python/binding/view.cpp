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
                                   bool indices, const Monitor& monitor) {
  view::SceneOptions options;
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

py::bytes picture(const std::vector<Polyhedron>& sets, std::uint32_t width, std::uint32_t height) {
  return call(items(sets), [=](const Monitor& monitor) {
    view::PictureOptions options;
    options.width = width;
    options.height = height;
    return view::png_bytes(view::draw_picture(layers_of(sets, {}, false, monitor), options));
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
  m.def("_picture", &picture, py::arg("sets"), py::arg("width"), py::arg("height"));
  m.def("_write_page", &write_page, py::arg("sets"), py::arg("names"), py::arg("path"), py::arg("title"));
  m.def("_has_pages", &view::has_viewer_bundle);
}

}  // namespace nef::python
