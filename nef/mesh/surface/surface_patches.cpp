// SPDX-License-Identifier: Apache-2.0
//
// Let q lie on one side of the plane of p but for corners that are corners of p, too. Then q meets that plane in these
// corners and in edges between them. One corner is nothing beyond what they share, and neither are two, unless an edge
// of q joins them and none of p does: such an edge may run through p.
#include "nef/mesh/surface/surface_patches.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "nef/base/fast_path.h"
#include "nef/base/threads/group_by.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/search/direction_tree.h"
#include "nef/mesh/surface/coplanar_groups.h"
#include "nef/mesh/surface/terrains.h"

namespace nef {
namespace {

// In ordinary meshes the boxes of some ten others overlap that of a triangle.
constexpr std::size_t kManyPairs = 32;

bool adjacent(std::span<const std::uint32_t> next, std::uint32_t i, std::uint32_t j) {
  return next.empty() || next[i] == j || next[j] == i;  // in a triangle all are
}

}  // namespace

SurfacePatches::SurfacePatches(const MeshSurface& surface, const Monitor& monitor)
    : surface_(surface),
      monitor_(monitor),
      stars_(surface.points, surface.triangles, monitor),
      patch_of_face_(surface.defects.size(), 0),
      faces_(planar_faces()) {
  for (std::uint32_t p = 0; p < faces_.patches.size(); ++p) {
    patch_of_face_[surface.face_of[faces_.patches[p].first]] = p;
  }
}

SurfacePatches::Layout SurfacePatches::planar_faces() const {
  Layout layout;
  const auto count = static_cast<std::uint32_t>(surface_.triangles.size());
  layout.patches.reserve(surface_.defects.size());
  for (std::uint32_t t = 0; t < count;) {
    const std::uint32_t f = surface_.face_of[t];
    Patch patch{t, t + 1, 0, 0, true};
    if (!surface_.ring(f).empty()) {
      while (patch.last < count && surface_.face_of[patch.last] == f) ++patch.last;
      patch.proper = surface_.pieces[patch.first] == surface_.pieces[patch.last - 1];
    }
    if (patch.size() > 1) {
      const std::span<const std::uint32_t> ring = surface_.ring(f);
      patch.corner_begin = static_cast<std::uint32_t>(layout.corners.size());
      add_cycles(layout, ring, std::array{static_cast<std::uint32_t>(ring.size())});
      patch.corner_end = static_cast<std::uint32_t>(layout.corners.size());
    }
    layout.patches.push_back(patch);
    t = patch.last;
  }
  index_corners(layout);
  return layout;
}

// The same with coplanar neighbours as one patch.
SurfacePatches::Layout SurfacePatches::united() const {
  std::vector<std::span<const std::uint32_t>> polygons;
  for (const Patch& patch : faces_.patches) {
    polygons.push_back(patch.proper ? corners(faces_, patch) : std::span<const std::uint32_t>());
  }
  const std::vector<CoplanarGroup> groups = coplanar_groups(surface_.points, polygons, monitor_);
  std::vector<bool> grouped(faces_.patches.size(), false);
  Layout layout;
  const auto push = [&](std::span<const std::uint32_t> members, std::span<const std::uint32_t> cycles,
                        std::span<const std::uint32_t> ends) {
    Patch patch = faces_.patches[members[0]];
    patch.first = static_cast<std::uint32_t>(layout.order.size());
    for (const std::uint32_t p : members) {
      for (std::uint32_t t = faces_.patches[p].first; t < faces_.patches[p].last; ++t) layout.order.push_back(t);
    }
    patch.last = static_cast<std::uint32_t>(layout.order.size());
    patch.corner_begin = static_cast<std::uint32_t>(layout.corners.size());
    if (patch.size() > 1) add_cycles(layout, cycles, ends);
    patch.corner_end = static_cast<std::uint32_t>(layout.corners.size());
    layout.patches.push_back(patch);
  };
  for (const CoplanarGroup& group : groups) {
    for (const std::uint32_t p : group.members) grouped[p] = true;
    push(group.members, group.cycles, group.cycle_end);
  }
  for (std::uint32_t p = 0; p < faces_.patches.size(); ++p) {
    if (grouped[p]) continue;
    const std::span<const std::uint32_t> ring = corners(faces_, faces_.patches[p]);
    push(std::array{p}, ring, std::array{static_cast<std::uint32_t>(ring.size())});
  }
  index_corners(layout);
  return layout;
}

void SurfacePatches::add_cycles(Layout& layout, std::span<const std::uint32_t> cycles,
                                std::span<const std::uint32_t> ends) const {
  layout.corners.insert(layout.corners.end(), cycles.begin(), cycles.end());
  for (std::uint32_t begin = 0; const std::uint32_t end : ends) {
    for (std::uint32_t i = begin; i < end; ++i) layout.next.push_back(i + 1 == end ? begin : i + 1);
    begin = end;
  }
}

void SurfacePatches::index_corners(Layout& layout) const {
  layout.at.resize(layout.corners.size());
  const auto each_corner = [&](const auto& visit) {
    for (std::uint32_t p = 0; p < layout.patches.size(); ++p) {
      const Patch& patch = layout.patches[p];
      for (std::uint32_t i = patch.corner_begin; i < patch.corner_end; ++i) {
        visit(layout.corners[i], Corner{p, i - patch.corner_begin});
      }
    }
  };
  const auto put = [&](std::uint32_t place, const Corner& corner) { layout.at[place] = corner; };
  layout.corner_begin =
      group_by(surface_.points.size(), each_corner, put, for_vertices(layout.corners.size(), monitor_));
}

std::span<const std::uint32_t> SurfacePatches::corners(const Layout& layout, const Patch& patch) const {
  if (patch.size() == 1) return surface_.triangles[layout.triangle(patch.first)];
  return std::span(layout.corners).subspan(patch.corner_begin, patch.corner_end - patch.corner_begin);
}

// Of a place among the corners of a patch.
std::optional<std::uint32_t> SurfacePatches::position(const Layout& layout, std::uint32_t patch,
                                                      std::uint32_t place) const {
  if (layout.patches[patch].size() == 1) {
    const std::array<std::uint32_t, 3>& t = surface_.triangles[layout.triangle(layout.patches[patch].first)];
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (t[i] == place) return i;
    }
    return std::nullopt;
  }
  for (std::uint32_t i = layout.corner_begin[place]; i < layout.corner_begin[place + 1]; ++i) {
    if (layout.at[i].patch == patch) return layout.at[i].position;
  }
  return std::nullopt;
}

