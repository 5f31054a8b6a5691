// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/pipeline/view_silhouettes.h"

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

/// A silhouette as cameras are refined by: along the sides of pixels, and nothing beyond the frame.
Silhouette outline_of(const View& view, const cv::Mat& mask, SilhouetteOptions options, const nef::Monitor& monitor) {
  options.simplify = {};
  options.border = Border::kOutside;
  return view.polygons ? silhouette_of_polygons(*view.polygons, view.name, options, monitor).region
                       : silhouette_of_mask(mask, view.distortion, view.name, options, monitor).region;
}

/// The size that all images have. Throws InputError naming a view of another size, or of no image.
ImageSize size_of_all(const Views& views) {
  const cv::Size first = views[0].silhouette.image_size;
  for (const ViewResult& view : views) {
    const cv::Size& size = view.silhouette.image_size;
    if (size != first || size.area() == 0) {
      throw nef::InputError("view " + view.name + ": images of a turntable have one size");
    }
  }
  return {first.width, first.height};
}

}  // namespace

void add_silhouettes(const Run& run, const Scene& scene, std::vector<cv::Mat> masks, const SilhouetteOptions& options,
                     Result& result, std::vector<Silhouette>& outlines, const nef::Monitor& monitor) {
  timed(result.phases, Phase::kContours, monitor, [&](const nef::Monitor& watching) {
    run.each_view(Phase::kContours, result.views, watching, [&](std::size_t i, const nef::Monitor& own) {
      const View& view = scene.views[i];
      result.views[i].silhouette = view.polygons
                                       ? silhouette_of_polygons(*view.polygons, view.name, options, own)
                                       : silhouette_of_mask(masks[i], view.distortion, view.name, options, own);
      if (!outlines.empty()) outlines[i] = outline_of(view, masks[i], options, own);
      masks[i].release();
    });
  });
}

void refine_views(const Run& run, const Scene& scene, const std::vector<Silhouette>& outlines, Result& result,
                  Place& place, const nef::Monitor& monitor) {
  timed(result.phases, Phase::kRefine, monitor, [&](const nef::Monitor& watching) {
    run.tell(Phase::kRefine, "", 0, 1);
    std::vector<refine::GivenView> given;
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      const ViewSilhouette& s = result.views[i].silhouette;
      const ImageSize frame = s.cut_by_frame ? ImageSize{s.image_size.width, s.image_size.height} : ImageSize{};
      given.push_back({scene.views[i].name, result.views[i].camera, &outlines[i], frame, scene.views[i].distortion});
    }
    refine::RefineOptions options{result.origin, {}, scene.camera_error};
    if (scene.guessed) options.turntable = size_of_all(result.views);
    result.refinement = refine::refine_cameras(given, options, watching);
    if (!result.refinement->accepted) return;
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < result.views.size(); ++i) {
      cameras.push_back(result.refinement->views[i].camera);
      result.views[i].camera = cameras.back();
    }
    place = place_of(cameras);
  });
}

}  // namespace nef::visual_hull
