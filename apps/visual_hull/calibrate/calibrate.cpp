// SPDX-License-Identifier: Apache-2.0
//
// Photographs -> corners of the board in each -> one lens -> a pose each -> without those that do not fit, lens and
// poses again -> the same by all borders between black and white, which need a camera to be found.
#include "apps/visual_hull/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>

#include "apps/visual_hull/calibrate/border_fit.h"
#include "apps/visual_hull/calibrate/find_board.h"
#include "apps/visual_hull/masks/measures.h"
#include "apps/visual_hull/masks/separation.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestCorners = 6;
constexpr std::size_t kFewestPlaced = 3;
constexpr double kCornerNoise = 1;  // pixels that corners of a good photograph may be off by
constexpr double kManyTimes = 3;    // the median error
constexpr int kCalibrationRounds = 3;
constexpr double kOnALine = 0.05;    // extent across over extent along
constexpr double kSureFocal = 0.01;  // standard deviation, as a share
constexpr double kOtherLens = 2;     // times the error of the series that the lens comes from
constexpr std::size_t kFewestBorders = 100;

/// Photographs with the corners that they show.
struct BoardSeries {
  std::vector<CalibratedView> views;
  std::vector<SeenBoard> seen;
  ImageSize size;

  [[nodiscard]] bool good(std::size_t i) const { return views[i].refused.empty(); }
  [[nodiscard]] std::vector<const SeenBoard*> boards() const {
    std::vector<const SeenBoard*> result;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (good(i)) result.push_back(&seen[i]);
    }
    return result;
  }
};

bool on_a_line(const SeenBoard& seen) {
  cv::Matx22d sum = cv::Matx22d::zeros();
  cv::Point2d middle;
  for (const cv::Point3d& p : seen.corners) middle += cv::Point2d(p.x, p.y) / static_cast<double>(seen.corners.size());
  for (const cv::Point3d& p : seen.corners) {
    const cv::Vec2d d(p.x - middle.x, p.y - middle.y);
    sum += d * d.t();
  }
  cv::Vec2d extents;
  cv::eigen(sum, extents);
  return extents[1] < kOnALine * kOnALine * extents[0];
}

// Why a photograph is of no use from the start; empty: it is.
std::string reason_to_refuse(const SeenBoard& seen, const cv::Size& size, const ImageSize& expected) {
  if (size.width != expected.width || size.height != expected.height) {
    return fmt::format("it has {} x {} pixels, the first photograph {} x {}", size.width, size.height, expected.width,
                       expected.height);
  }
  if (seen.points.empty()) return "no two markers of the board are seen";
  if (seen.points.size() < kFewestCorners) return fmt::format("it shows {} corners of the board", seen.points.size());
  if (on_a_line(seen)) return "it shows one row of corners";
  return "";
}

BoardSeries look_for_boards(const std::vector<fs::path>& photographs, const Board& board, const nef::Monitor& monitor) {
  BoardSeries series;
  series.views.resize(photographs.size());
  series.seen.resize(photographs.size());
  std::vector<cv::Size> sizes(photographs.size());
  nef::parallel_for(photographs.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const cv::Mat picture = read_picture(photographs[i]);
    sizes[i] = picture.size();
    series.seen[i] = find_board(picture, board);
  });
  if (!sizes.empty()) series.size = {sizes[0].width, sizes[0].height};
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    series.views[i].photograph = photographs[i];
    series.views[i].corners = series.seen[i].points.size();
    series.views[i].refused = reason_to_refuse(series.seen[i], sizes[i], series.size);
  }
  return series;
}

// Poses of all views that are left.
void place_views(BoardSeries& series, const Lens& lens) {
  for (std::size_t i = 0; i < series.views.size(); ++i) {
    if (!series.good(i)) continue;
    CalibratedView& view = series.views[i];
    const std::optional<BoardPose> found = pose_by_board(series.seen[i], lens);
    if (!found) {
      view.refused = "its corners fit no pose";
      continue;
    }
    view.pose = found->pose;
    view.error_px = found->error_px;
    view.corners = found->corners;
    view.off_px = found->off_px;
    if (found->ambiguous) view.refused = "two poses explain its corners: the board is too small in the picture";
  }
}

