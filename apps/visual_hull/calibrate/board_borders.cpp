// SPDX-License-Identifier: Apache-2.0
//
// Borders of a board: points of the sides of its tiles. How far it is black and white around them is read from a
// picture of the board. In a photograph: a profile of brightness across each border that is wide enough there.
#include "apps/visual_hull/calibrate/board_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "apps/visual_hull/calibrate/board_sheet.h"
#include "apps/visual_hull/calibrate/opencv_camera.h"
#include "apps/visual_hull/masks/separation.h"

namespace nef::visual_hull {
namespace {

constexpr double kMostPixels = 4000;  // of the picture that lengths are measured in, along its longer side
constexpr double kUsualPixels = 4;    // a millimetre
constexpr double kNearest = 2;        // pixels to the next border
constexpr double kFarthest = 3;       // pixels that are looked at on each side
constexpr double kStep = 0.25;        // pixels
constexpr int kSteps = static_cast<int>(kFarthest / kStep);
constexpr int kEnd = 3;                   // places at each end of a profile whose mean is black or white
constexpr double kLeastContrast = 20;     // of 255
constexpr double kShareOfContrast = 0.4;  // of the median contrast

/// The board as pixels, to see how far black and white reach.
class BoardPixels {
 public:
  explicit BoardPixels(const Board& board)
      : board_(board),
        pixels_(std::min(kUsualPixels, kMostPixels / (std::max(board.width(), board.height()) + 2 * board.square))),
        picture_(board_picture(board, pixels_)) {}

  // How far a property holds in a direction: a square at most, and none where it does not hold at once.
  template <typename Holds>
  [[nodiscard]] double reach(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Holds& holds) const {
    const double step = 1 / pixels_;
    double length = step;
    while (length < board_.square && holds(from + length * direction)) length += step;
    return length - step;
  }

  // Of a place in millimetres from the upper left corner, y down. All around the board is white.
  [[nodiscard]] bool black(const Eigen::Vector2d& p) const {
    const int x = static_cast<int>(std::floor((p.x() + board_.square) * pixels_));
    const int y = static_cast<int>(std::floor((p.y() + board_.square) * pixels_));
    return x >= 0 && y >= 0 && x < picture_.cols && y < picture_.rows && picture_.at<cv::Vec3b>(y, x)[0] == 0;
  }

  [[nodiscard]] double pixel() const { return 1 / pixels_; }

 private:
  const Board& board_;
  double pixels_;
  cv::Mat picture_;
};

// A place on the side of a tile, if it is on a border.
std::optional<BoardBorder> border_at(const BoardPixels& pixels, const Eigen::Vector2d& at, const Eigen::Vector2d& out) {
  const auto black = [&](const Eigen::Vector2d& p) { return pixels.black(p); };
  const auto white = [&](const Eigen::Vector2d& p) { return !pixels.black(p); };
  const Eigen::Vector2d aside = 1.5 * pixels.pixel() * out;
  const auto border = [&](const Eigen::Vector2d& p) { return black(p - aside) && white(p + aside); };
  if (!border(at)) return std::nullopt;
  const Eigen::Vector2d along(-out.y(), out.x());
  return BoardBorder{at, out, pixels.reach(at - aside, -out, black), pixels.reach(at + aside, out, white),
                     std::min(pixels.reach(at, along, border), pixels.reach(at, -along, border))};
}

/// Brightness across a border, from black to white.
struct Profile {
  std::size_t border = 0;
  cv::Point2d middle;
  cv::Vec2d direction;
  int first = 0, last = 0;  // of the steps -kSteps .. kSteps, those that are nearer than the next border
  std::array<float, 2 * kSteps + 1> values{};

  // Of a step in `values`.
  [[nodiscard]] static std::size_t place_of(int step) {
    const int place = step + kSteps;
    return static_cast<std::size_t>(place);
  }
  [[nodiscard]] double value(int step) const { return values[place_of(step)]; }
  [[nodiscard]] double mean(int from) const {
    double sum = 0;
    for (int i = from; i < from + kEnd; ++i) sum += value(i);
    return sum / kEnd;
  }
  [[nodiscard]] double contrast() const { return mean(last - kEnd + 1) - mean(first); }