bool SurfacePatches::is_cut(std::uint32_t triangle, std::uint32_t u, std::uint32_t v) const {
  const std::uint32_t p = patch_of_face_[surface_.face_of[triangle]];
  const Patch& patch = faces_.patches[p];
  if (patch.size() == 1) return false;
  const std::optional<std::uint32_t> i = position(faces_, p, u);
  const std::optional<std::uint32_t> j = position(faces_, p, v);
  return i && j && !adjacent(std::span(faces_.next).subspan(patch.corner_begin), *i, *j);
}

bool SurfacePatches::on_plane(std::uint32_t triangle, std::uint32_t place) const {
  const std::uint32_t patch = patch_of_face_[surface_.face_of[triangle]];
  return faces_.patches[patch].size() > 1 && position(faces_, patch, place).has_value();
}

// True if the plane of p shows that the two have nothing in common beyond shared corners and a shared edge.
bool SurfacePatches::apart(const Layout& layout, std::uint32_t p, std::uint32_t q) const {
  const Patch& patch = layout.patches[p];
  const Patch& other = layout.patches[q];
  const std::array<std::uint32_t, 3>& plane = surface_.triangles[layout.triangle(patch.first)];
  const std::span<const std::uint32_t> ring = corners(layout, other);
  std::array<std::uint32_t, 2> in_p{};
  std::array<std::uint32_t, 2> in_q{};
  std::size_t shared = 0;
  int side = 0;
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (const std::optional<std::uint32_t> at = position(layout, p, ring[i])) {
      if (shared == 2) return false;
      in_p[shared] = *at;
      in_q[shared++] = i;
      continue;
    }
    const int sign = surface_.points.orientation(plane[0], plane[1], plane[2], ring[i], monitor_);
    if (sign == 0 || sign * side < 0) return false;
    side = sign;
  }
  const auto joined = [&layout](const Patch& of, const std::array<std::uint32_t, 2>& at) {
    return adjacent(std::span(layout.next).subspan(of.corner_begin, of.corner_end - of.corner_begin), at[0], at[1]);
  };
  return shared < 2 || !joined(other, in_q) || joined(patch, in_p);
}

