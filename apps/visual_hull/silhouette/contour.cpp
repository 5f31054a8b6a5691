// SPDX-License-Identifier: Apache-2.0
//
// A pixel's four sides are directed so that the pixel is to the left; sides between two set pixels
// cancel. What is left is a balanced directed graph on the corners of the pixels. A walk through
// it that cuts off a loop whenever it comes back to a corner gives simple rings, whatever the walk.
#include "apps/visual_hull/silhouette/contour.h"

#include <cstdint>

namespace visual_hull {
namespace {

// Directions +u, +v, -u, -v: bit d of a corner says that a side leaves it in direction d.
constexpr std::array<int, 4> kStepX{1, 0, -1, 0};
constexpr std::array<int, 4> kStepY{0, 1, 0, -1};

class Tracer {
 public:
  Tracer(const cv::Mat& mask, PixelOrigin origin)
      : width_(mask.cols + 1),
        height_(mask.rows + 1),
        shift_(origin == PixelOrigin::kCenter ? -0.5 : 0.0),
        out_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0),
        position_(out_.size(), -1) {
    collect_sides(mask);
  }

  std::vector<Ring> trace() {
    for (std::size_t corner = 0; corner < out_.size(); ++corner) {
      while (out_[corner] != 0) walk_from(corner);
    }
    return std::move(rings_);
  }

 private:
  std::size_t corner(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  void collect_sides(const cv::Mat& mask) {
    const auto set = [&mask](int x, int y) {
      return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask.at<std::uint8_t>(y, x) != 0;
    };
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        if (!set(x, y)) continue;
        if (!set(x, y - 1)) out_[corner(x, y)] |= 1U;
        if (!set(x + 1, y)) out_[corner(x + 1, y)] |= 2U;
        if (!set(x, y + 1)) out_[corner(x + 1, y + 1)] |= 4U;
        if (!set(x - 1, y)) out_[corner(x, y + 1)] |= 8U;
      }
    }
  }

  void walk_from(std::size_t start) {
    path_.assign(1, start);
    position_[start] = 0;
    std::size_t at = start;
    while (out_[at] != 0) {
      unsigned direction = 0;
      while ((out_[at] >> direction & 1U) == 0) ++direction;
      out_[at] = static_cast<std::uint8_t>(out_[at] & ~(1U << direction));
      at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + kStepX[direction] +
                                    static_cast<std::ptrdiff_t>(kStepY[direction]) * width_);
      if (position_[at] < 0) {
        position_[at] = static_cast<std::int64_t>(path_.size());
        path_.push_back(at);
      } else {
        cut_loop(static_cast<std::size_t>(position_[at]));
      }
    }
    position_[start] = -1;
  }

  // The corners from `first` on are a simple cycle; only `first` stays on the path.
  void cut_loop(std::size_t first) {
    const std::size_t n = path_.size() - first;
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = path_[first + (i + n - 1) % n];
      const std::size_t here = path_[first + i];
      const std::size_t after = path_[first + (i + 1) % n];
      if (after - here == here - before) continue;  // straight on; wraps around alike for negative steps
      const std::size_t row = here / static_cast<std::size_t>(width_);
      const std::size_t column = here % static_cast<std::size_t>(width_);
      ring.push_back(Point2::from_doubles(static_cast<double>(column) + shift_, static_cast<double>(row) + shift_));
    }
    rings_.push_back(std::move(ring));
    for (std::size_t i = first + 1; i < path_.size(); ++i) position_[path_[i]] = -1;
    path_.resize(first + 1);
  }

  int width_;
  int height_;
  double shift_;
  std::vector<std::uint8_t> out_;
  std::vector<std::int64_t> position_;  // on the path, -1 if not
  std::vector<std::size_t> path_;
  std::vector<Ring> rings_;
};

}  // namespace

Silhouette trace_contours(const cv::Mat& mask, PixelOrigin origin) {
  CV_Assert(mask.type() == CV_8UC1);
  return nest(Tracer(mask, origin).trace());
}

bool touches_frame(const cv::Mat& mask) {
  if (mask.empty()) return false;
  return cv::countNonZero(mask.row(0)) > 0 || cv::countNonZero(mask.row(mask.rows - 1)) > 0 ||
         cv::countNonZero(mask.col(0)) > 0 || cv::countNonZero(mask.col(mask.cols - 1)) > 0;
}

}  // namespace visual_hull
