// SPDX-License-Identifier: Apache-2.0
//
// A pixel's four sides are directed so that the pixel is to the left; sides between two set pixels
// cancel. What is left is a balanced directed graph on the corners of the pixels. A walk through
// it that cuts off a loop whenever it comes back to a corner gives simple rings, whatever the walk.
#include "apps/visual_hull/silhouette/contour.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <opencv2/imgproc.hpp>

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
    std::size_t corner = 0;
    while ((corner = next_with_sides(corner)) < out_.size()) {
      while (out_[corner] != 0) walk_from(corner);
    }
    return std::move(rings_);
  }

 private:
  static constexpr std::size_t kWord = sizeof(std::uint64_t);

  std::size_t corner(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  static std::uint64_t word_at(const std::uint8_t* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return word;
  }

  // The first corner from `corner` on that a side leaves; most words of eight corners have none.
  std::size_t next_with_sides(std::size_t corner) const {
    while (corner + kWord <= out_.size() && word_at(&out_[corner]) == 0) corner += kWord;
    while (corner < out_.size() && out_[corner] == 0) ++corner;
    return corner;
  }

  // A corner has a side where its pixel differs from the one above or to the left of it. Pixels are compared eight at a
  // time: few differ.
  void collect_sides(const cv::Mat& mask) {
    cv::Mat padded;  // 0 or 255, with a frame of zeros, and so wide that the last word of a row ends in it
    cv::copyMakeBorder(mask != 0, padded, 1, 1, 1, static_cast<int>(kWord), cv::BORDER_CONSTANT, cv::Scalar(0));
    for (int y = 0; y < height_; ++y) {
      const auto* above = padded.ptr<std::uint8_t>(y) + 1;
      const auto* here = padded.ptr<std::uint8_t>(y + 1) + 1;
      for (int x = 0; x < width_; x += static_cast<int>(kWord)) {
        const std::uint64_t word = word_at(here + x);
        if (((word ^ word_at(above + x)) | (word ^ word_at(here + x - 1))) == 0) continue;
        const int end = std::min(x + static_cast<int>(kWord), width_);
        for (int i = x; i < end; ++i) add_sides(i, y, here[i] != 0, above[i] != 0, here[i - 1] != 0);
      }
    }
  }

  // The sides above and to the left of pixel (x, y).
  void add_sides(int x, int y, bool set, bool above, bool left) {
    if (set && !above) out_[corner(x, y)] |= 1U;
    if (above && !set) out_[corner(x + 1, y)] |= 4U;
    if (left && !set) out_[corner(x, y)] |= 2U;
    if (set && !left) out_[corner(x, y + 1)] |= 8U;
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
        position_[at] = static_cast<std::int32_t>(path_.size());
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
  std::vector<std::int32_t> position_;  // on the path, -1 if not
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