// Of the views that are left; 0 if there are none.
double median_error(const BoardSeries& series) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < series.views.size(); ++i) {
    if (series.good(i)) errors.push_back(series.views[i].error_px);
  }
  return errors.empty() ? 0 : median_of(std::move(errors));
}

// Refuses views that are off by far more than the others; whether there were any.
bool refuse_outliers(BoardSeries& series) {
  const double median = median_error(series);
  const double most = std::max(kCornerNoise, kManyTimes * median);
  bool any = false;
  for (CalibratedView& view : series.views) {
    if (!view.refused.empty() || view.error_px <= most) continue;
    view.refused =
        fmt::format("its corners are off by {:.2f} pixels, those of the others by {:.2f}", view.error_px, median);
    any = true;
  }
  return any;
}

std::string why_of_most(const BoardSeries& series) {
  for (const CalibratedView& view : series.views) {
    if (!view.refused.empty()) return view.photograph.string() + ": " + view.refused;
  }
  return "there are too few photographs";
}

// The boards that are left, enough of them.
std::vector<const SeenBoard*> enough_boards(const BoardSeries& series) {
  std::vector<const SeenBoard*> boards = series.boards();
  if (boards.size() < kFewestPlaced) {
    throw nef::InputError(
        fmt::format("the board is found in {} of {} photographs, {} are needed ({}); does --board say "
                    "what was printed?",
                    boards.size(), series.views.size(), kFewestPlaced, why_of_most(series)));
  }
  return boards;
}

// The lens of a series, and its poses.
BoardLens lens_of_series(BoardSeries& series) {
  BoardLens lens;
  for (int round = 0; round < kCalibrationRounds; ++round) {
    lens = fit_lens(enough_boards(series), series.size);
    if (!std::isfinite(lens.error_px)) {
      throw nef::InputError(
          "the boards fit no lens: take photographs that show the board tilted, in several directions");
    }
    place_views(series, lens.lens);
    if (!refuse_outliers(series)) break;
  }
  return lens;
}

double series_error(const BoardSeries& series) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < series.views.size(); ++i) {
    if (!series.good(i)) continue;
    const auto n = static_cast<double>(std::max(series.views[i].corners, series.views[i].borders));
    sum += n * series.views[i].error_px * series.views[i].error_px;
    count += n;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

/// What the lens and poses of some series are fitted to.
struct BorderSeries {
  std::vector<CalibratedView*> owners;
  std::vector<BorderView> views;
};

// The borders that the good photographs of a series show.
void find_series_borders(BoardSeries& series, const Board& board, const Lens& lens, const nef::Monitor& monitor,
                         BorderSeries& found) {
  const std::vector<BoardBorder> borders = board_borders(board);
  std::vector<BorderView> views(series.views.size());
  nef::parallel_for(series.views.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    if (!series.good(i)) return;
    cv::Mat gray;
    cv::cvtColor(read_picture(series.views[i].photograph), gray, cv::COLOR_BGR2GRAY);
    views[i].pose = series.views[i].pose;
    views[i].borders = find_borders(gray, borders, lens, views[i].pose);
  });
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].borders.size() < kFewestBorders) continue;
    found.owners.push_back(&series.views[i]);
    found.views.push_back(std::move(views[i]));
  }
}

// Poses, and the lens if it is the same for all, by borders.
void fit_series_borders(std::span<BoardSeries* const> together, const Board& board, BoardLens& lens, bool fit_the_lens,
                        const nef::Monitor& monitor) {
  BorderSeries found;
  for (BoardSeries* series : together) find_series_borders(*series, board, lens.lens, monitor, found);
  if (found.views.empty()) return;
  fit_borders(lens, found.views, fit_the_lens);
  for (std::size_t i = 0; i < found.views.size(); ++i) {
    CalibratedView& view = *found.owners[i];
    const BorderView& fitted = found.views[i];
    view.pose = fitted.pose;
    view.borders = fitted.kept;
    view.error_px = fitted.error_px;
    view.off_px = fitted.off_px;
  }
}

