// SPDX-License-Identifier: Apache-2.0
//
// The extension module nef._visual_hull: arguments of Python become scenes, masks and options of the library, its
// calls run without the interpreter's lock, and results go back as plain tuples and dicts, which nef/visual_hull.py
// gives names.
#include "apps/visual_hull/visual_hull.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "apps/view/image.h"
#include "apps/visual_hull/calibrate/board_sheet.h"
#include "apps/visual_hull/calibrate/calibrate.h"
#include "apps/visual_hull/combine/combine.h"
#include "apps/visual_hull/formats/read_scene.h"
#include "apps/visual_hull/formats/turntable.h"
#include "apps/visual_hull/formats/write_scene.h"
#include "apps/visual_hull/masks/cut_out.h"
#include "apps/visual_hull/scene/axes.h"
#include "apps/visual_hull/scene/images.h"
#include "apps/visual_hull/texture/hull_texture.h"
#include "binding/base/arguments.h"
#include "binding/base/bindings.h"
#include "nef/base/text/in_quotes.h"
#include "nef/export/to_mesh.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mend_rounded.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef::python {
namespace {

nef::visual_hull::Matrix34 matrix_of(py::handle rows) {
  nef::visual_hull::Matrix34 result;
  const py::sequence given = py::reinterpret_borrow<py::sequence>(rows);
  if (py::len(given) != 3) throw InputError("a camera is a matrix of shape (3, 4)");
  for (std::size_t i = 0; i < 3; ++i) {
    const py::sequence row = given[i];
    if (row.size() != 4) throw InputError("a camera is a matrix of shape (3, 4)");
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = to_rational(row[j]);
  }
  return result;
}

using Mask = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

// Shades of grey.
void write_mask(const Mask& mask, const std::string& path) {
  if (mask.ndim() != 2) throw InputError("a mask is an array of shape (H, W)");
  view::Image image;
  image.height = static_cast<std::uint32_t>(mask.shape(0));
  image.width = static_cast<std::uint32_t>(mask.shape(1));
  image.rgb.reserve(3 * static_cast<std::size_t>(mask.size()));
  for (const std::uint8_t* pixel = mask.data(); pixel != mask.data() + mask.size(); ++pixel) {
    image.rgb.insert(image.rgb.end(), 3, *pixel);
  }
  write_file(path, view::png_bytes(image));
}

// An array of shape (H, W, 3), red, green and blue.
view::Image image_of(const Mask& pixels, const char* what) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3 || pixels.size() == 0) {
    throw InputError(std::string(what) + " is an array of shape (H, W, 3)");
  }
  view::Image image;
  image.height = static_cast<std::uint32_t>(pixels.shape(0));
  image.width = static_cast<std::uint32_t>(pixels.shape(1));
  image.rgb.assign(pixels.data(), pixels.data() + pixels.size());
  return image;
}

void write_photograph(const Mask& pixels, const std::string& path) {
  write_file(path, view::png_bytes(image_of(pixels, "a photograph")));
}

// A hull's mesh with its texture.
struct TexturedMesh {
  Mesh mesh;
  nef::visual_hull::HullTexture texture;
};

template <typename Number>
py::array_t<Number> array_of(const std::vector<py::ssize_t>& shape) {
  return py::array_t<Number>(shape);
}

// (vertices, triangles, places of their corners, image, share that no view sees)
py::tuple texture_tuple(const TexturedMesh& made) {
  const auto count = static_cast<py::ssize_t>(made.mesh.vertices.size());
  const auto faces = static_cast<py::ssize_t>(made.mesh.face_count());
  auto vertices = array_of<double>({count, 3});
  double* number = vertices.mutable_data();
  for (const Rational3& p : made.mesh.vertices) {
    for (const Rational& x : p) *number++ = nearest_double(x);
  }
  auto triangles = array_of<std::uint32_t>({faces, 3});
  std::copy(made.mesh.corners.begin(), made.mesh.corners.end(), triangles.mutable_data());
  auto places = array_of<float>({faces, 3, 2});
  float* place = places.mutable_data();
  for (const auto& [u, v] : made.texture.corners) {
    *place++ = u;
    *place++ = v;
  }
  const cv::Mat& bgr = made.texture.image;
  auto image = array_of<std::uint8_t>({bgr.rows, bgr.cols, 3});
  std::uint8_t* channel = image.mutable_data();
  for (auto pixel = bgr.begin<cv::Vec3b>(); pixel != bgr.end<cv::Vec3b>(); ++pixel) {
    for (const int i : {2, 1, 0}) *channel++ = (*pixel)[i];
  }
  return py::make_tuple(vertices, triangles, places, image, made.texture.unseen);
}

