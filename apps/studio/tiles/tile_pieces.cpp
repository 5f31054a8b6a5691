// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/tiles/tile_pieces.h"

#include <cmath>

#include "apps/view/page.h"
#include "nef/base/threads/parallel.h"
#include "nef/query/measures/approximate_volume.h"
#include "nef/tiles/questions/tile_queries.h"

namespace nef::studio {
namespace {

// Entries that were not used by so many sets since are forgotten, if there are many.
constexpr std::uint64_t kSetsKept = 6;
constexpr std::size_t kManyEntries = 4096;

Approximation approximation(const Rational& number) {
  const double value = nearest_double(number);
  return {value, std::fabs(value) * kRoundingUnit + 1e-300};
}

}  // namespace

TilePieces::Entry TilePieces::made(const TileRef& leaf, const Monitor& monitor) {
  monitor.check_interruption();
  Entry entry;
  entry.node = leaf.node;
  entry.piece.id = numbers_.next();
  entry.piece.source = leaf.complemented ? complement(leaf.node->set()) : leaf.node->set();
  // Exact volumes of a few tiles would take as long as the operation.
  const MeasuredVolume measured = approximate_volume(entry.piece.source, monitor);
  entry.volume = {measured.value, measured.error};
  std::vector<view::Layer> layers(1);
  layers[0].name = "result";
  layers[0].color = view::palette_color(0);
  layers[0].scene = view::build_tile_scene(entry.piece.source, monitor);
  entry.triangles = layers[0].scene.triangles.size();
  entry.piece.scene = std::make_shared<const std::string>(view::page_scene(layers, {.details = false}));
  return entry;
}

// Two pages may make the entry of one leaf at once; the first one that is done stays.
std::vector<TilePieces::Entry> TilePieces::entries_of(const std::vector<TileRef>& leaves, const Monitor& monitor) {
  std::vector<Entry> entries(leaves.size());
  std::vector<std::size_t> missing;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const auto found = entries_.find(key_of(leaves[i]));
      if (found != entries_.end()) {
        entries[i] = found->second;
      } else {
        missing.push_back(i);
      }
    }
  }
  parallel_for(missing.size(), monitor,
               [&](std::size_t i, const Monitor& own) { entries[missing[i]] = made(leaves[missing[i]], own); });
  const std::lock_guard lock(mutex_);
  ++clock_;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    Entry& kept = entries_.try_emplace(key_of(leaves[i]), entries[i]).first->second;
    kept.used = clock_;
    entries[i] = kept;
  }
  forget_old();
  return entries;
}

void TilePieces::forget_old() {
  if (entries_.size() < kManyEntries) return;
  std::erase_if(entries_, [this](const auto& entry) { return entry.second.used + kSetsKept < clock_; });
}

DrawnTiles TilePieces::draw(const TiledPolyhedron& set, const Monitor& monitor) {
  DrawnTiles drawn;
  drawn.volume = Approximation{};
  std::vector<TileRef> leaves;
  for_each_leaf(set.tree(), [&](const TileRef& leaf, const Region& region) {
    if (leaf.node->kind != TileNode::Kind::kUniform) {
      leaves.push_back(leaf);
      return;
    }
    const std::optional<Rational> content = volume_of_leaf(leaf, region);
    if (!content) drawn.volume.reset();
    if (drawn.volume && *content != 0) drawn.volume = *drawn.volume + approximation(*content);
  });
  for (Entry& entry : entries_of(leaves, monitor)) {
    if (drawn.volume) drawn.volume = *drawn.volume + entry.volume;
    drawn.triangles += entry.triangles;
    if (entry.triangles > 0) drawn.pieces.push_back(std::move(entry.piece));
  }
  return drawn;
}

}  // namespace nef::studio
