// SPDX-License-Identifier: Apache-2.0
//
// Qualities: the pixels of the triangle's image are looked up one by one in the view's map of depth and in the pixels
// of its silhouette; a triangle between all pixels is looked up at its middle. Choice: first the view that is best on
// the average of the triangle's surroundings, then some rounds in which each triangle weighs the quality of a view
// against the length of its sides at which the neighbour has chosen it (iterated conditional modes of a Potts model, as
// in Lempitsky and Ivanov 2007).
#include "apps/visual_hull/texture/view_choice.h"

#include <algorithm>
#include <cmath>

#include "apps/visual_hull/color/photo_view.h"
#include "apps/visual_hull/color/triangle_pixels.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

/// What of a triangle's image a view sees, in samples.
struct SeenPart {
  std::size_t all = 0;
  std::size_t seen = 0;
  std::size_t inside = 0;  // of the silhouette, away from its border

  void add(const PhotoView& view, const ImagePlace& place) {
    ++all;
    if (!view.sees(place)) return;
    const auto sample = view.pixel_at(place);
    if (!sample) return;
    ++seen;
    if (sample->inside) ++inside;
  }
};

// No chart reaches farther out of its image than this part of its size.
constexpr double kMargin = 0.25;

bool near_frame(const ImagePlace& place, const cv::Size& size) {
  return place.u > -kMargin * size.width && place.u < (1 + kMargin) * size.width && place.v > -kMargin * size.height &&
         place.v < (1 + kMargin) * size.height;
}

SeenPart seen_part(const PhotoView& view, const std::array<ImagePlace, 3>& places) {
  const Triangle2 image{{{places[0].u, places[0].v}, {places[1].u, places[1].v}, {places[2].u, places[2].v}}};
  const double area = doubled_area(image);
  const auto at = [&](const Weights& w) {
    ImagePlace place;
    for (std::size_t i = 0; i < 3; ++i) {
      place.u += w[i] * places[i].u;
      place.v += w[i] * places[i].v;
      place.inverse_depth += w[i] * places[i].inverse_depth;
    }
    return place;
  };
  SeenPart part;
  if (std::abs(area) > 1e-9) {
    for_each_pixel_near(image, 1e-6, view.size().width, view.size().height, [&](int x, int y) {
      const Weights w = weights_at(image, area, x, y);
      if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) part.add(view, at(w));
    });
  }
  if (part.all == 0) part.add(view, at({1.0 / 3, 1.0 / 3, 1.0 / 3}));
  return part;
}

double quality_of(const PhotoView& view, const Surface& surface, std::size_t t) {
  std::array<ImagePlace, 3> places;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto place = view.project(surface.points()[surface.triangle(t)[i]]);
    if (!place || !near_frame(*place, view.size())) return 0;
    places[i] = *place;
  }
  const nef::Double3 normal = surface.normal(t);
  const nef::Double3 middle = point_at(surface.corners(t), {1.0 / 3, 1.0 / 3, 1.0 / 3});
  const nef::Double3 to_eye = nef::minus(view.projection().centre(), middle);
  const double cosine = nef::dot(normal, to_eye) / std::sqrt(nef::dot(normal, normal) * nef::dot(to_eye, to_eye));
  if (!(cosine > 0.02)) return 0;  // from behind, or along the surface
  const SeenPart part = seen_part(view, places);
  if (part.seen == 0) return 0;
  const Triangle2 image{{{places[0].u, places[0].v}, {places[1].u, places[1].v}, {places[2].u, places[2].v}}};
  const double area = std::abs(doubled_area(image)) / 2;
  const double seen = static_cast<double>(part.seen);
  // What lies beyond the frame has no samples.
  const double share = seen / std::max(static_cast<double>(part.all), 0.8 * area);
  const double clean = 0.2 + 0.8 * static_cast<double>(part.inside) / seen;
  return std::max(area, 1e-12) * cosine * share * clean;
}

std::vector<float> lengths_of(const Surface& surface) {
  std::vector<float> lengths;
  lengths.reserve(surface.sides().size());
  for (const Surface::Side& side : surface.sides()) {
    const nef::Double3 along = nef::minus(surface.points()[side.to], surface.points()[side.from]);
    lengths.push_back(static_cast<float>(std::sqrt(nef::dot(along, along))));
  }
  return lengths;
}