Box SurfacePatches::box(std::span<const std::uint32_t> places) const {
  Box result;
  for (const std::uint32_t v : places) surface_.points.extend(result, v);
  return result;
}

std::vector<Box> SurfacePatches::triangle_boxes(const Layout& layout, const Patch& patch) const {
  std::vector<Box> boxes;
  boxes.reserve(patch.size());
  for (std::uint32_t t = patch.first; t < patch.last; ++t) boxes.push_back(box(surface_.triangles[layout.triangle(t)]));
  return boxes;
}

BoxTree SurfacePatches::tree(const Layout& layout) const {
  const Monitor monitor = for_vertices(layout.patches.size(), monitor_);
  const std::vector<Box> boxes =
      vector_of(layout.patches.size(), monitor, [&](std::size_t p) { return box(corners(layout, layout.patches[p])); });
  return BoxTree(boxes, BoxSplit::kCells, monitor);
}

void SurfacePatches::within(const Layout& layout, const Patch& patch, const Visit& visit) const {
  BoxTree(triangle_boxes(layout, patch)).for_each_pair([&](std::uint32_t t, std::uint32_t u) {
    visit(layout.triangle(patch.first + t), layout.triangle(patch.first + u));
  });
}

// The tree over the triangles of a patch.
const BoxTree& SurfacePatches::PatchTrees::of(std::uint32_t patch) {
  constexpr std::uint32_t kMany = 64;  // triangles: a tree over fewer is made anew for each pair
  const bool is_kept = layout_.patches[patch].size() >= kMany;
  BoxTree& tree = is_kept ? kept_[patch] : last_;
  if (!is_kept || tree.size() == 0) tree = BoxTree(patches_.triangle_boxes(layout_, layout_.patches[patch]));
  return tree;
}

void SurfacePatches::between(std::uint32_t p, std::uint32_t q, PatchTrees& trees, const Visit& visit) const {
  const Layout& layout = trees.layout();
  if (layout.patches[p].size() > layout.patches[q].size()) std::swap(p, q);
  const Patch& small = layout.patches[p];
  const Patch& large = layout.patches[q];
  constexpr std::uint32_t kFew = 64;  // pairs that are looked at faster than a tree is built
  const auto each_of_small = [&](const auto& look) {
    for (std::uint32_t t = small.first; t < small.last; ++t) {
      const std::uint32_t own = layout.triangle(t);
      look(box(surface_.triangles[own]), [&](std::uint32_t u) { visit(own, layout.triangle(large.first + u)); });
    }
  };
  if (small.size() * static_cast<std::uint64_t>(large.size()) <= kFew) {
    const std::vector<Box> boxes = triangle_boxes(layout, large);
    each_of_small([&](const Box& own, const auto& meet) {
      for (std::uint32_t u = 0; u < boxes.size(); ++u) {
        if (own.overlaps(boxes[u])) meet(u);
      }
    });
    return;
  }
  const BoxTree& tree = trees.of(q);
  each_of_small([&](const Box& own, const auto& meet) { tree.for_each_overlap(own, meet); });
}

