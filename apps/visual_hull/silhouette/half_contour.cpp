// SPDX-License-Identifier: Apache-2.0
//
// A square has centres of pixels as corners. Each run of corners that are object, in the order right around, gives a
// segment from the side behind the run to the side before it, so the object lies to the left; each side where object
// and background meet has one segment that comes and one that goes. Segments of one square do not cross: the one at a
// corner stays on its side of the diagonal between the two neighbours, since no vertex lies in a corner.
#include "apps/visual_hull/silhouette/half_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <unordered_map>

#include "apps/visual_hull/silhouette/opacity.h"

namespace nef::visual_hull {
namespace {

/// A side of squares: from a centre to the next one to the right, or below. Centres are counted in the padded image.
struct SquareSide {
  int x = 0;
  int y = 0;
  bool down = false;
};

class HalfTracer {
 public:
  HalfTracer(const cv::Mat& opacity, PixelOrigin origin) : shift_(origin == PixelOrigin::kCenter ? -1 : -0.5) {
    cv::copyMakeBorder(opacity, opacity_, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    for (int y = 0; y + 1 < opacity_.rows; ++y) {
      const auto* here = opacity_.ptr<std::uint8_t>(y);
      const auto* below = opacity_.ptr<std::uint8_t>(y + 1);
      for (int x = 0; x + 1 < opacity_.cols; ++x) add_square(x, y, {here[x], here[x + 1], below[x + 1], below[x]});
    }
  }

  std::vector<Ring> trace() {
    std::vector<Ring> rings;
    for (const std::uint64_t first : starts_) {
      auto found = next_.find(first);
      if (found == next_.end()) continue;  // of a ring that is there already
      Ring ring;
      while (found != next_.end()) {
        ring.push_back(vertex(side_of(found->first)));
        const std::uint64_t after = found->second;
        next_.erase(found);
        found = next_.find(after);
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  [[nodiscard]] std::uint64_t key(const SquareSide& side) const {
    return 2 * (static_cast<std::uint64_t>(side.y) * static_cast<std::uint64_t>(opacity_.cols) +
                static_cast<std::uint64_t>(side.x)) +
           (side.down ? 1 : 0);
  }

  [[nodiscard]] SquareSide side_of(std::uint64_t key) const {
    const auto columns = static_cast<std::uint64_t>(opacity_.cols);
    return {static_cast<int>(key / 2 % columns), static_cast<int>(key / 2 / columns), key % 2 == 1};
  }

  // Corners from the upper left one to the right around; side k goes from corner k to the next one.
  void add_square(int x, int y, const std::array<int, 4>& corners) {
    std::array<bool, 4> object{};
    int count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      object[k] = corners[k] >= kObjectOpacity;
      count += object[k] ? 1 : 0;
    }
    if (count == 0 || count == 4) return;
    const std::array<SquareSide, 4> sides{{{x, y, false}, {x + 1, y, true}, {x, y + 1, false}, {x, y, true}}};
    const bool crossing = count == 2 && object[0] == object[2];
    const bool joined = crossing && 2 * (corners[0] + corners[1] + corners[2] + corners[3]) >= 4 * 255;
    for (std::size_t k = 0; k < 4; ++k) {  // a run begins at corner k
      if (!object[k] || object[(k + 3) % 4]) continue;
      std::size_t last = k;
      while (object[(last + 1) % 4]) last = (last + 1) % 4;
      // Joined runs are cut apart along the two corners between them: from behind one run to before the next.
      const std::size_t before = joined ? (last + 1) % 4 : (k + 3) % 4;
      const std::uint64_t from = key(sides[last]);
      next_.emplace(from, key(sides[before]));
      starts_.push_back(from);
    }
  }

  [[nodiscard]] Point2 vertex(const SquareSide& side) const {
    const int a = opacity_.at<std::uint8_t>(side.y, side.x);
    const int b = opacity_.at<std::uint8_t>(side.y + (side.down ? 1 : 0), side.x + (side.down ? 0 : 1));
    constexpr double kParts = 256;
    const double part = std::clamp(std::round(kParts * (2 * a - 255) / (2 * (a - b))), 1.0, kParts - 1) / kParts;
    return Point2::from_doubles(side.x + shift_ + (side.down ? 0 : part), side.y + shift_ + (side.down ? part : 0));
  }

  cv::Mat opacity_;
  double shift_;
  std::unordered_map<std::uint64_t, std::uint64_t> next_;  // side -> side
  std::vector<std::uint64_t> starts_;                      // as they were found, so that rings are in one order
};

}  // namespace

Silhouette trace_half_contours(const cv::Mat& opacity, PixelOrigin origin, const nef::Monitor& monitor) {
  CV_Assert(opacity.type() == CV_8UC1);
  return nest(HalfTracer(opacity, origin).trace(), monitor);
}

}  // namespace nef::visual_hull