// The hull's triangles with coordinates that all formats keep, repaired where rounding made them cross.
Mesh float_mesh(const Polyhedron& hull, const Monitor& monitor) {
  Mesh mesh = to_mesh(hull, {}, monitor).mesh;
  MendedMesh rounded = round_mesh(mesh, rounding_to(FileNumbers::kFloats), monitor);
  return rounded.legal ? std::move(rounded.mesh) : std::move(mesh);
}

using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Triangles = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;
using Places = py::array_t<float, py::array::c_style | py::array::forcecast>;

void write_textured(const std::string& path, const Vertices& vertices, const Triangles& triangles, const Places& places,
                    const Mask& pixels) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3 || triangles.ndim() != 2 || triangles.shape(1) != 3 ||
      places.size() != 2 * triangles.size()) {
    throw InputError("a texture needs vertices (N, 3), triangles (M, 3) and places (M, 3, 2)");
  }
  Mesh mesh;
  for (py::ssize_t v = 0; v < vertices.shape(0); ++v) {
    mesh.vertices.push_back(
        {exact_rational(vertices.at(v, 0)), exact_rational(vertices.at(v, 1)), exact_rational(vertices.at(v, 2))});
  }
  MeshWriteOptions options;
  for (py::ssize_t t = 0; t < triangles.shape(0); ++t) {
    const std::array<std::uint32_t, 3> face{triangles.at(t, 0), triangles.at(t, 1), triangles.at(t, 2)};
    for (const std::uint32_t v : face) {
      if (v >= mesh.vertices.size()) throw InputError("a triangle names vertex " + std::to_string(v));
    }
    mesh.push_face(face);
  }
  for (const float* place = places.data(); place != places.data() + places.size(); place += 2) {
    options.texture.corners.push_back({place[0], place[1]});
  }
  options.texture.png = view::png_bytes(image_of(pixels, "the image of a texture"));
  write_mesh(path, mesh, options);
}

nef::visual_hull::WorldBox box_of(const py::object& box) {
  const std::array<Rational3, 2> corners = to_corners(box);
  return {corners[0], corners[1]};
}

nef::visual_hull::Way way_named(const std::string& name) {
  if (name == "best") return nef::visual_hull::Way::kBest;
  if (name == "direct") return nef::visual_hull::Way::kDirect;
  if (name == "cones") return nef::visual_hull::Way::kCones;
  throw InputError("way must be 'best', 'direct' or 'cones', not " + in_quotes(name));
}

