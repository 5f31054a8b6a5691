// SPDX-License-Identifier: Apache-2.0
//
// How often --suspects names the view whose mask is damaged: for every scene, one mask after the other is damaged in
// each of nine ways; clean sets and random subsets of them tell how often it accuses where nothing is wrong.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <opencv2/imgproc.hpp>
#include <random>

#include "apps/visual_hull/cones/bounds.h"
#include "apps/visual_hull/visual_hull.h"
#include "bench/visual_hull/unseen_sets.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::visual_hull::bench {
namespace {

using Random = std::mt19937_64;

/// A scene with its clean masks.
struct Set {
  std::string name;
  Scene scene;
  std::vector<cv::Mat> masks;
  PixelOrigin origin = PixelOrigin::kCenter;
};

/// One view of a set as it is compared.
struct Seen {
  Camera camera;
  Silhouette silhouette;
};

struct Counts {
  std::size_t runs = 0;
  std::size_t first = 0;    ///< the damaged view has the highest score
  std::size_t three = 0;    ///< one of the three highest
  std::size_t named = 0;    ///< a verdict, and it is right
  std::size_t wrong = 0;    ///< a verdict, and it is wrong
  std::size_t without = 0;  ///< nothing to compare: the damaged mask is empty
};

Set load(const std::string& file) {
  Set set;
  set.name = std::filesystem::path(file).parent_path().filename().string();
  set.scene = read_scene(file);
  set.origin = set.scene.origin;
  SilhouetteOptions options;
  options.origin = set.origin;
  const auto images = images_of(set.scene, scene_folder(file), std::nullopt);
  for (std::size_t i = 0; i < images.size(); ++i) {
    set.masks.push_back(read_mask(images[i], set.scene.views[i].name, options));
  }
  return set;
}

std::optional<Seen> seen(const Set& set, const Camera& camera, const cv::Mat& mask) {
  if (cv::countNonZero(mask) == 0) return std::nullopt;
  const auto view = std::find_if(set.scene.views.begin(), set.scene.views.end(),
                                 [&](const View& v) { return v.name == camera.name(); });
  SilhouetteOptions options;
  options.origin = set.origin;
  options.simplify.tolerance = 1;
  return Seen{camera, silhouette_of_mask(mask, view->distortion, view->name, options, {}).region};
}

WorldBox box_of(const std::vector<Seen>& views, const WorldBox& otherwise) {
  std::vector<HalfSpace> half_spaces;
  for (const Seen& view : views) {
    const auto cone = convex_cone(view.camera, view.silhouette, {});
    half_spaces.insert(half_spaces.end(), cone.begin(), cone.end());
  }
  const Bounds bounds = bounds_of(half_spaces);
  return bounds.kind == Bounds::Kind::kBox ? loosen(bounds.box) : otherwise;
}

Consistency compared(const std::vector<Seen>& views, const WorldBox& box) {
  std::vector<ComparedView> inputs;
  for (const Seen& view : views) inputs.push_back({&view.camera, &view.silhouette});
  return compare_views(inputs, box, {});
}

cv::Mat shifted(const cv::Mat& mask, double pixels, Random& random) {
  const double angle = std::uniform_real_distribution<double>(0, 2 * M_PI)(random);
  const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, std::round(pixels * std::cos(angle)), 0, 1,
                        std::round(pixels * std::sin(angle)));
  cv::Mat result;
  cv::warpAffine(mask, result, move, mask.size(), cv::INTER_NEAREST);
  return result;
}

// Without a part of the area, at one of the four sides.
cv::Mat cut(const cv::Mat& mask, double share, Random& random) {
  cv::Mat turned;
  const int quarter = static_cast<int>(random() % 4);
  if (quarter == 0) {
    turned = mask.clone();
  } else {
    cv::rotate(mask, turned, quarter - 1);
  }
  const int keep = static_cast<int>((1 - share) * cv::countNonZero(turned));
  int passed = 0;
  for (int y = 0; y < turned.rows; ++y) {
    if (passed >= keep) turned.row(y).setTo(0);
    passed += cv::countNonZero(turned.row(y));
  }
  if (quarter == 0) return turned;
  cv::Mat result;
  cv::rotate(turned, result, quarter == 2 ? 1 : quarter == 1 ? 2 : 0);
  return result;
}

// A disc around a pixel of the silhouette, of a tenth of its area.
cv::Mat with_hole(const cv::Mat& mask, Random& random) {
  std::vector<cv::Point> inside;
  cv::findNonZero(mask, inside);
  cv::Mat result = mask.clone();
  const int radius = static_cast<int>(std::sqrt(static_cast<double>(inside.size()) / 10 / M_PI));
  cv::circle(result, inside[random() % inside.size()], radius, cv::Scalar(0), cv::FILLED);
  return result;
}