  // Where it passes the middle of black and white, in pixels from `middle`; nothing if it does so more than once.
  [[nodiscard]] std::optional<double> place() const {
    const double half = (mean(first) + mean(last - kEnd + 1)) / 2;
    std::optional<double> found;
    for (int i = first; i < last; ++i) {
      const double here = value(i) - half;
      const double next = value(i + 1) - half;
      if ((here < 0) == (next < 0)) continue;
      if (found || next < here) return std::nullopt;
      found = kStep * (i + here / (here - next));
    }
    return found;
  }
};

// Where a camera sees the borders of a board and what it sees across them, without brightness.
std::vector<Profile> profiles_of(const std::vector<BoardBorder>& borders, const Lens& lens, const Pose& pose) {
  constexpr double kAside = 0.5;  // millimetres
  std::vector<cv::Point3d> places;
  for (const BoardBorder& b : borders) {
    const Eigen::Vector2d along(-b.to_white.y(), b.to_white.x());
    for (const Eigen::Vector2d& p :
         {b.at, Eigen::Vector2d(b.at + kAside * b.to_white), Eigen::Vector2d(b.at + kAside * along)}) {
      places.emplace_back(p.x(), p.y(), 0);
    }
  }
  const std::vector<cv::Point2d> seen = seen_points(places, lens, OpenCvPose::of(pose));
  std::vector<Profile> result;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const cv::Point2d at = seen[3 * i];
    const cv::Point2d out = (seen[3 * i + 1] - at) / kAside;
    const cv::Point2d along = (seen[3 * i + 2] - at) / kAside;
    const double scale = cv::norm(along);
    if (!(scale > 0) || borders[i].along * scale < kNearest) continue;
    // Across in the image; what is perpendicular on the board seldom is so in the image.
    cv::Vec2d direction(-along.y / scale, along.x / scale);
    double across = direction[0] * out.x + direction[1] * out.y;
    if (across < 0) direction = -direction;
    across = std::abs(across);
    const double black = std::min(kFarthest, across * borders[i].black);
    const double white = std::min(kFarthest, across * borders[i].white);
    if (!(black >= kNearest && white >= kNearest)) continue;
    result.push_back({i, at, direction, -static_cast<int>(black / kStep), static_cast<int>(white / kStep), {}});
  }
  return result;
}

// Brightness between the centres of pixels.
float brightness_at(const cv::Mat& gray, const cv::Vec2d& p) {
  const int x = static_cast<int>(std::floor(p[0]));
  const int y = static_cast<int>(std::floor(p[1]));
  const double u = p[0] - x;
  const double v = p[1] - y;
  const auto row = [&](int k) {
    return (1 - u) * gray.at<std::uint8_t>(y + k, x) + u * gray.at<std::uint8_t>(y + k, x + 1);
  };
  return static_cast<float>((1 - v) * row(0) + v * row(1));
}

void look_at(const cv::Mat& gray, Profile& profile) {
  for (int k = profile.first; k <= profile.last; ++k) {
    const cv::Vec2d p = cv::Vec2d(profile.middle.x, profile.middle.y) + kStep * k * profile.direction;
    profile.values[Profile::place_of(k)] = brightness_at(gray, p);
  }
}

bool inside(const cv::Mat& gray, const Profile& profile) {
  const double x = profile.middle.x;
  const double y = profile.middle.y;
  return x >= kFarthest && y >= kFarthest && x < gray.cols - 1 - kFarthest && y < gray.rows - 1 - kFarthest;
}

}  // namespace

std::vector<BoardBorder> board_borders(const Board& board) {
  const BoardPixels pixels(board);
  const double apart = board.marker / (board.bits + 2) / 2;
  std::vector<BoardBorder> borders;
  for (const BlackTile& tile : black_tiles(board)) {
    const Eigen::Vector2d size(tile.width, tile.height);
    const Eigen::Vector2d corner(tile.x, tile.y);
    for (const int axis : {0, 1}) {
      const int count = static_cast<int>(std::round(size[axis] / apart));
      for (const double side : {0.0, 1.0}) {
        Eigen::Vector2d out = Eigen::Vector2d::Zero();
        out[1 - axis] = 2 * side - 1;
        for (int i = 0; i < count; ++i) {
          Eigen::Vector2d at = corner;
          at[axis] += (i + 0.5) * size[axis] / count;
          at[1 - axis] += side * size[1 - axis];
          std::optional<BoardBorder> border = border_at(pixels, at, out);
          if (!border) continue;
          border->at = {at.x() - board.width() / 2, board.height() / 2 - at.y()};
          border->to_white.y() *= -1;
          borders.push_back(*border);
        }
      }
    }
  }
  return borders;
}

std::vector<SeenBorder> find_borders(const cv::Mat& gray, const std::vector<BoardBorder>& borders, const Lens& lens,
                                     const Pose& pose) {
  std::vector<Profile> profiles = profiles_of(borders, lens, pose);
  std::erase_if(profiles, [&](const Profile& p) { return !inside(gray, p); });
  std::vector<double> contrasts;
  for (Profile& p : profiles) {
    look_at(gray, p);
    contrasts.push_back(p.contrast());
  }
  std::vector<SeenBorder> seen;
  if (contrasts.empty()) return seen;
  const double least = std::max(kLeastContrast, kShareOfContrast * median_of(contrasts));
  for (const Profile& p : profiles) {
    if (p.contrast() < least) continue;
    const std::optional<double> place = p.place();
    if (!place) continue;
    const Eigen::Vector2d& at = borders[p.border].at;
    seen.push_back({{at.x(), at.y(), 0}, p.middle + cv::Point2d(*place * p.direction), p.direction});
  }
  return seen;
}

}  // namespace nef::visual_hull