// Of the keywords that nef/visual_hull.py lists; each is there.
nef::visual_hull::Options options_of(const py::dict& given) {
  nef::visual_hull::Options options;
  const auto flag = [&given](const char* key) { return argument<bool>(given, key); };
  options.silhouette.simplify = {argument<double>(given, "tolerance"), flag("outer")};
  options.silhouette.min_area = argument<double>(given, "min_area");
  options.silhouette.soft = flag("soft");
  options.silhouette.border =
      flag("unknown_beyond") ? nef::visual_hull::Border::kUnknown : nef::visual_hull::Border::kOutside;
  if (flag("half_pixels")) options.origin = nef::visual_hull::PixelOrigin::kCorner;
  if (!given["box"].is_none()) options.box = box_of(given["box"]);
  options.images = argument<std::optional<std::string>>(given, "images");
  if (!given["threshold"].is_none()) {
    options.silhouette.threshold = nef::visual_hull::parse_threshold(py::str(given["threshold"]).cast<std::string>());
  }
  options.silhouette.threshold.invert = flag("invert");
  if (!given["channel"].is_none()) {
    options.silhouette.threshold.channel = nef::visual_hull::parse_channel(argument<std::string>(given, "channel"));
  }
  if (!given["mask"].is_none()) {
    if (!given["threshold"].is_none() || !given["channel"].is_none() || flag("invert")) {
      throw InputError("mask excludes threshold, channel and invert, which are for images that are masks");
    }
    options.mask = nef::visual_hull::parse_mask_method(argument<std::string>(given, "mask"));
  }
  options.at_least = argument<std::optional<std::size_t>>(given, "at_least");
  options.way = way_named(argument<std::string>(given, "way"));
  if (options.at_least && options.way == nef::visual_hull::Way::kDirect) {
    throw InputError("at_least excludes way='direct': it overlays cones");
  }
  options.repair_masks = flag("repair_masks");
  options.refine = flag("refine");
  options.suspects = flag("suspects");
  options.drop_suspects = flag("drop_suspects");
  options.largest = flag("largest");
  options.verify = flag("verify") && !options.at_least;
  options.monitor = Monitor().on_threads(argument<unsigned>(given, "threads"));
  return options;
}