// Patches with overlapping boxes.
void SurfacePatches::visit_pair(std::uint32_t i, std::uint32_t j, PatchTrees& trees, const Visit& visit) const {
  const Layout& layout = trees.layout();
  const Patch& p = layout.patches[i];
  const Patch& q = layout.patches[j];
  if (p.size() == 1 && q.size() == 1) {
    const std::uint32_t t = layout.triangle(p.first);
    const std::uint32_t u = layout.triangle(q.first);
    if (surface_.pieces[t] != surface_.pieces[u]) visit(t, u);
    return;
  }
  // The plane of the larger one first: that asks for the corners of the smaller.
  const bool ordered = p.size() >= q.size();
  if (!apart(layout, ordered ? i : j, ordered ? j : i) && !apart(layout, ordered ? j : i, ordered ? i : j)) {
    between(i, j, trees, visit);
  }
}

// The terrains among the patches below nodes of their tree, as a group of each patch.
std::vector<std::uint32_t> SurfacePatches::terrains(const Layout& layout, const BoxTree& tree) const {
  constexpr std::size_t kFew = 16;  // patches whose boxes are soon compared
  if (!kFastPaths || !surface_.points.moderate()) return {};
  Terrains terrains(surface_.points, stars_, surface_.triangles, monitor_);
  const bool are_triangles = layout.order.empty() && layout.patches.size() == surface_.triangles.size();
  std::vector<std::uint32_t> triangles;
  return tree.groups(kFew, [&](std::span<const std::uint32_t> patches) {
    if (are_triangles) return terrains.is_terrain(patches);
    triangles.clear();
    for (const std::uint32_t p : patches) {
      for (std::uint32_t t = layout.patches[p].first; t < layout.patches[p].last; ++t) {
        triangles.push_back(layout.triangle(t));
      }
    }
    return terrains.is_terrain(triangles);
  });
}

// The number of patches around each place.
std::vector<std::uint32_t> SurfacePatches::degrees(const Layout& layout) const {
  std::vector<std::uint32_t> degree(surface_.points.size(), 0);
  for (const Patch& patch : layout.patches) {
    for (const std::uint32_t place : corners(layout, patch)) ++degree[place];
  }
  return degree;
}

// Pairs of patches with overlapping boxes, but for many that have nothing in common besides a vertex of high degree.
class WideStars {
 public:
  WideStars(const SurfacePatches& patches, const SurfacePatches::Layout& layout)
      : patches_(patches), layout_(layout), star_of_(layout.patches.size(), kNone) {
    const std::vector<std::uint32_t> degree = patches.degrees(layout);
    if (std::none_of(degree.begin(), degree.end(), [](std::uint32_t d) { return d >= kWide; })) return;
    const MeshPoints& points = patches.surface_.points;
    for (std::size_t i = 0; i < 3; ++i) margin_ = std::max(margin_, points.margin(i));
    boxes_.reserve(layout.patches.size());
    for (const auto& patch : layout.patches) boxes_.push_back(patches.box(patches.corners(layout, patch)));
    std::vector<std::uint32_t> star_at(degree.size(), kNone);
    for (std::uint32_t p = 0; p < layout.patches.size(); ++p) {
      std::uint32_t centre = kNone;
      for (const std::uint32_t v : patches.corners(layout, layout.patches[p])) {
        if (degree[v] >= kWide && (centre == kNone || degree[v] > degree[centre])) centre = v;
      }
      if (centre == kNone) continue;
      if (star_at[centre] == kNone) {
        star_at[centre] = static_cast<std::uint32_t>(stars_.size());
        stars_.push_back({centre, {}, {}, DirectionTree(points.approximate(centre), margin_)});
      }
      join(p, star_at[centre]);
    }
    for (Star& star : stars_) star.directions.build();
  }

