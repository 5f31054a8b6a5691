// SPDX-License-Identifier: Apache-2.0
//
// A slice is the complement of sums of convex pieces: those of a solid robot and of the obstacles are made once and
// only turned for a slice, a fifth of the time of `elbow`. Other robots, and bodies of many pieces, whose sum may be
// found without pieces, are summed whole for each slice. Points of a component are spread over its zones.
#include "apps/planner/rigid_search/slices.h"

#include <algorithm>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/orientation/rotations.h"
#include "nef/base/threads/parallel.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

constexpr std::size_t kMostPoints = 16;  // of a component

// The 24 rotations that permute the axes.
std::vector<Quaternion> rotations_of_cube() {
  std::vector<Quaternion> result{{1, 0, 0, 0}};
  std::vector<Quaternion> found = grid_neighbours(result.front(), 0);
  found.push_back({0, 1, 0, 0});
  found.push_back({0, 0, 1, 0});
  found.push_back({0, 0, 0, 1});
  for (std::size_t i = 1; i < 4; ++i) {  // half turns about diagonals of faces
    for (std::size_t j = i + 1; j < 4; ++j) {
      for (const int sign : {1, -1}) {
        Quaternion q{};
        q[i] = 1;
        q[j] = sign;
        found.push_back(q);
      }
    }
  }
  for (const Quaternion& q : found) {
    const auto zeros = std::count(q.begin(), q.end(), Rational(0));
    if (zeros != 1 && std::find(result.begin(), result.end(), q) == result.end()) result.push_back(q);
  }
  return result;
}

// Points far from each other, the first one being the first.
std::vector<std::size_t> spread(const std::vector<Vector3d>& points, std::size_t most) {
  std::vector<std::size_t> chosen{0};
  std::vector<double> away(points.size(), std::numeric_limits<double>::infinity());
  while (chosen.size() < std::min(most, points.size())) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      away[i] = std::min(away[i], (points[i] - points[chosen.back()]).squaredNorm());
    }
    chosen.push_back(static_cast<std::size_t>(std::max_element(away.begin(), away.end()) - away.begin()));
  }
  return chosen;
}

}  // namespace

std::size_t pairs_of(const MotionChecker& checker) {
  return checker.robot().pieces().size() * checker.obstacles().pieces().size();
}

std::optional<std::size_t> Slice::component_at(const Rational3& position) const {
  const CellId cell = free->locate(ExactPoint(position));
  if (!free->is_free(cell)) return std::nullopt;
  const std::uint32_t wanted = free->component(cell);
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].component == wanted) return i;
  }
  return std::nullopt;
}

Slices::Slices(const Scene& scene, const Monitor& monitor, bool are_light) : scene_(scene) {
  scene_.rotation.reset();
  scene_.turns_freely = false;
  scene_.start.reset();
  scene_.goal.reset();
  if (are_light && scene_.robot.is_regular()) {
    obstacles_ = fixed_obstacles(scene_, monitor);
    for (minkowski::ConvexCell& cell : minkowski::decompose(scene_.robot, monitor)) {
      if (cell.dimension == 3) pieces_.push_back(std::move(cell.mesh));
    }
    if (obstacles_->solid_count() * pieces_.size() > minkowski::kFewPairsOfPieces) obstacles_.reset();
  }
  const auto box = bounding_box(scene_.robot);
  const std::vector<Quaternion> rotations = rotations_of_cube();
  std::vector<char> is_symmetry(rotations.size(), 0);
  parallel_for(rotations.size(), monitor, [&](std::size_t i, const Monitor& own) {
    const Polyhedron turned = transform(scene_.robot, map_of({Rational3{}, rotations[i]}), own);
    is_symmetry[i] = bounding_box(turned) == box && equal(turned, scene_.robot) ? 1 : 0;
  });
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    if (is_symmetry[i] != 0) symmetries_.push_back(rotations[i]);
  }
}

Quaternion Slices::least_alike(const Quaternion& rotation) const {
  Quaternion smallest = rotation;
  for (const Quaternion& symmetry : symmetries_) {
    smallest = std::min(smallest, canonical(product(rotation, symmetry)));
  }
  return smallest;
}

const Quaternion& Slices::shared(const Quaternion& rotation) {
  const std::scoped_lock lock(mutex_);
  const auto [place, is_new] = shared_.try_emplace(rotation);
  if (is_new) place->second = least_alike(rotation);
  return place->second;
}

const Slice& Slices::at(const Quaternion& rotation, const Monitor& monitor, const std::function<bool()>& meanwhile) {
  const Quaternion& least = shared(rotation);
  return slices_.at(
      least, [&] { return made_at(least, monitor); }, meanwhile);
}

Polyhedron Slices::free_positions_at(const Quaternion& rotation, const Monitor& monitor) const {
  const AffineMap turn = map_of({Rational3{}, rotation});
  if (obstacles_) {
    std::vector<Mesh> turned = pieces_;
    for (Mesh& piece : turned) {
      for (Rational3& v : piece.vertices) v = turn(v);
    }
    return obstacles_->free_positions(turned, monitor);
  }
  Scene turned = scene_;
  turned.robot = transform(scene_.robot, turn, monitor);
  return free_positions(turned, monitor);
}

Slice Slices::made_at(const Quaternion& rotation, const Monitor& monitor) const {
  Slice slice;
  slice.free = std::make_shared<const FreeSpace>(free_positions_at(rotation, monitor));
  const FreeSpace& free = *slice.free;
  if (free.complex().vertex_count() == 0) {  // all of space or nothing
    const CellId all = free.locate(ExactPoint(Rational3{}));
    if (free.is_free(all)) slice.components.push_back({free.component(all), {Rational3{}}, {Vector3d(0, 0, 0)}, {}});
    return slice;
  }
  free.build_roadmap(monitor);
  const Roadmap& roadmap = free.roadmap();
  std::map<std::uint32_t, std::vector<ZoneId>> zones;
  const auto& leaves = free.tree().leaves();
  for (ZoneId zone = 0; zone < leaves.size(); ++zone) {
    const CellId cell = leaves[zone].cell;
    if (cell == kNoCell || leaves[zone].dimension != 3 || free.cells().dimension(cell) != 3) continue;
    if (free.is_free(cell)) zones[free.component(cell)].push_back(zone);
  }
  for (auto& [component, members] : zones) {
    SliceComponent& made = slice.components.emplace_back();
    made.component = component;
    constexpr std::size_t kMostZones = 256;
    const std::size_t skip = (members.size() + kMostZones - 1) / kMostZones;
    std::vector<Rational3> points;
    std::vector<Vector3d> rounded;
    for (std::size_t i = 0; i < members.size(); i += skip) {
      points.push_back(roadmap.interior_point(members[i]));
      rounded.push_back(to_vector(points.back()));
    }
    for (const std::size_t i : spread(rounded, kMostPoints)) {
      made.points.push_back(points[i]);
      made.rounded.push_back(rounded[i]);
    }
    made.zones = std::move(members);
  }
  return slice;
}

}  // namespace nef::planner