// (name, image, contours, holes, cut by the frame, inside, unexplained pixels, silhouette's pixels)
py::tuple view_tuple(const nef::visual_hull::ViewResult& view) {
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

py::list doubles_of(const nef::visual_hull::Camera& camera) {
  py::list rows;
  for (const auto& row : camera.matrix()) {
    py::list entries;
    for (const Rational& entry : row) entries.append(nearest_double(entry));
    rows.append(entries);
  }
  return rows;
}

py::dict refinement_dict(const nef::visual_hull::refine::Refinement& r) {
  py::dict result;
  result["accepted"] = r.accepted;
  result["model"] = nef::visual_hull::refine::model_name(r.model);
  result["residual"] = py::make_tuple(r.before.mean, r.after.mean);
  result["held_out"] = py::make_tuple(r.held_out_before.mean, r.held_out_after.mean);
  result["focal"] = r.focal;
  result["undetermined"] = r.undetermined;
  py::list views;
  py::list cameras;
  for (const nef::visual_hull::refine::RefinedView& view : r.views) {
    using nef::visual_hull::refine::Fault;
    const py::object fault = view.fault == Fault::kNone
                                 ? py::object(py::none())
                                 : py::object(py::str(view.fault == Fault::kMask ? "mask" : "camera"));
    views.append(py::make_tuple(view.name, view.moved_px, view.turned_degrees, view.residual_before,
                                view.residual_after, fault));
    cameras.append(doubles_of(view.camera));
  }
  result["views"] = views;
  result["cameras"] = cameras;
  return result;
}

// Names of the views that disagree with the others, those that were left out first.
py::list suspects_of(const nef::visual_hull::Result& made) {
  py::list names;
  for (const nef::visual_hull::Dropped& dropped : made.dropped) names.append(dropped.view);
  if (made.consistency && made.consistency->guilty) names.append(made.views[*made.consistency->guilty].name);
  return names;
}

py::dict compute(const nef::visual_hull::Scene& scene, const std::string& folder,
                 const nef::visual_hull::Options& options, bool textured, const py::object& progress) {
  const ProgressFunction told(progress);
  const auto [made, texture] = call(kSmallCall, [=](const Monitor& monitor) {
    const nef::ProgressFunction tell = told_by(told, monitor);
    nef::visual_hull::Options watched = options;
    watched.monitor = monitor.on_threads(options.monitor.threads()).telling(tell);
    nef::visual_hull::Result hull = nef::visual_hull::compute(scene, folder, watched);
    watched.monitor = watched.monitor.quiet();
    std::optional<TexturedMesh> on_it;
    if (textured && !hull.vanished) {
      Mesh mesh = float_mesh(hull.hull, watched.monitor);
      nef::visual_hull::HullTexture found =
          nef::visual_hull::hull_texture(mesh, hull.views, hull.origin, watched.monitor);
      on_it = TexturedMesh{std::move(mesh), std::move(found)};
    }
    return std::pair(std::move(hull), std::move(on_it));
  });
  py::dict result;
  result["hull"] = made.hull;
  result["box"] = py::make_tuple(from_triple(made.box.low), from_triple(made.box.high));
  result["vanished"] =
      made.vanished ? py::object(py::make_tuple(made.vanished->view, made.vanished->reason)) : py::none();
  py::list views;
  for (const nef::visual_hull::ViewResult& view : made.views) views.append(view_tuple(view));
  result["views"] = views;
  result["notes"] = made.notes;
  result["pieces"] = made.pieces;
  result["suspects"] = suspects_of(made);
  result["texture"] = texture ? py::object(texture_tuple(*texture)) : py::object(py::none());
  result["refinement"] = made.refinement ? py::object(refinement_dict(*made.refinement)) : py::object(py::none());
  return result;
}

// (K, coefficients)
nef::visual_hull::Distortion distortion_of(py::handle lens) {
  const py::sequence parts = py::reinterpret_borrow<py::sequence>(lens);
  if (parts.size() != 2) throw InputError("a lens is a matrix K of shape (3, 3) and its coefficients");
  nef::visual_hull::Distortion result;
  const py::sequence rows = parts[0];
  if (rows.size() != 3) throw InputError("K is a matrix of shape (3, 3)");
  for (std::size_t i = 0; i < 3; ++i) result.intrinsics[i] = to_triple(rows[i], "a row of K");
  result.coefficients = parts[1].cast<std::vector<double>>();
  constexpr std::array<std::size_t, 5> kCounts{4, 5, 8, 12, 14};
  if (std::find(kCounts.begin(), kCounts.end(), result.coefficients.size()) == kCounts.end()) {
    throw InputError("a lens has 4, 5, 8, 12 or 14 coefficients, as OpenCV has them");
  }
  return result;
}

// `turntable` is the number of images of a turn; the others are None if its camera is not known.
nef::visual_hull::Scene turntable_of(const py::dict& given) {
  const int count = argument<int>(given, "turntable");
  const auto intrinsics = argument<std::optional<std::vector<double>>>(given, "intrinsics");
  const auto radius = argument<std::optional<double>>(given, "radius");
  const double height = argument<double>(given, "height");
  if (!intrinsics && !radius) return nef::visual_hull::guess_turntable(count);
  if (!intrinsics || !radius) throw InputError("a turntable needs intrinsics and radius, or neither");
  return nef::visual_hull::make_turntable({count, *intrinsics, *radius, height});
}

py::dict from_file(const std::string& path, nef::visual_hull::Options options, const std::string& matrices,
                   const std::string& up, const py::object& turntable, const std::vector<std::string>& without,
                   bool textured, const py::object& progress) {
  const std::filesystem::path file(path);
  nef::visual_hull::Scene scene =
      turntable.is_none() ? nef::visual_hull::read_scene(file, {matrices}) : turntable_of(py::dict(turntable));
  if (!up.empty()) nef::visual_hull::turn_up(scene, up);
  const std::filesystem::path folder = nef::visual_hull::scene_folder(file);
  Messages notes;
  if (!without.empty()) {
    nef::visual_hull::leave_out_views(scene, without, folder, options.images, &notes);
    options.images.reset();  // the views have theirs
  }
  py::dict result = compute(scene, folder.string(), options, textured, progress);
  const auto more = result["notes"].cast<Messages>();
  notes.insert(notes.end(), more.begin(), more.end());
  result["notes"] = notes;
  return result;
}

py::dict from_views(const std::vector<std::string>& names, const std::vector<std::string>& images,
                    const py::list& matrices, const py::object& lenses, const std::string& folder,
                    const nef::visual_hull::Options& options, bool textured, const py::object& progress) {
  nef::visual_hull::Scene scene;
  for (std::size_t i = 0; i < names.size(); ++i) {
    nef::visual_hull::View& view = scene.views.emplace_back();
    view.name = names[i];
    view.image = images.at(i);
    view.camera = nef::visual_hull::Camera(names[i], matrix_of(matrices[i]));
    if (!lenses.is_none()) view.distortion = distortion_of(py::list(lenses)[i]);
  }
  return compute(scene, folder, options, textured, progress);
}

cv::Mat mask_of(const Mask& mask) {
  if (mask.ndim() != 2 || mask.size() == 0) throw InputError("a mask is an array of shape (H, W)");
  cv::Mat result(static_cast<int>(mask.shape(0)), static_cast<int>(mask.shape(1)), CV_8UC1);
  std::copy(mask.data(), mask.data() + mask.size(), result.begin<std::uint8_t>());
  return result;
}

// Without matrices the cameras are those of a turntable, to be found.
py::dict refine(const std::vector<std::string>& names, const std::vector<Mask>& masks, const py::object& matrices,
                bool half_pixels, bool soft, std::optional<double> camera_error, unsigned threads) {
  if (camera_error && !(*camera_error > 0)) throw InputError("camera_error must be above 0");
  std::vector<cv::Mat> images;
  std::vector<nef::visual_hull::Camera> cameras;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    images.push_back(mask_of(masks[i]));
    if (matrices.is_none()) {
      if (images[i].size() != images[0].size()) throw InputError("masks of a turntable have one shape");
      cameras.emplace_back();
    } else {
      cameras.emplace_back(names[i], matrix_of(py::list(matrices)[i]));
    }
  }
  const bool found = matrices.is_none();
  const nef::visual_hull::refine::Refinement made = call(kSmallCall, [=](const Monitor& monitor) {
    nef::visual_hull::SilhouetteOptions silhouettes;
    if (half_pixels) silhouettes.origin = nef::visual_hull::PixelOrigin::kCorner;
    silhouettes.soft = soft;
    std::vector<nef::visual_hull::ViewSilhouette> seen;
    for (std::size_t i = 0; i < images.size(); ++i) {
      seen.push_back(nef::visual_hull::silhouette_of_mask(images[i], {}, names[i], silhouettes, monitor));
    }
    std::vector<nef::visual_hull::refine::GivenView> views;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const nef::visual_hull::ImageSize size{images[i].cols, images[i].rows};
      views.push_back(
          {names[i], cameras[i], &seen[i].region, seen[i].cut_by_frame ? size : nef::visual_hull::ImageSize{}, {}});
    }
    nef::visual_hull::refine::RefineOptions options{silhouettes.origin, {}, camera_error};
    if (found && !images.empty()) options.turntable = nef::visual_hull::ImageSize{images[0].cols, images[0].rows};
    return nef::visual_hull::refine::refine_cameras(views, options, monitor.on_threads(threads));
  });
  return refinement_dict(made);
}