// Qualities as parts of the best, averaged over the surroundings; 0 where a view does not see the triangle.
ViewQualities shared_qualities(const Surface& surface, const ViewQualities& qualities, const std::vector<float>& best,
                               const std::vector<float>& lengths) {
  const std::size_t views = qualities.views();
  ViewQualities shared(surface.size(), views);
  for (std::size_t t = 0; t < surface.size(); ++t) {
    for (std::size_t v = 0; v < views && best[t] > 0; ++v) shared.at(t, v) = qualities.at(t, v) / best[t];
  }
  constexpr int kRounds = 12;
  std::vector<float> around(views);
  for (int round = 0; round < kRounds; ++round) {
    const ViewQualities before = shared;
    for (std::size_t t = 0; t < surface.size(); ++t) {
      float all = 0;
      std::fill(around.begin(), around.end(), 0.0F);
      for (const std::uint32_t s : surface.sides_of(t)) {
        const std::uint32_t next = surface.beyond(s, t);
        all += lengths[s];
        for (std::size_t v = 0; v < views; ++v) around[v] += lengths[s] * before.at(next, v);
      }
      if (!(all > 0)) continue;
      for (std::size_t v = 0; v < views; ++v) {
        if (qualities.at(t, v) > 0) shared.at(t, v) = (before.at(t, v) + around[v] / all) / 2;
      }
    }
  }
  return shared;
}

// Lets triangles take the views of their neighbours, where what is shared is worth more than quality.
void agree(const Surface& surface, const ViewQualities& qualities, const std::vector<float>& best,
           const std::vector<float>& lengths, std::vector<std::uint32_t>& choice) {
  constexpr int kRounds = 10;
  constexpr double kTogether = 0.8;  // what sharing all neighbours' view is worth, as a part of the best quality
  bool changed = true;
  for (int round = 0; round < kRounds && changed; ++round) {
    changed = false;
    for (std::size_t t = 0; t < surface.size(); ++t) {
      if (choice[t] == kNoView) continue;
      const auto value_of = [&](std::uint32_t v) {
        double shared = 0;
        double all = 0;
        for (const std::uint32_t s : surface.sides_of(t)) {
          all += static_cast<double>(lengths[s]);
          if (choice[surface.beyond(s, t)] == v) shared += static_cast<double>(lengths[s]);
        }
        return static_cast<double>(qualities.at(t, v) / best[t]) + (all > 0 ? kTogether * shared / all : 0);
      };
      std::uint32_t winner = choice[t];
      double most = value_of(winner) + 1e-9;
      for (const std::uint32_t s : surface.sides_of(t)) {
        const std::uint32_t v = choice[surface.beyond(s, t)];
        if (v == kNoView || v == winner || !(qualities.at(t, v) > 0) || value_of(v) <= most) continue;
        winner = v;
        most = value_of(v) + 1e-9;
      }
      changed = changed || winner != choice[t];
      choice[t] = winner;
    }
  }
}

}  // namespace

ViewQualities measure_views(const nef::Mesh& mesh, const Surface& surface, const std::vector<const ViewResult*>& views,
                            PixelOrigin origin, const nef::Monitor& monitor) {
  ViewQualities qualities(surface.size(), views.size());
  nef::parallel_for(views.size(), monitor, [&](std::size_t v, const nef::Monitor&) {
    const PhotoView view(*views[v], origin, mesh, surface.points(), "--texture");
    for (std::size_t t = 0; t < surface.size(); ++t) {
      qualities.at(t, v) = static_cast<float>(quality_of(view, surface, t));
    }
  });
  return qualities;
}

std::vector<std::uint32_t> choose_views(const Surface& surface, const ViewQualities& qualities) {
  std::vector<float> best(surface.size(), 0);
  for (std::size_t t = 0; t < surface.size(); ++t) {
    for (std::uint32_t v = 0; v < qualities.views(); ++v) best[t] = std::max(best[t], qualities.at(t, v));
  }
  const std::vector<float> lengths = lengths_of(surface);
  const ViewQualities shared = shared_qualities(surface, qualities, best, lengths);
  std::vector<std::uint32_t> choice(surface.size(), kNoView);
  for (std::size_t t = 0; t < surface.size(); ++t) {
    constexpr float kGood = 0.4F;  // of the best quality
    float most = 0;
    for (std::uint32_t v = 0; v < qualities.views(); ++v) {
      if (!(qualities.at(t, v) >= kGood * best[t]) || !(shared.at(t, v) > most)) continue;
      most = shared.at(t, v);
      choice[t] = v;
    }
  }
  agree(surface, qualities, best, lengths, choice);
  return choice;
}

}  // namespace nef::visual_hull
