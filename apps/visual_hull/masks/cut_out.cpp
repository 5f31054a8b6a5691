// SPDX-License-Identifier: Apache-2.0
//
// Two passes over the photographs. The first looks at small copies: each candidate measure is fitted to each of them,
// and the measure whose outlines are clearest in the median photograph is taken, with the median of its levels. A
// series has one level since one lamp lights it, and the median forgives photographs in which a fit went astray. The
// second pass applies measure and level to the photographs as they are.
#include "apps/visual_hull/masks/cut_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/grab_cut.h"
#include "apps/visual_hull/masks/measures.h"
#include "apps/visual_hull/masks/separation.h"
#include "apps/visual_hull/masks/soft_outline.h"
#include "apps/visual_hull/masks/strokes.h"
#include "apps/visual_hull/scene/image_file.h"
#include "apps/visual_hull/silhouette/opacity.h"
#include "apps/visual_hull/silhouette/silhouette.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;
using Photographs = std::vector<fs::path>;

constexpr std::size_t kMostTried = 8;    // photographs for the choice of a measure
constexpr std::size_t kMostMedian = 15;  // photographs that a median is made of
constexpr double kClear = 2;             // quality of outlines
constexpr double kOddArea = 3;           // times the median's

/// A measure with its level for the whole series.
struct Rule {
  Measure measure;
  double level = 0;
  double quality = 0;
};

class Series {
 public:
  Series(const Photographs& files, const nef::Monitor& monitor) : files_(files), monitor_(monitor) {}

  [[nodiscard]] CutOuts by_rule(const Rule& rule, bool soft) const {
    CutOuts result = start();
    each_picture([&](std::size_t i, const cv::Mat& picture) {
      const cv::Mat values = rule.measure.of(picture);
      const cv::Mat mask = object_above(values, rule.level);
      result.masks[i] = soft ? soft_outline(values, mask) : mask;
      result.quality[i] = separation(values, mask).quality;
    });
    result.chosen = fmt::format("{} above {:.1f}", rule.measure.name, rule.level);
    return result;
  }

  [[nodiscard]] CutOuts by_grab_cut(const MaskMethod& method) const {
    CutOuts result = start();
    std::atomic<std::size_t> with_strokes = 0;
    each_picture([&](std::size_t i, const cv::Mat& picture) {
      const fs::path strokes = method.strokes.empty() ? fs::path() : strokes_of(method.strokes, files_[i]);
      if (!strokes.empty()) ++with_strokes;
      result.masks[i] = strokes.empty() ? cut_in_rectangle(picture, rectangle_of(method, picture.size()))
                                        : cut_by_strokes(picture, seeds_of_file(strokes, files_[i], picture.size()));
      result.quality[i] = clearest(picture, result.masks[i]);
    });
    result.chosen = method.rectangle ? "GrabCut in the given rectangle" : "GrabCut within margins of 5 %";
    if (!method.strokes.empty()) {
      result.chosen = fmt::format("GrabCut, by strokes in {} of {} photographs", with_strokes, files_.size());
    }
    return result;
  }

  [[nodiscard]] CutOuts by_alpha(bool soft) const {
    CutOuts result = start();
    result.chosen = "alpha";
    result.quality.assign(files_.size(), 1e3);
    nef::parallel_for(files_.size(), monitor_, [&](std::size_t i, const nef::Monitor&) {
      const cv::Mat pixels = read_pixels(files_[i]);
      result.masks[i] = soft ? make_opacity(pixels, {}) : make_mask(pixels, {});
    });
    return result;
  }

  // The first of the series decides: such pictures come from programs.
  [[nodiscard]] bool has_alpha() const {
    const cv::Mat first = read_pixels(files_.front());
    if (first.channels() != 4) return false;
    double low = 0;
    double high = 0;
    cv::Mat alpha;
    cv::extractChannel(first, alpha, 3);
    cv::minMaxLoc(alpha, &low, &high);
    return low < high;
  }

  // The best of the measures, fitted to the whole series.
  [[nodiscard]] Rule best(const std::vector<Measure>& measures) const {
    const std::vector<cv::Mat> few = copies(spread(kMostTried));
    Rule best;
    for (const Measure& measure : measures) {
      Rule rule = fitted(measure, few);
      if (best.measure.name.empty() || rule.quality > best.quality) best = std::move(rule);
    }
    return files_.size() > few.size() ? fitted(best.measure, copies(files_)) : best;
  }

  [[nodiscard]] cv::Mat median() const {
    std::vector<cv::Mat> pictures;
    for (const fs::path& file : spread(kMostMedian)) {
      pictures.push_back(read_picture(file));
      if (pictures.back().size() != pictures.front().size()) {
        throw nef::InputError("--mask background:median: " + file.string() +
                              " differs in size from the first photograph; the camera must not move");
      }
    }
    if (pictures.size() < 3) throw nef::InputError("--mask background:median needs at least three photographs");
    return median_picture(pictures);
  }

 private:
  // At most so many, evenly spread.
  [[nodiscard]] Photographs spread(std::size_t most) const {
    if (files_.size() <= most) return files_;
    Photographs some;
    for (std::size_t i = 0; i < most; ++i) some.push_back(files_[i * files_.size() / most]);
    return some;
  }