// (masks, qualities, what was chosen, notes)
py::tuple masks(const std::vector<std::string>& photographs, const std::string& method, bool soft, unsigned threads) {
  const nef::visual_hull::CutOuts made = call(kSmallCall, [=](const Monitor& monitor) {
    const std::vector<std::filesystem::path> files(photographs.begin(), photographs.end());
    nef::visual_hull::MaskMethod parsed = nef::visual_hull::parse_mask_method(method);
    parsed.soft = soft;
    return nef::visual_hull::cut_out(files, parsed, monitor.on_threads(threads));
  });
  py::list arrays;
  for (const cv::Mat& mask : made.masks) {
    py::array_t<std::uint8_t> array({mask.rows, mask.cols});
    std::copy(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(), array.mutable_data());
    arrays.append(array);
  }
  return py::make_tuple(arrays, made.quality, made.chosen, made.notes);
}

py::bytes board(const std::string& description, const std::string& extension) {
  return py::bytes(nef::visual_hull::board_file(nef::visual_hull::parse_board(description), extension));
}

py::list calibrated_views(const nef::visual_hull::Calibration& made,
                          const std::vector<nef::visual_hull::CalibratedView>& views) {
  py::list result;
  for (const nef::visual_hull::CalibratedView& view : views) {
    const bool good = view.refused.empty();
    const std::string name = view.photograph.string();
    const py::object camera =
        good ? py::object(doubles_of(nef::visual_hull::make_view(name, made.lens.lens, view.pose).camera))
             : py::object(py::none());
    result.append(py::make_tuple(name, view.corners, view.borders,
                                 good ? py::object(py::float_(view.error_px)) : py::none(), camera,
                                 good ? py::object(py::none()) : py::object(py::str(view.refused))));
  }
  return result;
}

