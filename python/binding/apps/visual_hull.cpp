// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._visual_hull.
#include "apps/visual_hull/visual_hull.h"

#include <pybind11/stl.h>

#include <filesystem>

#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/scene/images.h"
#include "binding/base/bindings.h"
#include "nef/io/file_bytes.h"
#include "nef/view/image.h"

namespace nef::python {
namespace {

visual_hull::Matrix34 matrix_of(py::handle rows) {
  visual_hull::Matrix34 result;
  const py::sequence given = py::reinterpret_borrow<py::sequence>(rows);
  if (py::len(given) != 3) throw py::value_error("a camera is a matrix of shape (3, 4)");
  for (std::size_t i = 0; i < 3; ++i) {
    const py::sequence row = given[i];
    if (row.size() != 4) throw py::value_error("a camera is a matrix of shape (3, 4)");
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = to_rational(row[j]);
  }
  return result;
}

using Mask = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

// White where the mask is not 0.
void write_mask(const Mask& mask, const std::string& path) {
  if (mask.ndim() != 2) throw py::value_error("a mask is an array of shape (H, W)");
  view::Image image;
  image.height = static_cast<std::uint32_t>(mask.shape(0));
  image.width = static_cast<std::uint32_t>(mask.shape(1));
  image.rgb.reserve(3 * static_cast<std::size_t>(mask.size()));
  for (const std::uint8_t* pixel = mask.data(); pixel != mask.data() + mask.size(); ++pixel) {
    image.rgb.insert(image.rgb.end(), 3, *pixel != 0 ? std::uint8_t{255} : std::uint8_t{0});
  }
  write_file(path, view::png_bytes(image));
}

visual_hull::Options options_of(double tolerance, bool half_pixels, bool unknown_beyond, const py::object& box,
                                bool verify, unsigned threads) {
  visual_hull::Options options;
  options.silhouette.simplify.tolerance = tolerance;
  if (half_pixels) options.origin = visual_hull::PixelOrigin::kCorner;
  options.silhouette.border = unknown_beyond ? visual_hull::Border::kUnknown : visual_hull::Border::kOutside;
  options.verify = verify;
  options.threads = threads;
  if (!box.is_none()) {
    const py::sequence corners = box;
    if (corners.size() != 2) throw py::value_error("a box needs two corners");
    options.box = visual_hull::WorldBox{to_triple(corners[0], "a corner"), to_triple(corners[1], "a corner")};
  }
  return options;
}

// (name, image, contours, holes, cut by the frame, inside, unexplained pixels, silhouette's pixels)
py::tuple view_tuple(const visual_hull::ViewResult& view) {
  py::object inside = py::none();
  py::object difference = py::none();
  py::object area = py::none();
  if (view.verification) {
    inside = py::bool_(view.verification->inside);
    if (view.verification->area_known) {
      difference = py::float_(view.verification->difference_area);
      area = py::float_(view.verification->silhouette_area);
    }
  }
  return py::make_tuple(view.name, view.image.string(), view.silhouette.contours, view.silhouette.holes,
                        view.silhouette.cut_by_frame, inside, difference, area);
}

py::dict compute(const visual_hull::Scene& scene, const std::string& folder, const visual_hull::Options& options,
                 const py::object& progress) {
  const ProgressFunction told(progress);
  const visual_hull::Result made = call(kSmallCall, [=](const Monitor& monitor) {
    const visual_hull::Progress forward = [&](visual_hull::Phase phase, const std::string& name, std::size_t done,
                                              std::size_t total) {
      told(monitor, std::string(visual_hull::phase_name(phase)), name, done, total);
    };
    visual_hull::Options watched = options;
    watched.monitor = monitor;
    return visual_hull::compute(scene, folder, watched, forward);
  });
  py::dict result;
  result["hull"] = made.hull;
  result["box"] = py::make_tuple(from_triple(made.box.low), from_triple(made.box.high));
  result["vanished"] =
      made.vanished ? py::object(py::make_tuple(made.vanished->view, made.vanished->reason)) : py::none();
  py::list views;
  for (const visual_hull::ViewResult& view : made.views) views.append(view_tuple(view));
  result["views"] = views;
  result["notes"] = made.notes;
  return result;
}

py::dict from_file(const std::string& path, const visual_hull::Options& options, const py::object& progress) {
  const std::filesystem::path file(path);
  return compute(visual_hull::read_scene(file), visual_hull::scene_folder(file).string(), options, progress);
}

py::dict from_views(const std::vector<std::string>& names, const std::vector<std::string>& images,
                    const py::list& matrices, const std::string& folder, const visual_hull::Options& options,
                    const py::object& progress) {
  visual_hull::Scene scene;
  for (std::size_t i = 0; i < names.size(); ++i) {
    visual_hull::View& view = scene.views.emplace_back();
    view.name = names[i];
    view.image = images.at(i);
    view.camera = visual_hull::Camera(names[i], matrix_of(matrices[i]));
  }
  return compute(scene, folder, options, progress);
}

void define_module(py::module_& m) {
  m.doc() = "The core of the package nef.visual_hull; see there.";
  py::module_::import("nef._nef");
  py::class_<visual_hull::Options>(m, "Options").def(py::init(&options_of));
  m.def("write_mask", &write_mask);
  m.def("from_file", &from_file);
  m.def("from_views", &from_views);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_visual_hull, m) { nef::python::define_module(m); }
