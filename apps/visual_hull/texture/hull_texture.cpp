// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/texture/hull_texture.h"

#include "apps/visual_hull/color/photo_view.h"
#include "apps/visual_hull/texture/blending.h"
#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/filling.h"
#include "apps/visual_hull/texture/levelling.h"
#include "apps/visual_hull/texture/packing.h"
#include "apps/visual_hull/texture/sampling.h"
#include "apps/visual_hull/texture/view_choice.h"

namespace nef::visual_hull {
namespace {

// What every graphics card of today can show.
constexpr int kLargestImage = 4096;

double unseen_share(const Texels& texels) {
  std::size_t used = 0;
  std::size_t unseen = 0;
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    if (texels.triangle(texel) == Texels::kFree) continue;
    ++used;
    if (texels.grade[texel] == TexelGrade::kNone) ++unseen;
  }
  return used == 0 ? 0 : static_cast<double>(unseen) / static_cast<double>(used);
}

}  // namespace

HullTexture hull_texture(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                         const nef::Monitor& monitor) {
  const std::vector<const ViewResult*> seeing = views_with_images(views, "--texture");
  const Surface surface(mesh);
  const ViewQualities qualities = measure_views(mesh, surface, seeing, origin, monitor);
  Atlas atlas = make_charts(surface, choose_views(surface, qualities), seeing, origin);
  pack(atlas, kLargestImage);
  Texels texels(atlas);
  const MeanColors means = sample_views({mesh, surface, seeing, origin}, atlas, qualities, texels, monitor);
  HullTexture result;
  result.charts = atlas.charts.size();
  result.unseen = unseen_share(texels);
  blend_views(atlas, means, texels, monitor);
  level_seams(surface, atlas, texels);
  fill_unseen(mesh, surface, atlas, texels);
  result.image = padded_image(texels);
  result.corners.reserve(mesh.corners.size());
  for (const Triangle2& places : atlas.places) {
    for (const Place2& place : places) {
      result.corners.push_back({static_cast<float>((place[0] + 0.5) / atlas.width),
                                static_cast<float>(1 - (place[1] + 0.5) / atlas.height)});
    }
  }
  return result;
}

}  // namespace nef::visual_hull