py::dict calibrate(const std::vector<std::string>& photographs, const std::string& board,
                   const std::vector<std::string>& lens, const std::string& scene, unsigned threads) {
  const nef::visual_hull::Calibration made = call(kSmallCall, [=](const Monitor& monitor) {
    nef::visual_hull::Calibration found =
        nef::visual_hull::calibrate({photographs.begin(), photographs.end()}, nef::visual_hull::parse_board(board),
                                    {lens.begin(), lens.end()}, monitor.on_threads(threads));
    if (!scene.empty()) nef::visual_hull::write_scene_file(scene, found.scene());
    return found;
  });
  const nef::visual_hull::BoardLens& found = made.lens;
  py::dict result;
  result["focal"] = py::make_tuple(found.lens.fx, found.lens.fy);
  result["focal_deviation"] = found.focal_share;
  result["principal_point"] = py::make_tuple(found.lens.cx, found.lens.cy);
  result["principal_point_assumed"] = found.centred;
  result["distortion"] = found.lens.distortion;
  result["error"] = made.error_px;
  result["camera_error"] = made.scene().camera_error;
  result["views"] = calibrated_views(made, made.views);
  result["lens_views"] = calibrated_views(made, made.lens_views);
  result["notes"] = made.notes;
  return result;
}

// (scene, views, whether it fits, whether another place does, rotation, scale, translation, pixels alone, together,
// held out, next best place)
py::tuple placed_tuple(const nef::visual_hull::PlacedSeries& series) {
  const nef::visual_hull::Placement& p = series.placement;
  const nef::visual_hull::refine::Similarity to_first = p.to_first();
  std::array<std::array<double, 3>, 3> rotation{};
  std::array<double, 3> translation{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) rotation[i][j] = to_first.rotation(row, static_cast<Eigen::Index>(j));
    translation[i] = to_first.shift[row];
  }
  return py::make_tuple(series.name, series.views, p.fits(), p.ambiguous(), rotation, to_first.scale, translation,
                        p.alone_px, p.together_px, p.held_out_px, p.runner_up_px);
}

// The series but the first, and notes; the scene is written if all series fit.
py::tuple combine(const std::vector<std::string>& scenes, const std::string& file,
                  const nef::visual_hull::Options& options) {
  const nef::visual_hull::Combined made = call(kSmallCall, [=](const Monitor& monitor) {
    nef::visual_hull::Options watched = options;
    watched.monitor = monitor.on_threads(options.monitor.threads());
    nef::visual_hull::Combined found = nef::visual_hull::combine({scenes.begin(), scenes.end()}, watched);
    if (found.fits()) nef::visual_hull::write_scene_file(file, found.scene);
    return found;
  });
  py::list series;
  for (const nef::visual_hull::PlacedSeries& placed : made.series) series.append(placed_tuple(placed));
  return py::make_tuple(series, made.notes);
}

void define_module(py::module_& m) {
  m.doc() = "The core of the package nef.visual_hull; see there.";
  py::module_::import("nef._nef");
  py::class_<nef::visual_hull::Options>(m, "Options").def(py::init(&options_of));
  m.def("write_mask", &write_mask);
  m.def("write_photograph", &write_photograph);
  m.def("write_textured", &write_textured);
  m.def("from_file", &from_file);
  m.def("from_views", &from_views);
  m.def("refine", &refine);
  m.def("masks", &masks);
  m.def("board", &board);
  m.def("calibrate", &calibrate);
  m.def("combine", &combine);
}

}  // namespace
}  // namespace nef::python

PYBIND11_MODULE(_visual_hull, m) {
  nef::python::define_module(m);
  nef::python::explain_arguments(m);
}