  using Pair = std::array<std::uint32_t, 2>;

  // Calls visit(i, j) at least once for each pair of patches that may have something in common beyond shared corners.
  template <typename Visit>
  void for_each_pair(const Visit& visit) const {
    const auto plain = [&](const BoxTree& tree, std::span<const std::uint32_t> groups, const auto& patch) {
      tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) { visit(patch(i), patch(j)); }, groups);
    };
    search(plain, visit);
  }

  // The same pairs, but for those that keep(i, j) says no to, on the threads of `monitor`; `keep` asks no predicates.
  // If there are `limit` or more, at least so many. The same for any number of threads.
  template <typename Keep>
  std::vector<Pair> pairs(std::size_t limit, const Keep& keep, const Monitor& monitor) const {
    std::vector<Pair> result;
    const auto plain = [&](const BoxTree& tree, std::span<const std::uint32_t> groups, const auto& patch) {
      constexpr std::size_t kBoxesOfPart = 2048;
      const BoxTree::PairSearch search(tree, groups, monitor);
      const std::vector<BoxTree::PairSearch::Part> parts = search.parts(tree.size() / kBoxesOfPart + 1);
      std::vector<std::vector<Pair>> found(parts.size());
      std::atomic<std::size_t> count = 0;  // so far, but for some of each part
      parallel_for(parts.size(), for_vertices(tree.size(), monitor), [&](std::size_t k, const Monitor&) {
        constexpr std::size_t kCountedAtOnce = 1024;
        search.for_each(parts[k], [&](std::uint32_t i, std::uint32_t j) {
          if (!keep(patch(i), patch(j)) || count.load(std::memory_order_relaxed) >= limit) return;
          found[k].push_back({patch(i), patch(j)});
          if (found[k].size() % kCountedAtOnce == 0) count.fetch_add(kCountedAtOnce, std::memory_order_relaxed);
        });
      });
      for (const std::vector<Pair>& part : found) result.insert(result.end(), part.begin(), part.end());
    };
    search(plain, [&](std::uint32_t i, std::uint32_t j) {
      if (result.size() < limit && keep(i, j)) result.push_back({i, j});
    });
    return result;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kWide = 64;  // patches around a vertex, whose pairs take longer than a tree

  struct Star {
    std::uint32_t centre = 0;
    Box box;
    std::vector<std::uint32_t> members;
    DirectionTree directions;
  };

  // plain(tree, groups, patch) is called for the patches that are told apart by their boxes: patch(i) is that of box i.
  template <typename Plain, typename Visit>
  void search(const Plain& plain_pairs, const Visit& visit) const {
    if (stars_.empty()) {
      const BoxTree tree = patches_.tree(layout_);
      plain_pairs(tree, patches_.terrains(layout_, tree), [](std::uint32_t i) { return i; });
      return;
    }
    std::vector<std::uint32_t> plain;
    std::vector<std::uint32_t> starred;
    for (std::uint32_t p = 0; p < boxes_.size(); ++p) (star_of_[p] == kNone ? plain : starred).push_back(p);
    const BoxTree plain_tree = tree_of(plain);
    const BoxTree starred_tree = tree_of(starred);
    plain_pairs(plain_tree, {}, [&](std::uint32_t i) { return plain[i]; });
    std::vector<std::uint32_t> found;
    for (std::uint32_t s = 0; s < stars_.size(); ++s) {
      plain_tree.for_each_overlap(stars_[s].box, [&](std::uint32_t i) { ask(s, plain[i], found, visit); });
      // Of a pair in one star the larger asks, of pairs in two, who is of the later one.
      starred_tree.for_each_overlap(stars_[s].box, [&](std::uint32_t i) {
        if (star_of_[starred[i]] >= s) ask(s, starred[i], found, visit);
      });
    }
  }

  [[nodiscard]] BoxTree tree_of(std::span<const std::uint32_t> patches) const {
    std::vector<Box> boxes;
    boxes.reserve(patches.size());
    for (const std::uint32_t p : patches) boxes.push_back(boxes_[p]);
    return BoxTree(boxes);
  }

  // Calls visit(polygon) for the triangles of a patch, without the corner `centre`, while it returns true.
  template <typename Visit>
  bool each_seen(std::uint32_t p, std::uint32_t centre, const Visit& visit) const {
    const auto& patch = layout_.patches[p];
    for (std::uint32_t i = patch.first; i < patch.last; ++i) {
      std::array<Double3, 3> polygon;
      std::size_t count = 0;
      for (const std::uint32_t v : patches_.surface_.triangles[layout_.triangle(i)]) {
        if (v != centre) polygon[count++] = patches_.surface_.points.approximate(v);
      }
      if (!visit(std::span<const Double3>(polygon).first(count))) return false;
    }
    return true;
  }

  void join(std::uint32_t p, std::uint32_t s) {
    Star& star = stars_[s];
    const auto sees = [&](std::span<const Double3> polygon) { return star.directions.sees(polygon); };
    const auto add = [&](std::span<const Double3> polygon) { return star.directions.add(p, polygon); };
    // All triangles or none: of several it is asked first.
    if (layout_.patches[p].size() > 1 && !each_seen(p, star.centre, sees)) return;
    if (!each_seen(p, star.centre, add)) return;
    star_of_[p] = s;
    star.members.push_back(p);
    star.box.add(boxes_[p]);
  }

  template <typename Visit>
  void ask(std::uint32_t s, std::uint32_t p, std::vector<std::uint32_t>& found, const Visit& visit) const {
    const Star& star = stars_[s];
    found.clear();
    const bool told = each_seen(p, star.centre,
                                [&](std::span<const Double3> polygon) { return star.directions.find(polygon, found); });
    if (!told) found = star.members;
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t q : found) {
      if ((star_of_[p] != s || q < p) && boxes_[p].overlaps(boxes_[q])) visit(std::min(p, q), std::max(p, q));
    }
  }

  const SurfacePatches& patches_;
  const SurfacePatches::Layout& layout_;
  double margin_ = 0;
  std::vector<Box> boxes_;              // of the patches
  std::vector<std::uint32_t> star_of_;  // of each patch; kNone if it is told apart by its box
  std::vector<Star> stars_;
};

