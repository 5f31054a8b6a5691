// SPDX-License-Identifier: Apache-2.0
//
// The options are declared in two groups, input and output, and their values go to `Arguments` as they are;
// `to_options` and `scene_of` turn these into what the library takes, and refuse combinations that mean nothing.
#include "apps/visual_hull/command/arguments.h"

#include <cstdlib>
#include <opencv2/core/version.hpp>

#include "apps/program/common_options.h"
#include "apps/program/version.h"
#include "apps/visual_hull/formats/scene_json.h"
#include "apps/visual_hull/formats/turntable.h"
#include "apps/visual_hull/scene/axes.h"
#include "apps/visual_hull/scene/images.h"
#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/io/polyhedron_file.h"

namespace nef::visual_hull {
namespace {

const char* const kFooter =
    "Subcommands, each with a --help: visual_hull masks PHOTOGRAPHS -o DIR cuts objects out of photographs,\n"
    "visual_hull board -o FILE.pdf makes a board for printing, visual_hull calibrate PHOTOGRAPHS -o SCENE.json\n"
    "finds the cameras of photographs of such a board, and visual_hull combine SCENES -o SCENE.json makes one scene "
    "of\n"
    "series between which the object was turned over.\n"
    "Formats of scenes are recognized by content; --check reports what was understood:\n"
    "  .json      {\"cameras\": [{\"image\": FILE, \"P\": 3x4} or {\"image\": FILE, \"K\": 3x3, \"R\": 3x3, \"t\": 3,\n"
    "             \"distortion\": [k1, k2, p1, p2, ...]}, ...], \"box\": [x0,y0,z0,x1,y1,z1], \"threshold\": "
    "N|\"otsu\"};\n"
    "             \"polygons\": [[[u,v], ...], ...] or \"silhouette\": FILE.json may replace \"image\"\n"
    "  .json      NeRF's, instant-ngp's or nerfstudio's transforms (with \"frames\")\n"
    "  DIR        a COLMAP model (cameras and images, .txt or .bin; also in sparse/0), a transforms.json,\n"
    "             NAME.pa, each a 3x4 matrix, or PMVS's CONTOUR files (in txt/)\n"
    "  .yml .xml  OpenCV's FileStorage: camera_matrix, distortion_coefficients, extrinsic_parameters, or R and t, or "
    "P\n"
    "  .mat       MATLAB 5: a cell array of 3x4 matrices, an array 3x4xN, or N variables\n"
    "  *_par.txt  Middlebury: name, K, R, t on each line\n"
    "  .txt       name and 12 numbers (3x4 matrix) on each line, or matrices of three lines, or blocks of\n"
    "             '#Intrinsic parameter' and '#Extrinsic parameter for IMAGE'\n"
    "  .vsh       Hachenberger's polygons in space\n"
    "Numbers are exact (\"1/3\" too). x = P X; u = x1/x3 to the right, v = x2/x3 down,\n"
    "x3 > 0 in front. Images are looked up beside the scene and in masks/, silhouettes/ and images/ there.\n"
    "-o, --report, --page and --refined-scene write a temporary file and rename it on success.\n"
    "Exit codes: 0 success, 1 empty or flat hull or failed --verify, 2 bad input or usage.";

}  // namespace

void add_mask_options(CLI::App& app, Arguments& a) {
  app.add_option("--threshold", a.threshold,
                 "N or otsu: pixels brighter than this are object (default: half of the range, or alpha)")
      ->type_name("N");
  app.add_option("--channel", a.channel,
                 "Channel that --threshold compares, such as red before a blue screen (default: gray)")
      ->check(CLI::IsMember(channel_names()));
  app.add_option("--mask", a.mask,
                 "The images are photographs: cut the object out of all of them by one method: " + mask_help())
      ->type_name("METHOD");
  app.add_flag("--invert", a.invert, "The object is darker than the background");
  app.add_option(
         "--pixel-origin", a.origin,
         "Whether whole image coordinates are the center or the upper left corner of a pixel (default: by format)")
      ->check(CLI::IsMember({"center", "corner"}));
  app.add_flag("--soft", a.soft,
               "Outlines to a fraction of a pixel: where the opacity, or what the threshold compares, is half between "
               "centres of pixels (default: along the edges of pixels)");
  app.add_option("--min-area", a.min_area,
                 "Drop islands and fill holes of fewer square pixels (with --outer holes only)")
      ->check(nef::not_negative())
      ->type_name("PX2");
}

namespace {

void add_input_options(CLI::App& app, Arguments& a) {
  app.add_option("SCENE", a.scene, "Cameras, in one of the formats below; with --turntable a folder of images")
      ->required();
  app.add_flag(
      "--check", a.check,
      "Report what is understood of the scene, one line per view, and compute no hull; with --mask or --overlay also "
      "what the silhouettes are like, and --overlay draws them");
  app.add_option("--up", a.up, "The axis of the scene that becomes +z: x, y, z, -x, -y or -z")->type_name("AXIS");
  app.add_option("--matrices", a.matrices,
                 "Which matrices of an OpenCV or MATLAB file are the projections; * matches a number")
      ->type_name("NAME");
  CLI::Option* turntable =
      app.add_option("--turntable", a.turntable, "The object turns by 1/N of a turn between images; -N: clockwise")
          ->type_name("N");
  app.add_option("--K", a.intrinsics, "Camera of the turntable: f,cx,cy or fx,fy,cx,cy or nine numbers")
      ->delimiter(',')
      ->needs(turntable);
  app.add_option("--radius", a.radius, "Distance of the camera from the axis (z) of the turntable")->needs(turntable);
  app.add_option("--height", a.height,
                 "Height of the camera of the turntable above the origin, which it looks at (default: 0)")
      ->needs(turntable);
  app.add_option("--images", a.images,
                 "Directory with an image for each view, found by the names in the scene, or else by the order of the "
                 "numbers in "
                 "their names")
      ->type_name("DIR");
  app.add_option("--without", a.without, "Leave out these views, by their names (--check lists them)")
      ->take_all()
      ->type_name("VIEW");
  app.add_option(
         "--frames", a.frames,
         "Video: one folder of images per frame, as in frame_%04d/; -o needs such a number, too. Frames that the "
         "manifest beside the hulls lists are not computed again")
      ->type_name("DIR%d");
  app.add_option("--silhouette", a.silhouettes,
                 "[VIEW=]FILE.json: polygons instead of a view's image; without VIEW, for the views in order")
      ->take_all()
      ->type_name("FILE");
  add_mask_options(app, a);
  app.add_flag("--repair-masks", a.repair_masks,
               "Correct pixels of the masks of --mask that the other views contradict, and report each change");
  app.add_option("--border", a.border,
                 "A silhouette that is cut by the image frame ends there (outside) or may go on (unknown)")
      ->check(CLI::IsMember({"outside", "unknown"}))
      ->capture_default_str();
  app.add_option("--simplify", a.simplify, "Simplify polygons within this many pixels")
      ->check(nef::not_negative())
      ->type_name("PX");
  app.add_flag("--outer", a.outer, "Simplified polygons contain the contour: the hull is an outer bound");
  app.add_option("--box", a.box, "x0,y0,z0,x1,y1,z1: the part of space to compute (default: found from the cones)")
      ->type_name("BOX");
}

void add_output_options(CLI::App& app, Arguments& a) {
  app.add_option(
         "-o,--output", a.session.output,
         "Write the hull; the extension (" + nef::word_list(nef::file_extensions(), "or") + ") selects the format")
      ->type_name("FILE");
  nef::add_file_output_options(app, a.session.exact, a.session.binary, a.session.text);
  nef::add_mesh_file_options(app, a.session.mesh_file);
  app.add_option("--decimate", a.decimate, "Write a mesh of about N triangles, and report its distance from the hull")
      ->check(nef::positive())
      ->type_name("N");
  app.add_flag("--manifold", a.session.mesh_file.manifold,
               "Write a mesh in which each edge has two faces: diagonal pixels are joined, other contacts are split");
  app.add_flag("--color", a.color,
               "Give each vertex the mean colour of the views that see it (PLY, GLB, --page, --picture); photographs "
               "for masks/NAME are searched in images/");
  app.add_flag(
      "--texture", a.texture,
      "Make an image of the surface from the photographs (GLB, 3MF; OBJ and PLY with files beside them; --page, "
      "--picture)");
  app.add_flag("--verify", a.verify, "Project the hull back into every view; exit code 1 if it is not inside");
  app.add_option(
         "--way", a.way,
         "Vertex by vertex (direct), by intersecting cones (cones), or whichever suits the views (best); same hull")
      ->check(CLI::IsMember({"best", "direct", "cones"}))
      ->capture_default_str();
  CLI::Option* refine = app.add_flag(
      "--refine", a.refine,
      "Correct the cameras so that the silhouettes agree, if this also improves outlines that were not used");
  app.add_option("--refined-scene", a.refined_scene, "Write the scene with the cameras that were used")
      ->needs(refine)
      ->type_name("FILE.json");
  app.add_flag("--suspects", a.suspects, "Compare the views and report which one disagrees with the others");
  app.add_flag("--drop-suspects", a.drop_suspects, "Leave out the view that disagrees, and repeat until none does");
  app.add_option("--at-least", a.at_least, "The points in at least K silhouettes, instead of in all")
      ->check(nef::positive())
      ->type_name("K");
  app.add_flag("--largest", a.largest, "Keep the piece of the largest volume only");
  app.add_flag("--exact-volume", a.exact_volume,
               "Report the exact volume, too (millions of digits for detailed hulls)");
  app.add_option("--report", a.session.report, "Write a report as JSON ('-': standard output)")->type_name("FILE.json");
  app.add_option("--overlay", a.overlay, "Directory for a picture per view: image, polygon, projection of the hull")
      ->type_name("DIR");
  app.add_option("--page", a.page, "Write a page that shows the hull with its cameras and their images")
      ->type_name("FILE.html");
  app.add_option("--picture", a.picture, "Draw the hull")->type_name("FILE.png");
  CLI::Option* points = app.add_option("--points", a.points,
                                       "Write points of the surface with normals (.ply) and colours (.ply, or .txt as "
                                       "COLMAP's points3D.txt), for programs that begin with points")
                            ->type_name("FILE");
  app.add_option("--samples", a.samples, "How many points --points writes")
      ->check(nef::positive())
      ->capture_default_str()
      ->needs(points)
      ->type_name("N");
  app.add_option(
         "--hull-masks", a.hull_masks,
         "Directory for a mask of the hull per view, NAME.png for the photograph NAME, and bounding_box.txt, as "
         "COLMAP's stereo_fusion takes them")
      ->type_name("DIR");
  nef::add_run_flags(&app, a.session);
}

}  // namespace

std::string mask_help() {
  return "auto (the measure that separates best), threshold[:CHANNEL[:LEVEL]] (<LEVEL: darker ones), background:FILE "
         "(a picture "
         "without the object), background:median (of a still camera), key:COLOUR (of a screen: #RRGGBB or a name), or "
         "grabcut[:X,Y,W,H], or grabcut:STROKES (a picture, or a folder of pictures, of the photographs' names, with "
         "#00FF00 painted over the object and #FF0000 over the background)";
}

void add_options(CLI::App& app, Arguments& arguments) {
  app.name("visual_hull");
  app.set_version_flag("--version", nef::version_text("visual_hull", {"OpenCV " CV_VERSION}));
  app.footer(kFooter);
  add_input_options(app, arguments);
  add_output_options(app, arguments);
}

Options to_options(const Arguments& a) {
  Options options;
  options.silhouette.simplify = {a.simplify, a.outer};
  options.silhouette.min_area = a.min_area;
  options.silhouette.soft = a.soft;
  if (a.session.mesh_file.manifold) options.silhouette.diagonal = DiagonalPixels::kJoin;
  options.silhouette.border = a.border == "unknown" ? Border::kUnknown : Border::kOutside;
  if (!a.origin.empty()) options.origin = a.origin == "corner" ? PixelOrigin::kCorner : PixelOrigin::kCenter;
  if (!a.threshold.empty()) options.silhouette.threshold = parse_threshold(a.threshold);
  options.silhouette.threshold.invert = a.invert;
  if (!a.channel.empty()) options.silhouette.threshold.channel = parse_channel(a.channel);
  if (!a.mask.empty()) {
    if (!a.threshold.empty() || !a.channel.empty() || a.invert) {
      throw nef::InputError("--mask excludes --threshold, --channel and --invert, which are for images that are masks");
    }
    options.mask = parse_mask_method(a.mask);
  }
  options.repair_masks = a.repair_masks;
  if (!a.box.empty()) options.box = parse_box(a.box);
  options.images = images_folder(a);
  if (a.way != "best") options.way = a.way == "direct" ? Way::kDirect : Way::kCones;
  options.refine = a.refine;
  options.suspects = a.suspects;
  options.drop_suspects = a.drop_suspects;
  if (a.at_least != 0) {
    if (a.verify) throw nef::InputError("--at-least excludes --verify: such a set is not inside every view");
    if (a.way == "direct") throw nef::InputError("--at-least excludes --way direct: it overlays cones");
    options.at_least = a.at_least;
  }
  options.verify = a.verify;
  options.largest = a.largest;
  options.monitor = a.session.monitor;
  return options;
}

Scene scene_of(const Arguments& a) {
  Scene scene;
  if (a.turntable) {
    const bool unknown = a.intrinsics.empty() && !a.radius;
    if (!(unknown && a.refine) && (a.intrinsics.empty() || !a.radius)) {
      throw nef::InputError(
          "--turntable: the camera is missing: give --K f,cx,cy, --radius R and --height H, or --refine to find it");
    }
    scene = unknown ? guess_turntable(*a.turntable) : make_turntable({*a.turntable, a.intrinsics, *a.radius, a.height});
  } else {
    scene = read_scene(a.scene, {a.matrices});
  }
  if (!a.up.empty()) turn_up(scene, a.up);
  take_silhouettes(scene, a.silhouettes);
  if (a.without.empty()) return scene;
  nef::Messages notes;
  leave_out_views(scene, a.without, scene_folder(a.scene),
                  a.images.empty() ? std::nullopt : std::optional<std::filesystem::path>(a.images), &notes);
  a.session.note_all(notes);
  return scene;
}

std::optional<std::filesystem::path> images_folder(const Arguments& a) {
  if (a.images.empty() || !a.without.empty()) return std::nullopt;
  return a.images;
}

void take_silhouettes(Scene& scene, const std::vector<std::string>& arguments) {
  std::size_t position = 0;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    const std::string name = equals == std::string::npos ? "" : argument.substr(0, equals);
    const std::string file = equals == std::string::npos ? argument : argument.substr(equals + 1);
    View* target = nullptr;
    if (equals == std::string::npos) {
      if (position >= scene.views.size()) {
        throw nef::InputError("--silhouette " + file + ": the scene has only " + std::to_string(position) + " views");
      }
      target = &scene.views[position++];
    } else {
      for (View& view : scene.views) {
        if (view.name == name) target = &view;
      }
      if (target == nullptr) throw nef::InputError("--silhouette: the scene has no view '" + name + "'");
    }
    target->polygons = read_polygons(file);
    target->image.clear();
  }
}

}  // namespace nef::visual_hull
