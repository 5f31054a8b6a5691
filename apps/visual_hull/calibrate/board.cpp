// SPDX-License-Identifier: Apache-2.0
//
// Which squares are black, where markers lie and how corners are numbered is OpenCV's to say (board_definition), so
// what is printed is what is detected.
#include "apps/visual_hull/calibrate/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "apps/visual_hull/calibrate/board_definition.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"

namespace nef::visual_hull {
namespace {

constexpr std::array<int, 4> kFamilies{50, 100, 250, 1000};
constexpr int kFewestSquares = 3;
constexpr int kMostSquares = 40;
constexpr double kLongestBoard = 10000;  // millimetres

[[noreturn]] void refuse_board(const std::string& text, const std::string& why) {
  throw nef::InputError("--board " + nef::in_quotes(text) + ": " + why + "; write for example " + kUsualBoard);
}

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "30", "30mm", "3cm", ".03m", "1.2in" in millimetres.
std::optional<double> length_in(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits{
      {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"m", 1000}}};
  double unit = 1;
  for (const auto& [name, size] : kUnits) {
    if (!text.ends_with(name)) continue;
    unit = size;
    text.remove_suffix(name.size());
    break;
  }
  const std::optional<double> value = number_in<double>(text);
  if (!value || !(*value > 0) || !(*value * unit <= kLongestBoard)) return std::nullopt;
  return *value * unit;
}

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

void parse_dictionary(Board& board, const std::string& text, std::string_view name) {
  const bool form = name.size() >= 8 && name.starts_with("DICT_") && name[6] == 'X' && name[5] == name[7];
  board.bits = form ? name[5] - '0' : 0;
  if (board.bits < 4 || board.bits > 7)
    refuse_board(text, "the dictionary is DICT_4X4, DICT_5X5, DICT_6X6 or DICT_7X7");
  if (name.size() == 8) {
    const auto* const enough =
        std::find_if(kFamilies.begin(), kFamilies.end(), [&](int count) { return count >= board.markers(); });
    board.family = enough == kFamilies.end() ? kFamilies.back() : *enough;
    return;
  }
  const std::optional<int> count = name[8] == '_' ? number_in<int>(name.substr(9)) : std::nullopt;
  if (!count || std::find(kFamilies.begin(), kFamilies.end(), *count) == kFamilies.end()) {
    refuse_board(text, "a dictionary has 50, 100, 250 or 1000 markers, as in DICT_5X5_100");
  }
  board.family = *count;
}

}  // namespace

std::string Board::dictionary() const { return fmt::format("DICT_{0}X{0}_{1}", bits, family); }

std::string Board::text() const {
  return fmt::format("charuco:{}x{},{}mm,{}mm,{}", columns, rows, square, marker, dictionary());
}

Board parse_board(const std::string& text) {
  constexpr std::string_view kKind = "charuco:";
  if (!text.starts_with(kKind)) refuse_board(text, "only ChArUco boards are known");
  const std::vector<std::string> parts = parts_of(text.substr(kKind.size()));
  if (parts.size() != 4) refuse_board(text, "squares, their side, the markers' side and the dictionary are needed");
  const std::size_t times = parts[0].find('x');
  if (times == std::string::npos) refuse_board(text, "the squares are COLUMNSxROWS");
  const auto columns = number_in<int>(std::string_view(parts[0]).substr(0, times));
  const auto rows = number_in<int>(std::string_view(parts[0]).substr(times + 1));
  const auto fits = [](const std::optional<int>& n) { return n && *n >= kFewestSquares && *n <= kMostSquares; };
  if (!fits(columns) || !fits(rows)) {
    refuse_board(text, fmt::format("a board has {} to {} squares a side", kFewestSquares, kMostSquares));
  }
  const std::optional<double> square = length_in(parts[1]);
  const std::optional<double> marker = length_in(parts[2]);
  if (!square || !marker) refuse_board(text, "a length is a positive number and mm, cm, m or in, of 10 m at most");
  if (!(*marker < *square)) refuse_board(text, "markers are smaller than the squares that they lie in");
  Board board{*columns, *rows, *square, *marker, 0, 0};
  parse_dictionary(board, text, parts[3]);
  if (board.markers() > board.family) {
    refuse_board(text, fmt::format("it has {} markers, its dictionary {}", board.markers(), board.family));
  }
  return board;
}

cv::Ptr<cv::aruco::CharucoBoard> board_definition(const Board& board) {
  const auto family = std::find(kFamilies.begin(), kFamilies.end(), board.family) - kFamilies.begin();
  // OpenCV numbers its dictionaries by bits, then by markers.
  const int number = cv::aruco::DICT_4X4_50 + 4 * (board.bits - 4) + static_cast<int>(family);
  return cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square),
                                         static_cast<float>(board.marker), cv::aruco::getPredefinedDictionary(number));
}

std::vector<BlackTile> black_tiles(const Board& board) {
  std::vector<BlackTile> tiles;
  const auto definition = board_definition(board);
  const auto columns = static_cast<std::size_t>(board.columns);
  std::vector<bool> white(columns * static_cast<std::size_t>(board.rows), false);
  const auto square = [columns](int row, int column) {
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  };
  const double cell = board.marker / (board.bits + 2);
  for (std::size_t k = 0; k < definition->ids.size(); ++k) {
    // The first corner of a marker is its upper left one; OpenCV's y goes down.
    const cv::Point3f corner = definition->objPoints[k][0];
    const int column = static_cast<int>(corner.x / board.square);
    const int row = static_cast<int>(corner.y / board.square);
    white[square(row, column)] = true;
    const double margin = (board.square - board.marker) / 2;
    cv::Mat pattern;
    definition->dictionary->drawMarker(definition->ids[k], board.bits + 2, pattern);
    for (int y = 0; y < pattern.rows; ++y) {
      for (int x = 0; x < pattern.cols; ++x) {
        if (pattern.at<std::uint8_t>(y, x) != 0) continue;
        tiles.push_back(
            {column * board.square + margin + x * cell, row * board.square + margin + y * cell, cell, cell});
      }
    }
  }
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      if (white[square(row, column)]) continue;
      tiles.push_back({column * board.square, row * board.square, board.square, board.square});
    }
  }
  return tiles;
}

std::vector<Eigen::Vector3d> board_corners(const Board& board) {
  const auto definition = board_definition(board);
  std::vector<Eigen::Vector3d> corners;
  for (const cv::Point3f& p : definition->chessboardCorners) {
    // In doubles from the number of the square, since OpenCV keeps floats.
    const double column = std::round(p.x / board.square);
    const double row = std::round(p.y / board.square);
    corners.emplace_back(column * board.square - board.width() / 2, board.height() / 2 - row * board.square, 0);
  }
  return corners;
}

}  // namespace nef::visual_hull