void SurfacePatches::for_each_candidate(const Visit& visit) const {
  const Visit ordered = [&visit](std::uint32_t t, std::uint32_t u) { visit(std::min(t, u), std::max(t, u)); };
  for (const Patch& patch : faces_.patches) {
    if (!patch.proper) within(faces_, patch, ordered);
  }
  const std::size_t limit = kManyPairs * faces_.patches.size() + 1000;
  const bool are_triangles = faces_.patches.size() == surface_.triangles.size();  // all of them
  const auto is_open = [&](std::uint32_t i, std::uint32_t j) {
    if (are_triangles) return !stars_.settle(surface_.triangles[i], surface_.triangles[j]);
    const Patch& p = faces_.patches[i];
    const Patch& q = faces_.patches[j];
    return p.size() != 1 || q.size() != 1 || !stars_.settle(surface_.triangles[p.first], surface_.triangles[q.first]);
  };
  std::vector<WideStars::Pair> pairs = WideStars(*this, faces_).pairs(limit, is_open, monitor_);
  if (pairs.size() < limit) {
    PatchTrees trees(*this, faces_);
    for (const auto& [i, j] : pairs) visit_pair(i, j, trees, ordered);
    return;
  }
  pairs = {};
  const Layout layout = united();
  PatchTrees trees(*this, layout);
  WideStars(*this, layout).for_each_pair([&](std::uint32_t i, std::uint32_t j) { visit_pair(i, j, trees, ordered); });
}

}  // namespace nef
