// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/hull_masks.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "apps/visual_hull/color/photo_view.h"
#include "apps/visual_hull/command/photographs.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/number_text.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> photographs_of_views(const std::vector<const ViewResult*>& views) {
  std::vector<fs::path> photographs;
  for (const ViewResult* view : views) photographs.push_back(photograph_of(view->image));
  return photographs;
}

// Names of masks; with the folders of the photographs if names alone are not enough.
std::vector<fs::path> mask_names(const std::vector<fs::path>& photographs) {
  for (const bool with_folder : {false, true}) {
    std::vector<fs::path> names;
    for (const fs::path& photograph : photographs) {
      const fs::path name = photograph.filename().string() + ".png";
      names.push_back(with_folder ? photograph.parent_path().filename() / name : name);
    }
    if (std::set<fs::path>(names.begin(), names.end()).size() == names.size()) return names;
  }
  throw nef::InputError("--hull-masks: two photographs are called alike; rename one of them");
}

void write_box(const nef::Polyhedron& hull, const fs::path& file) {
  const auto bounds = nef::bounding_box(hull);
  if (!bounds) return;
  std::string text;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < 3; ++i) {
      // Outward by a rounding, so that the box contains the hull.
      const double nearest = nef::nearest_double((*bounds)[side][i]);
      nef::append_number(text, std::nextafter(nearest, side == 0 ? -INFINITY : INFINITY));
      text += i == 2 ? '\n' : ' ';
    }
  }
  nef::write_file(file.string(), text);
}

}  // namespace

cv::Mat hull_mask(const ViewResult& view, const nef::Polyhedron& hull, PixelOrigin origin) {
  constexpr int kShift = 4;  // sixteenths of a pixel
  const double shift = origin == PixelOrigin::kCorner ? -0.5 : 0;
  const auto fixed = [shift](double x) {
    return static_cast<int>(std::lround(std::clamp(x + shift, -1e5, 1e5) * (1 << kShift)));
  };
  cv::Mat mask(view.silhouette.image_size, CV_8U, cv::Scalar(0));
  for (const auto& facet : project_facets(hull, view.camera)) {
    std::vector<std::vector<cv::Point>> cycles;
    for (const auto& cycle : facet) {
      cycles.emplace_back();
      for (const auto& p : cycle) cycles.back().emplace_back(fixed(p[0]), fixed(p[1]));
    }
    cv::fillPoly(mask, cycles, cv::Scalar(255), cv::LINE_8, kShift);
  }
  return mask;
}

void write_hull_masks(const Result& result, const fs::path& folder) {
  const std::vector<const ViewResult*> views = views_with_images(result.views, "--hull-masks");
  const std::vector<fs::path> names = mask_names(photographs_of_views(views));
  make_folder("--hull-masks", folder);
  for (std::size_t i = 0; i < views.size(); ++i) {
    cv::Mat picture;
    cv::cvtColor(hull_mask(*views[i], result.hull, result.origin), picture, cv::COLOR_GRAY2BGR);
    if (names[i].has_parent_path()) make_folder("--hull-masks", folder / names[i].parent_path());
    nef::write_file((folder / names[i]).string(), png_of(picture));
  }
  write_box(result.hull, folder / "bounding_box.txt");
}

}  // namespace nef::visual_hull