  [[nodiscard]] std::vector<cv::Mat> copies(const Photographs& files) const {
    std::vector<cv::Mat> result(files.size());
    nef::parallel_for(files.size(), monitor_,
                      [&](std::size_t i, const nef::Monitor&) { result[i] = read_picture(files[i], kLongestCopy); });
    return result;
  }

  [[nodiscard]] Rule fitted(const Measure& measure, const std::vector<cv::Mat>& pictures) const {
    std::vector<Separation> found(pictures.size());
    nef::parallel_for(pictures.size(), monitor_, [&](std::size_t i, const nef::Monitor&) {
      found[i] = fitted_separation(measure.of(pictures[i]));
    });
    std::vector<double> levels;
    std::vector<double> qualities;
    for (const Separation& one : found) {
      qualities.push_back(one.quality);
      if (one.sign > 0) levels.push_back(one.level);
    }
    if (levels.empty()) return {measure, 127, 0};
    return {measure, median_of(levels), median_of(qualities)};
  }

  [[nodiscard]] CutOuts start() const {
    CutOuts result;
    result.masks.resize(files_.size());
    result.quality.resize(files_.size());
    return result;
  }

  void each_picture(const std::function<void(std::size_t i, const cv::Mat& picture)>& body) const {
    nef::parallel_for(files_.size(), monitor_,
                      [&](std::size_t i, const nef::Monitor&) { body(i, read_picture(files_[i])); });
  }

  static cv::Rect rectangle_of(const MaskMethod& method, const cv::Size& size) {
    if (!method.rectangle) return inside_margins(size);
    const auto& [x, y, width, height] = *method.rectangle;
    return {x, y, width, height};
  }

  static cv::Mat seeds_of_file(const fs::path& strokes, const fs::path& photograph, const cv::Size& size) {
    const cv::Mat picture = read_picture(strokes);
    if (picture.size() != size) {
      throw nef::InputError(fmt::format("{} has {} x {} pixels, its photograph {} {} x {}", strokes.string(),
                                        picture.cols, picture.rows, photograph.string(), size.width, size.height));
    }
    return seeds_from_strokes(picture, strokes.string());
  }

  // Of a mask that comes from no measure: by the channel that shows it best.
  static double clearest(const cv::Mat& picture, const cv::Mat& mask) {
    double quality = 0;
    for (const Measure& measure : channel_measures()) {
      quality = std::max(quality, separation(measure.of(picture), mask).quality);
    }
    return quality;
  }

  const Photographs& files_;
  const nef::Monitor& monitor_;
};

Rule given_level(const MaskMethod& method) {
  return {channel_measure(method.channel, method.below), method.below ? 255 - *method.level : *method.level, 0};
}

CutOuts masks_by(const Series& series, const MaskMethod& method) {
  switch (method.kind) {
    case MaskMethod::Kind::kThreshold:
      if (method.level) return series.by_rule(given_level(method), method.soft);
      return series.by_rule(
          series.best({channel_measure(method.channel, false), channel_measure(method.channel, true)}), method.soft);
    case MaskMethod::Kind::kBackground:
      return series.by_rule(series.best({background_measure(read_picture(method.background))}), method.soft);
    case MaskMethod::Kind::kMedian:
      return series.by_rule(series.best({background_measure(series.median())}), method.soft);
    case MaskMethod::Kind::kKey:
      return series.by_rule(series.best({key_measure(method.key)}), method.soft);
    case MaskMethod::Kind::kGrabCut:
      return series.by_grab_cut(method);
    case MaskMethod::Kind::kAuto:
      break;
  }
  if (series.has_alpha()) return series.by_alpha(method.soft);
  const Rule rule = series.best(channel_measures());
  return rule.quality >= kClear ? series.by_rule(rule, method.soft) : series.by_grab_cut({});
}

// Masks that want a look.
nef::Messages doubts(const Photographs& files, const CutOuts& cut) {
  nef::Messages notes;
  std::vector<double> areas;
  for (const cv::Mat& mask : cut.masks) areas.push_back(cv::countNonZero(object_of(mask)));
  const double usual = median_of(areas);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string name = files[i].filename().string() + ": ";
    if (areas[i] == 0) {
      notes.push_back(name + "no object was found");
    } else if (areas[i] > kOddArea * usual || kOddArea * areas[i] < usual) {
      notes.push_back(name +
                      fmt::format("the object has {:.0f} pixels, in most photographs about {:.0f}", areas[i], usual));
    } else if (cut.quality[i] < kClear) {
      notes.push_back(name +
                      fmt::format("object and background hardly differ along the outline ({:.1f}; {:.0f} is clear)",
                                  cut.quality[i], kClear));
    }
  }
  return notes;
}

}  // namespace

CutOuts cut_out(const Photographs& photographs, const MaskMethod& method, const nef::Monitor& monitor) {
  if (photographs.empty()) throw nef::InputError("there are no photographs to make masks of");
  CutOuts result = masks_by(Series(photographs, monitor), method);
  result.notes = doubts(photographs, result);
  return result;
}

}  // namespace nef::visual_hull
