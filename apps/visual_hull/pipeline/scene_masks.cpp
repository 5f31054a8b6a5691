// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/pipeline/scene_masks.h"

#include <algorithm>

#include "apps/visual_hull/masks/cut_out.h"
#include "apps/visual_hull/silhouette/opacity.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

/// Decides again what the other views contradict, of the masks of photographs.
void repair_cut_out(const Run& run, PixelOrigin origin, Result& result, std::vector<cv::Mat>& masks,
                    const nef::Monitor& monitor) {
  run.tell(Phase::kLoad, "masks, compared", 0, masks.size());
  std::vector<PhotographedView> views;
  std::vector<std::size_t> numbers;
  std::vector<cv::Mat> own;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const ViewResult& view = result.views[i];
    if (view.image.empty()) continue;
    views.push_back({view.name, view.image, view.camera, view.distortion});
    numbers.push_back(i);
    own.push_back(object_of(masks[i]));
  }
  const std::vector<MaskChange> changes = repair_masks(views, origin, own, monitor);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    cv::Mat& mask = masks[numbers[k]];
    own[k].copyTo(mask, object_of(mask) != own[k]);
    result.views[numbers[k]].mask_change = changes[k];
  }
  const nef::Messages lines = change_lines(views, changes);
  result.notes.insert(result.notes.end(), lines.begin(), lines.end());
}

/// The masks of photographs, in one go, since one rule is looked for that suits all.
void cut_out_views(const Run& run, const Scene& scene, Result& result, std::vector<cv::Mat>& masks,
                   const nef::Monitor& monitor) {
  std::vector<std::filesystem::path> photographs;
  for (const ViewResult& view : result.views) {
    if (!view.image.empty()) photographs.push_back(view.image);
  }
  if (photographs.empty()) return;
  run.tell(Phase::kLoad, "masks", 0, photographs.size());
  MaskMethod method = *run.options.mask;
  method.soft = run.options.silhouette.soft;
  CutOuts cut = cut_out(photographs, method, monitor);
  result.notes.push_back("masks: " + cut.chosen);
  result.notes.insert(result.notes.end(), cut.notes.begin(), cut.notes.end());
  std::size_t next = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (result.views[i].image.empty()) continue;
    masks[i] = std::move(cut.masks[next++]);
    check_size_of(masks[i], scene.views[i], result.views[i].image.string());
  }
  if (run.options.repair_masks) repair_cut_out(run, result.origin, result, masks, monitor);
}

cv::Mat load_mask(const ViewResult& entry, const View& view, const SilhouetteOptions& options) {
  if (entry.image.empty()) return {};
  cv::Mat mask = read_mask(entry.image, view.name, options);
  check_size_of(mask, view, entry.image.string());
  return mask;
}

}  // namespace

SilhouetteOptions silhouette_options(const Scene& scene, const Options& options) {
  SilhouetteOptions result = options.silhouette;
  result.origin = options.origin.value_or(scene.origin);
  if (!scene.threshold) return result;
  ThresholdOptions& threshold = result.threshold;
  if (threshold.kind == ThresholdOptions::Kind::kDefault) {
    threshold.kind = scene.threshold->kind;
    threshold.value = scene.threshold->value;
  }
  if (threshold.channel == ThresholdOptions::Channel::kGray) threshold.channel = scene.threshold->channel;
  threshold.invert = threshold.invert || scene.threshold->invert;
  return result;
}

Views views_of(const Scene& scene) {
  Views views(scene.views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].name = scene.views[i].name;
    views[i].camera = scene.views[i].camera;
    views[i].distortion = scene.views[i].distortion;
  }
  return views;
}

void check_size_of(const cv::Mat& mask, const View& view, const std::string& what) {
  if (!view.size || (view.size->width == mask.cols && view.size->height == mask.rows)) return;
  throw nef::InputError("view " + view.name + ": " + what + " has " + std::to_string(mask.cols) + " x " +
                        std::to_string(mask.rows) + " pixels, but its camera was calibrated for " +
                        std::to_string(view.size->width) + " x " + std::to_string(view.size->height) +
                        ": scale the image or the intrinsics");
}

std::vector<cv::Mat> masks_of(const Run& run, const Scene& scene, const std::filesystem::path& folder,
                              const SilhouetteOptions& options, Result& result, const nef::Monitor& monitor) {
  std::vector<cv::Mat> masks(result.views.size());
  timed(result.phases, Phase::kLoad, monitor, [&](const nef::Monitor& watching) {
    const std::vector<std::filesystem::path> images = images_of(scene, folder, run.options.images, &result.notes);
    for (std::size_t i = 0; i < masks.size(); ++i) {
      if (!scene.views[i].polygons) result.views[i].image = images[i];
    }
    if (run.options.mask) return cut_out_views(run, scene, result, masks, watching);
    run.each_view(Phase::kLoad, result.views, watching, [&](std::size_t i, const nef::Monitor&) {
      masks[i] = load_mask(result.views[i], scene.views[i], options);
    });
  });
  return masks;
}

}  // namespace nef::visual_hull