// One pixel of a hundred of the silhouette is missing, with its neighbours.
cv::Mat speckled(const cv::Mat& mask, Random& random) {
  std::vector<cv::Point> inside;
  cv::findNonZero(mask, inside);
  cv::Mat result = mask.clone();
  for (std::size_t k = 0; k < inside.size() / 100; ++k) {
    cv::circle(result, inside[random() % inside.size()], 1, cv::Scalar(0), cv::FILLED);
  }
  return result;
}

// The camera turned by a degree about the line through its centre that is vertical in its image: P H.
Camera turned(const Camera& camera) {
  const auto& p = camera.matrix();
  // In space about the camera's centre, along its second row's direction.
  std::array<double, 3> axis{};
  for (std::size_t k = 0; k < 3; ++k) axis[k] = nef::nearest_double(p[1][k]);
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  for (double& a : axis) a /= length;
  const double angle = M_PI / 180;
  std::array<std::array<double, 3>, 3> rotation{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = (i == j ? std::cos(angle) : 0) + (1 - std::cos(angle)) * axis[i] * axis[j];
    }
  }
  const std::array<double, 3> s{std::sin(angle) * axis[0], std::sin(angle) * axis[1], std::sin(angle) * axis[2]};
  rotation[0][1] -= s[2];
  rotation[1][0] += s[2];
  rotation[0][2] += s[1];
  rotation[2][0] -= s[1];
  rotation[1][2] -= s[0];
  rotation[2][1] += s[0];
  Matrix34 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += nef::nearest_double(p[i][k]) * rotation[k][j];
      result[i][j] = nef::exact_rational(sum);
    }
    for (std::size_t j = 0; j < 3; ++j) result[i][3] -= result[i][j] * camera.centre()[j];
  }
  return {camera.name(), result};
}

/// Damages view v of a set.
using Damage = std::function<std::optional<Seen>(const Set&, std::size_t v, Random&)>;

std::vector<std::pair<std::string, Damage>> damages() {
  const auto on_mask = [](const std::function<cv::Mat(const cv::Mat&, Random&)>& change) {
    return [change](const Set& set, std::size_t v, Random& random) {
      return seen(set, set.scene.views[v].camera, change(set.masks[v], random));
    };
  };
  return {
      {"shifted by 3 px", on_mask([](const cv::Mat& m, Random& r) { return shifted(m, 3, r); })},
      {"shifted by 5 px", on_mask([](const cv::Mat& m, Random& r) { return shifted(m, 5, r); })},
      {"shifted by 10 px", on_mask([](const cv::Mat& m, Random& r) { return shifted(m, 10, r); })},
      {"cut by 10 %", on_mask([](const cv::Mat& m, Random& r) { return cut(m, 0.1, r); })},
      {"cut by 20 %", on_mask([](const cv::Mat& m, Random& r) { return cut(m, 0.2, r); })},
      {"hole", on_mask(with_hole)},
      {"speckle", on_mask(speckled)},
      {"camera turned by 1 degree", [](const Set& set, std::size_t v,
                                       Random&) { return seen(set, turned(set.scene.views[v].camera), set.masks[v]); }},
      {"mask of another view",
       [](const Set& set, std::size_t v, Random& random) {
         const std::size_t n = set.masks.size();
         return seen(set, set.scene.views[v].camera, set.masks[(v + 1 + random() % (n - 1)) % n]);
       }},
  };
}

void count(Counts& counts, const Consistency& found, std::size_t guilty) {
  ++counts.runs;
  const std::vector<std::size_t> ranked = found.ranked();
  const auto place = std::find(ranked.begin(), ranked.end(), guilty) - ranked.begin();
  if (place == 0) ++counts.first;
  if (place < 3) ++counts.three;
  if (found.guilty) ++(*found.guilty == guilty ? counts.named : counts.wrong);
}

void print(const std::string& name, const Counts& c) {
  const auto percent = [&c](std::size_t part) {
    return c.runs == 0 ? 0.0 : 100 * static_cast<double>(part) / static_cast<double>(c.runs);
  };
  std::cout << fmt::format("{:<28} {:>5} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f}\n", name, c.runs, percent(c.first),
                           percent(c.three), percent(c.named), percent(c.wrong));
}