void note_refused(const std::vector<CalibratedView>& views, nef::Messages& notes) {
  for (const CalibratedView& view : views) {
    if (!view.refused.empty()) notes.push_back(view.photograph.string() + " is left out: " + view.refused);
  }
}

// Whether a lens explains photographs far worse than those of the series that it comes from.
nef::Messages note_of_other_lens(const BoardSeries& series, const BoardLens& lens) {
  const double error = median_error(series);  // a view or two may be worse for reasons of their own
  if (error <= kOtherLens * lens.error_px) return {};
  return {
      fmt::format("the lens of the other series explains the photographs to {:.2f} pixels, its own ones to "
                  "{:.2f}: were zoom and focus the same?",
                  error, lens.error_px)};
}

nef::Messages calibration_notes(const Calibration& calibration) {
  nef::Messages notes;
  note_refused(calibration.views, notes);
  note_refused(calibration.lens_views, notes);
  if (calibration.lens.centred) {
    notes.emplace_back(
        "the boards do not determine where the axis of the lens meets the image, so its middle is assumed; add "
        "photographs of the board at several tilts (--lens)");
  }
  if (calibration.lens.focal_share > kSureFocal) {
    notes.push_back(
        fmt::format("the focal length is known only to {:.1f} %; add photographs of the board at several tilts "
                    "(--lens)",
                    100 * calibration.lens.focal_share));
  }
  return notes;
}

}  // namespace

Scene Calibration::scene() const {
  Scene scene;
  scene.format = "calibration by a board";
  double squares = 0;
  for (const CalibratedView& view : views) {
    if (!view.refused.empty()) continue;
    scene.views.push_back(make_view(view.photograph.filename().string(), lens.lens, view.pose));
    scene.views.back().image = view.photograph;
    squares += view.off_px * view.off_px;
  }
  const double error = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, scene.views.size())));
  if (std::isfinite(error) && error > 0) scene.camera_error = error;
  return scene;
}

Calibration calibrate(const std::vector<fs::path>& photographs, const Board& board, const std::vector<fs::path>& lens,
                      const nef::Monitor& monitor) {
  Calibration calibration;
  BoardSeries series = look_for_boards(photographs, board, monitor);
  nef::Messages other_lens;
  if (lens.empty()) {
    calibration.lens = lens_of_series(series);
    fit_series_borders(std::vector{&series}, board, calibration.lens, true, monitor);
  } else {
    BoardSeries own = look_for_boards(lens, board, monitor);
    calibration.lens = lens_of_series(own);
    if (own.size.width != series.size.width || own.size.height != series.size.height) {
      throw nef::InputError(
          fmt::format("--lens: its photographs have {} x {} pixels, the others {} x {}: the same camera "
                      "is needed, at the same settings",
                      own.size.width, own.size.height, series.size.width, series.size.height));
    }
    place_views(series, calibration.lens.lens);
    refuse_outliers(series);
    other_lens = note_of_other_lens(series, calibration.lens);
    if (other_lens.empty()) {
      fit_series_borders(std::vector{&own, &series}, board, calibration.lens, true, monitor);
    } else {
      fit_series_borders(std::vector{&own}, board, calibration.lens, true, monitor);
      fit_series_borders(std::vector{&series}, board, calibration.lens, false, monitor);
    }
    calibration.lens_views = std::move(own.views);
  }
  enough_boards(series);
  calibration.error_px = series_error(series);
  calibration.views = std::move(series.views);
  calibration.notes = calibration_notes(calibration);
  calibration.notes.insert(calibration.notes.end(), other_lens.begin(), other_lens.end());
  return calibration;
}

}  // namespace nef::visual_hull
