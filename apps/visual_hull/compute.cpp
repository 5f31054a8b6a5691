// SPDX-License-Identifier: Apache-2.0
//
// The pipeline: masks, contours, a box, cones, intersection.
#include <mutex>

#include "apps/visual_hull/bounds.h"
#include "apps/visual_hull/skeleton.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/base/error.h"
#include "nef/base/parallel.h"
#include "nef/base/phase_timer.h"
#include "nef/construct/construct.h"

namespace visual_hull {
namespace {

constexpr std::size_t kDirectVertices = 150;  // of all polygons: with fewer the general way is as fast

constexpr std::size_t kDirectViews =
    16;  // with more, pairs of views are so many that halving them step by step is faster

struct LoadedMask {
  cv::Mat mask;
  cv::Mat unseen;
};

class Pipeline {
 public:
  Pipeline(const Scene& scene, const std::filesystem::path& folder, const Options& options, const Progress& progress)
      : scene_(scene), folder_(folder), options_(options), silhouette_(options.silhouette), progress_(progress) {
    if (!scene.threshold) return;
    // What the command line does not say, the scene does.
    ThresholdOptions& threshold = silhouette_.threshold;
    if (threshold.kind == ThresholdOptions::Kind::kDefault) {
      threshold.kind = scene.threshold->kind;
      threshold.value = scene.threshold->value;
    }
    if (threshold.channel == ThresholdOptions::Channel::kGray) threshold.channel = scene.threshold->channel;
    threshold.invert = threshold.invert || scene.threshold->invert;
  }

  Result run() {
    timed(result_.phases, Phase::kLoad, [this] { load(); });
    timed(result_.phases, Phase::kContours, [this] { trace(); });
    timed(result_.phases, Phase::kCones, [this] {
      choose_box();
      make_parts();
    });
    timed(result_.phases, Phase::kIntersection, [this] { intersect(); });
    if (options_.verify && !result_.vanished) {
      timed(result_.phases, Phase::kVerify, [this] { verify(); });
    }
    return std::move(result_);
  }

 private:
  void tell(Phase phase, const std::string& view, std::size_t done, std::size_t total) const {
    if (progress_) progress_(phase, view, done, total);
  }

  // body(i) for every view, on as many threads as the user allows.
  void each_view(Phase phase, const std::function<void(std::size_t)>& body) const {
    const std::size_t count = result_.views.size();
    std::size_t begun = 0;
    std::mutex telling;
    nef::parallel_for(count, options_.threads, [&](std::size_t i) {
      {
        const std::lock_guard<std::mutex> lock(telling);
        tell(phase, result_.views[i].name, begun++, count);
      }
      body(i);
    });
  }

  void load() {
    find_images();
    masks_.resize(scene_.views.size());
    each_view(Phase::kLoad, [this](std::size_t i) {
      if (result_.views[i].image.empty()) return;
      masks_[i].mask = read_mask(result_.views[i].image, scene_.views[i], silhouette_, &masks_[i].unseen);
    });
  }

  void find_images() {
    std::vector<std::filesystem::path> images;
    if (options_.images) {
      images = list_images(*options_.images);
      if (images.size() != scene_.views.size()) {
        throw nef::InputError(options_.images->string() + " holds " + std::to_string(images.size()) +
                              " images, but the scene has " + std::to_string(scene_.views.size()) + " views");
      }
    }
    for (std::size_t i = 0; i < scene_.views.size(); ++i) {
      const View& view = scene_.views[i];
      ViewResult entry;
      entry.name = view.name;
      entry.camera = view.camera;
      entry.distortion = view.distortion;
      if (!view.polygons) {
        if (images.empty() && view.image.empty()) {
          throw nef::InputError("view " + view.name + ": the scene names no image; give --images DIR or --silhouette");
        }
        entry.image = images.empty() ? find_image(folder_, view.image.string()) : images[i];
      }
      result_.views.push_back(std::move(entry));
    }
  }

  void trace() {
    each_view(Phase::kContours, [this](std::size_t i) {
      const View& view = scene_.views[i];
      result_.views[i].silhouette = view.polygons
                                        ? silhouette_of_polygons(*view.polygons, view.name, silhouette_)
                                        : silhouette_of_mask(masks_[i].mask, masks_[i].unseen, view.name, silhouette_);
      masks_[i] = {};
    });
  }

  // The box to look at, and one that is known to hold the hull in its interior if there is one.
  void choose_box() {
    const bool given = options_.box || scene_.box;
    if (given) {
      result_.box = options_.box ? *options_.box : *scene_.box;
      check_box(result_.box, "box");
    }
    std::vector<HalfSpace> half_spaces;
    std::size_t vertices = 0;
    for (const ViewResult& view : result_.views) {
      if (view.silhouette.background) continue;
      vertices += view.silhouette.region.vertex_count();
      const std::vector<HalfSpace> cone = convex_cone(view.camera, view.silhouette.region);
      half_spaces.insert(half_spaces.end(), cone.begin(), cone.end());
    }
    // For a few vertices it is not worth the time.
    if (given && vertices < kDirectVertices) return;
    const Bounds bounds = bounds_of(half_spaces);
    if (bounds.kind == Bounds::Kind::kBox) result_.enclosing = loosen(bounds.box);
    if (given) return;
    if (bounds.kind == Bounds::Kind::kUnbounded) {
      throw nef::InputError("the cones of the views do not bound the scene: give a box with --box x0,y0,z0,x1,y1,z1");
    }
    result_.box_found = true;
    if (bounds.kind == Bounds::Kind::kEmpty) {
      report_empty_bounds();
    } else {
      result_.box = *result_.enclosing;
    }
  }