// What thresholds are chosen and judged by; `damaged`: the view that is, if one is.
TopView top_view(const Consistency& found, std::size_t set, std::optional<std::size_t> damaged) {
  constexpr double kFewestLines = 4;  // as in compare_views
  const std::vector<std::size_t> ranked = found.ranked();
  const ViewConsistency& first = found.views[ranked[0]];
  const std::size_t rays = std::clamp<std::size_t>(10000 / found.views.size(), 100, 300);
  TopView top;
  top.set = set;
  top.damaged = damaged.has_value();
  top.right = damaged == ranked[0];
  top.seen = first.fall * static_cast<double>(rays) >= kFewestLines;
  top.score = first.score;
  top.lead = first.score - found.views[ranked[1]].score;
  return top;
}

struct Alarms {
  std::size_t sets = 0;
  std::size_t alarms = 0;
};

void run(const std::vector<std::string>& scenes, std::size_t views_a_kind, std::size_t subsets) {
  Random random(2026);
  std::map<std::string, Counts> by_kind;
  Counts all;
  Alarms clean;
  Alarms parts;
  double comparing = 0;
  std::size_t comparisons = 0;
  std::vector<TopView> tops;
  for (std::size_t number = 0; number < scenes.size(); ++number) {
    const Set set = load(scenes[number]);
    std::vector<Seen> views;
    for (std::size_t v = 0; v < set.masks.size(); ++v) {
      views.push_back(seen(set, set.scene.views[v].camera, set.masks[v]).value());
    }
    const WorldBox box = box_of(views, {});
    ++clean.sets;
    const Consistency of_clean = compared(views, box);
    tops.push_back(top_view(of_clean, number, std::nullopt));
    if (of_clean.guilty) {
      ++clean.alarms;
      std::cerr << set.name << ", clean: " << views[*of_clean.guilty].camera.name() << " is accused\n";
    }
    for (std::size_t k = 0; k < subsets; ++k) {
      std::vector<Seen> some = views;
      std::shuffle(some.begin(), some.end(), random);
      some.resize(std::max<std::size_t>(6, some.size() / 2));
      ++parts.sets;
      const Consistency of_some = compared(some, box_of(some, box));
      tops.push_back(top_view(of_some, number, std::nullopt));
      if (of_some.guilty) ++parts.alarms;
    }
    for (const auto& [kind, damage] : damages()) {
      for (std::size_t k = 0; k < std::min(views_a_kind, views.size()); ++k) {
        const std::size_t v = views_a_kind >= views.size() ? k : random() % views.size();
        std::optional<Seen> damaged = damage(set, v, random);
        if (!damaged) {
          ++all.without;
          continue;
        }
        std::vector<Seen> changed = views;
        changed[v] = std::move(*damaged);
        const WorldBox changed_box = box_of(changed, box);
        const nef::ThreadStopwatch watch;
        const Consistency found = compared(changed, changed_box);
        comparing += watch.seconds();
        ++comparisons;
        count(by_kind[kind], found, v);
        count(all, found, v);
        tops.push_back(top_view(found, number, v));
      }
    }
    std::cerr << set.name << " done\n";
  }
  std::cout << fmt::format("{:<28} {:>5} {:>8} {:>8} {:>8} {:>8}\n", "damage", "runs", "first %", "three %", "named %",
                           "wrong %");
  for (const auto& [kind, damage] : damages()) print(kind, by_kind[kind]);
  print("all", all);
  std::cout << fmt::format("clean sets: {} alarms in {}; halves of them: {} in {}\n", clean.alarms, clean.sets,
                           parts.alarms, parts.sets);
  const UnseenRates unseen = leave_one_out(tops, scenes.size());
  std::cout << fmt::format(
      "thresholds chosen without the set that they judge (score {:.1f} to {:.1f}, lead {:.1f} to {:.1f}): {} of {} "
      "named, {} "
      "wrong; {} alarms in {} clean ones; all sets together choose {:.1f} and {:.1f}\n",
      unseen.least_score, unseen.most_score, unseen.least_lead, unseen.most_lead, unseen.right, unseen.damaged,
      unseen.wrong, unseen.alarms, unseen.clean, unseen.score, unseen.lead);
  std::cout << fmt::format("{:.4f} processor seconds a comparison\n",
                           comparing / static_cast<double>(std::max<std::size_t>(comparisons, 1)));
}

}  // namespace
}  // namespace nef::visual_hull::bench

int main(int argc, char** argv) {
  std::vector<std::string> scenes;
  std::size_t views = 4;
  std::size_t subsets = 10;
  CLI::App app{"How often --suspects names the view whose mask is damaged"};
  app.add_option("SCENES", scenes, "Sets of clean masks")->required();
  app.add_option("--views", views, "Damaged views of each kind and set");
  app.add_option("--subsets", subsets, "Random subsets of each clean set");
  CLI11_PARSE(app, argc, argv);
  try {
    nef::visual_hull::bench::run(scenes, views, subsets);
  } catch (const std::exception& error) {
    std::cerr << "nef_bench_suspects: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
