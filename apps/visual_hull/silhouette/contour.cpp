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

namespace nef::visual_hull {
namespace {

// Directions +u, +v, -u, -v: bit d of a corner says that a side leaves it in direction d.
constexpr std::array<int, 4> kStepX{1, 0, -1, 0};
constexpr std::array<int, 4> kStepY{0, 1, 0, -1};

class Tracer {
 public:
  Tracer(const cv::Mat& mask, PixelOrigin origin, DiagonalPixels diagonal)
      : diagonal_(diagonal),
        width_(mask.cols + 1),
        height_(mask.rows + 1),
        shift_(origin == PixelOrigin::kCenter ? -0.5 : 0.0),
        out_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {
    collect_sides(mask);
  }

  std::vector<Ring> trace() {
    std::size_t corner = 0;
    while ((corner = next_with_sides(corner)) < out_.size()) {
      while (has_sides(corner)) diagonal_ == DiagonalPixels::kTouch ? walk_from(corner) : walk_joined(corner);
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

  // Set where two sides leave a corner, for good.
  static constexpr std::uint8_t kPinch = 16;
  static constexpr std::uint8_t kSides = 15;

  bool has_sides(std::size_t corner) const { return (out_[corner] & kSides) != 0; }
  bool is_pinch(std::size_t corner) const { return (out_[corner] & kPinch) != 0; }

  // The first corner from `corner` on that a side leaves; most words of eight corners have none.
  std::size_t next_with_sides(std::size_t corner) const {
    constexpr std::uint64_t kAnySide = 0x0f0f0f0f0f0f0f0f;
    while (corner + kWord <= out_.size() && (word_at(&out_[corner]) & kAnySide) == 0) corner += kWord;
    while (corner < out_.size() && !has_sides(corner)) ++corner;
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
    if (set && !above) add_side(corner(x, y), 1U);
    if (above && !set) add_side(corner(x + 1, y), 4U);
    if (left && !set) add_side(corner(x, y), 2U);
    if (set && !left) add_side(corner(x, y + 1), 8U);
  }

  void add_side(std::size_t corner, unsigned side) {
    std::uint8_t& out = out_[corner];
    out = static_cast<std::uint8_t>(out | side | (out != 0 ? kPinch : 0U));
  }

  // Only where a walk began, or two sides leave a corner, can it come by again.
  void walk_from(std::size_t start) {
    path_.assign(1, start);
    passed_.assign(1, {start, 0});
    std::size_t at = start;
    while (has_sides(at)) {
      unsigned direction = 0;
      while ((out_[at] >> direction & 1U) == 0) ++direction;
      out_[at] = static_cast<std::uint8_t>(out_[at] & ~(1U << direction));
      at = step(at, direction);
      if (at == start || is_pinch(at)) {
        const auto before =
            std::find_if(passed_.begin(), passed_.end(), [at](const Passed& passed) { return passed.corner == at; });
        if (before != passed_.end()) {
          cut_loop(before->place);
          passed_.erase(before + 1, passed_.end());
          continue;
        }
        passed_.push_back({at, path_.size()});
      }
      path_.push_back(at);
    }
  }

  std::size_t step(std::size_t at, unsigned direction) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + kStepX[direction] +
                                    static_cast<std::ptrdiff_t>(kStepY[direction]) * width_);
  }

  void push(Ring& ring, std::size_t at, double x, double y) const {
    const std::size_t row = at / static_cast<std::size_t>(width_);
    const std::size_t column = at % static_cast<std::size_t>(width_);
    ring.push_back(
        Point2::from_doubles(static_cast<double>(column) + shift_ + x, static_cast<double>(row) + shift_ + y));
  }

  // At a corner of two pixels the walk turns away from the one whose side it came along, to the other, and the corner
  // is passed a quarter of a pixel before and behind it. So no place is visited twice.
  void walk_joined(std::size_t start) {
    constexpr double kQuarter = 0.25;
    Ring ring;
    unsigned first = 0;
    while ((out_[start] >> first & 1U) == 0) ++first;
    std::size_t at = start;
    unsigned direction = first;
    do {
      out_[at] = static_cast<std::uint8_t>(out_[at] & ~(1U << direction));
      at = step(at, direction);
      const unsigned back = (direction + 2) % 4;
      const unsigned right = (direction + 3) % 4;
      if (is_pinch(at)) {
        push(ring, at, kQuarter * kStepX[back], kQuarter * kStepY[back]);
        push(ring, at, kQuarter * kStepX[right], kQuarter * kStepY[right]);
        direction = right;
      } else {
        unsigned next = first;  // at the start its side is gone
        if (at != start) {
          next = 0;
          while ((out_[at] >> next & 1U) == 0) ++next;
        }
        if (next != direction) push(ring, at, 0, 0);
        direction = next;
      }
    } while (at != start || direction != first);
    rings_.push_back(std::move(ring));
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
      push(ring, here, 0, 0);
    }
    rings_.push_back(std::move(ring));
    path_.resize(first + 1);
  }

  DiagonalPixels diagonal_;
  int width_;
  int height_;
  double shift_;
  std::vector<std::uint8_t> out_;
  struct Passed {
    std::size_t corner = 0;
    std::size_t place = 0;  // on the path
  };
  std::vector<Passed> passed_;  // the start and corners of two pixels, in the order of the path
  std::vector<std::size_t> path_;
  std::vector<Ring> rings_;
};

}  // namespace

Silhouette trace_contours(const cv::Mat& mask, PixelOrigin origin, DiagonalPixels diagonal,
                          const nef::Monitor& monitor) {
  CV_Assert(mask.type() == CV_8UC1);
  return nest(Tracer(mask, origin, diagonal).trace(), monitor);
}

bool touches_frame(const cv::Mat& mask) {
  if (mask.empty()) return false;
  return cv::countNonZero(mask.row(0)) > 0 || cv::countNonZero(mask.row(mask.rows - 1)) > 0 ||
         cv::countNonZero(mask.col(0)) > 0 || cv::countNonZero(mask.col(mask.cols - 1)) > 0;
}

}  // namespace nef::visual_hull