  // The convex hulls of the cones have no common point: find the view that takes the last one.
  void report_empty_bounds() {
    std::vector<HalfSpace> half_spaces;
    for (const ViewResult& view : result_.views) {
      if (view.silhouette.background) continue;
      const std::vector<HalfSpace> cone = convex_cone(view.camera, view.silhouette.region);
      half_spaces.insert(half_spaces.end(), cone.begin(), cone.end());
      if (bounds_of(half_spaces).kind == Bounds::Kind::kEmpty) {
        result_.vanished = Vanished{view.name, "its cone has no point in common with what the views before it left"};
        return;
      }
    }
  }

  void make_parts() {
    if (result_.vanished) return;
    parts_.resize(result_.views.size());
    each_view(Phase::kCones, [this](std::size_t i) {
      ViewResult& view = result_.views[i];
      nef::Polyhedron cone = make_cone(view.camera, view.silhouette.region, result_.box);
      view.cone_facets = nef::counts(cone).facets;
      if (view.silhouette.background) cone = nef::complement(nef::interior(cone));
      const auto& row = view.camera.matrix()[2];
      parts_[i] = {std::move(cone), {row[0], row[1], row[2]}};
    });
  }

  // Vertex by vertex, where the views allow that.
  bool intersect_directly() {
    std::size_t vertices = 0;
    std::vector<SkeletonInput> inputs;
    for (const ViewResult& view : result_.views) {
      if (view.silhouette.background) return false;
      vertices += view.silhouette.region.vertex_count();
      inputs.push_back({&view.camera, &view.silhouette.region});
    }
    if (!result_.enclosing || vertices < kDirectVertices || inputs.size() > kDirectViews) return false;
    for (std::size_t i = 0; i < 3 && !result_.box_found; ++i) {
      if (result_.enclosing->low[i] <= result_.box.low[i] || result_.enclosing->high[i] >= result_.box.high[i])
        return false;
    }
    tell(Phase::kIntersection, "edges", 0, 1);
    std::optional<nef::Polyhedron> hull = direct_hull(inputs, *result_.enclosing, options_.threads);
    if (!hull || hull->is_empty()) return false;  // the general way finds out why
    result_.hull = std::move(*hull);
    result_.direct = true;
    return true;
  }

  void intersect() {
    if (result_.vanished || (options_.direct && intersect_directly())) return;
    const nef::Polyhedron box = nef::make_box(result_.box.low, result_.box.high);
    std::vector<Part> all = parts_;
    // A box that was found is larger than what the cones leave, but for views that keep space.
    bool needed = !result_.box_found;
    for (const ViewResult& view : result_.views) needed = needed || view.silhouette.background;
    if (needed) all.push_back({box, {}});
    result_.hull = intersect_parts(std::move(all), options_.threads, [this](std::size_t done, std::size_t total) {
      tell(Phase::kIntersection, "", done, total);
    });
    if (result_.hull.is_empty()) {
      const std::size_t view = vanishes_at(parts_, box, false).value_or(parts_.size() - 1);
      result_.vanished = Vanished{result_.views[view].name, describe(view)};
    } else if (nef::interior(result_.hull).is_empty()) {
      const std::size_t view = vanishes_at(parts_, box, true).value_or(parts_.size() - 1);
      result_.vanished =
          Vanished{result_.views[view].name, "what it leaves has no volume (only points, edges or facets)"};
    }
  }

  std::string describe(std::size_t index) const {
    const ViewResult& view = result_.views[index];
    if (sgn(depth_range(view.camera, result_.box).farthest) <= 0) {
      return "the whole box lies behind its camera (a matrix of the other sign?)";
    }
    return "its cone has no point in common with what the views before it left of the box";
  }

  void verify() {
    each_view(Phase::kVerify, [this](std::size_t i) {
      ViewResult& view = result_.views[i];
      if (!view.silhouette.background) {
        view.verification = verify_view(result_.hull, view.camera, view.silhouette.region);
        return;
      }
      Verification check;
      check.inside = nef::subtract(result_.hull, parts_[i].solid).is_empty();
      if (!check.inside) check.problem = "a part of the hull is seen as background";
      check.area_known = false;
      view.verification = check;
    });
  }

  const Scene& scene_;
  std::filesystem::path folder_;
  const Options& options_;
  SilhouetteOptions silhouette_;
  const Progress& progress_;
  std::vector<LoadedMask> masks_;
  std::vector<Part> parts_;
  Result result_;
};

}  // namespace

const char* phase_name(Phase phase) {
  static constexpr std::array<const char*, kPhaseCount> kNames{"load",         "contours", "cones",
                                                               "intersection", "verify",   "write"};
  return kNames[static_cast<std::size_t>(phase)];
}

void timed(PhaseReports& reports, Phase phase, const std::function<void()>& work) {
  PhaseReport& report = reports[static_cast<std::size_t>(phase)];
  const nef::PhaseTimer timer(report.seconds, report.predicates);
  work();
}

Result compute(const Scene& scene, const std::filesystem::path& folder, const Options& options,
               const Progress& progress) {
  return Pipeline(scene, folder, options, progress).run();
}

}  // namespace visual_hull
